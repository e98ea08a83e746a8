/* SPDX-License-Identifier: Apache-2.0 */
/* Start-up of a Cortex-M image without a C library's input and output, for images whose size counts: vector table,
 * static data, main, exit through semihosting with main's status. */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

extern char data_begin[], data_end[], data_image[], bss_begin[], bss_end[], stack_top[]; /* mps2.ld */
int main(void);
void reset(void);
void fault(void);

typedef struct vector_table {
    void *stack;
    void (*handler[3])(void);
} vector_table;

__attribute__((section(".vectors"), used)) static const vector_table vectors = {stack_top, {reset, fault, fault}};

/* SYS_EXIT: ApplicationExit ends QEMU with 0, any other reason with 1. */
static void leave(int status)
{
    register uint32_t operation __asm__("r0") = 0x18;
    register uint32_t reason __asm__("r1") = status == 0 ? UINT32_C(0x20026) : UINT32_C(0x20023);
    __asm__ volatile("bkpt 0xAB" : : "r"(operation), "r"(reason) : "memory");
    for (;;) {}
}

void fault(void) { leave(1); }

void reset(void)
{
    memcpy(data_begin, data_image, (size_t)(data_end - data_begin));
    memset(bss_begin, 0, (size_t)(bss_end - bss_begin));
    leave(main());
}
