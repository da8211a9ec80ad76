# storey_add_module(name REQUIRES modules... SOURCES ... PUBLIC_LINKS ... PRIVATE_LINKS ...)
# One library storey_<name>, exported as storey::<name> in an export set of its own, so that
# find_package(storey COMPONENTS <name>) loads no more than it needs, and storey_<name>.pc for
# builds without CMake. REQUIRES names the modules that it is built on.
function(storey_add_module name)
  cmake_parse_arguments(ARG "" "" "REQUIRES;SOURCES;PUBLIC_LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(storey_${name} ${ARG_SOURCES})
  add_library(storey::${name} ALIAS storey_${name})
  # Before 1.0 every minor version may change the binary interface.
  set_target_properties(storey_${name} PROPERTIES EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(storey_${name} PUBLIC cxx_std_17)
  # Calls within a library are not to be replaced from outside: they may be inlined.
  target_compile_options(storey_${name} PRIVATE -fno-semantic-interposition)
  target_include_directories(storey_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_REQUIRES PREPEND storey:: OUTPUT_VARIABLE modules)
  # OpenMP is PUBLIC: the pragmas live in headers and would be ignored silently in a consumer.
  target_link_libraries(storey_${name}
    PUBLIC ${modules} ${ARG_PUBLIC_LINKS} OpenMP::OpenMP_CXX
    PRIVATE $<BUILD_INTERFACE:storey_warnings> ${ARG_PRIVATE_LINKS})
  install(TARGETS storey_${name} EXPORT storey-${name}-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
      COMPONENT runtime NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT storey-${name}-targets NAMESPACE storey::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/storey COMPONENT development)

  list(TRANSFORM ARG_REQUIRES PREPEND storey_ OUTPUT_VARIABLE storey_packages)
  list(FILTER ARG_PUBLIC_LINKS INCLUDE REGEX "^pcl_")
  list(JOIN storey_packages " " PC_STOREY)
  list(JOIN ARG_PUBLIC_LINKS " " PC_PCL)
  set(PC_NAME ${name})
  # Relative to the file itself: an installed tree may be moved.
  file(RELATIVE_PATH PC_INCLUDE ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/storey.pc.in storey_${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/storey_${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()
