/* SPDX-License-Identifier: Apache-2.0 */
/* The library against the same put together from OpenCV, and its search against AprilTag's, on the same images: thread CPU
 * time, one thread, contenders in turn within one process, so that what disturbs one disturbs the other. Writes table.md,
 * bench.json and time.png; with --quick few images and sides. Exit status 1 when a ratio is more than twice the stated one. */
#include <getopt.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

#include <opencv2/imgproc.hpp>

#include "apriltag_way.hpp"
#include "images.hpp"
#include "library.hpp"
#include "opencv_way.hpp"
#include "tables.hpp"

using namespace bench;

namespace {

const char *const beside_tags = "search beside AprilTag";

/* Stated in docs/performance.md: the library's time over the other's. */
const Stateds stated = {{"front end", {0.8, 0}},
                        {"measurement", {0.45, 0}},
                        {"search", {0.75, 0}},
                        {"tracking", {0.8, 0}},
                        {beside_tags, {1, 1}}};

/* Both in turn, changing places from round to round. */
Entry compare(const std::string &what, const std::string &image, cv::Size size, const std::function<void()> &ours,
              const std::function<void()> &other, double budget_s)
{
    std::vector<double> a, b, ratio;
    ours();
    const double once = seconds(ours) + seconds(other);
    const int rounds = std::clamp(static_cast<int>(budget_s / once), 5, 101);
    for (int i = 0; i < rounds; i++) {
        const bool first = i % 2 == 0;
        double t = seconds(first ? ours : other);
        double u = seconds(first ? other : ours);
        if (!first) {
            std::swap(t, u);
        }
        a.push_back(t * 1e9 / size.area());
        b.push_back(u * 1e9 / size.area());
        ratio.push_back(t / u);
    }
    return {what, image, size.width, size.height, accuracy::median(a), accuracy::median(b), accuracy::median(ratio)};
}

Shares shares_of(const std::string &image, int side, Library &library)
{
    std::vector<double> front, outline;
    for (int i = 0; i < 7; i++) {
        const double all = seconds([&] { library.measure(); });
        front.push_back(seconds([&] { library.front_end(true); }) / all);
        outline.push_back(seconds([&] { library.outline(); }) / all);
    }
    return {image, side, accuracy::median(front), accuracy::median(outline)};
}

/* Least of three times, so that what disturbs the machine is not the worst. */
double least_s(const std::function<void()> &work) { return std::min({seconds(work), seconds(work), seconds(work)}); }

Spread spread_of(int side, int count)
{
    const double middle = (side - 1) / 2.0, f = side / 2.5 * 6 / rim_m;
    std::vector<double> whole_us, back_us;
    for (int seed = 0; seed < count; seed++) {
        const cv::Mat image = cluttered(side, seed);
        Library library(image, {f, f, middle, middle});
        whole_us.push_back(1e6 * least_s([&] { library.measure(); }));
        back_us.push_back(whole_us.back() - 1e6 * least_s([&] { library.front_end(true); }));
    }
    return {side,
            count,
            accuracy::median(whole_us),
            *std::max_element(whole_us.begin(), whole_us.end()),
            accuracy::median(back_us),
            *std::max_element(back_us.begin(), back_us.end())};
}

void add(std::vector<Entry> &entries, const Entry &e)
{
    std::fprintf(stderr, "%-22s %-20s %4d px  %7.2f %7.2f  %.2f\n", e.what.c_str(), e.image.c_str(), e.width, e.ours_ns,
                 e.other_ns, e.ratio);
    entries.push_back(e);
}

void compare_sides(std::vector<Entry> &entries, std::vector<Shares> &shares, const Image &image, int side,
                   double budget_s)
{
    const cv::Mat pixels = image.of_side(side);
    const double middle = (side - 1) / 2.0, f = side / 2.5 * 6 / rim_m;
    const accuracy::Camera camera = {f, f, middle, middle};
    Library library(pixels, camera);
    Tracker tracker;
    const auto both = [&](const char *what, const std::function<void()> &ours, const std::function<void()> &other) {
        add(entries, compare(what, image.name, pixels.size(), ours, other, budget_s));
    };
    both(
        "front end", [&] { library.front_end(false); }, [&] { (void)edges(pixels); });
    both(
        "measurement", [&] { library.measure(); }, [&] { (void)measure(pixels, camera, rim_m, depth_m); });
    both(
        "tracking", [&] { library.follow(); }, [&] { (void)tracker.frame(pixels, camera, rim_m, depth_m); });
    shares.push_back(shares_of(image.name, side, library));
}

void compare_searches(std::vector<Entry> &entries, const Image &image, cv::Size frame_px, double budget_s)
{
    cv::Mat frame;
    cv::resize(image.of_side(512), frame, frame_px, 0, 0, cv::INTER_LINEAR);
    Library library(frame, {1500, 1500, 640, 360});
    const auto ours = [&] { library.seek(); };
    add(entries, compare(
                     "search", image.name, frame_px, ours, [&] { (void)search(frame); }, budget_s));
    if (Tags::there()) {
        Tags tags;
        add(entries, compare(
                         beside_tags, image.name, frame_px, ours, [&] { (void)tags.count(frame); }, budget_s));
    }
}

/* A line for each stated ratio; 1 when one is far off. */
int judge(const std::vector<Entry> &entries)
{
    int status = 0;
    for (const auto &[what, limit] : stated) {
        const double mean = geometric_mean(entries, what, 256), worst = worst_ratio(entries, what);
        if (what == beside_tags && !Tags::there()) {
            std::printf("bench: %s: SKIPPED, libapriltag was not there when this was built\n", what.c_str());
            continue;
        }
        const bool far_off = !(mean <= 2 * limit.mean) || (limit.worst > 0 && !(worst <= 2 * limit.worst));
        std::printf("bench: %s: ratio %.2f, worst %.2f; stated %.2f%s\n", what.c_str(), mean, worst, limit.mean,
                    far_off ? ", FAR OFF" : "");
        status |= far_off;
    }
    return status;
}

int run(const std::string &folder, bool quick)
{
    const std::vector<int> sides = quick ? std::vector<int>{256, 512} : std::vector<int>{64, 128, 256, 512, 1024, 2048};
    const double budget_s = quick ? 0.1 : 0.6;
    std::vector<Entry> entries;
    std::vector<Shares> shares;
    std::vector<Spread> spreads;
    std::filesystem::create_directories(folder);
    cv::setNumThreads(1);
    for (const Image &image : images(quick)) {
        for (int side : sides) {
            compare_sides(entries, shares, image, side, budget_s);
        }
        compare_searches(entries, image, quick ? cv::Size(640, 360) : cv::Size(1280, 720), budget_s);
    }
    for (int side : {128, 256}) {
        spreads.push_back(spread_of(side, quick ? 50 : 1500));
    }
    write_table(folder, entries, shares, spreads, stated);
    write_json(folder, entries, spreads);
    if (!quick) {
        write_plot(folder, entries);
    }
    return judge(entries);
}

} // namespace

int main(int argc, char **argv)
{
    const option known[] = {{"out", required_argument, nullptr, 'o'}, {"quick", no_argument, nullptr, 'q'}, {}};
    std::string folder;
    bool quick = false;
    int c;
    while ((c = getopt_long(argc, argv, "", known, nullptr)) != -1) {
        if (c == 'o') {
            folder = optarg;
        } else if (c == 'q') {
            quick = true;
        } else {
            return 2;
        }
    }
    if (optind != argc || folder.empty()) {
        std::fprintf(stderr, "usage: bench --out DIR [--quick]\n");
        return 2;
    }
    return run(folder, quick);
}
