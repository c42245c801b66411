# SPDX-License-Identifier: Apache-2.0
# Install: the library, its headers as include/glint/<layer>/..., a CMake package that gives
# glint::glint, and a pkg-config file.
include(CMakePackageConfigHelpers)

set_target_properties(glint PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
install(TARGETS glint glint_settings EXPORT glintTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# lanes*.hpp are the insides of kernels: they only mean something to the builds of their own folder.
foreach(layer kernels engine)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${layer}/
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glint/${layer}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.glsl" PATTERN "lanes*.hpp" EXCLUDE)
endforeach()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/glint)
install(EXPORT glintTargets NAMESPACE glint:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/glintConfig.cmake.in
  ${PROJECT_BINARY_DIR}/glintConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/glintConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/glintConfig.cmake ${PROJECT_BINARY_DIR}/glintConfigVersion.cmake
  DESTINATION ${package_dir})

# The prefix is written relative to the file itself, so that the tree can be moved.
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkgconfig_to_prefix ${CMAKE_INSTALL_PREFIX}/${pkgconfig_dir}
  ${CMAKE_INSTALL_PREFIX})
configure_file(${PROJECT_SOURCE_DIR}/cmake/glint.pc.in ${PROJECT_BINARY_DIR}/glint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/glint.pc DESTINATION ${pkgconfig_dir})
