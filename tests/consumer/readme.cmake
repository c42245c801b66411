# SPDX-License-Identifier: Apache-2.0
# The C++ example of README.md as a project.

# readme_block(LANGUAGE OUT): the first block of README.md that begins with ```LANGUAGE and names glint.
function(readme_block language out)
  file(READ ${SOURCE}/../../README.md text)
  string(FIND "${text}" "```${language}\n" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "README.md has no block of ${language}")
  endif()
  string(LENGTH "```${language}\n" fence)
  math(EXPR at "${at} + ${fence}")
  string(SUBSTRING "${text}" ${at} -1 text)
  string(FIND "${text}" "```" end)
  string(SUBSTRING "${text}" 0 ${end} text)
  if(NOT text MATCHES "glint")
    message(FATAL_ERROR "README.md's first block of ${language} is not Glint's example:\n${text}")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

# write_readme_project(FOLDER [FIND REPLACEMENT]): main.cpp and CMakeLists.txt, whose line that matches
# FIND becomes REPLACEMENT.
function(write_readme_project folder)
  readme_block(cpp program)
  readme_block(cmake project)
  string(REGEX MATCHALL "\n" lines "${program}")
  list(LENGTH lines count)
  if(count GREATER 12)
    message(FATAL_ERROR "README.md's C++ example has ${count} lines, more than 12")
  endif()
  if(ARGC GREATER 1)
    string(REGEX REPLACE "${ARGV1}" "${ARGV2}" project "${project}")
  endif()
  file(WRITE ${folder}/main.cpp "${program}")
  file(WRITE ${folder}/CMakeLists.txt "${project}")
endfunction()

# run_readme(BUILD FRAMES OUT): what the program prints of the frames, which must be tracks.
function(run_readme build frames out)
  execute_process(COMMAND ${build}/track INPUT_FILE ${frames} RESULT_VARIABLE failed OUTPUT_VARIABLE tracks
    ERROR_VARIABLE error)
  if(failed OR NOT tracks MATCHES "^[0-9]+ [0-9.]+ [0-9.]+\n")
    message(FATAL_ERROR "README's program in ${build}: ${failed}\n${tracks}${error}")
  endif()
  set(${out} "${tracks}" PARENT_SCOPE)
endfunction()
