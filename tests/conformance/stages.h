/* SPDX-License-Identifier: Apache-2.0 */
/* Every stage of the library as a function from arrays of words to arrays of words: what the golden vectors hold.
 * Static memory only, no operating system: the same file runs on the host and on a bare target. */
#ifndef DROGUE_TESTS_STAGES_H
#define DROGUE_TESTS_STAGES_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Capacity of the workspace that the stages run in. A frame that needs more is answered with a 'full' status,
 * which the vectors hold: a port that is checked with them needs the same capacity. */
#define CONF_MAX_EDGES 16384
#define CONF_MAX_LABELS 8192
#define CONF_MAX_ARCS 1024
#define CONF_MAX_PIXELS 65536 /* image of the stages that write one: smooth, gradient, canny, mask */
#define CONF_MAX_IMAGE 262144 /* bytes of an input image whose rows are apart */
#define CONF_MAX_CANDIDATES 64

/* Array of words: input of a stage, its output, or an expected output. */
typedef struct conf_array {
    const char *name;
    int bits;     /* 8, 16, 32 or 64: 'data' is an array of intN_t, two's complement; an image: of uint8_t */
    size_t count; /* words */
    const void *data;
    int32_t width_px; /* image: both > 0, rows adjacent, count = width * height; else both 0 */
    int32_t height_px;
} conf_array;

/* Word i, extended to 64 bits: grey levels without sign, all others with theirs. */
static inline int64_t conf_word(const conf_array *a, size_t i)
{
    switch (a->bits) {
    case 8: return a->width_px > 0 ? (int64_t)((const uint8_t *)a->data)[i] : (int64_t)((const int8_t *)a->data)[i];
    case 16: return ((const int16_t *)a->data)[i];
    case 32: return ((const int32_t *)a->data)[i];
    default: return ((const int64_t *)a->data)[i];
    }
}

/* Failures of the adapter itself, all negative. What the library answers is a word of the output. */
enum {
    CONF_E_MALFORMED = -1, /* unknown stage; name, width, number of words or range of an input */
    CONF_E_MEMORY = -2,    /* inputs need more than the static memory */
    CONF_E_GUARD = -3      /* the library wrote behind a buffer */
};

#define CONF_MAX_INPUTS 5
#define CONF_MAX_OUTPUTS 4

