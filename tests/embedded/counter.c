/* SPDX-License-Identifier: Apache-2.0 */
/* Cortex-M: SysTick, Armv7-M B3.3, at 25 MHz on the MPS2 boards. RISC-V: minstret. */
#include "counter.h"

#define LOOP_ROUNDS 100000u
#define LOOP_INSTRUCTIONS (2u * LOOP_ROUNDS)

#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'

#define SYST ((volatile uint32_t *)UINT32_C(0xE000E010)) /* control, reload, current value */
#define SYST_MASK UINT32_C(0xFFFFFF)

static void enable(void)
{
    SYST[1] = SYST_MASK;
    SYST[2] = 0;
    SYST[0] = 5; /* processor clock, no interrupt, on */
}

uint32_t counter_read(void) { return (SYST_MASK - SYST[2]) * COUNTER_STEP; }

uint32_t counter_between(uint32_t earlier, uint32_t later)
{
    return ((later / COUNTER_STEP - earlier / COUNTER_STEP) & SYST_MASK) * COUNTER_STEP;
}

static void loop(void)
{
    uint32_t rounds = LOOP_ROUNDS;
    __asm__ volatile(".syntax unified\n1: subs %0, #1\nbne 1b" : "+l"(rounds) : : "cc");
}

#elif defined(__riscv) && !defined(__linux__)

static void enable(void) {}

uint32_t counter_read(void)
{
    uint32_t count;
    __asm__ volatile(".option push\n.option arch, +zicsr\ncsrr %0, minstret\n.option pop" : "=r"(count));
    return count;
}

uint32_t counter_between(uint32_t earlier, uint32_t later) { return later - earlier; }

static void loop(void)
{
    uint32_t rounds = LOOP_ROUNDS;
    __asm__ volatile("1: addi %0, %0, -1\nbnez %0, 1b" : "+r"(rounds));
}

#else

static void enable(void) {}
static void loop(void) {}
uint32_t counter_read(void) { return 0; }
uint32_t counter_between(uint32_t earlier, uint32_t later) { return later - earlier; }

#endif

int counter_start(void)
{
    uint32_t begin, counted;
    enable();
    begin = counter_read();
    loop();
    counted = counter_between(begin, counter_read());
    return counted >= LOOP_INSTRUCTIONS && counted <= LOOP_INSTRUCTIONS + 3 * COUNTER_STEP;
}
