/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_cone(): every vector of the stage 'pose'. */
#include "backend.h"
#include "testbench.h"

static void run(bench *b, const conf_case *c)
{
    int32_t ellipse[5];
    int32_t camera[4];
    int32_t poses[16];
    int32_t expected[16];
    int32_t words[21];
    drogue_camera cam;
    drogue_ellipse e;
    drogue_pose both[2];
    drogue_choice choice;
    drogue_status status;
    const drogue_q16 radius = (drogue_q16)conf_word(&c->inputs[2], 0);
    size_t i;
    bench_begin(b, c->id);
    memset(&cam, 0, sizeof cam);
    memset(words, 0, sizeof words);
    for (i = 0; i < 5; i++) {
        ellipse[i] = (int32_t)conf_word(&c->inputs[0], i);
    }
    for (i = 0; i < 4; i++) {
        camera[i] = (int32_t)conf_word(&c->inputs[1], i);
    }
    e = drogue_hls_unpack_ellipse(ellipse);
    cam.fx_px_q16 = camera[0];
    cam.fy_px_q16 = camera[1];
    cam.cx_px_q16 = camera[2];
    cam.cy_px_q16 = camera[3];
    BENCH_ARRAY(0, ellipse);
    BENCH_ARRAY(1, camera);
    BENCH_ARRAY(3, poses);
    words[0] = drogue_hls_cone(ellipse, camera, radius, poses);
    bench_word(b, "status", 0, words[0], drogue_pose_from_ellipse(both, &e, &cam, radius));
    drogue_hls_pack_pose(expected, &both[0]);
    drogue_hls_pack_pose(expected + 8, &both[1]);
    bench_words32(b, "poses", poses, expected, 16);
    if (words[0] == DROGUE_OK) { /* the choice is the library's */
        memcpy(words + 1, poses, sizeof poses);
        status =
            drogue_choose_pose(&choice, both, (drogue_q16)conf_word(&c->inputs[2], 2),
                               (drogue_q16)conf_word(&c->inputs[2], 3), (drogue_q16)conf_word(&c->inputs[2], 1), &cam);
        words[0] = (int32_t)status;
        if (status == DROGUE_OK) {
            words[17] = (int32_t)choice.index;
            words[18] = choice.distance_px_q16[0];
            words[19] = choice.distance_px_q16[1];
            words[20] = choice.ambiguity_q16;
        }
    }
    bench_vector32(b, c, "pose", words, 21);
    bench_end(b, "");
}

int main(void)
{
    bench b = {"cone", "", 0, 0, 0, 0};
    size_t l;
    size_t i;
    for (l = 0; l < conf_case_list_count; l++) {
        for (i = 0; i < conf_case_lists[l].count; i++) {
            if (bench_wants(&conf_case_lists[l].cases[i], "pose")) {
                run(&b, &conf_case_lists[l].cases[i]);
            }
        }
    }
    return bench_report(&b);
}