/* Run a stage. All words are 32 bits wide where no width is given; Q16 where no format is given.
 *
 *  outputs  out, in the order below; names and widths set; data valid until the next call
 *  return   number of outputs, or CONF_E_*
 *
 * A failed status leaves the other words of its output 0, unless said otherwise.
 *
 *  stage        inputs -> outputs
 *  smooth       image -> image
 *  gradient     image -> gx (16 bits), gy (16 bits): grey levels * 8, y down, raster order
 *  canny        image; params: low high smooth -> map (image: 255 on edges)
 *  mask         params: width height centre2_x centre2_y longest -> ring (image: 255 inside)
 *  arcs         image; params: low high smooth use_ring centre2_x centre2_y longest min_arc_px
 *               -> arcs: status edge_count arc_count, then per edge point x_px y_px class arc (-1: none);
 *                  edges: per edge point x_q5 y_q5 gx gy; points by arc, each in raster order, then the rest in raster order
 *  constraints  points (16 bits): x y, px, raster order; params: centre2_x centre2_y longest class min_short
 *               -> verdict: xc yc short long (Q16), quadrant (-1: rejected), polarity (2: rejected);
 *                  distance2 (64 bits, px^2 Q32)
 *  select       points (16 bits): x y of all arcs, one after the other, each in raster order; arcs: count class of each;
 *               params: centre2_x centre2_y longest min_short polarity
 *               -> choices: status, two arcs of each quadrant (-1: none)
 *  ellipse      points (16 bits): x y, unit 2^-frac_bits px; params: frac_bits -> ellipse: status xc yc a b angle
 *  quality      ellipse: xc yc a b angle; points: x y; params: fit_error k1 k2
 *               -> quality: threshold circumference, deviation of each point (0 when the status is not OK), then
 *                  fit_ratio length_ratio axis_ratio score reliability; status: of drogue_ellipse_frame_of()
 *  support      ellipse; edges: x_q5 y_q5 gx gy each; params: half_width cos stride polarity
 *               -> summary: status of drogue_ellipse_frame_of(), points counted at that stride, bright_bins, covered, cover
 *                  (Q16), points in the sums; then over all edges: bins: count dark, count bright, sum (Q16) of each;
 *                  members: bin + 32 polarity of each edge (-1: does not belong); sums (64 bits): squares (Q32) gradient
 *  cluster      candidates: xc yc a b angle reliability polarity each; config: centre a b angle round
 *               -> winner: index members
 *  eigen        matrix (64 bits): a00 a01 a02 a11 a12 a22
 *               -> values: 3, matrix's unit * 2^30; vectors: 3 x 3, Q30; full: mantissa and exponent of each value
 *  undistort    camera: fx fy cx cy k1 k2 p1 p2 k3; points: x y
 *               -> undistorted: status x y each; distorted: status x y each; on failure x y as given
 *  pose         ellipse; camera; params: radius depth inner_x inner_y
 *               -> pose: status, twice (position 3, axis 3, yaw, pitch), choice, distance 2, ambiguity; a failed
 *                  choice (behind the camera) leaves the poses
 *  joint        ellipse; camera; bins: count sum (Q16) of each of 32; params: rim_radius inner_radius inner_depth, start
 *               x y z yaw pitch, inner x y std, shading blur, gradient (whole), steps (whole)
 *               -> joint: status, pose 8, chi2; disc: status xc yc a b angle of the start's inner disc; covariance (64 bits, Q48)
 *                  of x y z yaw pitch, packed by rows of the lower triangle; outline (64 bits, Q48): that of m0 .. m4
 *  kalman       params: dt_us, process std 5, start std 5 x (value rate acceleration), start value 5;
 *               frames: value 5, std 5 each (all five std 0: frame missed, predicted only)
 *               -> states: per frame value 5, rate 5, acceleration 5; parameters in the order x y z pitch yaw
 *  frame        image; camera; model: rim_radius inner_radius inner_depth; region: x y width height (px);
 *               config, where they are not the defaults: every threshold in the order of drogue_config
 *               -> frame: status, ellipse 5, ideal 5, polarity, bit set of quadrants with an arc, refit_points,
 *                  has_inner, inner x y area threshold spread, pose 8, alternative 8, resolved, ambiguity;
 *                  detail: region 4, edge_count arc_count, arc of each quadrant (-1: none),
 *                  fit_ratio length_ratio axis_ratio score reliability, members, cover, doubt, outside, rays of the inner part;
 *                  covariance (64 bits, Q48) as of 'joint'; std (64 bits, Q32): x y z, axis;
 *                  whatever is known for every status
 *  decide       ellipse; camera; bins as of 'joint'; params: rim_radius inner_radius inner_depth, two poses (position 3,
 *               axis 3, yaw, pitch), nearer (whole), inner x y std, shading blur max_chi2 min_chi2_gap, gradient (whole), doubt
 *               too_far outside (whole) -> decision: status, pose 8, alternative 8, resolved, doubt; covariance and std as of 'frame'
 *  look         image; camera; model; params (whole): region x y width height, the workspace's width edges labels arcs,
 *               transfer -> looked: status second_look tried, region used 4, cover, ellipse 5, has_inner resolved
 *  rim          image: cells, at most 48 high; disc (whole): x y, ring (Q4), contrast
 *               -> rims: count, then x y radius (Q4) score of each, 0 behind the last of six
 *  search       image; params: min_contrast (whole)
 *               -> sightings (whole): status, counts of sightings and of dark discs, then x y radius score and region 4 of
 *                  each of 12 sightings and of 4 dark discs, 0 behind the last
 *  acquire      image; camera; model; params (whole): 1 when there is a region, that (x y width height), the search's
 *               width, the workspace's, min_contrast -> found: status, region used 4, has_inner resolved, ellipse 5, pose 8
 *  follow       image: frames of one size, one below the other; camera; model; params (whole): number of frames, dt_us,
 *               first region 4 (width 0: none), the workspace's width edges labels arcs, the search's width, max_missed
 *               reconsider_frames known_frames -> states (whole): per frame of drogue_track_frame() state, status, region asked
 *               for 4, region used 4, edge_count arc_count, has_inner resolved, missed gated; estimates: as of 'track'
 *  track        setup: camera 9, model 3, first region 4 (px; width 0: none); config: max_missed agree_frames
 *               reconsider_frames known_frames min_region max_region (whole) gate position_gate region_scale region_sigmas
 *               lateral depth angle (std) position angle (floor) process std 5 process_step lasting_share start std of rate
 *               and acceleration; frames: dt_us status second_look has_inner resolved (whole) cover, pose (x y z yaw
 *               pitch), alternative (5), doubt; covariance (64 bits, Q48) of each frame as of 'joint'
 *               -> states (whole): per frame status of drogue_track_init(), region 4 search reach 4 of
 *                  drogue_track_begin(), state missed gated orientation_known open_frames turned trial agreeing
 *                  second_known; estimates: per frame position 3 velocity 3 axis 3 yaw pitch resolved; std (64 bits,
 *                  Q32): per frame x y z yaw pitch axis
 */
int conf_run_stage(const char *stage, const conf_array *inputs, int input_count, conf_array *outputs,
                   int output_capacity);

/* Number of stages; name of stage i in the order above, NULL beyond the last. */
int conf_stage_count(void);
const char *conf_stage_name(int i);

/* What a CONF_E_* says, a short phrase. */
const char *conf_failure_text(int failure);

#ifdef __cplusplus
}
#endif
#endif
