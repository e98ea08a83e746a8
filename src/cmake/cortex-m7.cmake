# SPDX-License-Identifier: Apache-2.0
# Toolchain for Arm Cortex-M7, soft float: firmware with hard float takes cortex-m7-hard.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m7 -mthumb")
