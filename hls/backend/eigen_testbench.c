/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_eigen(): every vector of the stage 'eigen'. */
#include "backend.h"
#include "drogue/eigen.h"
#include "testbench.h"

static void run(bench *b, const conf_case *c)
{
    int64_t matrix[6];
    int64_t eigen[12];
    int64_t expected[12];
    drogue_sym3 m;
    drogue_eigen3 e;
    int32_t sweeps;
    size_t i;
    bench_begin(b, c->id);
    memset(eigen, 0, sizeof eigen);
    for (i = 0; i < 6; i++) {
        matrix[i] = m.a[i] = conf_word(&c->inputs[0], i);
    }
    BENCH_ARRAY(0, matrix);
    BENCH_ARRAY(1, eigen);
    sweeps = drogue_hls_eigen(matrix, eigen);
    bench_word(b, "sweeps", 0, sweeps, drogue_eigen_sym3(&e, &m));
    memcpy(expected, e.value, sizeof e.value);
    memcpy(expected + 3, e.vector_q60, sizeof e.vector_q60);
    bench_words64(b, "eigen", eigen, expected, 12);
    bench_vector64(b, c, "full", eigen, 12);
    bench_end(b, "");
}

int main(void)
{
    bench b = {"eigen", "", 0, 0, 0, 0};
    size_t l;
    size_t i;
    for (l = 0; l < conf_case_list_count; l++) {
        for (i = 0; i < conf_case_lists[l].count; i++) {
            if (bench_wants(&conf_case_lists[l].cases[i], "eigen")) {
                run(&b, &conf_case_lists[l].cases[i]);
            }
        }
    }
    return bench_report(&b);
}
