# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=... -DWORK=... -DCXX=... -DLIBRARY=... -DTBB=... -DFRAMES_PROGRAM=... [-DWHOLE=ON]
#   -P subdirectory_test.cmake
# README's project with Glint fetched as a part of itself, in place of find_package: FetchContent is
# add_subdirectory on a folder that is there. By each compiler there is and under flags of the program's
# own the program is compiled, linked with LIBRARY, the libglint.a of the build that the test belongs to
# (the same sources, built once) and TBB, and run. With WHOLE, by CXX, the project builds its own library,
# without optimisation: three minutes of CPU.
include(${SOURCE}/readme.cmake)
include(${SOURCE}/run.cmake)

file(REMOVE_RECURSE ${WORK})
get_filename_component(glint ${SOURCE}/../.. ABSOLUTE)
write_readme_project(${WORK}/readme "find_package[^\n]*"
  "include(FetchContent)\nFetchContent_Declare(glint SOURCE_DIR ${glint})\nFetchContent_MakeAvailable(glint)")
find_program(ninja ninja REQUIRED)
set(compilers ${CXX})
find_program(clang clang++)
if(clang)
  list(APPEND compilers ${clang})
endif()

# configured(COMPILER FLAGS BUILD [more options])
function(configured compiler flags build)
  run(${CMAKE_COMMAND} -G Ninja -S ${WORK}/readme -B ${build} -DCMAKE_CXX_COMPILER=${compiler}
    -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${flags}" ${ARGN})
endfunction()

run(${FRAMES_PROGRAM} ${WORK}/frames.raw)
foreach(compiler IN LISTS compilers)
  foreach(flags "" -march=native)
    get_filename_component(name ${compiler} NAME)
    set(build ${WORK}/${name}${flags})
    configured(${compiler} "${flags}" ${build})
    run(${ninja} -C ${build} CMakeFiles/track.dir/main.cpp.o)
    run(${compiler} ${build}/CMakeFiles/track.dir/main.cpp.o ${LIBRARY} ${TBB} -ldl -pthread -o ${build}/track)
    run_readme(${build} ${WORK}/frames.raw tracks)
    if(DEFINED first AND NOT tracks STREQUAL first)
      message(FATAL_ERROR "other tracks by ${name} ${flags}:\n${tracks}\nthan by the first:\n${first}")
    endif()
    set(first "${tracks}")
    message(STATUS "README as a subdirectory by ${name} ${flags}: the same tracks")
  endforeach()
endforeach()

if(WHOLE)
  configured(${CXX} -O0 ${WORK}/linked)
  run(${ninja} -C ${WORK}/linked track)
  run_readme(${WORK}/linked ${WORK}/frames.raw tracks)
  message(STATUS "README as a subdirectory:\n${tracks}")
endif()
