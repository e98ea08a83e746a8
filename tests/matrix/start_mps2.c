/* SPDX-License-Identifier: Apache-2.0 */
/* Start-up of a Cortex-M image under QEMU: vector table, static data, semihosting, main. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern char data_begin[], data_end[], data_image[], bss_begin[], bss_end[], stack_top[]; /* mps2.ld */
void initialise_monitor_handles(void);                                                   /* librdimon: open stdout */
int main(void);
void reset(void);
void fault(void);
void _fini(void);

typedef struct vector_table {
    void *stack;
    void (*handler[15])(void);
} vector_table;

/* Armv7-M B1.5.2: reset, NMI, faults, SVC, debug, PendSV, SysTick. Nothing but reset is expected to happen. */
__attribute__((section(".vectors"), used)) static const vector_table vectors = {
    stack_top,
    {reset, fault, fault, fault, fault, fault, NULL, NULL, NULL, NULL, fault, fault, NULL, fault, fault},
};

/* exit() calls it; the C library leaves it to the start-up code. */
void _fini(void) {}

void fault(void)
{
    printf("start: exception\n");
    exit(2);
}

#define CPACR (*(volatile uint32_t *)0xE000ED88)

void reset(void)
{
#ifdef __ARM_FP /* hard float: the unit is off after reset, and its first use would be a fault */
    CPACR |= 0xFu << 20;
    __asm__ volatile("dsb\nisb");
#endif
    memcpy(data_begin, data_image, (size_t)(data_end - data_begin));
    memset(bss_begin, 0, (size_t)(bss_end - bss_begin));
    initialise_monitor_handles();
    exit(main());
}
