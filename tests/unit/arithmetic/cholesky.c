/* SPDX-License-Identifier: Apache-2.0 */
/* Factor, solve, square and invert against quadruple precision, up to the least pivot that is accepted. */
#include "suite.h"

#include "drogue/cholesky.h"
#include "real_quad.h"

typedef quad matrix[5][5];

/* Random positive definite matrix of real numbers: its variables are scaled by up to 2^+-reach, and each is the sum of
 * others but for a share of about 2^-near. */
static void random_matrix(drogue_real *a, matrix exact, int n, int reach, double near, uint64_t *rng)
{
    quad b[5][6], scale[5];
    int i, j, k;
    for (i = 0; i < n; i++) {
        scale[i] = quad_scale(1, rng_range(rng, -reach, reach));
        for (k = 0; k < 6; k++) {
            b[i][k] = (quad)rng_normal(rng) * (quad)exp2(-near * rng_real(rng, 0, 1));
        }
        for (k = 0; i > 0 && k < 6 && near > 0; k++) {
            b[i][k] += b[rng_range(rng, 0, i - 1)][k];
        }
    }
    for (i = 0; i < n; i++) {
        for (j = 0; j <= i; j++) {
            quad sum = 0;
            for (k = 0; k < 6; k++) {
                sum += b[i][k] * b[j][k];
            }
            a[DROGUE_PACKED(i, j)] = real_of(sum * scale[i] * scale[j]);
            exact[i][j] = exact[j][i] = quad_of(a[DROGUE_PACKED(i, j)]);
        }
    }
}

/* Condition of the matrix scaled to a diagonal of ones: sum of its inverse's magnitudes. */
static double condition(matrix inverse, matrix exact, int n)
{
    double sum = 0;
    int i, j;
    for (i = 0; i < n; i++) {
        for (j = 0; j < n; j++) {
            sum += (double)(quad_abs(inverse[i][j]) * quad_sqrt(exact[i][i]) * quad_sqrt(exact[j][j]));
        }
    }
    return sum;
}

static const double ulp = 1.0 / 1073741824.0; /* 2^-30 */

static void check_matrix(int n, int reach, double near, uint64_t *rng, int number, int *accepted)
{
    drogue_real a[DROGUE_PACKED_MAX], l[DROGUE_PACKED_MAX], inverted[DROGUE_PACKED_MAX], b[5], x[5], length2;
    matrix exact, inverse;
    double kappa;
    quad square = 0;
    int i, j, k;
    random_matrix(a, exact, n, reach, near, rng);
    MUST(quad_invert(inverse, exact, n), "matrix %d is singular", number);
    kappa = condition(inverse, exact, n);
    memcpy(l, a, sizeof l);
    if (drogue_cholesky_factor(l, n) != DROGUE_OK) {
        MUST(kappa > 1e7, "matrix %d of condition %g refused", number, kappa);
        return;
    }
    (*accepted)++;
    for (i = 0; i < n; i++) { /* L L' = A, to rounding */
        MUST(l[DROGUE_PACKED(i, i)].mantissa > 0, "matrix %d: diagonal", number);
        for (j = 0; j <= i; j++) {
            quad sum = -exact[i][j];
            for (k = 0; k <= j; k++) {
                sum += quad_of(l[DROGUE_PACKED(i, k)]) * quad_of(l[DROGUE_PACKED(j, k)]);
            }
            MUST(quad_abs(sum) <= (quad)(16 * ulp) * quad_sqrt(exact[i][i] * exact[j][j]), "matrix %d: factor %d %d",
                 number, i, j);
        }
    }
    for (i = 0; i < n; i++) {
        b[i] = real_of((quad)rng_normal(rng) * quad_sqrt(exact[i][i]));
        x[i] = b[i];
    }
    drogue_cholesky_solve(x, l, n);
    drogue_cholesky_invert(inverted, l, n);
    for (i = 0; i < n; i++) {
        quad sum = 0;
        for (j = 0; j < n; j++) {
            quad error = quad_of(inverted[DROGUE_PACKED(i, j)]) - inverse[i][j];
            sum += inverse[i][j] * quad_of(b[j]);
            square += quad_of(b[i]) * inverse[i][j] * quad_of(b[j]);
            MUST(quad_abs(error) * quad_sqrt(exact[i][i] * exact[j][j]) <= (quad)(32 * ulp * kappa * kappa),
                 "matrix %d of condition %g: inverse %d %d", number, kappa, i, j);
        }
        MUST(quad_abs(quad_of(x[i]) - sum) * quad_sqrt(exact[i][i]) <= (quad)(128 * ulp * kappa * kappa),
             "matrix %d of condition %g: solution %d", number, kappa, i);
    }
    drogue_cholesky_square(&length2, b, l, n);
    MUST(quad_abs(quad_of(length2) - square) <= (quad)(256 * ulp * kappa * kappa), "matrix %d of condition %g: square",
         number, kappa);
}

