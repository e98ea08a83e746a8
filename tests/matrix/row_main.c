/* SPDX-License-Identifier: Apache-2.0 */
/* Prints what a row of the matrix was compiled by and for, before the conformance run (embedded_main.c, its main()
 * renamed). Pointer size and byte order are those met at run time, and so is the processor where it can be asked. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int conformance_main(void);

#if defined(__clang__)
#define COMPILER "clang-" __clang_version__
#else
#define COMPILER "gcc-" __VERSION__
#endif

#if defined(__OPTIMIZE_SIZE__)
#define OPTIMISED "size"
#elif defined(__OPTIMIZE__)
#define OPTIMISED "speed"
#else
#define OPTIMISED "none"
#endif

#if defined(__x86_64__)
#define TARGET "x86-64"
#elif defined(__i386__)
#define TARGET "i386"
#elif defined(__aarch64__)
#define TARGET "aarch64"
#elif defined(__ARM_ARCH_6M__)
#define TARGET "armv6-m"
#elif defined(__ARM_ARCH_7EM__)
#define TARGET "armv7e-m"
#elif defined(__ARM_ARCH_7M__)
#define TARGET "armv7-m"
#elif defined(__arm__)
#define TARGET "arm"
#elif defined(__riscv) && __riscv_xlen == 32
#define TARGET "rv32"
#elif defined(__riscv)
#define TARGET "rv64"
#elif defined(__s390x__)
#define TARGET "s390x"
#else
#define TARGET "unknown"
#endif

/* Name of the processor this runs on. */
static const char *core(void)
{
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
    uint32_t part = (*(const volatile uint32_t *)UINT32_C(0xE000ED00) >> 4) & 0xFFFu; /* CPUID, Armv7-M B3.2.3 */
    return part == 0xC23u ? "Cortex-M3" : part == 0xC27u ? "Cortex-M7" : "unknown";
#elif defined(__riscv) && !defined(__linux__)
    uintptr_t misa;
    __asm__ volatile(".option push\n.option arch, +zicsr\ncsrr %0, misa\n.option pop" : "=r"(misa));
    return misa >> (sizeof misa * 8u - 2u) == 1u ? "RV32" : "unknown"; /* MXL, RISC-V Privileged 3.1.1 */
#else
    return "-";
#endif
}

int main(void)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    printf("row: target=%s bits=%u order=%s core=%s optimised=%s compiler=%s\n", TARGET,
           (unsigned)(sizeof(void *) * 8u), first == 1 ? "little" : "big", core(), OPTIMISED, COMPILER);
    return conformance_main();
}
