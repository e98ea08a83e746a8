/* SPDX-License-Identifier: Apache-2.0 */
/* What cameras, codecs and air do to a picture after the sensor. */
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "drogue/config.h"

namespace accuracy {

/* jpeg     a codec: quality 85
 * sharp    unsharp mask: the picture and what a blur of one pixel took of it once more
 * both     sharp at 0.8, then jpeg at 80
 * median   of 3 x 3 pixels, as against noise
 * resized  shrunk to two thirds and enlarged again
 * defocus  a disc of 1.8 px radius
 * glow     what is brighter than 0.6 spreads over 6 and 14 px
 * haze     three tenths of the contrast
 * vignette 0.55 of the light at the left, 1.15 at the right
 * exposed  1.5 times the light: bright parts saturate
 * srgb     encoded for display, the library not told
 * told     the same, and told
 * curve    a steep tone curve */
const std::vector<std::string> &processings();

/* A grey picture as such a thing leaves it; throws for a name that is none. */
cv::Mat processed(const cv::Mat &picture, const std::string &processing);

/* What the library is told of such a picture. */
drogue_transfer transfer_of(const std::string &processing);

} // namespace accuracy
