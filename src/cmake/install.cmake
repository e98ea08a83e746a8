# SPDX-License-Identifier: Apache-2.0
# What 'cmake --install' lays down: headers, static library, the target drogue::drogue for find_package(drogue),
# drogue.pc for pkg-config. The host program installs itself where it is built.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS drogue EXPORT drogue
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/drogue DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

set(drogue_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/drogue)
# The library depends on nothing, so the export is the whole package file.
install(EXPORT drogue FILE drogue-config.cmake NAMESPACE drogue:: DESTINATION ${drogue_package_dir})
write_basic_package_version_file(drogue-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/drogue-config-version.cmake DESTINATION ${drogue_package_dir})

# Relative, since 'cmake --install --prefix' may put it anywhere.
file(RELATIVE_PATH drogue_pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/drogue.pc.in drogue.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/drogue.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
