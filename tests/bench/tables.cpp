/* SPDX-License-Identifier: Apache-2.0 */
#include "tables.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <opencv2/core.hpp>

#include "measure.hpp"
#include "report.hpp"

namespace bench {

double geometric_mean(const std::vector<Entry> &entries, const std::string &what, int least_side)
{
    double sum = 0;
    int count = 0;
    for (const Entry &e : entries) {
        if (e.what == what && std::max(e.width, e.height) >= least_side) {
            sum += std::log(e.ratio);
            count++;
        }
    }
    return count > 0 ? std::exp(sum / count) : NAN;
}

double worst_ratio(const std::vector<Entry> &entries, const std::string &what)
{
    double worst = NAN;
    for (const Entry &e : entries) {
        if (e.what == what && !(e.ratio <= worst)) {
            worst = e.ratio;
        }
    }
    return worst;
}

namespace {

/* For each kind and size: the image that takes longest, over the median of all images. */
void write_worst(std::ofstream &out, const std::vector<Entry> &entries)
{
    std::map<std::pair<std::string, int>, std::vector<const Entry *>> groups;
    for (const Entry &e : entries) {
        if (e.what.find("beside") == std::string::npos) {
            groups[{e.what, e.width}].push_back(&e);
        }
    }
    out << "\n| worst over typical | pixels | median of the images, ns a pixel | worst, ns a pixel | which | worst over "
           "typical |\n| --- | --- | --- | --- | --- | --- |\n";
    for (const auto &[key, group] : groups) {
        std::vector<double> ns;
        for (const Entry *e : group) {
            ns.push_back(e->ours_ns);
        }
        const Entry *worst =
            *std::max_element(group.begin(), group.end(), [](auto a, auto b) { return a->ours_ns < b->ours_ns; });
        const double typical = accuracy::median(ns);
        out << "| " << key.first << " | " << worst->width << " x " << worst->height << " | "
            << accuracy::fixed(typical, 2) << " | " << accuracy::fixed(worst->ours_ns, 2) << " | " << worst->image
            << " | " << accuracy::fixed(worst->ours_ns / typical, 1) << " |\n";
    }
}

void write_spreads(std::ofstream &out, const std::vector<Spread> &spreads)
{
    out << "\n| cluttered images | side | median, us | worst, us | worst over median | without a front end: median, us | "
           "worst, us | worst over median |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Spread &s : spreads) {
        out << "| " << s.images << " | " << s.side << " | " << accuracy::fixed(s.median_us, 0) << " | "
            << accuracy::fixed(s.worst_us, 0) << " | " << accuracy::fixed(s.worst_us / s.median_us, 1) << " | "
            << accuracy::fixed(s.back_median_us, 0) << " | " << accuracy::fixed(s.back_worst_us, 0) << " | "
            << accuracy::fixed(s.back_worst_us / s.back_median_us, 1) << " |\n";
    }
}

} // namespace

void write_table(const std::string &folder, const std::vector<Entry> &entries, const std::vector<Shares> &shares,
                 const std::vector<Spread> &spreads, const Stateds &stated)
{
    std::ofstream out(folder + "/table.md");
    out << "| what | image | pixels | ours, ns a pixel | other, ns a pixel | ratio |\n"
           "| --- | --- | --- | --- | --- | --- |\n";
    for (const Entry &e : entries) {
        out << "| " << e.what << " | " << e.image << " | " << e.width << " x " << e.height << " | "
            << accuracy::fixed(e.ours_ns, 2) << " | " << accuracy::fixed(e.other_ns, 2) << " | "
            << accuracy::fixed(e.ratio, 2) << " |\n";
    }
    out << "\n| ratios | geometric mean from 64 px | from 256 px | worst | stated: mean from 256 px | worst |\n"
           "| --- | --- | --- | --- | --- | --- |\n";
    for (const auto &[what, limit] : stated) {
        if (std::isnan(worst_ratio(entries, what))) {
            continue;
        }
        out << "| " << what << " | " << accuracy::fixed(geometric_mean(entries, what, 64), 2) << " | "
            << accuracy::fixed(geometric_mean(entries, what, 256), 2) << " | "
            << accuracy::fixed(worst_ratio(entries, what), 2) << " | " << accuracy::fixed(limit.mean, 2) << " | "
            << (limit.worst > 0 ? accuracy::fixed(limit.worst, 2) : "-") << " |\n";
    }
    write_worst(out, entries);
    write_spreads(out, spreads);
    out << "\n| stages of a measurement | side | front end | outline | the rest |\n| --- | --- | --- | --- | --- |\n";
    for (const Shares &s : shares) {
        out << "| " << s.image << " | " << s.side << " | " << accuracy::fixed(100 * s.front_end, 0) << " % | "
            << accuracy::fixed(100 * s.outline, 0) << " % | "
            << accuracy::fixed(100 * std::max(0.0, 1 - s.front_end - s.outline), 0) << " % |\n";
    }
}

void write_json(const std::string &folder, const std::vector<Entry> &entries, const std::vector<Spread> &spreads)
{
    cv::FileStorage file(folder + "/bench.json", cv::FileStorage::WRITE | cv::FileStorage::FORMAT_JSON);
    file << "opencv" << CV_VERSION << "entries"
         << "[";
    for (const Entry &e : entries) {
        file << "{"
             << "what" << e.what << "image" << e.image << "width" << e.width << "height" << e.height
             << "ours_ns_per_pixel" << e.ours_ns << "other_ns_per_pixel" << e.other_ns << "ratio" << e.ratio << "}";
    }
    file << "]"
         << "cluttered"
         << "[";
    for (const Spread &s : spreads) {
        file << "{"
             << "side" << s.side << "images" << s.images << "median_us" << s.median_us << "worst_us" << s.worst_us
             << "back_median_us" << s.back_median_us << "back_worst_us" << s.back_worst_us << "}";
    }
    file << "]";
}

void write_plot(const std::string &folder, const std::vector<Entry> &entries)
{
    accuracy::Report report(folder, "Benchmark");
    accuracy::Plot p;
    p.name = "time";
    p.caption = "Time of one image by its pixels, medians over the images";
    p.x_label = "pixels";
    p.y_label = "CPU time, ms";
    p.log_x = p.log_y = true;
    p.commands = {"set key left"};
    for (const char *what : {"front end", "measurement", "tracking"}) {
        std::map<int, std::vector<double>> ours, opencv;
        for (const Entry &e : entries) {
            if (e.what == what) {
                ours[e.width * e.height].push_back(e.ours_ns * e.width * e.height * 1e-6);
                opencv[e.width * e.height].push_back(e.other_ns * e.width * e.height * 1e-6);
            }
        }
        for (const auto &[name, times] : {std::pair("ours", ours), std::pair("OpenCV", opencv)}) {
            accuracy::Series series;
            series.title = std::string(what) + ", " + name;
            for (const auto &[pixels, values] : times) {
                series.x.push_back(pixels);
                series.y.push_back(accuracy::median(values));
            }
            p.series.push_back(series);
        }
    }
    report.plot(p);
    (void)report.finish();
}

} // namespace bench
