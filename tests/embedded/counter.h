/* SPDX-License-Identifier: Apache-2.0 */
/* Instructions executed, exact and repeatable under QEMU with -icount shift=0, where an instruction takes 1 ns. */
#ifndef COUNTER_H
#define COUNTER_H

#include <stdint.h>

/* Start counting. Returns 1 when the count of a loop of known length is right, 0 when it is not (no QEMU, no -icount,
 * another clock): then counts mean nothing. */
int counter_start(void);

/* Instructions since some point in time, modulo 2^32 on RISC-V, 40 * 2^24 on Cortex-M; the host counts none. */
uint32_t counter_read(void);

/* Instructions between two readings. */
uint32_t counter_between(uint32_t earlier, uint32_t later);

#define COUNTER_STEP 40u /* coarsest unit: a tick of the MPS2 board's 25 MHz clock */

#endif
