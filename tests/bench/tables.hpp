/* SPDX-License-Identifier: Apache-2.0 */
/* What the benchmark found, as tables for docs/performance.md, as JSON and as a plot. */
#pragma once

#include <map>
#include <string>
#include <vector>

namespace bench {

struct Entry {
    std::string what, image;
    int width, height;
    double ours_ns, other_ns, ratio; /* a pixel; ratio: median of the rounds' */
};

/* Shares of the front end and of the outline in a measurement; the rest is inner part, poses and decision. */
struct Shares {
    std::string image;
    int side;
    double front_end, outline;
};

/* Time of drogue_measure() over cluttered images of one side. */
struct Spread {
    int side, images;
    double median_us, worst_us;           /* of the whole measurement */
    double back_median_us, back_worst_us; /* less one front end */
};

/* What is stated in docs/performance.md of a comparison: the library's time over the other's. */
struct Stated {
    double mean;  /* geometric mean over images and sides from 256 px */
    double worst; /* of one image; 0: not stated */
};
using Stateds = std::map<std::string, Stated>;

/* NAN when there are none. */
double geometric_mean(const std::vector<Entry> &entries, const std::string &what, int least_side);
double worst_ratio(const std::vector<Entry> &entries, const std::string &what);

void write_table(const std::string &folder, const std::vector<Entry> &entries, const std::vector<Shares> &shares,
                 const std::vector<Spread> &spreads, const Stateds &stated);
void write_json(const std::string &folder, const std::vector<Entry> &entries, const std::vector<Spread> &spreads);
void write_plot(const std::string &folder, const std::vector<Entry> &entries);

} // namespace bench
