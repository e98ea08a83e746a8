/* SPDX-License-Identifier: Apache-2.0 */
/* Start-up of a Cortex-M: vector table, floating-point unit, static data, main; SysTick as a clock. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "board.h"

extern char data_begin[], data_end[], data_image[], bss_begin[], bss_end[], stack_top[]; /* board.ld */
int main(void);
void reset(void);
void fault(void);
void tick(void);

typedef struct vector_table {
    void *stack;
    void (*handler[15])(void);
} vector_table;

/* Reset, NMI, faults, SVC, debug, PendSV, SysTick. */
__attribute__((section(".vectors"), used)) static const vector_table vectors = {
    stack_top,
    {reset, fault, fault, fault, fault, fault, NULL, NULL, NULL, NULL, fault, fault, NULL, fault, tick},
};

#define CPACR (*(volatile uint32_t *)0xE000ED88)
#define SYSTICK ((volatile uint32_t *)0xE000E010) /* control, reload, current value */
#define SYSTICK_PERIOD 0x1000000u

static volatile uint32_t periods;

void fault(void) { exit(2); }

void tick(void) { periods++; }

uint64_t board_ticks(void)
{
    uint32_t before, now;
    do {
        before = periods;
        now = SYSTICK[2];
    } while (before != periods);
    return (uint64_t)before * SYSTICK_PERIOD + (SYSTICK_PERIOD - 1 - now);
}

void reset(void)
{
#ifdef __ARM_FP /* built for the floating-point unit: it is off after reset, and its first use would be a fault */
    CPACR |= 0xFu << 20;
    __asm__ volatile("dsb\nisb");
#endif
    memcpy(data_begin, data_image, (size_t)(data_end - data_begin));
    memset(bss_begin, 0, (size_t)(bss_end - bss_begin));
    SYSTICK[1] = SYSTICK_PERIOD - 1;
    SYSTICK[2] = 0;
    SYSTICK[0] = 7; /* processor clock, interrupt at each wrap, on */
    exit(main());
}
