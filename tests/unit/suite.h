/* SPDX-License-Identifier: Apache-2.0 */
/* One Check suite an executable: its tests in a table, its result as the exit code. */
#ifndef DROGUE_TESTS_SUITE_H
#define DROGUE_TESTS_SUITE_H

#include <check.h>

#include "common.h"

/* For loops of many cases: an assertion of Check's notes its position each time it passes, this only acts on failure. */
#define MUST(condition, ...)           \
    do {                               \
        if (!(condition)) {            \
            ck_abort_msg(__VA_ARGS__); \
        }                              \
    } while (0)

/* The configuration takes 'good' in that member and refuses 'bad'. */
#define CHECK_LIMIT(valid, config, member, good, bad)                            \
    do {                                                                         \
        const int32_t kept_ = (config).member;                                   \
        (config).member = (good);                                                \
        MUST(valid(&(config)), #member " = %d refused", (int)(config).member);   \
        (config).member = (bad);                                                 \
        MUST(!valid(&(config)), #member " = %d accepted", (int)(config).member); \
        (config).member = kept_;                                                 \
    } while (0)

#define SUITE_TIMEOUT_S 300.0 /* sanitizers and emulators are slow */

static inline int suite_run(const char *name, const TTest *const *tests, size_t count)
{
    Suite *suite = suite_create(name);
    TCase *tcase = tcase_create(name);
    SRunner *runner;
    size_t i;
    int failed;
    tcase_set_timeout(tcase, SUITE_TIMEOUT_S);
    for (i = 0; i < count; i++) {
        tcase_add_test(tcase, tests[i]);
    }
    suite_add_tcase(suite, tcase);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* main() of a suite; the arguments are its tests. */
#define SUITE_MAIN(name, ...)                                          \
    int main(void)                                                     \
    {                                                                  \
        const TTest *const tests[] = {__VA_ARGS__};                    \
        return suite_run(name, tests, sizeof tests / sizeof tests[0]); \
    }

#endif
