/* SPDX-License-Identifier: Apache-2.0 */
/* The library against the same put together from OpenCV, on the same images: thread CPU time, one thread, contenders in
 * turn within one process, so that what disturbs one disturbs the other. Writes table.md, bench.json and time.png; with
 * --quick few images and sides. Exit status 1 when a ratio is more than twice the stated one. */
#include <getopt.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "drogue/track.h"
#include "measure.hpp"
#include "opencv_way.hpp"
#include "report.hpp"
#include "scene.hpp"

namespace {

const double rim_m = 0.35, inner_m = 0.12, depth_m = 0.25;

/* Stated in docs/performance.md: geometric means over images and sides from 256 px of the library's time over OpenCV's. */
const std::map<std::string, double> stated = {
    {"front end", 0.8}, {"measurement", 0.45}, {"search", 2.2}, {"tracking", 0.8}};

double cpu_s()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(const std::function<void()> &work)
{
    const double begin = cpu_s();
    work();
    return cpu_s() - begin;
}

struct Image {
    std::string name;
    std::function<cv::Mat(int)> of_side;
};

/* A drogue in the middle of a square image, the side 2.5 semi-axes; above 'most' enlarged, with the sensor's noise anew. */
cv::Mat rendered(int side, const accuracy::Look &look, const accuracy::Background &background)
{
    const int most = 512;
    const int drawn = std::min(side, most);
    accuracy::Scene s;
    cv::Mat small, image, noise;
    const double middle = (drawn - 1) / 2.0, f = drawn / 2.5 * 6 / rim_m;
    s.camera = {f, f, middle, middle};
    s.image_px = {drawn, drawn};
    s.pose = {{0, 0, 6}, accuracy::axis_of(0.15, -0.1)};
    s.look = look;
    s.background = background;
    small = accuracy::render(s, {0, 0, drawn, drawn});
    if (drawn == side) {
        return small;
    }
    cv::resize(small, image, {side, side}, 0, 0, cv::INTER_CUBIC);
    noise.create(image.size(), CV_16S);
    cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::add(image, noise, image, cv::noArray(), CV_8U);
    return image;
}

std::vector<Image> images(bool quick)
{
    using accuracy::Background;
    using accuracy::Look;
    std::vector<Image> all = {
        {"rendered, sky", [](int s) { return rendered(s, Look::dark(), Background::sky()); }},
        {"rendered, ground", [](int s) { return rendered(s, Look::bright(), Background::ground()); }},
    };
    const std::filesystem::path folder = BENCH_IMAGES_DIR;
    if (!quick && std::filesystem::is_directory(folder)) {
        std::vector<std::filesystem::path> files;
        for (const auto &entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".png") {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin(), files.end());
        for (const auto &file : files) {
            const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
            all.push_back({"photograph " + file.stem().string(), [grey](int s) {
                               cv::Mat out;
                               cv::resize(grey, out, {s, s}, 0, 0, cv::INTER_AREA);
                               return out;
                           }});
        }
    }
    all.push_back({"uniform noise", [](int s) {
                       cv::Mat out(s, s, CV_8U);
                       cv::RNG(1).fill(out, cv::RNG::UNIFORM, 0, 256);
                       return out;
                   }});
    return all;
}

/* The library with memory for an image. */
struct Library {
    Library(const cv::Mat &image, const accuracy::Camera &camera)
        : q_image{image.data, image.cols, image.rows, static_cast<int32_t>(image.step)}, region{0, 0, image.cols,
                                                                                                image.rows}
    {
        const auto side = static_cast<uint32_t>(std::max(image.cols, image.rows));
        const uint32_t area = side * side;
        const drogue_capacity capacity = {side, area / 2, area / 4 + 2, area / 8 + 96};
        memory.resize(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
        search_memory.resize(DROGUE_SEARCH_BYTES(image.cols));
        drogue_config_default(&config);
        q_camera = {accuracy::to_q16(camera.fx_px),
                    accuracy::to_q16(camera.fy_px),
                    accuracy::to_q16(camera.cx_px),
                    accuracy::to_q16(camera.cy_px),
                    0,
                    0,
                    0,
                    0,
                    0};
        model = {accuracy::to_q16(rim_m), accuracy::to_q16(inner_m), accuracy::to_q16(depth_m)};
        drogue_track_config track_config;
        drogue_track_config_default(&track_config);
        CV_Assert(drogue_workspace_init(&workspace, memory.data(), memory.size() * 4, &capacity) == DROGUE_OK);
        CV_Assert(drogue_search_init(&search, search_memory.data(), search_memory.size(), image.cols) == DROGUE_OK);
        CV_Assert(drogue_track_init(&track, &track_config, &q_camera, &model, &region) == DROGUE_OK);
    }

    void front_end(bool ring)
    {
        drogue_frontend f;
        const drogue_mask mask = drogue_mask_of_size(region.width_px, region.height_px);
        const drogue_frontend_config c = {
            config.canny_low, config.canny_high, 1, ring, mask, static_cast<uint32_t>(region.width_px) / 8};
        CV_Assert(drogue_frontend_begin(&f, &workspace, &c, region.width_px, region.height_px) == DROGUE_OK);
        for (int32_t y = 0; y < region.height_px; y++) {
            drogue_frontend_row(&f, drogue_image_row(&q_image, y));
        }
        (void)drogue_frontend_end(&list, &f);
    }
    void outline()
    {
        const drogue_mask mask = drogue_mask_of_size(region.width_px, region.height_px);
        drogue_outline out;
        (void)drogue_outline_find(&out, &workspace, &list, &mask, &config);
    }
    void measure()
    {
        const drogue_setup setup = {&q_camera, &model, &config};
        (void)drogue_measure(&result, &workspace, &setup, &q_image, &region);
    }
    void seek()
    {
        CV_Assert(drogue_search_begin(&search, region.width_px) == DROGUE_OK);
        for (int32_t y = 0; y < region.height_px; y++) {
            drogue_search_row(&search, drogue_image_row(&q_image, y));
        }
        (void)drogue_search_end(&search);
    }
    void follow()
    {
        drogue_region used;
        (void)drogue_track_frame(&result, &used, &track, &workspace, &search, &config, &q_image, 40000);
    }

    drogue_image q_image;
    drogue_region region;
    drogue_camera q_camera;
    drogue_model model;
    drogue_config config;
    drogue_workspace workspace;
    drogue_search search;
    drogue_track track;
    drogue_result result;
    drogue_edge_list list = {0, 0};
    std::vector<uint32_t> memory;
    std::vector<uint8_t> search_memory;
};

struct Entry {
    std::string what, image;
    int width, height;
    double ours_ns, opencv_ns, ratio; /* a pixel; ratio: median of the rounds' */
};

/* Both in turn, changing places from round to round. */
Entry compare(const std::string &what, const std::string &image, cv::Size size, const std::function<void()> &ours,
              const std::function<void()> &opencv, double budget_s)
{
    std::vector<double> a, b, ratio;
    ours();
    const double once = seconds(ours) + seconds(opencv);
    const int rounds = std::clamp(static_cast<int>(budget_s / once), 5, 101);
    for (int i = 0; i < rounds; i++) {
        const bool first = i % 2 == 0;
        double t = seconds(first ? ours : opencv);
        double u = seconds(first ? opencv : ours);
        if (!first) {
            std::swap(t, u);
        }
        a.push_back(t * 1e9 / size.area());
        b.push_back(u * 1e9 / size.area());
        ratio.push_back(t / u);
    }
    return {what, image, size.width, size.height, accuracy::median(a), accuracy::median(b), accuracy::median(ratio)};
}

/* Shares of the front end and of the outline in a measurement; the rest is inner part, poses and decision. */
struct Shares {
    std::string image;
    int side;
    double front_end, outline;
};

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

void write_table(const std::string &folder, const std::vector<Entry> &entries, const std::vector<Shares> &shares)
{
    std::ofstream out(folder + "/table.md");
    out << "| what | image | pixels | ours, ns a pixel | OpenCV, ns a pixel | ratio |\n"
           "| --- | --- | --- | --- | --- | --- |\n";
    for (const Entry &e : entries) {
        out << "| " << e.what << " | " << e.image << " | " << e.width << " x " << e.height << " | "
            << accuracy::fixed(e.ours_ns, 2) << " | " << accuracy::fixed(e.opencv_ns, 2) << " | "
            << accuracy::fixed(e.ratio, 2) << " |\n";
    }
    out << "\n| geometric mean of ratios | from 64 px | from 256 px | stated |\n| --- | --- | --- | --- |\n";
    for (const auto &[what, limit] : stated) {
        out << "| " << what << " | " << accuracy::fixed(geometric_mean(entries, what, 64), 2) << " | "
            << accuracy::fixed(geometric_mean(entries, what, 256), 2) << " | " << accuracy::fixed(limit, 2) << " |\n";
    }
    out << "\n| stages of a measurement | side | front end | outline | the rest |\n| --- | --- | --- | --- | --- |\n";
    for (const Shares &s : shares) {
        out << "| " << s.image << " | " << s.side << " | " << accuracy::fixed(100 * s.front_end, 0) << " % | "
            << accuracy::fixed(100 * s.outline, 0) << " % | "
            << accuracy::fixed(100 * std::max(0.0, 1 - s.front_end - s.outline), 0) << " % |\n";
    }
}

void write_json(const std::string &folder, const std::vector<Entry> &entries)
{
    cv::FileStorage file(folder + "/bench.json", cv::FileStorage::WRITE | cv::FileStorage::FORMAT_JSON);
    file << "opencv" << CV_VERSION << "entries"
         << "[";
    for (const Entry &e : entries) {
        file << "{"
             << "what" << e.what << "image" << e.image << "width" << e.width << "height" << e.height
             << "ours_ns_per_pixel" << e.ours_ns << "opencv_ns_per_pixel" << e.opencv_ns << "ratio" << e.ratio << "}";
    }
    file << "]";
}

void plot(accuracy::Report &report, const std::vector<Entry> &entries)
{
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
                opencv[e.width * e.height].push_back(e.opencv_ns * e.width * e.height * 1e-6);
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
}

int run(const std::string &folder, bool quick)
{
    const std::vector<int> sides = quick ? std::vector<int>{256, 512} : std::vector<int>{64, 128, 256, 512, 1024, 2048};
    const double budget_s = quick ? 0.1 : 0.6;
    std::vector<Entry> entries;
    std::vector<Shares> shares;
    std::filesystem::create_directories(folder);
    cv::setNumThreads(1);
    for (const Image &image : images(quick)) {
        for (int side : sides) {
            const cv::Mat pixels = image.of_side(side);
            const double middle = (side - 1) / 2.0, f = side / 2.5 * 6 / rim_m;
            const accuracy::Camera camera = {f, f, middle, middle};
            Library library(pixels, camera);
            bench::Tracker tracker;
            const auto both = [&](const char *what, const std::function<void()> &ours,
                                  const std::function<void()> &opencv) {
                entries.push_back(compare(what, image.name, pixels.size(), ours, opencv, budget_s));
                std::fprintf(stderr, "%-12s %-20s %4d px  %7.2f %7.2f  %.2f\n", what, image.name.c_str(), side,
                             entries.back().ours_ns, entries.back().opencv_ns, entries.back().ratio);
            };
            both(
                "front end", [&] { library.front_end(false); }, [&] { (void)bench::edges(pixels); });
            both(
                "measurement", [&] { library.measure(); },
                [&] { (void)bench::measure(pixels, camera, rim_m, depth_m); });
            both(
                "tracking", [&] { library.follow(); }, [&] { (void)tracker.frame(pixels, camera, rim_m, depth_m); });
            shares.push_back(shares_of(image.name, side, library));
        }
        const cv::Size frame_px(quick ? cv::Size(640, 360) : cv::Size(1280, 720));
        cv::Mat frame;
        cv::resize(image.of_side(512), frame, frame_px, 0, 0, cv::INTER_LINEAR);
        Library library(frame, {1500, 1500, 640, 360});
        entries.push_back(compare(
            "search", image.name, frame_px, [&] { library.seek(); }, [&] { (void)bench::search(frame); }, budget_s));
    }
    write_table(folder, entries, shares);
    write_json(folder, entries);
    if (!quick) {
        accuracy::Report report(folder, "Benchmark");
        plot(report, entries);
        (void)report.finish();
    }
    int status = 0;
    for (const auto &[what, limit] : stated) {
        const double mean = geometric_mean(entries, what, 256);
        const bool far_off = !(mean <= 2 * limit);
        std::printf("bench: %s: ratio %.2f, stated %.2f%s\n", what.c_str(), mean, limit, far_off ? ", FAR OFF" : "");
        status |= far_off;
    }
    return status;
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
