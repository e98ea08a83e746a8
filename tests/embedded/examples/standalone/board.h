/* SPDX-License-Identifier: Apache-2.0 */
/* What the sample knows of its board. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Ticks of SysTick since reset. On a board: clocks of the processor. In QEMU's MPS2 boards with '-icount shift=0' one
 * tick is 40 instructions: an instruction lasts 1 ns there, SysTick runs at 25 MHz. */
uint64_t board_ticks(void);

#ifdef BOARD_CLOCK_HZ /* -DBOARD_CLOCK_HZ=480000000: on a board, at its clock */
#define BOARD_CLOCKS_A_TICK 1u
#else
#define BOARD_CLOCK_HZ 480000000u /* what QEMU's count is stated for: a Cortex-M7 at one instruction a clock */
#define BOARD_CLOCKS_A_TICK 40u
#endif

#endif
