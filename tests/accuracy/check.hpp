/* SPDX-License-Identifier: Apache-2.0 */
/* Checks of the self-tests: counted, printed when they fail, all run. */
#pragma once

#include <cmath>
#include <cstdio>

namespace accuracy {

inline int checks = 0;
inline int failures = 0;

inline void near(const char *what, double got, double want, double tolerance)
{
    checks++;
    if (!(std::fabs(got - want) <= tolerance)) {
        failures++;
        std::printf("FAIL %s: got %.9g, want %.9g within %.3g\n", what, got, want, tolerance);
    }
}

inline void truth(const char *what, bool holds) { near(what, holds ? 1 : 0, 1, 0); }

/* Last line of a self-test; its exit status. */
inline int finish(const char *test)
{
    std::printf("%s: checks=%d failures=%d\n", test, checks, failures);
    return failures == 0 ? 0 : 1;
}

} // namespace accuracy
