/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_cone(): every vector of the stage 'pose'. */
#include <string.h>

#include "../bench/bench.h"
#include "../words.h"
#include "sim.h"

/* The choice between the poses, which is the library's, to complete the vector's words. */
static void choose(int32_t words[21], const int32_t camera_words[4], const int32_t *params)
{
    drogue_camera camera;
    drogue_pose poses[2];
    drogue_choice choice;
    memset(&camera, 0, sizeof camera);
    camera.fx_px_q16 = camera_words[0];
    camera.fy_px_q16 = camera_words[1];
    camera.cx_px_q16 = camera_words[2];
    camera.cy_px_q16 = camera_words[3];
    drogue_hls_unpack_pose(&poses[0], words + 1);
    drogue_hls_unpack_pose(&poses[1], words + 9);
    words[0] = (int32_t)drogue_choose_pose(&choice, poses, params[2], params[3], params[1], &camera);
    if (words[0] == DROGUE_OK) {
        words[17] = (int32_t)choice.index;
        words[18] = choice.distance_px_q16[0];
        words[19] = choice.distance_px_q16[1];
        words[20] = choice.ambiguity_q16;
    }
}

static void run(bench *b, const conf_case *c)
{
    const int32_t *params = bench_words32(bench_input(c, "params"));
    int32_t ellipse[5];
    int32_t camera[4];
    int32_t poses[16];
    int32_t words[21];
    memcpy(ellipse, bench_input(c, "ellipse")->data, sizeof ellipse);
    memcpy(camera, bench_input(c, "camera")->data, sizeof camera);
    memset(words, 0, sizeof words);
    memset(poses, 0x55, sizeof poses);
    SIM_ARRAY(0, ellipse);
    SIM_ARRAY(1, camera);
    SIM_ARRAY(3, poses);
    words[0] = drogue_hls_cone(ellipse, camera, params[0], poses);
    memcpy(words + 1, poses, sizeof poses);
    if (words[0] == DROGUE_OK) {
        choose(words, camera, params);
    }
    (void)bench_words(b, "pose", words, bench_expected(c, "pose"));
}

int main(void)
{
    const conf_case *c;
    bench b;
    bench_begin(&b, "cone");
    while ((c = bench_next(&b, "pose")) != NULL) {
        run(&b, c);
    }
    return bench_end(&b);
}
