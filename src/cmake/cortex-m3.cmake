# SPDX-License-Identifier: Apache-2.0
# Toolchain for Arm Cortex-M3; floating-point registers unused: the library has no use for them.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m3 -mthumb")
