/* SPDX-License-Identifier: Apache-2.0 */
/* The accuracy study: writes report.md with its plots. Exit status 1 when a bar is missed that is not known as missed. */
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>

#include <getopt.h>

#include "study.hpp"

using namespace accuracy;

namespace {

struct Arguments {
    std::string out, only;
    StudyOptions options;
};

struct Section {
    const char *name;
    void (*write)(Report &, const StudyOptions &);
};

constexpr Section sections[] = {
    {"distances", section_distances},   {"conditions", section_conditions}, {"loss", section_loss},
    {"extraction", section_extraction}, {"noise", section_pose_noise},      {"approach", section_approach},
    {"table5", section_table5},         {"search", section_search},         {"sequences", section_sequences},
    {"tracking", section_tracking},     {"boards", section_boards},         {"systems", section_systems},
};

void usage(FILE *to)
{
    std::fputs(
        "usage: study --out DIR [--quick] [--seed S] [--threads N] [--cache DIR] [--only SECTION]\n"
        "  --out DIR    report.md, its plots and their data\n"
        "  --quick      few scenes: less than two minutes\n"
        "  --seed S     seed of the scenes (1)\n"
        "  --threads N  as many as the machine has\n"
        "  --cache DIR  keep rendered regions there and use those that are (empty it when the renderer changes)\n"
        "  --only SECTION  one of:",
        to);
    for (const Section &s : sections) {
        std::fprintf(to, " %s", s.name);
    }
    std::fputc('\n', to);
}

Arguments parse(int argc, char **argv)
{
    const option known[] = {{"out", required_argument, nullptr, 'o'},     {"quick", no_argument, nullptr, 'q'},
                            {"seed", required_argument, nullptr, 's'},    {"cache", required_argument, nullptr, 'c'},
                            {"threads", required_argument, nullptr, 't'}, {"only", required_argument, nullptr, 'y'},
                            {"help", no_argument, nullptr, 'h'},          {nullptr, 0, nullptr, 0}};
    Arguments a;
    int c;
    while ((c = getopt_long(argc, argv, "", known, nullptr)) != -1) {
        switch (c) {
        case 'o': a.out = optarg; break;
        case 'q': a.options.quick = true; break;
        case 's': a.options.seed = std::strtoull(optarg, nullptr, 10); break;
        case 'c': a.options.cache = optarg; break;
        case 'y': a.only = optarg; break;
        case 't': a.options.threads = std::atoi(optarg); break;
        case 'h': usage(stdout); std::exit(0);
        default: usage(stderr); std::exit(2);
        }
    }
    const bool there = a.only.empty() || std::any_of(std::begin(sections), std::end(sections),
                                                     [&](const Section &s) { return a.only == s.name; });
    if (optind != argc || a.out.empty() || !there) {
        usage(stderr);
        std::exit(2);
    }
    return a;
}

/* Bars that the library does not reach yet, and why: take off the list what is met. */
void declare_known(Report &report)
{
    report.known_missed(
        "normalised error squared, mean",
        "the covariance allows for shading beside the rim, which the drogue of these scenes hardly has. With 0.6 for "
        "outline_shading it is 4.2 here, but 2.9 to 3.5 a degree of freedom where the light changes, and courses lose frames");
    report.known_missed(
        "circle boards: z, mean",
        "every board but one reads 0.2 to 0.35 % near: the discs are that much larger than the truth has "
        "them, in the hand-labelled ellipses too; about its mean z scatters by 0.14 %");
    report.known_missed(
        "filtered over raw error, severe turbulence, worst of five",
        "0.98 over all its frames, 1.00 over the quick form's: what is wrong with x, y and z at 20 to 25 m lasts from "
        "frame to frame, as the shading does, and there is little to average");
    report.known_missed("z at 3 m, median",
                        "0.0041 %: noise of the rays along which what lies beside the outline is measured");
}

bool study(const Arguments &a)
{
    Report report(a.out, a.options.quick ? "Accuracy study, quick" : "Accuracy study");
    StudyOptions options = a.options;
    if (options.cache.empty()) {
        options.cache = a.out + "/scenes";
        std::filesystem::remove_all(options.cache);
    }
    std::filesystem::create_directories(options.cache);
    declare_known(report);
    for (const Section &section : sections) {
        if (a.only.empty() || a.only == section.name) {
            section.write(report, options);
        }
    }
    if (a.options.cache.empty()) {
        std::filesystem::remove_all(options.cache);
    }
    return report.finish();
}

} // namespace

int main(int argc, char **argv)
{
    const Arguments a = parse(argc, argv);
    try {
        return study(a) ? 0 : 1;
    } catch (const std::exception &e) {
        std::fprintf(stderr, "study: %s\n", e.what());
        return 2;
    }
}
