/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of the search of whole frames and of the courses of the tracker. */
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "course.hpp"
#include "parallel.hpp"
#include "search_frames.hpp"

using namespace accuracy;

namespace {

struct Options {
    uint64_t seed = 1;
    int courses = 3;  /* of each name */
    int frames = 100; /* with a drogue, and as many without */
    Variety variety;
    std::string cache, sheets, only;
    bool list = false;
    bool bars = false;
};

cv::Mat contact_sheet(const std::vector<cv::Mat> &images, int columns, const cv::Size &tile)
{
    const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
    cv::Mat sheet(rows * tile.height, columns * tile.width, CV_8U, cv::Scalar(0));
    for (int i = 0; i < static_cast<int>(images.size()); i++) {
        cv::Mat small;
        cv::resize(images[static_cast<size_t>(i)], small, tile, 0, 0, cv::INTER_AREA);
        small.copyTo(sheet(cv::Rect(i % columns * tile.width, i / columns * tile.height, tile.width, tile.height)));
    }
    return sheet;
}

/* Of measurements whose log odds lie from one whole number to the next: how many are right, and how many they expect. */
struct Odds {
    int frames = 0, right = 0;
    double expected = 0;
};

void print_odds(const std::map<int, Odds> &odds)
{
    std::printf("log odds         measured  right  expected\n");
    for (const auto &[from, o] : odds) {
        std::printf("%3d to %3d       %9d %6d %9.1f\n", from, from + 1, o.frames, o.right, o.expected);
    }
}

void print_frames(const Options &o, bool has_drogue, std::map<int, Odds> &odds)
{
    struct Count {
        int frames = 0, hit = 0, wrong = 0, none = 0, unsure = 0, sighted = 0, can_be = 0, can_decide = 0;
        void add(const Search &s)
        {
            const Finding f = s.finding;
            unsure += s.unsure_right;
            sighted += s.sighted >= 0;
            can_be += s.can_be;
            can_decide += s.can_decide;
            frames++;
            hit += f == Finding::hit;
            wrong += f == Finding::wrong;
            none += f == Finding::none;
        }
    };
    std::vector<WholeFrame> frames(static_cast<size_t>(o.frames));
    std::vector<Search> found(frames.size());
    std::map<std::string, Count> by;
    std::map<int, int> statuses;
    std::vector<double> ms;
    parallel_for(
        frames.size(), 0,
        [&](size_t i) {
            frames[i] = make_whole_frame(o.seed, static_cast<int>(i), has_drogue, o.variety, o.cache);
            found[i] = search_whole(frames[i]);
        },
        nullptr);
    for (size_t i = 0; i < frames.size(); i++) {
        const double a = frames[i].rim.a_px;
        by["all"].add(found[i]);
        by[" " + frames[i].kind.substr(0, frames[i].kind.find(','))].add(found[i]);
        if (has_drogue) {
            by[a < 12 ? "a < 12 px" : a < 40 ? "a 12 to 40 px" : "a > 40 px"].add(found[i]);
        }
        statuses[found[i].result.status]++;
        if (!std::isnan(found[i].log_odds)) {
            Odds &own = odds[static_cast<int>(std::floor(std::clamp(found[i].log_odds, -3.0, 5.0)))];
            own.frames++;
            own.right += found[i].finding == Finding::hit || found[i].unsure_right;
            own.expected += 1 / (1 + std::exp(-found[i].log_odds));
        }
        ms.push_back(1e3 * found[i].seconds);
        if (o.list && found[i].finding != (has_drogue ? Finding::hit : Finding::none)) {
            const drogue_result &r = found[i].result;
            std::printf(
                "  %3zu %-26s rim %4.0f %4.0f a %3.0f b/a %.2f  unsure right %d sighted %d there %d%d %-12s %4.0f %4.0f a %5.1f cover %.2f res %d "
                "inner %d rel %.2f\n",
                i, frames[i].kind.c_str(), frames[i].rim.xc_px, frames[i].rim.yc_px, a, frames[i].rim.b_px / a,
                found[i].unsure_right, found[i].sighted, found[i].can_be, found[i].can_decide,
                drogue_status_name(r.status), r.ideal.xc_px_q16 / 65536.0, r.ideal.yc_px_q16 / 65536.0,
                r.ideal.a_px_q16 / 65536.0, r.cover_q16 / 65536.0, r.orientation_resolved, r.has_inner,
                r.quality.reliability_q16 / 65536.0);
        }
    }
    std::printf("%s\n%-16s frames  hit wrong none | unsure but right, sighted; in the true region measured, decided\n",
                has_drogue ? "with a drogue" : "without", "");
    for (const auto &[name, c] : by) {
        std::printf("%-16s %5d %5d %5d %4d | %3d %3d %3d %3d\n", name.c_str(), c.frames, c.hit, c.wrong, c.none,
                    c.unsure, c.sighted, c.can_be, c.can_decide);
    }
    double sum = 0;
    for (const double v : ms) {
        sum += v;
    }
    std::sort(ms.begin(), ms.end());
    std::printf("ms of the thread: mean %.1f, median %.1f, worst %.1f\n", sum / static_cast<double>(ms.size()),
                ms[ms.size() / 2], ms.back());
    if (!o.sheets.empty()) {
        std::vector<cv::Mat> images;
        for (size_t i = 0; i < std::min<size_t>(frames.size(), 20); i++) {
            images.push_back(frames[i].image);
        }
        cv::imwrite(o.sheets + (has_drogue ? "/with.png" : "/without.png"), contact_sheet(images, 4, {480, 270}));
    }
}

/* Is each course right in 99 of 100 frames in sight, with no false one and no wrong twin? */
bool print_courses(const Options &o)
{
    struct Job {
        std::string name;
        int index;
    };
    std::vector<Job> jobs;
    for (const std::string &name : course_names()) {
        for (int i = 0; i < o.courses && (o.only.empty() || o.only == name); i++) {
            jobs.push_back({name, i});
        }
    }
    std::vector<CourseScore> scores(jobs.size());
    std::map<std::string, CourseScore> by;
    parallel_for(
        jobs.size(), 0,
        [&](size_t i) {
            CourseOptions c;
            c.seed = o.seed;
            c.index = jobs[i].index;
            c.variety = o.variety;
            c.cache = o.cache;
            const Course course = make_course(jobs[i].name, c);
            scores[i] = run_course(course);
            if (!o.sheets.empty() && jobs[i].index == 0) {
                std::vector<cv::Mat> images;
                for (size_t k = 0; k < 12; k++) {
                    images.push_back(course.frames[k * course.frames.size() / 12].image);
                }
                cv::imwrite(o.sheets + "/" + jobs[i].name + ".png", contact_sheet(images, 4, {480, 270}));
            }
        },
        nullptr);
    std::printf(
        "course  right%% false twins resolved%% known%% gated first again |  x     y     z    axis ratio | v m/s  z %%   "
        "NEES raw filt\n");
    for (size_t i = 0; i < jobs.size(); i++) {
        by[jobs[i].name] += scores[i];
    }
    const auto line = [](const std::string &name, const CourseScore &s) {
        const auto ratio = [&](int k) { return std::sqrt(s.filtered2[k] / s.raw2[k]); };
        std::printf(
            "%-7s %6.2f %5d %5d %8.1f %6.1f %5d %5d %5d | %.2f  %.2f  %.2f  %.2f       | %.4f %.3f  %6.2f %6.2f\n",
            name.c_str(), 100.0 * s.right / s.visible, s.false_frames, s.wrong_twins, 100.0 * s.resolved / s.visible,
            100.0 * s.known / s.visible, s.gated, s.first_right, s.again_right, ratio(0), ratio(1), ratio(2),
            std::sqrt(s.axis_filtered2 / s.axis_raw2), std::sqrt(s.velocity2 / s.velocities),
            100 * std::sqrt(s.z_share2 / s.compared), s.nees_raw / s.nees_frames, s.nees_filtered / s.nees_frames);
    };
    for (const std::string &name : course_names()) {
        if (by.count(name) != 0) {
            for (size_t i = 0; o.list && i < jobs.size(); i++) {
                if (jobs[i].name == name) {
                    line("  " + name + " " + std::to_string(jobs[i].index), scores[i]);
                }
            }
            line(name, by[name]);
        }
    }
    bool met = true;
    for (const auto &[name, s] : by) {
        met = met && 100 * s.right >= 99 * s.visible && s.false_frames == 0 && s.wrong_twins == 0;
    }
    std::printf("follow: courses=%zu bars=%s\n", jobs.size(), met ? "met" : "missed");
    return met && !jobs.empty();
}

} // namespace

