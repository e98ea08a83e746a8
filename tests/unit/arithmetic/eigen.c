/* SPDX-License-Identifier: Apache-2.0 */
/* The symmetric 3x3 eigen-solver: values against quadruple precision, the vectors' residual and order. */
#include "suite.h"

#include "real_quad.h"

#include "drogue/eigen.h"

#define ONE_Q30 (1 << 30)
#define LIMIT (INT64_C(1) << 30)

static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

/* Distance of the solution from one over the matrix's largest value, in units of 2^-30: of the values, of A v - lambda v,
 * and of the vectors from orthonormal ones. */
typedef struct distance {
    double value, residual, vectors;
} distance;

static void check_matrix(const drogue_real m[6], distance *worst)
{
    drogue_eigen3 e;
    quad matrix[3][3], value[3], vector[3][3], det, unit;
    int i, j, k, sweeps = drogue_eigen_sym3(&e, m);
    MUST(sweeps >= 0 && sweeps <= 8, "%d sweeps", sweeps);
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            matrix[i][j] = quad_of(m[at[i][j]]);
        }
    }
    quad_eigen3(value, vector, (const quad(*)[3])matrix);
    unit = quad_abs(value[0]) > quad_abs(value[2]) ? quad_abs(value[0]) : quad_abs(value[2]);
    unit = unit == 0 ? 1 : unit / ONE_Q30;
    MUST(quad_of(e.value[0]) >= quad_of(e.value[1]) && quad_of(e.value[1]) >= quad_of(e.value[2]),
         "values not in descending order");
    for (k = 0; k < 3; k++) {
        int largest = 0;
        worst->value = fmax(worst->value, (double)(quad_abs(quad_of(e.value[k]) - value[k]) / unit));
        for (i = 0; i < 3; i++) {
            quad r = -quad_of(e.value[k]) * (quad)e.vector_q30[k][i];
            quad cross = 0;
            for (j = 0; j < 3; j++) {
                r += matrix[i][j] * (quad)e.vector_q30[k][j];
                cross += (quad)e.vector_q30[k][j] * (quad)e.vector_q30[i][j];
            }
            worst->residual = fmax(worst->residual, (double)(quad_abs(r / ONE_Q30) / unit));
            worst->vectors =
                fmax(worst->vectors, (double)quad_abs(cross / ONE_Q30 - (i == k ? (quad)ONE_Q30 : (quad)0)));
            if (drogue_abs_u64(e.vector_q30[k][i]) > drogue_abs_u64(e.vector_q30[k][largest])) {
                largest = i;
            }
        }
        MUST(k == 2 || e.vector_q30[k][largest] > 0, "sign of vector %d", k);
    }
    det = 0;
    for (i = 0; i < 3; i++) {
        det += (quad)e.vector_q30[0][i] * ((quad)e.vector_q30[1][(i + 1) % 3] * (quad)e.vector_q30[2][(i + 2) % 3] -
                                           (quad)e.vector_q30[1][(i + 2) % 3] * (quad)e.vector_q30[2][(i + 1) % 3]);
    }
    MUST(det > 0, "left-handed vectors");
}

static void must_be_small(const char *what, const distance *worst)
{
    MUST(worst->value <= 8.0, "%s: values off by %.1f units", what, worst->value);
    MUST(worst->residual <= 8.0, "%s: residual of %.1f units", what, worst->residual);
    MUST(worst->vectors <= 4.0, "%s: vectors off by %.1f units", what, worst->vectors);
}

