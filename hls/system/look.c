/* SPDX-License-Identifier: Apache-2.0 */
/* The library's src/look.c with the driver in the place of its front end, which is told each row where it is called. */
#include "drogue/frontend.h"

static inline __attribute__((always_inline)) void tell_row(drogue_frontend *frontend, const uint8_t *row);

#define drogue_frontend_row tell_row
#include "../../src/look.c"
#include "../driver/block_frontend.c"
