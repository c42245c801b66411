# SPDX-License-Identifier: Apache-2.0
# `cpack -G DEB` in the build folder: one package a component. What each depends on is read off its
# binaries; the versions of what the headers include are those of CMakeLists.txt.
if(NOT GLINT_BUILD_SHARED OR NOT GLINT_BUILD_TOOLS)
  return()
endif()
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME glint)
set(CPACK_PACKAGE_CONTACT "The developers of Glint")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENTS_ALL runtime dev tools)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libglint${abi})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Shared libraries, for programs in C and in C++.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libglint-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libtbb-dev, libeigen3-dev")
set(CPACK_COMPONENT_DEV_DEPENDS runtime)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers, static library, CMake package and pkg-config files.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME glint-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "The command line program glint.")

if(GLINT_WITH_PYTHON)
  # The module is of one minor version of Python, whose name its file carries.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  list(APPEND CPACK_COMPONENTS_ALL python_package)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_NAME python3-glint)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_DEPENDS "python3-numpy, \
python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
  set(CPACK_COMPONENT_PYTHON_PACKAGE_DESCRIPTION "The Python package glint.")
endif()

if(GLINT_WITH_GSTREAMER)
  list(APPEND CPACK_COMPONENTS_ALL gstreamer_package)
  set(CPACK_DEBIAN_GSTREAMER_PACKAGE_PACKAGE_NAME gstreamer1.0-glint)
  set(CPACK_DEBIAN_GSTREAMER_PACKAGE_PACKAGE_SECTION video)
  set(CPACK_COMPONENT_GSTREAMER_PACKAGE_DESCRIPTION "The GStreamer element glinttrack.")
endif()

include(CPack)
