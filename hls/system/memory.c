/* SPDX-License-Identifier: Apache-2.0 */
/* memset() and memcpy() a word at a time, eight a turn: picolibc's, compiled for size, take a byte at a time. */
#include <stdint.h>
#include <string.h>

void *memset(void *to, int byte, size_t count)
{
    const uint32_t word = (uint32_t)(unsigned char)byte * 0x01010101u;
    unsigned char *b = to;
    for (; count > 0 && ((uintptr_t)b & 3u) != 0; count--) {
        *b++ = (unsigned char)byte;
    }
    for (; count >= 32; count -= 32, b += 32) {
        uint32_t *w = (uint32_t *)(void *)b;
        w[0] = w[1] = w[2] = w[3] = w[4] = w[5] = w[6] = w[7] = word;
    }
    for (; count >= 4; count -= 4, b += 4) {
        *(uint32_t *)(void *)b = word;
    }
    for (; count > 0; count--) {
        *b++ = (unsigned char)byte;
    }
    return to;
}

void *memcpy(void *restrict to, const void *restrict from, size_t count)
{
    unsigned char *b = to;
    const unsigned char *f = from;
    if ((((uintptr_t)b | (uintptr_t)f) & 3u) == 0) {
        for (; count >= 16; count -= 16, b += 16, f += 16) {
            uint32_t *w = (uint32_t *)(void *)b;
            const uint32_t *v = (const uint32_t *)(const void *)f;
            const uint32_t v0 = v[0];
            const uint32_t v1 = v[1];
            const uint32_t v2 = v[2];
            const uint32_t v3 = v[3];
            w[0] = v0;
            w[1] = v1;
            w[2] = v2;
            w[3] = v3;
        }
        for (; count >= 4; count -= 4, b += 4, f += 4) {
            *(uint32_t *)(void *)b = *(const uint32_t *)(const void *)f;
        }
    }
    for (; count > 0; count--) {
        *b++ = *f++;
    }
    return to;
}
