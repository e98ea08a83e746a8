/* SPDX-License-Identifier: Apache-2.0 */
/* One violation a rule of the checked build, by number: each must be reported. */
#include <stdlib.h>

int main(int argc, char **argv)
{
    volatile int64_t big = INT64_MAX;
    int32_t s;
    int32_t c;
    switch (argc > 1 ? atoi(argv[1]) : 0) {
    case 1: DROGUE_NOTE("bites: a quantity", big, 62); break;
    case 2: (void)drogue_shl_s64(big, 1); break;
    case 3: (void)drogue_shr_round_s64(big, 64); break;
    case 4: (void)drogue_div_round_s64(1, (int64_t)(big - big)); break;
    case 5: drogue_sincos_q30(&s, &c, INT32_MAX); break;
    default: DROGUE_NOTE("bites: a quantity", 1, 1); break;
    }
    return 0;
}
