/* SPDX-License-Identifier: Apache-2.0 */
/* What the agreement tests share: the report line of a stage, random images by seed, images of a folder. */
#ifndef DROGUE_TESTS_GOLDEN_HPP
#define DROGUE_TESTS_GOLDEN_HPP

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common.h"
#include "images.h"

#include "drogue/types.h"

/* Differences of one stage from its reference, in LSB; fails on excess. */
class Report {
public:
    Report(std::string stage, double bound) : stage_(std::move(stage)), bound_(bound) {}

    void add(double lsb, const std::string &name)
    {
        lsb = std::isnan(lsb) ? INFINITY : lsb;
        cases_++;
        exact_ += lsb == 0 ? 1 : 0;
        sum_ += lsb;
        if (lsb > worst_ || worst_name_.empty()) {
            worst_ = lsb;
            worst_name_ = name;
        }
        if (lsb > bound_ && excess_++ < 5) {
            std::printf("%s: %s is off by %g LSB, allowed %g\n", stage_.c_str(), name.c_str(), lsb, bound_);
        }
    }

    /* Prints the line; true when every case kept the bound and there were at least as many as promised. */
    bool finish(long least_cases) const
    {
        const bool ok = excess_ == 0 && cases_ >= least_cases;
        std::printf(
            "%s stage=%s cases=%ld exact=%ld worst_lsb=%.4g mean_lsb=%.3g bound_lsb=%g over=%ld worst_case=\"%s\"\n",
            ok ? "pass" : "FAIL", stage_.c_str(), cases_, exact_, worst_, cases_ ? sum_ / cases_ : 0.0, bound_, excess_,
            worst_name_.c_str());
        return ok;
    }

private:
    std::string stage_, worst_name_;
    double bound_, worst_ = 0, sum_ = 0;
    long cases_ = 0, exact_ = 0, excess_ = 0;
};

/* Difference of a Q16 result from a real reference that is rounded once. */
inline double lsb_from(std::int32_t got, long double reference)
{
    return (double)std::fabs((long double)got - std::floor(reference * 65536.0L + 0.5L));
}

inline std::string name_of(const char *what, long number) { return std::string(what) + " " + std::to_string(number); }

struct NamedImage {
    std::string name;
    cv::Mat pixels; /* 8-bit grey, continuous */
    std::uint64_t seed;
};

constexpr int RANDOM_IMAGES = 300;

/* Image of a seed: every kind, sides 1 to 200, thin ones among them. */
inline NamedImage random_image(int seed)
{
    std::uint64_t rng = 0x5EED0000u + (std::uint64_t)seed;
    int width = rng_range(&rng, 1, seed % 4 == 0 ? 12 : 200), height = rng_range(&rng, 1, seed % 4 == 1 ? 12 : 200);
    NamedImage image{name_of("seed", seed), cv::Mat(height, width, CV_8U), (std::uint64_t)seed};
    image_fill(image.pixels.data, width, height, seed % IMAGE_KINDS, &rng);
    return image;
}

/* Every PNG under a folder in order of name, cut to the largest side that the library takes. */
inline std::vector<NamedImage> folder_images(const std::string &folder)
{
    std::vector<std::string> paths;
    std::vector<NamedImage> images;
    if (std::filesystem::is_directory(folder)) {
        for (const auto &entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == ".png") {
                paths.push_back(entry.path().string());
            }
        }
    }
    std::sort(paths.begin(), paths.end());
    for (const std::string &path : paths) {
        cv::Mat grey = cv::imread(path, cv::IMREAD_GRAYSCALE);
        if (grey.empty()) {
            std::printf("cannot read %s\n", path.c_str());
            std::exit(EXIT_FAILURE);
        }
        const cv::Rect part(0, 0, std::min(grey.cols, DROGUE_MAX_SIDE), std::min(grey.rows, DROGUE_MAX_SIDE));
        images.push_back({std::filesystem::path(path).filename().string(), grey(part).clone(), images.size()});
    }
    return images;
}

/* Random images without an argument, else those of a folder; 77 when it holds none. */
inline int run_on_images(int argc, char **argv, const std::function<bool(const std::vector<NamedImage> &)> &test)
{
    std::vector<NamedImage> images;
    if (argc > 1) {
        images = folder_images(argv[1]);
        if (images.empty()) {
            std::printf("skipped: no images under %s\n", argv[1]);
            return 77;
        }
    } else {
        for (int seed = 1; seed <= RANDOM_IMAGES; seed++) {
            images.push_back(random_image(seed));
        }
    }
    return test(images) ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
