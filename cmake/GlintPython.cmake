# SPDX-License-Identifier: Apache-2.0
# GLINT_WITH_PYTHON: whether the Python module is built. GLINT_BUILD_PYTHON is AUTO (where all it
# needs is there), ON (a missing part is an error) or OFF. What is missing stands in
# GLINT_PYTHON_MISSING. Sets Python_EXECUTABLE, and GLINT_PYTEST where pytest is there too.
include_guard(GLOBAL)
set(GLINT_BUILD_PYTHON AUTO CACHE STRING "the Python module: AUTO, ON or OFF")
set_property(CACHE GLINT_BUILD_PYTHON PROPERTY STRINGS AUTO ON OFF)
set(GLINT_WITH_PYTHON OFF)
set(GLINT_PYTHON_MISSING "")

# The first in PATH may be one without NumPy.
function(glint_find_python)
  set(candidates python3 /usr/bin/python3)
  foreach(given IN ITEMS "${Python3_EXECUTABLE}" "${Python_EXECUTABLE}")
    if(given)
      set(candidates ${given})
    endif()
  endforeach()
  foreach(candidate IN LISTS candidates)
    execute_process(
      COMMAND ${candidate} -c "import numpy, os, sys, sysconfig; \
assert os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h')); print(sys.executable)"
      OUTPUT_VARIABLE found RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT failed)
      set(Python_EXECUTABLE ${found} CACHE FILEPATH "the interpreter that the module is built for")
      return()
    endif()
  endforeach()
  set(GLINT_PYTHON_MISSING "an interpreter with NumPy and its headers (Debian: python3-dev \
python3-numpy; -DPython_EXECUTABLE=... chooses another)" PARENT_SCOPE)
endfunction()

if(NOT GLINT_BUILD_PYTHON)
  set(GLINT_PYTHON_MISSING "GLINT_BUILD_PYTHON=ON")
elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize" AND GLINT_BUILD_PYTHON STREQUAL AUTO)
  # An interpreter would have to be started with the sanitizer's library loaded first.
  set(GLINT_PYTHON_MISSING "a build without sanitizers")
else()
  glint_find_python()
  if(NOT GLINT_PYTHON_MISSING)
    set(PYBIND11_FINDPYTHON ON)
    find_package(Python QUIET COMPONENTS Interpreter Development.Module)
    find_package(pybind11 2.10 QUIET CONFIG)
    if(NOT Python_Development.Module_FOUND)
      set(GLINT_PYTHON_MISSING "Python's headers (Debian: python3-dev)")
    elseif(NOT pybind11_FOUND)
      set(GLINT_PYTHON_MISSING "pybind11 (Debian: pybind11-dev)")
    else()
      set(GLINT_WITH_PYTHON ON)
    endif()
  endif()
endif()

if(GLINT_WITH_PYTHON)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "import pytest" RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(GLINT_PYTEST ON)
  endif()
  message(STATUS "Python module: for ${Python_EXECUTABLE}, ${Python_VERSION}")
elseif(GLINT_BUILD_PYTHON AND NOT GLINT_BUILD_PYTHON STREQUAL AUTO)
  message(FATAL_ERROR "GLINT_BUILD_PYTHON=ON, and there is missing: ${GLINT_PYTHON_MISSING}")
else()
  message(STATUS "Python module: left out; it needs ${GLINT_PYTHON_MISSING}")
endif()
