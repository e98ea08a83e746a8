/* SPDX-License-Identifier: Apache-2.0 */
/* One-pass labelling against flood fill: same partition, roots in raster order, nothing written beyond the tables. */
#include "suite.h"

#include "../../../src/frontend/label_pass.h"

typedef struct labelling {
    int32_t width, height;
    guarded code, labels, model, parent, merges, zeros;
    drogue_labels state;
} labelling;

static labelling labelling_of_size(int32_t width, int32_t height, uint32_t capacity)
{
    labelling t;
    size_t pixels = (size_t)width * (size_t)height;
    t.width = width;
    t.height = height;
    t.code = guarded_alloc(pixels);
    t.labels = guarded_alloc(pixels * sizeof(uint32_t));
    t.model = guarded_alloc(pixels * sizeof(uint32_t));
    t.parent = guarded_alloc(capacity * sizeof(uint32_t));
    t.merges = guarded_alloc((size_t)width * sizeof(drogue_merge));
    t.zeros = guarded_alloc((size_t)width * sizeof(uint32_t));
    memset(t.labels.data, 0, t.labels.bytes);
    memset(t.zeros.data, 0, t.zeros.bytes);
    memset(t.code.data, 0, t.code.bytes);
    drogue_labels_reset(&t.state, t.parent.data, capacity);
    return t;
}

static void labelling_free(labelling *t)
{
    guarded_free(&t->code);
    guarded_free(&t->labels);
    guarded_free(&t->model);
    guarded_free(&t->parent);
    guarded_free(&t->merges);
    guarded_free(&t->zeros);
}

/* As the front end labels: a row's pixels by the parents of the row above, then the merges that they brought. */
static void run_rows(labelling *t, uint8_t mask)
{
    const uint8_t *code = t->code.data;
    uint32_t *labels = t->labels.data;
    const uint32_t *parent = t->parent.data;
    int32_t x, y;
    uint32_t i;
    for (y = 0; y < t->height; y++) {
        const uint8_t *code_row = code + y * t->width, *code_above = y ? code_row - t->width : t->zeros.data;
        uint32_t *row = labels + y * t->width;
        drogue_label_pass p =
            drogue_label_pass_of(&t->state, row, y ? row - t->width : t->zeros.data, t->merges.data, 1, t->width, mask);
        for (x = 0; x < t->width; x++) {
            if ((code_row[x] & mask) != 0) {
                (void)drogue_label_pixel(&p, &t->state, code_row, code_above, x);
            }
        }
        drogue_labels_resolve(t->parent.data, t->merges.data, (uint32_t)(p.merge - (drogue_merge *)t->merges.data));
        for (x = 0; x < t->width; x++) {
            MUST(row[x] < t->state.count && parent[parent[row[x]]] == parent[row[x]], "row %d, x %d: parent is no root",
                 y, x);
        }
    }
    MUST(guarded_intact(&t->merges), "merge table overrun, width %d", t->width);
    MUST(guarded_intact(&t->labels) && guarded_intact(&t->parent), "label table overrun, width %d", t->width);
    drogue_labels_flatten(t->parent.data, t->state.count);
    for (i = 1; i < t->state.count; i++) {
        MUST(parent[i] <= i && parent[parent[i]] == parent[i], "label %u is not flat", (unsigned)i);
    }
}

/* Components 1, 2, ... in raster order of their first pixel, by flood fill. Returns their number. */
static uint32_t flood_fill(labelling *t, uint8_t mask)
{
    const uint8_t *code = t->code.data;
    uint32_t *model = t->model.data, count = 0;
    int32_t pixels = t->width * t->height, start;
    int32_t *stack = malloc((size_t)pixels * sizeof *stack);
    memset(model, 0, t->model.bytes);
    for (start = 0; start < pixels; start++) {
        int32_t top = 0;
        if ((code[start] & mask) == 0 || model[start] != 0) {
            continue;
        }
        model[start] = ++count;
        stack[top++] = start;
        while (top > 0) {
            int32_t at = stack[--top], dx, dy;
            for (dy = -1; dy <= 1; dy++) {
                for (dx = -1; dx <= 1; dx++) {
                    int32_t x = at % t->width + dx, y = at / t->width + dy, to = y * t->width + x;
                    if (x >= 0 && x < t->width && y >= 0 && y < t->height && model[to] == 0 &&
                        (code[to] & mask) == (code[at] & mask)) {
                        model[to] = count;
                        stack[top++] = to;
                    }
                }
            }
        }
    }
    free(stack);
    return count;
}

