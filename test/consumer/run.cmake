# Installs the build tree to a fresh prefix, builds a user's project and the examples against it, and
# runs them; then compares the example of README.md with what was compiled.
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/test/consumer -B ${WORK}/build -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS} -Dstorey_ROOT=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/readme_example)
run(${WORK}/build/foreign_point)

run(${CMAKE_COMMAND} -S ${SOURCE}/apps/examples -B ${WORK}/examples -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS} -Dstorey_ROOT=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/examples)
set(programs ${WORK}/prefix/bin)
if(EXISTS ${programs}/storey_synth)
  run(${programs}/storey_synth two_towers -o ${WORK}/cloud.ply)
  run(${WORK}/examples/planar_points ${WORK}/cloud.ply)
  run(${WORK}/examples/five_classes ${WORK}/cloud.ply ${WORK}/model.vtk)
  run(${WORK}/examples/floorplans ${WORK}/cloud.ply)
  run(${WORK}/examples/own_point_type ${WORK}/cloud.ply)
endif()

file(READ ${SOURCE}/test/consumer/readme_example.cpp example)
string(REGEX MATCH "// README begin\n(.*)// README end" found "${example}")
set(example "${CMAKE_MATCH_1}")
file(READ ${SOURCE}/README.md readme)
string(FIND "${readme}" "```cpp\n${example}```" position)
if(position EQUAL -1)
  message(FATAL_ERROR "the example of README.md is not the one that was compiled")
endif()

# So must be the tutorial's lines, in their order.
file(READ ${SOURCE}/apps/examples/five_classes.cpp rest)
file(READ ${SOURCE}/doc/tutorial.md tutorial)
while(tutorial MATCHES "```cpp\n")
  string(FIND "${tutorial}" "```cpp\n" start)
  math(EXPR start "${start} + 7")
  string(SUBSTRING "${tutorial}" ${start} -1 tutorial)
  string(FIND "${tutorial}" "```" length)
  string(SUBSTRING "${tutorial}" 0 ${length} lines)
  string(FIND "${rest}" "${lines}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "not in apps/examples/five_classes.cpp, or out of order:\n${lines}")
  endif()
  string(SUBSTRING "${rest}" ${position} -1 rest)
endwhile()