START_TEST(random_matrices)
{
    uint64_t rng = 1;
    int i, accepted = 0;
    for (i = 0; i < 20000; i++) {
        check_matrix(1 + i % 5, 0, 0, &rng, i, &accepted);
    }
    ck_assert_int_eq(accepted, 20000);
}
END_TEST

START_TEST(variables_of_very_different_size)
{
    uint64_t rng = 2;
    int i, accepted = 0;
    for (i = 0; i < 20000; i++) {
        check_matrix(1 + i % 5, 400, 0, &rng, i, &accepted);
    }
    ck_assert_int_eq(accepted, 20000);
}
END_TEST

START_TEST(ill_conditioned_matrices)
{
    uint64_t rng = 3;
    int i, accepted = 0;
    for (i = 0; i < 20000; i++) {
        check_matrix(2 + i % 4, 20, 12, &rng, i, &accepted);
    }
    ck_assert_int_gt(accepted, 15000);
}
END_TEST

static drogue_real whole(int64_t v) { return real_set(v, 0); }

/* The least pivot that is accepted is 2^-26 of the diagonal entry. */
START_TEST(least_pivot)
{
    drogue_real a[3];
    int turn;
    for (turn = 0; turn < 3; turn++) {
        a[0] = whole(1);
        a[1] = whole(1);
        a[2] = real_set((INT64_C(1) << 27) + (turn == 0 ? 3 : turn == 1 ? 2 : 1), -27); /* 1 + p */
        ck_assert_int_eq(drogue_cholesky_factor(a, 2), turn == 0 ? DROGUE_OK : DROGUE_E_DEGENERATE);
    }
}
END_TEST

START_TEST(not_positive_definite)
{
    drogue_real a[DROGUE_PACKED_MAX];
    uint64_t rng = 4;
    int n, i, k, round;
    for (n = 1; n <= 5; n++) { /* zero; a negative or zero entry of the diagonal */
        memset(a, 0, sizeof a);
        ck_assert_int_eq(drogue_cholesky_factor(a, n), DROGUE_E_DEGENERATE);
        for (k = 0; k < n; k++) {
            for (i = 0; i < 2; i++) {
                int j;
                memset(a, 0, sizeof a);
                for (j = 0; j < n; j++) {
                    a[DROGUE_PACKED(j, j)] = whole(j == k ? -i : 3);
                }
                ck_assert_int_eq(drogue_cholesky_factor(a, n), DROGUE_E_DEGENERATE);
            }
        }
    }
    for (round = 0; round < 5000; round++) { /* of less rank than size: the last variable repeats others */
        matrix exact;
        quad weight[5];
        int j;
        n = 2 + round % 4;
        random_matrix(a, exact, n - 1, 10, 0, &rng);
        for (k = 0; k < n - 1; k++) {
            weight[k] = (quad)rng_range(&rng, -3, 3);
        }
        weight[round % (n - 1)] = 1;
        exact[n - 1][n - 1] = 0;
        for (i = 0; i < n - 1; i++) {
            quad sum = 0;
            for (j = 0; j < n - 1; j++) {
                sum += weight[j] * exact[i][j];
            }
            a[DROGUE_PACKED(n - 1, i)] = real_of(sum);
            exact[n - 1][n - 1] += weight[i] * sum;
        }
        a[DROGUE_PACKED(n - 1, n - 1)] = real_of(exact[n - 1][n - 1]);
        MUST(drogue_cholesky_factor(a, n) == DROGUE_E_DEGENERATE, "singular matrix %d accepted", round);
    }
}
END_TEST

START_TEST(packing)
{
    int i, j, at = 0;
    for (i = 0; i < DROGUE_CHOLESKY_MAX; i++) {
        for (j = 0; j <= i; j++, at++) {
            ck_assert_int_eq(DROGUE_PACKED(i, j), at);
            ck_assert_int_eq(DROGUE_PACKED(j, i), at);
        }
    }
    ck_assert_int_eq(at, DROGUE_PACKED_MAX);
}
END_TEST

SUITE_MAIN("cholesky", random_matrices, variables_of_very_different_size, ill_conditioned_matrices, least_pivot,
           not_positive_definite, packing)