/* Every pixel's root must stand for its component alone, and roots ascend with the components. */
static void compare(labelling *t, uint32_t components)
{
    const uint32_t *labels = t->labels.data, *model = t->model.data, *parent = t->parent.data;
    uint32_t *root = calloc((size_t)components + 2u, sizeof *root), k;
    int32_t i;
    ck_assert_uint_eq(t->state.full, 0);
    for (i = 0; i < t->width * t->height; i++) {
        uint32_t r = parent[labels[i]];
        MUST((model[i] == 0) == (labels[i] == 0), "%d x %d: background differs at %d", t->width, t->height, i);
        if (model[i] != 0 && root[model[i]] == 0) {
            root[model[i]] = r;
        }
        MUST(model[i] == 0 || root[model[i]] == r, "%d x %d: component split at %d", t->width, t->height, i);
    }
    for (k = 1; k < components; k++) {
        MUST(root[k] < root[k + 1], "%d x %d: roots %u and %u do not ascend", t->width, t->height, (unsigned)root[k],
             (unsigned)root[k + 1]);
    }
    free(root);
}

/* The map in 'code' with ample, exact, and one label too few. */
static void check_map(const uint8_t *code, int32_t width, int32_t height, uint8_t mask)
{
    uint32_t ample = (uint32_t)(width * height) + 1u, needed, components;
    labelling t = labelling_of_size(width, height, ample);
    int pass;
    memcpy(t.code.data, code, t.code.bytes);
    components = flood_fill(&t, mask);
    run_rows(&t, mask);
    compare(&t, components);
    needed = t.state.count;
    labelling_free(&t);
    for (pass = 0; pass < 2 && needed > 1; pass++) {
        t = labelling_of_size(width, height, needed - (uint32_t)pass);
        memcpy(t.code.data, code, t.code.bytes);
        flood_fill(&t, mask);
        run_rows(&t, mask);
        MUST(t.state.full == (uint32_t)pass, "%u labels of %u: full is %u", (unsigned)(needed - (uint32_t)pass),
             (unsigned)needed, (unsigned)t.state.full);
        MUST(t.state.count == needed - (uint32_t)pass, "count passes the capacity");
        if (pass == 0) {
            compare(&t, components);
        }
        labelling_free(&t);
    }
}

START_TEST(random_maps)
{
    uint64_t rng = 1;
    int32_t i, k;
    for (i = 0; i < 4000; i++) {
        int32_t width = rng_range(&rng, 1, 40), height = rng_range(&rng, 1, 40);
        int32_t density = rng_range(&rng, 1, 100), keys = rng_range(&rng, 1, 4);
        uint8_t *code = calloc((size_t)(width * height), 1);
        for (k = 0; k < width * height; k++) { /* other bits must not matter */
            code[k] = (uint8_t)(rng_range(&rng, 0, 3) |
                                (rng_range(&rng, 1, 100) <= density ? rng_range(&rng, 1, keys) << 2 : 0));
        }
        check_map(code, width, height, 0x1C);
        free(code);
    }
}
END_TEST

/* Walls one pixel thick and gaps one pixel wide, all one component. */
static void draw_spiral(uint8_t *code, int32_t side)
{
    static const int32_t dx[4] = {1, 0, -1, 0}, dy[4] = {0, 1, 0, -1};
    int32_t x = 0, y = 0, length = side - 1, leg, i;
    code[0] = 1;
    for (leg = 0; length > 0; leg++) {
        for (i = 0; i < length; i++) {
            x += dx[leg & 3];
            y += dy[leg & 3];
            code[y * side + x] = 1;
        }
        if (leg >= 2 && (leg & 1) == 0) {
            length -= 2;
        }
    }
}

START_TEST(spirals)
{
    int32_t side, k;
    for (side = 1; side <= 61; side++) {
        uint8_t *code = calloc((size_t)(side * side), 1), *turned = calloc((size_t)(side * side), 1);
        draw_spiral(code, side);
        for (k = 0; k < side * side; k++) {
            turned[side * side - 1 - k] = code[k];
        }
        check_map(code, side, side, 1);
        check_map(turned, side, side, 1);
        free(code);
        free(turned);
    }
}
END_TEST

/* Teeth that stand apart until the last row joins them all, and the same upside down and as V-shaped steps. */
START_TEST(combs)
{
    int32_t width, height, k;
    for (width = 1; width <= 64; width += 3) {
        for (height = 1; height <= 9; height += 2) {
            uint8_t *down = calloc((size_t)(width * height), 1), *up = calloc((size_t)(width * height), 1);
            uint8_t *teeth = calloc((size_t)(width * height), 1);
            for (k = 0; k < width * height; k++) {
                int32_t x = k % width, y = k / width;
                down[k] = (x & 1) == 0 || y == height - 1;
                up[k] = (x & 1) == 0 || y == 0;
                teeth[k] = ((x + y) & 3) == 0 || ((x - y) & 3) == 0;
            }
            check_map(down, width, height, 1);
            check_map(up, width, height, 1);
            check_map(teeth, width, height, 1);
            free(down);
            free(up);
            free(teeth);
        }
    }
}
END_TEST

