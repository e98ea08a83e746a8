#----------------------------------------------------------------
# Generated CMake target import file for configuration "Release".
#----------------------------------------------------------------

# Commands may need to know the format version.
set(CMAKE_IMPORT_FILE_VERSION 1)

# Import target "drogue::drogue" for configuration "Release"
set_property(TARGET drogue::drogue APPEND PROPERTY IMPORTED_CONFIGURATIONS RELEASE)
set_target_properties(drogue::drogue PROPERTIES
  IMPORTED_LINK_INTERFACE_LANGUAGES_RELEASE "C"
  IMPORTED_LOCATION_RELEASE "${_IMPORT_PREFIX}/lib/libdrogue.a"
  )

list(APPEND _cmake_import_check_targets drogue::drogue )
list(APPEND _cmake_import_check_files_for_drogue::drogue "${_IMPORT_PREFIX}/lib/libdrogue.a" )

# Commands beyond this point should not need to know the version.
set(CMAKE_IMPORT_FILE_VERSION)
