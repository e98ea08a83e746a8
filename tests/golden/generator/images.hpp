/* SPDX-License-Identifier: Apache-2.0 */
/* Images for the cases, in whole numbers throughout: the same on every machine. */
#pragma once

#include <functional>
#include <vector>

#include "case.hpp"

namespace vectors {

/* Image of a function of the pixel, clamped to [0, 255]. */
cv::Mat image_from(int width, int height, const std::function<int(int x, int y)> &grey);

cv::Mat constant(int width, int height, int grey);
cv::Mat noise(int width, int height, accuracy::Random &random, int low = 0, int high = 255);
/* Every pixel one of the given levels: many equal magnitudes. */
cv::Mat few_levels(int width, int height, accuracy::Random &random, const std::vector<int> &levels);

/* Disc about ((width - 1) / 2, (height - 1) / 2) of the given radius, in quarter pixels, drawn with a step. */
cv::Mat disc_image(int width, int height, int radius4, int inside, int outside);
/* The same with a ramp of 'ramp4' quarter pixels between the two levels. */
cv::Mat soft_disc(int width, int height, int centre2_x, int centre2_y, int radius4, int ramp4, int inside, int outside);

/* Filled rectangle [x, x + w) x [y, y + h). */
void fill(cv::Mat &image, int x, int y, int w, int h, int grey);

/* A path of axis-parallel strokes of the given thickness through points (x, y). */
void stroke(cv::Mat &image, const std::vector<cv::Point> &points, int thickness, int grey);
std::vector<cv::Point> serpentine(int width, int height, int pitch);
std::vector<cv::Point> spiral(int width, int height, int pitch);
/* Teeth down from a bar that comes last, so that labels merge at the end ('down') or that opens the comb. */
cv::Mat comb(int width, int height, int pitch, int thickness, bool bar_last, int ink, int paper);

} // namespace vectors
