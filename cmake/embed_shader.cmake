# SPDX-License-Identifier: Apache-2.0
# cmake -DNAME=x -DINPUT=x.comp -DROOT=INCLUDES -DOUT=FOLDER -P this: puts in what x.comp includes,
# each file once, and writes the whole as FOLDER/x.comp and as the C++ header
# FOLDER/glint_shaders/x.hpp.
cmake_minimum_required(VERSION 3.22)
function(expand file out)
  file(READ ${file} text)
  while(text MATCHES "#include \"([^\"]+)\"\n")
    set(line "${CMAKE_MATCH_0}")
    set(name "${CMAKE_MATCH_1}")
    set(inner "")
    get_property(seen GLOBAL PROPERTY seen)
    if(NOT name IN_LIST seen)
      set_property(GLOBAL APPEND PROPERTY seen ${name})
      expand(${ROOT}/${name} inner)
    endif()
    string(REPLACE "${line}" "${inner}" text "${text}")
  endwhile()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

expand(${INPUT} text)
set(text "#version 430 core\n${text}")
file(WRITE ${OUT}/${NAME}.comp "${text}")
file(WRITE ${OUT}/glint_shaders/${NAME}.hpp "#pragma once
#include \"glint/kernels/core/gl_queue.hpp\"
namespace glint::shaders {
inline constexpr gl::Shader ${NAME}{\"${NAME}\", R\"glsl(${text})glsl\"};
}  // namespace glint::shaders
")