/* Two keys in a chequered pattern join diagonally at almost every pixel of a row: the most merges there can be. */
START_TEST(chequers_of_two_keys)
{
    int32_t width, k;
    for (width = 1; width <= 40; width++) {
        uint8_t *code = calloc((size_t)(width * 6), 1);
        for (k = 0; k < width * 6; k++) {
            code[k] = (uint8_t)(1 + ((k % width + k / width) & 1));
        }
        check_map(code, width, 6, 3);
        free(code);
    }
}
END_TEST

/* Every map of two grey levels of these sizes: one look at the table a label is enough, whatever the shapes. */
START_TEST(every_small_map)
{
    static const int32_t size[][2] = {{4, 4}, {6, 3}, {3, 6}, {18, 1}, {9, 2}, {5, 4}};
    size_t s;
    uint32_t bits;
    int32_t k;
    for (s = 0; s < sizeof size / sizeof size[0]; s++) {
        int32_t pixels = size[s][0] * size[s][1];
        labelling t = labelling_of_size(size[s][0], size[s][1], (uint32_t)pixels + 1u);
        for (bits = 0; bits < (uint32_t)1 << pixels; bits++) {
            for (k = 0; k < pixels; k++) {
                ((uint8_t *)t.code.data)[k] = (bits >> k) & 1u;
            }
            memset(t.labels.data, 0, t.labels.bytes);
            drogue_labels_reset(&t.state, t.parent.data, (uint32_t)pixels + 1u);
            run_rows(&t, 1);
            compare(&t, flood_fill(&t, 1));
        }
        labelling_free(&t);
    }
}
END_TEST

START_TEST(isolated_points_need_a_label_each)
{
    int32_t width, height, k;
    for (width = 1; width <= 20; width++) {
        for (height = 1; height <= 20; height++) {
            labelling t = labelling_of_size(width, height, (uint32_t)((width + 1) / 2 * ((height + 1) / 2)) + 1u);
            for (k = 0; k < width * height; k++) {
                ((uint8_t *)t.code.data)[k] = (k % width) % 2 == 0 && (k / width) % 2 == 0;
            }
            flood_fill(&t, 1);
            run_rows(&t, 1);
            compare(&t, t.state.count - 1u);
            ck_assert_uint_eq(t.state.count, t.state.capacity);
            labelling_free(&t);
        }
    }
}
END_TEST

START_TEST(capacity_of_one_gives_no_label)
{
    labelling t = labelling_of_size(5, 5, 1);
    int32_t k;
    memset(t.code.data, 1, t.code.bytes);
    run_rows(&t, 1);
    ck_assert_uint_eq(t.state.full, 1);
    ck_assert_uint_eq(t.state.count, 1);
    for (k = 0; k < 25; k++) {
        ck_assert_uint_eq(((uint32_t *)t.labels.data)[k], 0);
    }
    labelling_free(&t);
}
END_TEST

/* A pixel takes a label of one of its neighbours, and says which other one is the same component. */
START_TEST(a_label_of_every_neighbourhood)
{
    int i;
    for (i = 0; i < 256; i++) {
        const uint32_t above = (uint32_t)i & 3u, left = (uint32_t)i >> 2 & 3u, above_left = (uint32_t)i >> 4 & 3u,
                       above_right = (uint32_t)i >> 6;
        uint32_t other = 99;
        const uint32_t label = drogue_label_choose(&other, above, left, above_left, above_right);
        const int before = left != 0 || above_left != 0;
        MUST((label == 0) == (above == 0 && !before && above_right == 0), "%d: label %u", i, (unsigned)label);
        MUST(label == 0 || label == above || label == left || label == above_left || label == above_right,
             "%d: %u is no neighbour's", i, (unsigned)label);
        if (above != 0 || !before || above_right == 0) { /* those that there are touch each other */
            MUST(other == 0 && (above == 0 || label == above), "%d: %u and %u", i, (unsigned)label, (unsigned)other);
        } else { /* what is to the left, and what is above right */
            MUST((label == left || label == above_left) && other == (label == above_right ? 0 : above_right),
                 "%d: %u and %u", i, (unsigned)label, (unsigned)other);
        }
    }
}
END_TEST

SUITE_MAIN("label", random_maps, every_small_map, spirals, combs, chequers_of_two_keys,
           isolated_points_need_a_label_each, capacity_of_one_gives_no_label, a_label_of_every_neighbourhood)
