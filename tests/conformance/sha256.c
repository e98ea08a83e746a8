/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 as FIPS 180-4 states it, a byte at a time into blocks of 64. */
#include "sha256.h"

/* First 32 bits of the fractional parts of the cube roots of the first 64 primes. */
static const uint32_t round_constant[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t rotate_right(uint32_t v, int n) { return (v >> n) | (v << (32 - n)); }

static uint32_t big_endian(const uint8_t *p)
{
    return ((uint32_t)p[0] << 24) | ((uint32_t)p[1] << 16) | ((uint32_t)p[2] << 8) | p[3];
}

static void compress(sha256 *s)
{
    uint32_t w[64];
    uint32_t v[8]; /* a to h */
    int t;
    int k;
    for (t = 0; t < 16; t++) {
        w[t] = big_endian(s->block + 4 * t);
    }
    for (; t < 64; t++) {
        uint32_t s0 = rotate_right(w[t - 15], 7) ^ rotate_right(w[t - 15], 18) ^ (w[t - 15] >> 3);
        uint32_t s1 = rotate_right(w[t - 2], 17) ^ rotate_right(w[t - 2], 19) ^ (w[t - 2] >> 10);
        w[t] = w[t - 16] + s0 + w[t - 7] + s1;
    }
    for (k = 0; k < 8; k++) {
        v[k] = s->state[k];
    }
    for (t = 0; t < 64; t++) {
        uint32_t sum1 = rotate_right(v[4], 6) ^ rotate_right(v[4], 11) ^ rotate_right(v[4], 25);
        uint32_t choice = (v[4] & v[5]) ^ (~v[4] & v[6]);
        uint32_t t1 = v[7] + sum1 + choice + round_constant[t] + w[t];
        uint32_t sum0 = rotate_right(v[0], 2) ^ rotate_right(v[0], 13) ^ rotate_right(v[0], 22);
        uint32_t majority = (v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]);
        for (k = 7; k > 0; k--) {
            v[k] = v[k - 1];
        }
        v[4] += t1;
        v[0] = t1 + sum0 + majority;
    }
    for (k = 0; k < 8; k++) {
        s->state[k] += v[k];
    }
}

void sha256_init(sha256 *s)
{
    static const uint32_t start[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    int k;
    for (k = 0; k < 8; k++) {
        s->state[k] = start[k];
    }
    s->length = 0;
}

void sha256_add(sha256 *s, const void *data, size_t bytes)
{
    const uint8_t *p = (const uint8_t *)data;
    size_t i;
    for (i = 0; i < bytes; i++) {
        s->block[s->length++ % 64] = p[i];
        if (s->length % 64 == 0) {
            compress(s);
        }
    }
}

void sha256_end(char hex[SHA256_HEX], sha256 *s)
{
    static const uint8_t one = 0x80;
    static const uint8_t zero = 0;
    uint64_t bits = s->length * 8;
    uint8_t length[8];
    int k;
    for (k = 0; k < 8; k++) {
        length[k] = (uint8_t)(bits >> (56 - 8 * k));
    }
    sha256_add(s, &one, 1);
    while (s->length % 64 != 56) {
        sha256_add(s, &zero, 1);
    }
    sha256_add(s, length, 8);
    for (k = 0; k < 64; k++) {
        hex[k] = "0123456789abcdef"[(s->state[k / 8] >> (28 - 4 * (k % 8))) & 15u];
    }
    hex[64] = '\0';
}
