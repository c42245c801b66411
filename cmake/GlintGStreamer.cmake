# SPDX-License-Identifier: Apache-2.0
# GLINT_WITH_GSTREAMER: whether the GStreamer plugin is built. GLINT_BUILD_GSTREAMER is AUTO (where
# all it needs is there), ON (a missing part is an error) or OFF. What is missing stands in
# GLINT_GSTREAMER_MISSING.
include_guard(GLOBAL)
set(GLINT_BUILD_GSTREAMER AUTO CACHE STRING "the GStreamer plugin: AUTO, ON or OFF")
set_property(CACHE GLINT_BUILD_GSTREAMER PROPERTY STRINGS AUTO ON OFF)
set(GLINT_WITH_GSTREAMER OFF)
set(GLINT_GSTREAMER_MISSING "")

if(NOT GLINT_BUILD_GSTREAMER)
  set(GLINT_GSTREAMER_MISSING "GLINT_BUILD_GSTREAMER=ON")
elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize" AND GLINT_BUILD_GSTREAMER STREQUAL AUTO)
  # gst-launch-1.0 would have to be started with the sanitizer's library loaded first.
  set(GLINT_GSTREAMER_MISSING "a build without sanitizers")
else()
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(GSTREAMER QUIET IMPORTED_TARGET GLOBAL
      gstreamer-1.0>=1.20 gstreamer-base-1.0>=1.20 gstreamer-video-1.0>=1.20)
  endif()
  if(GSTREAMER_FOUND)
    set(GLINT_WITH_GSTREAMER ON)
  else()
    set(GLINT_GSTREAMER_MISSING
      "GStreamer 1.20 or later (Debian: libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev)")
  endif()
endif()

if(GLINT_WITH_GSTREAMER)
  message(STATUS "GStreamer plugin: for GStreamer ${GSTREAMER_gstreamer-1.0_VERSION}")
elseif(GLINT_BUILD_GSTREAMER AND NOT GLINT_BUILD_GSTREAMER STREQUAL AUTO)
  message(FATAL_ERROR "GLINT_BUILD_GSTREAMER=ON, and there is missing: ${GLINT_GSTREAMER_MISSING}")
else()
  message(STATUS "GStreamer plugin: left out; it needs ${GLINT_GSTREAMER_MISSING}")
endif()
