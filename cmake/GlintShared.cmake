# SPDX-License-Identifier: Apache-2.0
# glint_shared: libglint.so, made of the static library's objects; glint::shared for its users.
set(source ${PROJECT_BINARY_DIR}/shared.cpp)
file(CONFIGURE OUTPUT ${source} CONTENT "// All that libglint.so holds comes out of libglint.a.\n")
add_library(glint_shared SHARED ${source})
add_library(glint::shared ALIAS glint_shared)
# Before 1.0 a minor version may break its users, so it has a soname of its own.
set(map ${PROJECT_SOURCE_DIR}/cmake/glint.map)
set_target_properties(glint_shared PROPERTIES OUTPUT_NAME glint EXPORT_NAME shared
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  LINK_DEPENDS "${map};$<TARGET_FILE:glint>")
add_dependencies(glint_shared glint)
target_link_libraries(glint_shared PUBLIC glint_settings TBB::tbb Eigen3::Eigen
  PRIVATE ${CMAKE_DL_LIBS})
target_link_options(glint_shared PRIVATE LINKER:--whole-archive $<TARGET_FILE:glint>
  LINKER:--no-whole-archive LINKER:--version-script=${map})
