/* SPDX-License-Identifier: Apache-2.0 */
/* Measures the frames compiled in and prints, one line each: result, digest, instructions, peak stack, RAM. Exits with 0
 * when every frame is measured and its position is within 1 % of the distance of the truth. With MEASURE_STAGES it
 * prints instructions per stage instead of the rest. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "counter.h"
#include "digest.h"
#include "drogue/drogue.h"
#include "frames.h"
#include "stages.h"

#define PAINT_BYTES 16384u /* of stack below the caller, watched for use */
#define PAINT 0xA5u

static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(FRAMES_SIDE_PX) / 4 + 1];
static drogue_config config;
static drogue_result result;

/* Bytes of RAM for a frame, without its stack. */
typedef struct need {
    drogue_workspace workspace;
    size_t bytes;
} need;

/* A workspace just large enough for the frame's longest side. */
static int prepare(need *out, const frame *f)
{
    int32_t side = f->image.width_px > f->image.height_px ? f->image.width_px : f->image.height_px;
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(side);
    size_t workspace_bytes = drogue_workspace_bytes(&capacity);
    out->bytes = workspace_bytes + sizeof out->workspace + sizeof config + sizeof result;
    return drogue_workspace_init(&out->workspace, memory, workspace_bytes, &capacity) == DROGUE_OK;
}

static void run(need *n, const frame *f)
{
    const drogue_region whole = {0, 0, f->image.width_px, f->image.height_px};
    (void)drogue_measure(&result, &n->workspace, &(drogue_setup){&f->camera, &f->model, &config}, &f->image, &whole);
}

static void print_q16(const char *name, drogue_q16 value)
{
    long size = (long)((llabs((long long)value) * 10000 + 32768) / 65536); /* in units of 0.0001 */
    printf(" %s=%s%ld.%04ld", name, value < 0 ? "-" : "", size / 10000, size % 10000);
}

static int near_truth(const frame *f)
{
    int32_t tolerance = f->true_position_m_q16[2] / 100;
    int i, near = 1;
    for (i = 0; i < 3; i++) {
        near = near && labs((long)result.pose.position_m_q16[i] - f->true_position_m_q16[i]) <= tolerance;
    }
    return near;
}

static void print_result(const frame *f)
{
    printf("frame %s: status=%s", f->name, drogue_status_name(result.status));
    print_q16("x_m", result.pose.position_m_q16[0]);
    print_q16("y_m", result.pose.position_m_q16[1]);
    print_q16("z_m", result.pose.position_m_q16[2]);
    print_q16("yaw_rad", result.pose.yaw_rad_q16);
    print_q16("pitch_rad", result.pose.pitch_rad_q16);
    printf(" pixels=%" PRId32, f->image.width_px * f->image.height_px);
}

#ifdef MEASURE_STAGES

/* Measure a frame and print it; returns its digest. */
static uint64_t measure(need *n, const frame *f)
{
    uint32_t counts[STAGE_COUNT];
    int i;
    stages_begin();
    run(n, f);
    stages_end(counts);
    print_result(f);
    for (i = 0; i < STAGE_COUNT; i++) {
        printf(" %s=%" PRIu32, stage_names[i], counts[i]);
    }
    return digest_result(DIGEST_START, &result);
}

#else

/* About where the caller's stack ends. */
__attribute__((noinline)) static volatile uint8_t *stack_here(void) { return __builtin_frame_address(0); }

/* Peak stack of a frame. The memory below the stack pointer is painted, used, and looked at. */
__attribute__((noinline)) static size_t peak_stack(need *n, const frame *f)
{
    volatile uint8_t *top = stack_here();
    volatile uint8_t *p;
    for (p = top - PAINT_BYTES; p < top - 128; p++) { /* 128: what this function may still use */
        *p = PAINT;
    }
    run(n, f);
    for (p = top - PAINT_BYTES; p < top && *p == PAINT; p++) {}
    return (size_t)(top - p);
}

/* Measure a frame and print it; returns its digest. */
static uint64_t measure(need *n, const frame *f)
{
    uint64_t digest;
    size_t stack;
    uint32_t begin = counter_read();
    uint32_t end;
    run(n, f);
    end = counter_read();
    digest = digest_result(DIGEST_START, &result);
    stack = peak_stack(n, f);
    print_result(f);
    printf(" instructions=%" PRIu32 " stack=%lu ram=%lu", counter_between(begin, end), (unsigned long)stack,
           (unsigned long)(n->bytes + stack));
    return digest_result(DIGEST_START, &result) == digest ? digest : 0; /* a frame measured twice gives the same */
}

#endif

static void print_digest(uint64_t digest)
{
    printf(" digest=%08" PRIx32 "%08" PRIx32 "\n", (uint32_t)(digest >> 32), (uint32_t)digest);
}

int main(void)
{
    static need n;
    uint64_t all = DIGEST_START;
    uint64_t digest;
    size_t i;
    int failed = 0;
    int counting = counter_start();
    drogue_config_default(&config);
    for (i = 0; i < frame_count; i++) {
        failed |= !prepare(&n, &frames[i]);
        digest = measure(&n, &frames[i]);
        print_digest(digest);
        all = (all ^ digest) * UINT64_C(0x100000001b3);
        failed |= digest == 0 || result.status != DROGUE_OK || !near_truth(&frames[i]);
    }
    printf("measure: drogue %s frames=%lu counting=%d failed=%d", drogue_version(), (unsigned long)frame_count,
           counting, failed);
    print_digest(all);
    return failed || frame_count == 0;
}
