# SPDX-License-Identifier: Apache-2.0
# Toolchain for Arm Cortex-M4, soft float: firmware with hard float takes cortex-m4-hard.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m4 -mthumb")
