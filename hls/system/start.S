/* SPDX-License-Identifier: Apache-2.0 */
    .section .start, "ax"
    .globl _start
_start:
    la sp, stack_top
    .option arch, +zicsr
    li t0, 1 << 31 /* its own instructions, for the units beside it */
    csrw 0xBC0, t0
    la t0, bss_begin
    la t1, bss_end
1:  bgeu t0, t1, 2f
    sw zero, 0(t0)
    addi t0, t0, 4
    j 1b
2:  call main
3:  j 3b
