# SPDX-License-Identifier: Apache-2.0
# Toolchain for Arm Cortex-M4 with hardware floating point in the calling convention, for firmware that is built so. The
# library computes nothing in floating point; linker and start-up need one convention throughout.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
