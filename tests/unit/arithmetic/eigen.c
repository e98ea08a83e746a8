/* SPDX-License-Identifier: Apache-2.0 */
/* The symmetric 3x3 eigen-solver: values against quadruple precision, the vectors' residual and order. */
#include "suite.h"

#include "drogue/eigen.h"
#include "quad.h"

#define ONE_Q60 (INT64_C(1) << DROGUE_EIGEN_FRAC)
#define LIMIT (INT64_C(1) << 59)

static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

/* Distance of the solution from one, in units of the matrix: of the values, and of A v - lambda v. */
static void check_matrix(const drogue_sym3 *m, double *value_error, double *residual)
{
    drogue_eigen3 e;
    quad matrix[3][3], value[3], vector[3][3], det;
    int i, j, k, sweeps = drogue_eigen_sym3(&e, m);
    MUST(sweeps >= 0 && sweeps <= 8, "%d sweeps", sweeps);
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            matrix[i][j] = m->a[at[i][j]];
        }
    }
    quad_eigen3(value, vector, (const quad(*)[3])matrix);
    MUST(e.value[0] >= e.value[1] && e.value[1] >= e.value[2], "values not in descending order");
    for (k = 0; k < 3; k++) {
        quad length2 = 0;
        int largest = 0;
        *value_error = fmax(*value_error, (double)quad_abs((quad)e.value[k] - value[k]));
        for (i = 0; i < 3; i++) {
            quad r = -(quad)e.value[k] * (quad)e.vector_q60[k][i];
            quad cross = 0;
            for (j = 0; j < 3; j++) {
                r += matrix[i][j] * (quad)e.vector_q60[k][j];
                cross += (quad)e.vector_q60[k][j] * (quad)e.vector_q60[i][j];
            }
            *residual = fmax(*residual, (double)quad_abs(r / ONE_Q60));
            length2 = i == k ? cross / ONE_Q60 / ONE_Q60 : length2;
            MUST(i == k || quad_abs(cross / ONE_Q60 / ONE_Q60) < (quad)1e-16L, "vectors %d and %d are not orthogonal",
                 i, k);
            if (drogue_abs_u64(e.vector_q60[k][i]) > drogue_abs_u64(e.vector_q60[k][largest])) {
                largest = i;
            }
        }
        MUST(quad_abs(length2 - 1) < (quad)1e-16L, "vector %d has length^2 %.18g", k, (double)length2);
        MUST(k == 2 || e.vector_q60[k][largest] > 0, "sign of vector %d", k);
    }
    det = 0;
    for (i = 0; i < 3; i++) {
        det += (quad)e.vector_q60[0][i] * ((quad)e.vector_q60[1][(i + 1) % 3] * (quad)e.vector_q60[2][(i + 2) % 3] -
                                           (quad)e.vector_q60[1][(i + 2) % 3] * (quad)e.vector_q60[2][(i + 1) % 3]);
    }
    MUST(det > 0, "left-handed vectors");
}

static void must_be_small(const char *what, double value_error, double residual)
{
    MUST(value_error <= 64.0, "%s: values off by %.1f units", what, value_error);
    MUST(residual <= 64.0, "%s: residual of %.1f units", what, residual);
}

START_TEST(random_matrices)
{
    uint64_t rng = 1;
    double value_error = 0, residual = 0;
    int i, k;
    for (i = 0; i < 40000; i++) {
        drogue_sym3 m;
        for (k = 0; k < 6; k++) {
            m.a[k] = (int64_t)rng_u64(&rng) >> 5;
            if (i & 1) {
                m.a[k] >>= rng_range(&rng, 0, 58);
            }
        }
        m.a[rng_range(&rng, 0, 5)] = LIMIT - (int64_t)(rng_u64(&rng) >> 6);
        check_matrix(&m, &value_error, &residual);
    }
    must_be_small("random", value_error, residual);
}
END_TEST

