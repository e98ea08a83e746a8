# SPDX-License-Identifier: Apache-2.0
# The library as a component of ESP-IDF, which includes the top-level CMakeLists.txt.
file(GLOB drogue_sources ${CMAKE_CURRENT_LIST_DIR}/../*.c ${CMAKE_CURRENT_LIST_DIR}/../*/*.c)
list(FILTER drogue_sources EXCLUDE REGEX "/cli/")
idf_component_register(SRCS ${drogue_sources} INCLUDE_DIRS include)
