/* SPDX-License-Identifier: Apache-2.0 */
/* drogue: the library on images from the command line. */
#include <stdio.h>

#include "cli.h"
#include "commands.h"
#include "drogue/drogue.h"
#include "help.h"
#include "outputs.h"
#include "sequence.h"
#include "settings.h"

static int run(const options *o)
{
    switch (o->command) {
    case COMMAND_MEASURE: return command_measure(o);
    case COMMAND_TRACK: return command_track(o);
    case COMMAND_EDGES: return command_edges(o);
    case COMMAND_HELP_CONFIG: settings_print(); return flush_output();
    case COMMAND_VERSION: printf("drogue %s\n", drogue_version()); return flush_output();
    case COMMAND_HELP:
    default: help_print(); return flush_output();
    }
}

int main(int argc, char **argv)
{
    options o;
    int code;
    if (options_parse(&o, argc, argv)) {
        return EXIT_BAD;
    }
    code = sequence_expand(&o) || outputs_check(&o) ? EXIT_BAD : run(&o);
    sequence_free(&o);
    return code;
}
