/* SPDX-License-Identifier: Apache-2.0 */
/* Search and acquisition in any region of an image that is a block of its own: pixels beyond it are none. */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

static drogue_result acquired(const fuzz_scene *s, const drogue_region *region, const drogue_capacity *capacity,
                              int32_t search_width_px, uint8_t fill)
{
    const size_t bytes = DROGUE_SEARCH_BYTES((size_t)search_width_px);
    fuzz_workspace w = fuzz_workspace_make(capacity, fill);
    void *memory = fuzz_alloc(bytes);
    drogue_search search;
    drogue_result r;
    memset(memory, fill, bytes);
    memset(&search, fill, sizeof search);
    memset(&r, fill, sizeof r);
    FUZZ_MUST(drogue_search_init(&search, memory, bytes, search_width_px) == DROGUE_OK);
    FUZZ_MUST(drogue_acquire(&r, &w.workspace, &search, &s->setup, &s->image, region) == r.status);
    fuzz_check_result(&r, region, &s->image);
    free(memory);
    free(w.memory);
    return r;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes b = {data, size};
    fuzz_scene s;
    drogue_capacity capacity;
    const drogue_region *region;
    drogue_result clean, dirty;
    int32_t width;
    fuzz_scene_make(&s, &b, 160);
    capacity = fuzz_capacity(&b, 160);
    region = fuzz_byte(&b) % 2 ? &s.region : NULL;
    width = fuzz_range(&b, 1, 200);
    clean = acquired(&s, region, &capacity, width, 0);
    dirty = acquired(&s, region, &capacity, width, 0xA5);
    FUZZ_MUST(memcmp(&clean, &dirty, sizeof clean) == 0);
    fuzz_scene_free(&s);
    return 0;
}
