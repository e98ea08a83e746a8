/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 (FIPS 180-4), for the digest of a run and the check of the vectors' files. */
#ifndef DROGUE_TESTS_SHA256_H
#define DROGUE_TESTS_SHA256_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SHA256_HEX 65 /* 64 digits and the end of the string */

typedef struct sha256 {
    uint32_t state[8];
    uint64_t length; /* bytes so far */
    uint8_t block[64];
} sha256;

void sha256_init(sha256 *s);
void sha256_add(sha256 *s, const void *data, size_t bytes);

/* End the message; hex gets 64 lower-case digits. */
void sha256_end(char hex[SHA256_HEX], sha256 *s);

#ifdef __cplusplus
}
#endif
#endif
