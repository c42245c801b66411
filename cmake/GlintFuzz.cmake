# SPDX-License-Identifier: Apache-2.0
# A build of the fuzzers and nothing else. What reads the bytes is built here, and watched; the
# engine behind it is tested elsewhere, would be slow, and is taken as another build has made it.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "GLINT_BUILD_FUZZERS needs clang: cmake --preset fuzz")
endif()
set(GLINT_LIBRARY ${PROJECT_SOURCE_DIR}/build/release/libglint.a CACHE FILEPATH
  "libglint.a of this source, built without sanitizers")
if(NOT EXISTS ${GLINT_LIBRARY})
  message(FATAL_ERROR "there is no ${GLINT_LIBRARY}: run scripts/build release glint, or set "
    "-DGLINT_LIBRARY=...")
endif()
add_library(glint STATIC IMPORTED GLOBAL)
set_target_properties(glint PROPERTIES IMPORTED_LOCATION ${GLINT_LIBRARY})
target_link_libraries(glint INTERFACE glint_settings TBB::tbb Eigen3::Eigen ${CMAKE_DL_LIBS})

# float-cast-overflow is not among "undefined", and is how a number from a file breaks an index.
set(watch -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all
  -fno-omit-frame-pointer)
add_compile_options(${watch} -fsanitize=fuzzer-no-link)
add_link_options(${watch})
add_subdirectory(frontends)
add_subdirectory(tests/fuzz)
