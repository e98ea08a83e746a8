/* SPDX-License-Identifier: Apache-2.0 */
/* Renderer of a refuelling drogue: analytic ray tracing of canopy, inner part, coupling and hose before a plain
 * background, then optics, motion, illumination and sensor. Every pixel is a function of the scene and of its own
 * coordinates alone, so that any region of an image is the same as that part of the whole. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "geometry.hpp"
#include "random.hpp"

namespace accuracy {

/* A dark part of the canopy's inside: a sector of the funnel between two depths. */
struct Patch {
    double angle_rad;      /* of its middle about the axis, from first() to second() */
    double half_angle_rad; /* below pi */
    double from_m, to_m;   /* depths */
};

/* Shape, metres. The end plane is at depth 0, depths grow along the axis. */
struct Drogue {
    double rim_radius_m = 0.35;
    double coupling_radius_m = 0.14; /* where the canopy ends, at the inner part's depth */
    double inner_radius_m = 0.12;    /* black disc on the axis */
    double inner_depth_m = 0.25;
    double housing_length_m = 0.2; /* cylinder of the coupling's radius behind the canopy */
    double hose_radius_m = 0.034;
    double hose_length_m = 40;
    int ribs = 28;
    double rib_share = 0.25; /* of the circumference */
    double rib_phase = 0;    /* [0, 1) of the distance between two ribs */
    double scallop_m = 0;    /* how far the canopy's edge recedes between two ribs */
    int spokes = 0;          /* bars before the black disc, from the axis outwards */
    double spoke_width_m = 0;
    double spoke_phase_rad = 0;
    std::vector<Patch> patches = {};
    double wall_share =
        0;              /* of the rim's radius: what of the funnel's inside lies deeper is wall, not canopy; 0: none */
    int wall_ribs = 0;  /* dark ribs on the wall, as far in as the black disc */
    double tube_m = 0;  /* a torus round the end plane whose outer radius is the rim's; 0: a sharp edge */
    double texture = 0; /* share of the canopy's and the wall's grey by which a weave changes it */
    double texture_turn = 0; /* where that begins, radians */
};

/* Grey levels and light. Lambert: grey = albedo * (ambient + (1 - ambient) * max(0, normal . sun)). */
struct Look {
    double canopy_grey = 60;
    double rib_gain = 1.2;    /* ribs against canopy */
    double depth_loss = 0.15; /* share of light lost at the bottom of the funnel */
    double inner_grey = 14;
    double coupling_grey = 85;
    double hose_grey = 45;
    double spoke_grey = 110;
    double patch_grey = 16;
    double wall_grey = 90;
    double wall_rib_grey = 25;
    double tube_grey = 120;
    double shine_grey = 0; /* the torus's highlight: this times cos^24 between sun and mirrored ray */
    double ambient = 0.75;
    cv::Vec3d sun = {-0.48, -0.64, -0.6}; /* unit, towards the sun, camera frame */

    static Look dark();   /* for bright and mid-grey backgrounds */
    static Look bright(); /* for dark and mid-grey backgrounds */
};

/* A thing behind the drogue, drawn over the background: an ellipse or a bar. */
struct Clutter {
    cv::Point2d at_px;
    double half_length_px, half_width_px;
    double angle_rad; /* of the length, from +x towards +y */
    double grey;
    bool round;     /* ellipse, otherwise rectangle */
    double soft_px; /* width of its edge, >= 1 */
};

/* Gradient over the image height plus fractal value noise, then a linear ramp, then things. */
struct Background {
    double top_grey = 205;
    double bottom_grey = 225;
    double texture_grey = 6; /* amplitude: the texture stays within plus and minus this */
    double texture_px = 256; /* largest structure */
    int octaves = 3;         /* each half the size and amplitude of the one before */
    cv::Point2d ramp_at_px = {0, 0};
    cv::Point2d ramp_per_px = {0, 0}; /* grey levels a pixel along x and y, 0 at ramp_at; the sum stays in [0, 255] */
    std::vector<Clutter> clutter = {};
    cv::Mat plate = {}; /* CV_32F, as large as the image: grey levels that take the place of all the above */

    static Background sky();    /* bright */
    static Background cloud();  /* mid grey */
    static Background ground(); /* dark */
};

/* What stands between the scene and the number in a pixel. */
struct Sensor {
    double blur_px = 0.7;        /* sigma of the optics' Gaussian, beyond the pixel's own area */
    double noise = 2;            /* sigma, grey levels */
    double motion_sigma_px = 0;  /* Gaussian motion blur, all directions */
    double motion_length_px = 0; /* linear motion blur */
    double motion_angle_rad = 0; /* from +x towards +y */
    /* Paper (41): grey *= light_k * (1 - distance to light_at / light_radius), not below 0; off at radius 0. */
    double light_k = 1;
    double light_radius_px = 0;
    cv::Point2d light_at_px = {0, 0};
    double glare_grey = 0; /* a round spot of light added before the sensor saturates; off at 0 */
    double glare_radius_px = 0;
    cv::Point2d glare_at_px = {0, 0};
};

/* The receiver's probe before the drogue: a rod in the image plane with a round tip; off at width 0. */
struct Probe {
    cv::Point2d tip_px = {0, 0};
    cv::Point2d root_px = {0, 0};
    double half_width_px = 0;
    double grey = 60;
};

struct Scene {
    Camera camera = {1465.5, 1465.5, 1023.5, 1023.5};
    cv::Size image_px = {2048, 2048};
    Pose pose = {{0, 0, 10}, {0, 0, 1}};
    Drogue drogue;
    Look look;
    Background background;
    Sensor sensor;
    Probe probe;
    uint64_t seed = 1;
    bool coarse = false; /* fewer rays a pixel, for many frames: edges err by up to a grey level */

    Ellipse rim() const { return project_circle(camera, pose, drogue.rim_radius_m, 0); } /* ideal pixels */
    cv::Point2d inner_centre_ideal() const { return camera.project_ideal(inner_centre_m()); }
    cv::Vec3d inner_centre_m() const { return pose.position_m + drogue.inner_depth_m * pose.axis; }
};

/* Surfaces in the order in which the tracer knows them. */
enum class Surface {
    background,
    inner,
    coupling,
    inside,
    inside_rib,
    outside,
    outside_rib,
    housing,
    hose,
    probe,
    spoke,
    patch,
    wall,
    wall_rib,
    tube
};

/* What the ray of a pixel (as seen, subpixel) meets, and the light that it gives off. */
struct Hit {
    Surface surface;
    double grey;       /* 0 for the background, which is a function of whole pixels */
    cv::Vec3d point_m; /* in the drogue's frame (first, second, axis); zero for background and probe */
};
Hit trace(const Scene &scene, const cv::Point2d &seen_px);

/* Background of a pixel, without blur and noise. */
double background_grey(const Scene &scene, int x_px, int y_px);

/* Region of the image before the sensor's noise and quantisation, CV_64F. */
cv::Mat render_light(const Scene &scene, const cv::Rect &region_px);
/* The same as the sensor gives it, CV_8U. */
cv::Mat render(const Scene &scene, const cv::Rect &region_px);

} // namespace accuracy
