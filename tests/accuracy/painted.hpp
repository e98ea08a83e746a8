/* SPDX-License-Identifier: Apache-2.0 */
/* Painted backgrounds and varied drogues for whole frames and sequences: quicker to make than the study's, and of
 * other kinds. */
#pragma once

#include "scene.hpp"

namespace accuracy {

enum class Ground { sky, clouds, ground, horizon, dark };
constexpr int grounds = 5;
const char *name_of(Ground ground);

/* Ranges from which things are drawn; the held-out set has others. */
struct Variety {
    bool held_out = false;
};

/* A background of the given size, CV_8U. */
cv::Mat paint_ground(Random &random, Ground ground, const cv::Size &size);

/* Things that are no drogue, each outside of 'kept' and drawn over the background. */
void paint_discs(cv::Mat &plate, Random &random,
                 const cv::Rect &kept); /* dark discs, bright rings, some within one another */
void paint_aircraft(cv::Mat &plate, Random &random, const cv::Rect &kept); /* wing, pods with dark inlets, windows */
void paint_probe(cv::Mat &plate, Random &random, const cv::Rect &kept);    /* rod with a round tip and a dark nozzle */

/* As the optics see it: CV_32F, blurred as the drogue will be. */
cv::Mat plate_of(const cv::Mat &painted, double blur_px);

/* Shape and greys of a drogue before a background of about the given grey; its canopy is one piece, or ends inside at
 * 0.66 to 0.85 of the rim's radius in a wall of another grey. */
void draw_drogue(Scene &scene, Random &random, double behind_grey, const Variety &variety);

/* The light of the whole image, CV_32F: the plate and, within 1.7 semi-axes, the drogue before it. */
cv::Mat light_of(const Scene &scene);
/* The part of it that is not the plate. */
cv::Rect part_about(const Scene &scene);

/* What the sensor makes of it, CV_8U: gain, noise, rounding. */
cv::Mat exposed(const cv::Mat &light, double gain, double noise, uint64_t seed);

} // namespace accuracy
