/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: a port that goes into a function that is not inline, and one whose address is kept in memory; one into an inline function
 * is followed. */
#include <stdint.h>

typedef struct view {
    const uint8_t *data;
} view;

int32_t top(const int32_t a[8], const int32_t b[8], const uint8_t pixels[64], int32_t at);

static int32_t apart(const int32_t v[4]) { return v[0] + v[1]; }

static inline int32_t part(const int32_t v[4]) { return v[2] + v[3]; }

static int32_t read(const view *v, int32_t at) { return v->data[at]; }

int32_t top(const int32_t a[8], const int32_t b[8], const uint8_t pixels[64], int32_t at)
{
    view v;
    v.data = pixels;                                  /* expect: port */
    return part(b + 4) + apart(a + 1) + read(&v, at); /* expect: port */
}
