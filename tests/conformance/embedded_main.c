/* SPDX-License-Identifier: Apache-2.0 */
/* The runner over the cases compiled in: for targets without files, any libc with a stdout. */
#include <stdio.h>

#include "conformance.h"

static void put(const char *text) { (void)fputs(text, stdout); }

int main(void)
{
    static conf_run run;
    size_t i;
    size_t k;
    printf("vectors %s\n", conf_vectors_version);
    conf_begin(&run, put);
    for (i = 0; i < conf_case_list_count; i++) {
        for (k = 0; k < conf_case_lists[i].count; k++) {
            conf_run_case(&run, &conf_case_lists[i].cases[k]);
        }
    }
    return conf_end(&run);
}
