/* SPDX-License-Identifier: Apache-2.0 */
/* conformance: runs the golden vectors of a folder through this build of the library, or judges the outputs of another. */
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "judge.h"

static const char usage_text[] =
    "usage: conformance [--vectors DIR] [--stage NAME]    run all cases, or those of one stage\n"
    "       conformance [--vectors DIR] [--stage NAME] --list    print their ids and tiers\n"
    "       conformance [--vectors DIR] judge STAGE|CASE RESULTS    compare the result files in a folder with\n"
    "                   the bit-exact tier\n"
    "\n"
    "DIR is 'vectors' unless given. Exit status: 0 all is well, 1 a comparison failed, 2 bad usage or vectors.\n";

static void put(const char *text) { (void)fputs(text, stdout); }

static int usage_error(const char *what, const char *argument)
{
    fprintf(stderr, "conformance: %s%s\n%s", what, argument, usage_text);
    return 2;
}

static int selected(const conf_case *c, const char *stage) { return stage == NULL || strcmp(c->stage, stage) == 0; }

static int run_cases(const vectors *v, const char *stage)
{
    static conf_run run;
    size_t i;
    conf_begin(&run, put);
    for (i = 0; i < v->count; i++) {
        if (selected(&v->cases[i].run, stage)) {
            conf_run_case(&run, &v->cases[i].run);
        }
    }
    return conf_end(&run);
}

static int list_cases(const vectors *v, const char *stage)
{
    size_t i;
    for (i = 0; i < v->count; i++) {
        if (selected(&v->cases[i].run, stage)) {
            printf("%s %s\n", v->cases[i].run.id, v->cases[i].run.tier);
        }
    }
    return 0;
}

static int is_stage(const char *name)
{
    int i;
    for (i = 0; i < conf_stage_count() && strcmp(conf_stage_name(i), name) != 0; i++) {}
    return i < conf_stage_count();
}

int main(int argc, char **argv)
{
    static const struct option options[] = {{"vectors", required_argument, NULL, 'v'},
                                            {"stage", required_argument, NULL, 's'},
                                            {"list", no_argument, NULL, 'l'},
                                            {"help", no_argument, NULL, 'h'},
                                            {NULL, 0, NULL, 0}};
    const char *directory = "vectors";
    const char *stage = NULL;
    vectors v;
    int list = 0;
    int judging;
    int option;
    int status;
    while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
        switch (option) {
        case 'v': directory = optarg; break;
        case 's': stage = optarg; break;
        case 'l': list = 1; break;
        case 'h': put(usage_text); return 0;
        default: fputs(usage_text, stderr); return 2;
        }
    }
    judging = optind < argc && strcmp(argv[optind], "judge") == 0;
    if (stage != NULL && !is_stage(stage)) {
        return usage_error("there is no stage ", stage);
    }
    if (judging ? argc - optind != 3 || list || stage != NULL : optind < argc) {
        return usage_error(judging ? "judge takes a stage or case and a folder" : "unexpected argument ",
                           judging ? "" : argv[optind]);
    }
    if (!vectors_read(&v, directory)) {
        status = 2;
    } else if (judging) {
        status = judge(&v, argv[optind + 1], argv[optind + 2], directory);
    } else {
        status = list ? list_cases(&v, stage) : run_cases(&v, stage);
    }
    vectors_free();
    if (fflush(stdout) != 0) {
        return 2;
    }
    return status;
}
