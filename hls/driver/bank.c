/* SPDX-License-Identifier: Apache-2.0 */
/* A register bank at an address. */
#include "block.h"

uint32_t drogue_bank_read(const drogue_bank_of_registers *bank, uint32_t offset) { return bank->base[offset / 4u]; }

void drogue_bank_write(const drogue_bank_of_registers *bank, uint32_t offset, uint32_t word)
{
    bank->base[offset / 4u] = word;
}
