# SPDX-License-Identifier: Apache-2.0
# The fuzzers as programs, by clang's libFuzzer.
foreach(name IN LISTS fuzzers)
  add_executable(fuzz_${name} ${name}.cpp)
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  target_link_libraries(fuzz_${name} PRIVATE glint_files glint_fits glint_c_objects)
endforeach()
