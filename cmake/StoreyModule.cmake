# storey_add_module(name SOURCES ... PUBLIC_LINKS ... PRIVATE_LINKS ...)
# One library storey_<name>, exported as storey::<name> in an export set of its own, so that
# find_package(storey COMPONENTS <name>) loads no more than it needs.
function(storey_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC_LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(storey_${name} ${ARG_SOURCES})
  add_library(storey::${name} ALIAS storey_${name})
  set_target_properties(storey_${name} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION})
  target_compile_features(storey_${name} PUBLIC cxx_std_17)
  target_include_directories(storey_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  # OpenMP is PUBLIC: the pragmas live in headers and would be ignored silently in a consumer.
  target_link_libraries(storey_${name}
    PUBLIC ${ARG_PUBLIC_LINKS} OpenMP::OpenMP_CXX
    PRIVATE $<BUILD_INTERFACE:storey_warnings> ${ARG_PRIVATE_LINKS})
  install(TARGETS storey_${name} EXPORT storey-${name}-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT storey-${name}-targets NAMESPACE storey::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/storey)
endfunction()
