/* SPDX-License-Identifier: Apache-2.0 */
/* What the proofs are written in: any value of a type, what may be taken for granted, what must hold. A proof is a function
 * without arguments; list.txt says how it is run. */
#ifndef PROOF_H
#define PROOF_H

#include <stdint.h>

void __ESBMC_assume(_Bool);
void __ESBMC_assert(_Bool, const char *);

#define ASSUME(condition) __ESBMC_assume(condition)
#define PROVE(condition) __ESBMC_assert(condition, #condition)

/* Any value: the model checker takes functions without a body so. */
uint8_t nondet_u8(void);
int16_t nondet_s16(void);
int32_t nondet_s32(void);
uint32_t nondet_u32(void);
int64_t nondet_s64(void);
uint64_t nondet_u64(void);

/* Of so many bits: a narrow number whose sign is one variable, where an assumed range would leave the solver 32. */
static inline int32_t any_signed(int bits) { return (int32_t)(nondet_u32() << (32 - bits)) >> (32 - bits); }
static inline uint32_t any_unsigned(int bits) { return nondet_u32() >> (32 - bits); }

static inline int32_t any_within(int32_t least, int32_t most)
{
    const int32_t v = nondet_s32();
    ASSUME(v >= least && v <= most);
    return v;
}

#endif