START_TEST(random_matrices)
{
    uint64_t rng = 1;
    distance worst = {0, 0, 0};
    int i, k;
    for (i = 0; i < 40000; i++) {
        drogue_real m[6];
        for (k = 0; k < 6; k++) {
            m[k] = real_set((int64_t)rng_u64(&rng) >> 33, i & 1 ? -rng_range(&rng, 0, 40) : 0);
        }
        m[rng_range(&rng, 0, 5)] = real_set(LIMIT + (int64_t)(rng_u64(&rng) >> 34), 0);
        check_matrix(m, &worst);
    }
    must_be_small("random", &worst);
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
    distance worst = {0, 0, 0};
    int i, j, k, round;
    size_t s;
    for (s = 0; s < sizeof spectrum / sizeof spectrum[0]; s++) {
        for (round = 0; round < 1000; round++) {
            double w = rng_normal(&rng), x = rng_normal(&rng), y = rng_normal(&rng), z = rng_normal(&rng);
            double n = round < 3 ? (x = y = z = 0, fabs(w)) : sqrt(w * w + x * x + y * y + z * z), r[3][3];
            drogue_real m[6];
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
                    m[at[i][j]] = real_of((quad)sum);
                }
            }
            check_matrix(m, &worst);
        }
    }
    must_be_small("chosen", &worst);
}
END_TEST

START_TEST(edge_values)
{
    static const int64_t entry[5] = {0, 1, -1, LIMIT, -LIMIT};
    distance worst = {0, 0, 0};
    int i, k, code;
    for (i = 0; i < 15625; i++) {
        drogue_real m[6];
        for (k = 0, code = i; k < 6; k++, code /= 5) {
            m[k] = real_set(entry[code % 5], 0);
        }
        check_matrix(m, &worst);
    }
    must_be_small("edge values", &worst);
}
END_TEST

START_TEST(diagonal_needs_no_sweep)
{
    drogue_real m[6];
    drogue_eigen3 e;
    memset(m, 0, sizeof m);
    m[0] = real_set(3, 0);
    m[3] = real_set(7, 0);
    m[5] = real_set(-5, 0);
    ck_assert_int_eq(drogue_eigen_sym3(&e, m), 0);
    ck_assert(quad_of(e.value[0]) == 7 && quad_of(e.value[1]) == 3 && quad_of(e.value[2]) == -5);
    ck_assert(e.vector_q30[0][1] == ONE_Q30 && e.vector_q30[1][0] == ONE_Q30 && e.vector_q30[2][2] == -ONE_Q30);
}
END_TEST

/* Rows and columns scaled as the cone's in its own frame: each value to 2^-27 of itself. */
START_TEST(graded_matrices_keep_their_small_values)
{
    uint64_t rng = 3;
    int i, k;
    for (i = 0; i < 20000; i++) {
        const double grade = exp(rng_real(&rng, log(1e-9), log(1e-2))), shape = rng_real(&rng, 0.1, 1);
        const quad b[3][2] = {{(quad)rng_normal(&rng), (quad)rng_normal(&rng)},
                              {(quad)rng_normal(&rng), (quad)rng_normal(&rng)},
                              {(quad)rng_normal(&rng), (quad)rng_normal(&rng)}};
        drogue_real m[6];
        drogue_eigen3 e;
        quad matrix[3][3], value[3], vector[3][3];
        int j;
        for (k = 0; k < 3; k++) {
            for (j = k; j < 3; j++) {
                m[at[k][j]] = real_of((quad)grade * (b[k][0] * b[j][0] + (quad)shape * b[k][1] * b[j][1]) -
                                      (k == 2 && j == 2 ? 1 : 0));
                matrix[k][j] = matrix[j][k] = quad_of(m[at[k][j]]);
            }
        }
        quad_eigen3(value, vector, (const quad(*)[3])matrix);
        (void)drogue_eigen_sym3(&e, m);
        if (value[1] > value[0] / 100) {
            for (k = 0; k < 3; k++) {
                MUST(quad_abs(quad_of(e.value[k]) - value[k]) <=
                         quad_abs(value[k]) * (quad)0x1p-27L * (k == 1 ? 100 : 1),
                     "grade %g: value %d is %.9g instead of %.9g", grade, k, (double)quad_of(e.value[k]),
                     (double)value[k]);
            }
        }
    }
}
END_TEST

SUITE_MAIN("eigen", random_matrices, chosen_spectra, edge_values, diagonal_needs_no_sweep,
           graded_matrices_keep_their_small_values)
