/* SPDX-License-Identifier: Apache-2.0 */
/* One number for every member of a result: 64-bit FNV-1a over the members in the order of the struct, each as 8 bytes,
 * two's complement, least significant first. The same on every processor, whatever its byte order and padding. */
#ifndef DIGEST_H
#define DIGEST_H

#include <stdint.h>

#include "drogue/drogue.h"

#define DIGEST_START UINT64_C(0xcbf29ce484222325)

uint64_t digest_result(uint64_t digest, const drogue_result *result);

#endif
