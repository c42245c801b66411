# SPDX-License-Identifier: Apache-2.0
# Install: libraries, headers as include/glint/<layer>/..., a CMake package that gives glint::glint,
# glint::shared and glint::c, and pkg-config files. Components are those of GlintPackages.cmake.
include(CMakePackageConfigHelpers)

set(libraries glint glint_settings)
foreach(library glint_shared glint_c)
  if(TARGET ${library})
    list(APPEND libraries ${library})
  endif()
endforeach()
install(TARGETS ${libraries} EXPORT glintTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)

# Not the insides of kernels (lanes*.hpp) and of the scheduler, which only mean something to the build
# of their own folder, nor what glint_trials holds, which is not installed.
foreach(layer kernels engine)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${layer}/
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glint/${layer} COMPONENT dev
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.glsl" PATTERN "lanes*.hpp" EXCLUDE
    PATTERN "scheduler_state.hpp" EXCLUDE PATTERN "parity.hpp" EXCLUDE PATTERN "trials.hpp" EXCLUDE
    PATTERN "trial_images.hpp" EXCLUDE)
endforeach()

# The interface; what it takes in is above.
install(FILES ${PROJECT_SOURCE_DIR}/include/glint/glint.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glint COMPONENT dev)
install(FILES ${PROJECT_SOURCE_DIR}/examples/track_raw.cpp ${PROJECT_SOURCE_DIR}/examples/track_raw.c
  ${PROJECT_SOURCE_DIR}/examples/resume_raw.c
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT dev)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/glint)
install(EXPORT glintTargets NAMESPACE glint:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/glintConfig.cmake.in
  ${PROJECT_BINARY_DIR}/glintConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/glintConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/glintConfig.cmake ${PROJECT_BINARY_DIR}/glintConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT dev)

# The prefix is written relative to the file itself, so that the tree can be moved.
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkgconfig_to_prefix ${CMAKE_INSTALL_PREFIX}/${pkgconfig_dir}
  ${CMAKE_INSTALL_PREFIX})
set(pkgconfig_files glint)
if(TARGET glint_c)
  list(APPEND pkgconfig_files glint-c)
endif()
foreach(name IN LISTS pkgconfig_files)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_dir} COMPONENT dev)
endforeach()
