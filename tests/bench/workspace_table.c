/* SPDX-License-Identifier: Apache-2.0 */
/* Prints the RAM that a frame needs, per longest side of the region: the table in README.md. */
#include <stdio.h>

#include "drogue/drogue.h"

int main(void)
{
    static const unsigned side[] = {64, 128, 160, 256, 512, 1024, 2048};
    size_t i;
    puts("| region, px | edge points | labels | arcs | workspace, KiB |");
    puts("| --- | --- | --- | --- | --- |");
    for (i = 0; i < sizeof side / sizeof side[0]; i++) {
        printf("| %u | %zu | %zu | %zu | %.1f |\n", side[i], DROGUE_EDGES_FOR(side[i]), DROGUE_LABELS_FOR(side[i]),
               DROGUE_ARCS_FOR(side[i]), (double)DROGUE_WORKSPACE_BYTES_FOR(side[i]) / 1024.0);
    }
    return 0;
}
