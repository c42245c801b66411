# SPDX-License-Identifier: Apache-2.0
# A build of the fuzzers and nothing else. What reads the bytes is built here, and watched; the
# engine behind it is tested elsewhere, would be slow, and is taken as another build has made it,
# unless GLINT_FUZZ_ENGINE asks for one that is watched too: checkpoints are read by the engine.
option(GLINT_FUZZ_ENGINE "build the engine under the fuzzers' sanitizers" OFF)
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "GLINT_BUILD_FUZZERS needs clang: cmake --preset fuzz")
endif()

# float-cast-overflow is not among "undefined", and is how a number from a file breaks an index.
string(APPEND CMAKE_CXX_FLAGS " -fsanitize=address,undefined,float-cast-overflow"
  " -fno-sanitize-recover=all -fno-omit-frame-pointer -fsanitize=fuzzer-no-link")
if(GLINT_FUZZ_ENGINE)
  add_library(glint STATIC)
  target_link_libraries(glint PUBLIC glint_settings TBB::tbb Eigen3::Eigen ${CMAKE_DL_LIBS})
  add_subdirectory(kernels)
  add_subdirectory(engine)
else()
  set(GLINT_LIBRARY ${PROJECT_SOURCE_DIR}/build/release/libglint.a CACHE FILEPATH
    "libglint.a of this source, built without sanitizers")
  if(NOT EXISTS ${GLINT_LIBRARY})
    message(FATAL_ERROR "there is no ${GLINT_LIBRARY}: run scripts/build release glint, or set "
      "-DGLINT_LIBRARY=...")
  endif()
  add_library(glint STATIC IMPORTED GLOBAL)
  set_target_properties(glint PROPERTIES IMPORTED_LOCATION ${GLINT_LIBRARY})
  target_link_libraries(glint INTERFACE glint_settings TBB::tbb Eigen3::Eigen ${CMAKE_DL_LIBS})
endif()
add_subdirectory(frontends)
add_subdirectory(tests/fuzz)