int main(int argc, char **argv)
{
    Options o;
    bool frames = true, courses = true;
    for (int i = 1; i < argc; i++) {
        const std::string a = argv[i];
        const auto next = [&] { return ++i < argc ? std::string(argv[i]) : std::string(); };
        if (a == "--seed") {
            o.seed = std::stoull(next());
        } else if (a == "--courses") {
            o.courses = std::stoi(next());
            courses = o.courses > 0;
        } else if (a == "--frames") {
            o.frames = std::stoi(next());
            frames = o.frames > 0;
        } else if (a == "--only") {
            o.only = next();
        } else if (a == "--cache") {
            o.cache = next();
        } else if (a == "--sheets") {
            o.sheets = next();
        } else if (a == "--held-out") {
            o.variety.held_out = true;
        } else if (a == "--list") {
            o.list = true;
        } else if (a == "--bars") {
            o.bars = true;
        } else {
            std::fprintf(stderr, "usage: follow [--seed N] [--courses N] [--only NAME] [--frames N] [--held-out] "
                                 "[--cache FOLDER] [--sheets FOLDER] [--list] [--bars]\n");
            return 2;
        }
    }
    for (const std::string &folder : {o.cache, o.sheets}) {
        if (!folder.empty()) {
            std::filesystem::create_directories(folder);
        }
    }
    if (frames) {
        std::map<int, Odds> odds;
        print_frames(o, true, odds);
        print_frames(o, false, odds);
        print_odds(odds);
    }
    return courses && !print_courses(o) && o.bars;
}
