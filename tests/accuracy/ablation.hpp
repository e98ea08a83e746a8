/* SPDX-License-Identifier: Apache-2.0 */
/* The method with parts of the ellipse's extraction left out (paper, table 5), built from the library's stages. */
#pragma once

#include <array>

#include <opencv2/core.hpp>

#include "drogue/drogue.h"
#include "geometry.hpp"

namespace accuracy {

/* What of the extraction is there.
 *
 *  nothing  one fit to all edge points in the ring mask
 *  arcs     (1): the first choice of arc in each quadrant by length, straightness, position and distance, for either
 *           polarity; of the two polarities that with more points; one fit to all its arcs; no combinations, no score, no
 *           clusters, no refit
 *  quality  (2): the edge points in the ring mask by quadrant and polarity, whichever arcs they belong to, given to the
 *           library as if each such set were one arc: combinations, score, clusters, refit are the library's
 *  both     (1) and (2): the library's measurement
 */
enum class Extraction { nothing, arcs, quality, both };
constexpr size_t extractions = 4;

/* Results by extraction. Outline, status, poses and covariance are the extraction's own; the inner part is the library's
 * in all (it is not what is compared), as are the joint pose of both and what blur takes from a curved edge.
 *
 *  image    CV_8UC1, the whole image; only the region is looked at
 *  camera   without distortion
 *  library  drogue_measure()'s result on the same region
 */
std::array<drogue_result, extractions> ablate(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                                              const cv::Rect &region, const drogue_result &library);

/* The library's own extraction put together from the same stages: what the reduced ones reduce. Equal to the library's
 * result where that did not look twice. */
drogue_result measure_by_stages(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                                const cv::Rect &region, const drogue_result &library);

} // namespace accuracy
