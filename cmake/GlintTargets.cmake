# SPDX-License-Identifier: Apache-2.0
# glint_settings: what every target of the house is compiled with.
add_library(glint_settings INTERFACE)
target_include_directories(glint_settings INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(glint_settings INTERFACE cxx_std_20)
# Bitwise reproducible floats: no contraction that the source does not spell out as fma.
target_compile_options(glint_settings INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
target_compile_options(glint_settings INTERFACE $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra>
  $<BUILD_INTERFACE:-Wshadow> $<BUILD_INTERFACE:-Wno-psabi>
  # g++ 12 sees overlapping copies in every string + string (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:$<BUILD_INTERFACE:-Wno-restrict>>
  $<$<BOOL:${GLINT_WERROR}>:$<BUILD_INTERFACE:-Werror>>)
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  # g++ takes what the sanitizers put in for paths that leave variables unset.
  target_compile_options(glint_settings INTERFACE $<BUILD_INTERFACE:-Wno-maybe-uninitialized>)
endif()

# glint_optimise(TARGET LEVEL): another level than the release build's -O3, for what has no arithmetic
# worth it. No level changes a value.
function(glint_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# glint_unity(TARGET): with GLINT_UNITY, the sources of each folder are compiled together, eight at most.
# So names in their unnamed namespaces must differ within a folder. A kernel's folder is left
# out: there the same names stand for the same thing of serial, tbb and gl. Each source must still
# compile alone, as it does without GLINT_UNITY.
function(glint_unity target)
  if(NOT GLINT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    cmake_path(GET folder PARENT_PATH folder)
    if(source MATCHES "[.]cpp$" AND (NOT folder MATCHES "^kernels/" OR folder STREQUAL "kernels/core"))
      string(MAKE_C_IDENTIFIER "count_${folder}" count)
      math(EXPR ${count} "${${count}} + 1")
      math(EXPR part "(${${count}} - 1) / 8")
      set_property(SOURCE ${source} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${folder}/${part})
    endif()
  endforeach()
endfunction()

# The instruction sets that a kernel's lanes.cpp is built for; each becomes namespace glint::lanes_<isa>.
set(GLINT_LANES plain)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(GLINT_LANES plain v3 v4)
  target_compile_definitions(glint_settings INTERFACE $<BUILD_INTERFACE:GLINT_X86_LANES=1>)
endif()
set(GLINT_LANES_FLAGS_plain "")
set(GLINT_LANES_FLAGS_v3 -march=x86-64-v3)
set(GLINT_LANES_FLAGS_v4 -march=x86-64-v4 -mprefer-vector-width=512)

# glint_lanes(TARGET NAME FILE): adds a lanes.cpp to TARGET, once per instruction set.
function(glint_lanes target name file)
  foreach(isa IN LISTS GLINT_LANES)
    set(object glint_${name}_${isa})
    add_library(${object} OBJECT ${file})
    target_link_libraries(${object} PRIVATE glint_settings)
    target_compile_definitions(${object} PRIVATE GLINT_LANES=lanes_${isa})
    # -O3 and no trapping or errno: what lets plain loops become vectors; none of them changes a value.
    # Sanitizers blow these loops up until -O3 takes minutes a file; -O1 checks as much in seconds.
    set(level -O3)
    if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
      set(level -O1)
    endif()
    target_compile_options(${object} PRIVATE ${GLINT_LANES_FLAGS_${isa}}
      -fno-math-errno -fno-trapping-math $<$<CONFIG:Release,RelWithDebInfo>:${level}>)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
  endforeach()
endfunction()

# glint_kernel(NAME [more sources]): adds kernels/NAME/{serial,tbb}.cpp, and lanes.cpp once per
# instruction set; trial.cpp to glint_trials.
function(glint_kernel name)
  set(dir ${PROJECT_SOURCE_DIR}/kernels/${name})
  set(sources ${dir}/serial.cpp ${dir}/tbb.cpp)
  foreach(extra IN LISTS ARGN)
    list(APPEND sources ${dir}/${extra})
  endforeach()
  target_sources(glint PRIVATE ${sources})
  target_sources(glint_trials PRIVATE ${dir}/trial.cpp)
  if(EXISTS ${dir}/lanes.cpp)
    glint_lanes(glint ${name} ${dir}/lanes.cpp)
  endif()
endfunction()

# glint_shaders(NAME [SHADERS files] [PARTS files]): embeds the shaders of kernels/NAME, with what they
# include put in: NAME.comp as glint::shaders::NAME, or each SHADERS's FILE.comp as
# glint::shaders::NAME_FILE. They are listed in glint's property GLINT_SHADERS for the tests. PARTS are
# the included files, from kernels/.
function(glint_shaders name)
  cmake_parse_arguments(arg "" "" "SHADERS;PARTS" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/kernels/${name})
  set(out ${PROJECT_BINARY_DIR}/shaders)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake)
  list(TRANSFORM arg_PARTS PREPEND ${PROJECT_SOURCE_DIR}/kernels/ OUTPUT_VARIABLE parts)
  if(NOT arg_SHADERS)
    set(arg_SHADERS ${name})
  endif()
  foreach(file IN LISTS arg_SHADERS)
    set(shader ${name}_${file})
    if(file STREQUAL name)
      set(shader ${name})
    endif()
    set(outputs ${out}/${shader}.comp ${out}/glint_shaders/${shader}.hpp)
    add_custom_command(OUTPUT ${outputs}
      COMMAND ${CMAKE_COMMAND} -DNAME=${shader} -DINPUT=${dir}/${file}.comp
        -DROOT=${PROJECT_SOURCE_DIR}/include -DOUT=${out} -P ${script}
      DEPENDS ${dir}/${file}.comp ${script} ${parts} VERBATIM)
    add_custom_target(glint_shader_${shader} DEPENDS ${outputs})
    add_dependencies(glint glint_shader_${shader})
    set_property(TARGET glint APPEND PROPERTY GLINT_SHADERS ${shader})
  endforeach()
  target_include_directories(glint PRIVATE ${out})
endfunction()

# glint_gl(NAME ...): adds kernels/NAME/gl.cpp with its shaders, as glint_shaders() does.
function(glint_gl name)
  glint_shaders(${name} ${ARGN})
  target_sources(glint PRIVATE ${PROJECT_SOURCE_DIR}/kernels/${name}/gl.cpp)
endfunction()
