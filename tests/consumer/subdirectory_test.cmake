# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=... -DWORK=... -DCXX=... -DFRAMES_PROGRAM=... -P subdirectory_test.cmake
# README's project with Glint fetched as a part of itself, in place of find_package: FetchContent is
# add_subdirectory on a folder that is there. The library is built without optimisation, to be quick.
include(${SOURCE}/readme.cmake)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
get_filename_component(glint ${SOURCE}/../.. ABSOLUTE)
write_readme_project(${WORK}/readme "find_package[^\n]*"
  "include(FetchContent)\nFetchContent_Declare(glint SOURCE_DIR ${glint})\nFetchContent_MakeAvailable(glint)")
run(${FRAMES_PROGRAM} ${WORK}/frames.raw)
find_program(ninja ninja)
if(ninja)
  set(generator -G Ninja)
endif()
run(${CMAKE_COMMAND} ${generator} -S ${WORK}/readme -B ${WORK}/build -DCMAKE_CXX_COMPILER=${CXX}
  -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=-O0 ${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2 --target track)
run_readme(${WORK}/build ${WORK}/frames.raw tracks)
message(STATUS "README as a subdirectory:\n${tracks}")