/* Rotated diagonal matrices of a chosen spectrum: double values, a spread of 1 : 5000 and of 1 : 2^50. */
START_TEST(chosen_spectra)
{
    static const double spectrum[][3] = {{1, 1, 1},
                                         {1, 1, -1},
                                         {1, -1, -1},
                                         {1, 1, 1 - 1e-12},
                                         {1, 1 - 1e-9, -1},
                                         {1, 2e-4, -1},
                                         {2e-4, 1.9999e-4, -1},
                                         {1, 1e-6, -2e-4},
                                         {1, 1e-15, -1e-15},
                                         {1, 0, 0},
                                         {0, 0, -1},
                                         {1e-3, 1e-3, -1},
                                         {1, 0.5, 0.25}};
    uint64_t rng = 2;
    double value_error = 0, residual = 0;
    int i, j, k, round;
    size_t s;
    for (s = 0; s < sizeof spectrum / sizeof spectrum[0]; s++) {
        for (round = 0; round < 1000; round++) {
            double w = rng_normal(&rng), x = rng_normal(&rng), y = rng_normal(&rng), z = rng_normal(&rng);
            double n = round < 3 ? (x = y = z = 0, fabs(w)) : sqrt(w * w + x * x + y * y + z * z), r[3][3];
            drogue_sym3 m;
            w /= n;
            x /= n;
            y /= n;
            z /= n;
            r[0][0] = 1 - 2 * (y * y + z * z);
            r[0][1] = 2 * (x * y - w * z);
            r[0][2] = 2 * (x * z + w * y);
            r[1][0] = 2 * (x * y + w * z);
            r[1][1] = 1 - 2 * (x * x + z * z);
            r[1][2] = 2 * (y * z - w * x);
            r[2][0] = 2 * (x * z - w * y);
            r[2][1] = 2 * (y * z + w * x);
            r[2][2] = 1 - 2 * (x * x + y * y);
            for (i = 0; i < 3; i++) {
                for (j = i; j < 3; j++) {
                    double sum = 0;
                    for (k = 0; k < 3; k++) {
                        sum += r[i][k] * r[j][k] * spectrum[s][k];
                    }
                    m.a[at[i][j]] = (int64_t)(sum * 0x1p58);
                }
            }
            check_matrix(&m, &value_error, &residual);
        }
    }
    must_be_small("chosen", value_error, residual);
}
END_TEST

START_TEST(edge_values)
{
    static const int64_t entry[5] = {0, 1, -1, LIMIT, -LIMIT};
    double value_error = 0, residual = 0;
    int i, k, code;
    for (i = 0; i < 15625; i++) {
        drogue_sym3 m;
        for (k = 0, code = i; k < 6; k++, code /= 5) {
            m.a[k] = entry[code % 5];
        }
        check_matrix(&m, &value_error, &residual);
    }
    must_be_small("edge values", value_error, residual);
}
END_TEST

START_TEST(diagonal_needs_no_sweep)
{
    const drogue_sym3 m = {{3, 0, 0, 7, 0, -5}};
    drogue_eigen3 e;
    ck_assert_int_eq(drogue_eigen_sym3(&e, &m), 0);
    ck_assert(e.value[0] == 7 && e.value[1] == 3 && e.value[2] == -5);
    ck_assert(e.vector_q60[0][1] == ONE_Q60 && e.vector_q60[1][0] == ONE_Q60 && e.vector_q60[2][2] == -ONE_Q60);
}
END_TEST

START_TEST(normalise_brings_to_one_scale)
{
    uint64_t rng = 3;
    drogue_wide w[6];
    drogue_sym3 m;
    int i, k;
    for (i = 0; i < 200000; i++) {
        int32_t e, base = rng_range(&rng, -200, 200);
        uint64_t largest = 0;
        for (k = 0; k < 6; k++) {
            w[k] = drogue_wide_from_s64(rng_s64_any_width(&rng), base + rng_range(&rng, -5, 5));
            if (rng_range(&rng, 0, 3) == 0) {
                w[k] = drogue_wide_from_s64(0, 0);
            }
        }
        w[rng_range(&rng, 0, 5)] = drogue_wide_from_s64(1 + (int64_t)(rng_u64(&rng) >> 3), base);
        e = drogue_sym3_normalise(&m, w);
        for (k = 0; k < 6; k++) {
            quad exact = quad_scale((quad)w[k].mantissa, w[k].exponent - e);
            MUST(quad_abs((quad)m.a[k] - exact) <= (quad)0.5L, "entry %d off", k);
            largest = drogue_abs_u64(m.a[k]) > largest ? drogue_abs_u64(m.a[k]) : largest;
        }
        MUST(largest >= (uint64_t)LIMIT / 2 && largest <= (uint64_t)LIMIT, "largest entry %llu",
             (unsigned long long)largest);
    }
    for (k = 0; k < 6; k++) {
        w[k] = drogue_wide_from_s64(0, 0);
    }
    (void)drogue_sym3_normalise(&m, w);
    for (k = 0; k < 6; k++) {
        ck_assert_int_eq(m.a[k], 0);
    }
}
END_TEST

SUITE_MAIN("eigen", random_matrices, chosen_spectra, edge_values, diagonal_needs_no_sweep,
           normalise_brings_to_one_scale)
