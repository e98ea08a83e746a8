/* SPDX-License-Identifier: Apache-2.0 */
#include "images.hpp"

#include <algorithm>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "library.hpp"
#include "scene.hpp"

namespace bench {

namespace {

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

} // namespace

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

cv::Mat cluttered(int side, int seed)
{
    cv::RNG rng(static_cast<uint64_t>(seed) + 1);
    cv::Mat image(side, side, CV_8U, cv::Scalar(rng.uniform(0, 256))), noise(side, side, CV_16S);
    for (int things = rng.uniform(10, 41); things > 0; things--) {
        const cv::Point at(rng.uniform(0, side), rng.uniform(0, side));
        const cv::Size half(rng.uniform(side / 32 + 1, side / 2), rng.uniform(side / 32 + 1, side / 2));
        const double turn = rng.uniform(0.0, 180.0);
        const int thickness = rng.uniform(0, 3) == 0 ? -1 : rng.uniform(1, side / 32 + 2); /* -1: filled */
        const cv::Scalar grey(rng.uniform(0, 256));
        if (rng.uniform(0, 4) == 0) {
            const cv::Point to(rng.uniform(0, side), rng.uniform(0, side));
            cv::line(image, at, to, grey, std::max(thickness, 1), cv::LINE_AA);
        } else {
            const double from = rng.uniform(0.0, 360.0), span = rng.uniform(60.0, 360.0);
            cv::ellipse(image, at, half, turn, from, from + span, grey, thickness, cv::LINE_AA);
        }
    }
    cv::GaussianBlur(image, image, {0, 0}, rng.uniform(0.5, 1.5));
    rng.fill(noise, cv::RNG::NORMAL, 0, rng.uniform(0.0, 10.0));
    cv::add(image, noise, image, cv::noArray(), CV_8U);
    return image;
}

} // namespace bench
