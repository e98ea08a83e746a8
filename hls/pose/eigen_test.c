/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_eigen(): every vector of the stage 'eigen'. */
#include <string.h>

#include "../bench/bench.h"
#include "../words.h"
#include "drogue/eigen.h"
#include "sim.h"

static void run(bench *b, const conf_case *c)
{
    const conf_array *in = bench_input(c, "matrix");
    int64_t matrix[6];
    int32_t eigen[15];
    drogue_real m[6];
    drogue_eigen3 e;
    int32_t sweeps;
    int i;
    for (i = 0; i < 6; i++) {
        matrix[i] = conf_word(in, (size_t)i);
        drogue_real_set(&m[i], matrix[i], -60);
    }
    memset(eigen, 0x55, sizeof eigen);
    SIM_ARRAY(0, matrix);
    SIM_ARRAY(1, eigen);
    sweeps = drogue_hls_eigen(matrix, eigen);
    (void)bench_word(b, "sweeps", sweeps, drogue_eigen_sym3(&e, m));
    (void)bench_words(b, "full", eigen, bench_expected(c, "full"));
    (void)bench_words(b, "vectors", eigen + 6, bench_expected(c, "vectors"));
}

int main(void)
{
    const conf_case *c;
    bench b;
    bench_begin(&b, "eigen");
    while ((c = bench_next(&b, "eigen")) != NULL) {
        run(&b, c);
    }
    return bench_end(&b);
}
