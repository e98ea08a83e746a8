/* SPDX-License-Identifier: Apache-2.0 */
/* From edge points and arcs to the outline of the end plane: fits of pairs of arcs, each scored by all edge points of
 * the region, clustering, and a last fit on every edge point that belongs to the winner. */
#ifndef DROGUE_OUTLINE_H
#define DROGUE_OUTLINE_H

#include "drogue/cluster.h"
#include "drogue/config.h"
#include "drogue/constraints.h"
#include "drogue/ellipse.h"
#include "drogue/frontend.h"
#include "drogue/quality.h"
#include "drogue/rays.h"
#include "drogue/support.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The outline of the end plane and what speaks for it. */
typedef struct drogue_outline {
    drogue_ellipse ellipse;   /* region coordinates, as seen, what blur took put back; after
                                 drogue_outline_pull() what lies beside it, too */
    drogue_ellipse fitted;    /* the same before: what edge points lie about */
    drogue_quality quality;   /* of the winning candidate; l_r is the share of the circumference that is covered */
    drogue_polarity polarity; /* DARK, BRIGHT, or BOTH where the background crosses the drogue's own grey */
    uint32_t arcs[4];         /* the arcs of the winning candidate by quadrant: index, or DROGUE_NO_ARC */
    uint32_t cluster_members; /* candidates that agree with the winner, itself included */
    uint32_t refit_points;    /* points in the last fit; 0 when the fit of the arcs was kept */
    drogue_q16 cover_q16;     /* share of the circumference that edge points cover */
    drogue_q16 band_px_q16;   /* half width of the band about the ellipse that they lie in */
    drogue_support support;   /* of the last fit */
    int32_t outer;            /* 1: the rim's outer edge along rays, see drogue_outline_pull() */
} drogue_outline;

/* Moments of points, 1 / 2^frac_bits px from an origin. */
typedef struct drogue_collection {
    drogue_moments moments; /* in that unit */
    drogue_q16 x_px_q16;    /* origin, region coordinates */
    drogue_q16 y_px_q16;    /* downward */
    int frac_bits;          /* 0 .. 10 */
} drogue_collection;

/* What the outline stage works on, in the workspace. */
typedef struct drogue_outline_room {
    drogue_candidate candidates[DROGUE_MAX_CANDIDATES]; /* scored so far */
    drogue_collection sum;                              /* of the points of the arcs that were fitted last */
    drogue_collection own;                              /* of the points that belong to the ellipse looked at last */
    drogue_support support;                             /* of that */
    drogue_outline trial;                               /* being refined */
    drogue_outline best;                                /* of those so far, when a larger one is looked for */
} drogue_outline_room;

/* With the four bytes that alignment may take. */
typedef char drogue_assume_outline_fits[sizeof(drogue_outline_room) + 4 <= DROGUE_SCRATCH_BYTES ? 1 : -1];

/* Find the outline.
 *
 *  out        outline; on failure what is known of the best candidate, zero when there is none
 *  workspace  edges and arcs as the front end left them
 *  mask       centre and longest side of the region
 *  return     DROGUE_OK, DROGUE_E_NO_EDGES, DROGUE_E_NO_ARCS, DROGUE_E_NO_ELLIPSE
 */
drogue_status drogue_outline_find(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                                  const drogue_mask *mask, const drogue_config *config);

/* Look for a larger outline about the one found, which may be the canopy's inner edge or a rib within the rim: the one
 * that edge points cover best; of equals the largest.
 *
 *  out     in: what drogue_outline_find() found; out: the larger outline, untouched when there is none
 *  return  1: found
 */
int drogue_outline_enlarge(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                           const drogue_mask *mask, const drogue_config *config);

#define DROGUE_OUTLINE_LOOKS 512 /* edge points that score an ellipse at most, evenly taken */

/* Share of an ellipse that edge points cover, of which DROGUE_OUTLINE_LOOKS at most are looked at; 0 where it is no
 * plausible outline. */
drogue_q16 drogue_outline_covered(const drogue_ellipse *ring, const drogue_workspace *workspace,
                                  const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config);

/* Fit the edge points about an ellipse, as an outline without arcs.
 *
 *  band         px Q16, half the width of the band about it that they lie in at first; 0: as for drogue_outline_find()
 *  least_cover  Q16: the share that they have to cover; less than config's min_cover is enough where seven of the
 *               outline's eight parts show
 *  return       1; 0: they cover too little, and 'out' has none
 */
int drogue_outline_settle(drogue_outline *out, const drogue_ellipse *ring, drogue_q16 band_px_q16,
                          drogue_q16 least_cover_q16, const drogue_workspace *workspace, const drogue_edge_list *list,
                          const drogue_mask *mask, const drogue_config *config);

/* None: no ellipse, no arcs. */
void drogue_outline_clear(drogue_outline *outline);

/* Measure along rays how far what lies beside the outline moved it, as shading or the wall's edge, and put that back:
 * an edge goes from where the front end sees it, by gradients a pixel to either side, to where it is steepest with less
 * blur. Of each coefficient c the part c^2 / (c^2 + v) is put back, v its variance by the noise that the rays show
 * outside, by what the coefficients leave and by the pixels' grid. Who has edge points and no image does without.
 * Where motion blurs the outline (by more than half a px^2 of variance more along it than across, and 24 px and more of
 * b), its edges have no steepest place: the middle of their slopes counts then, less half of what the motion is longer
 * than the bright band is wide that the outline ends, and all of that is put back.
 * Where the grey is 254 and more as near as 1.5 px beside it, the sensor has cut off what would be brighter, and the
 * edge lies towards the dark side: by half the optics' blur, in the share of the rays where it is so, which is right of
 * light 1.2 to 1.5 times what the sensor bears and half of it at 2. White that is not cut off is so near only where
 * there is less blur than is configured.
 *
 * Of the rim's outer edge, outline.outer, nothing is put back: its points are edges along rays, which no front end has
 * blurred. support.pull_q24 is there in: by how much it is larger than the inner edge, which of the two is the rim's is
 * in doubt.
 *
 *  outline  in: found or enlarged; out: ellipse, and support.pull_q24 with the coefficients that were put back: at most
 *           an eighth of the semi-axis; support.smear_px2_q16 with the motion blur that the edge's widths show. Below 1
 *           px of b: as fitted. outside with the parts where the mean over 8 rays, those of bins without points left
 *           out as 0, has an edge of either sign between 1 and 5 px outside, of 3 grey levels a pixel and a sixth of
 *           what the outline's own has
 *  rays     memory, as that of the workspace: nothing in it is kept
 *  view     the region's pixels
 *  config   as it was found with
 */
void drogue_outline_pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                         const drogue_config *config);

/* Look along rays for the rim's outer edge about an outline that may be its inner one, on one side or all about, as of
 * a band of another grey or a lip that is lit: too narrow or too faint for the edge detector, or cut off by the ring.
 * Between 1.5 px within and 5 px outside, where that shows none of a semi-axis above 100 px to a twentieth of it, four
 * rays a bin (support.h) show edges of either sign, by steps of grey over 1 px, or over a hundredth of that semi-axis:
 * of 5 levels, of a fifth of what the outline's own have, and of half as much again as the mean farther outside but
 * for the steepest; each an eighth higher than what lies between it and a higher one. From the steepest edges outside,
 * and from ellipses larger by 0 to 5 px, least squares over size, place and shape settle on the edges nearest to one;
 * of what they settle on the one that most bins have an edge on, one more of them for a quarter of a pixel of size.
 * It is the rim where its semi-axes are larger by 0.3 px on the mean and by no more than an eighth of b, as no other
 * wave is, it passes 22 of 32 bins within 0.6 px of an edge, half of those that it passes farther than 0.7 px from the
 * outline, 6 at least, and three quarters of the rays show that edge by themselves.
 *
 *  outer   in: the outline, region coordinates; out: where there is one, that ellipse, a guess to a pixel; else as it
 *          was, as for b < 16 px
 *  grown   out: where there is one, by how much it is larger, Q24 of the semi-axes and negative, as waves over the
 *          eccentric angle of the ellipse that went in, as support.pull_q24; else as it was
 *  rays    memory, as that of the workspace: nothing in it is kept
 *  view    the region's pixels
 *  return  1: there is one
 */
int drogue_outline_outer(drogue_ellipse *outer, int32_t grown_q24[5], drogue_ray rays[DROGUE_RAYS],
                         const drogue_image *view);

/* Fit the edge points that belong to an outline, each with the lens distortion removed.
 *
 *  out       ellipse as an ideal pinhole camera would see it, px of the whole image
 *  outline   found in a region whose pixel (0, 0) is pixel (x_px, y_px) of the image
 *  return    DROGUE_OK, DROGUE_E_TOO_FEW_POINTS, DROGUE_E_DEGENERATE; points outside the lens model's domain
 *            are left out, more than a quarter of them degenerate
 */
drogue_status drogue_outline_undistorted(drogue_ellipse *out, const drogue_outline *outline,
                                         const drogue_workspace *workspace, const drogue_edge_list *list,
                                         const drogue_setup *setup, int32_t x_px, int32_t y_px);

#ifdef __cplusplus
}
#endif
#endif
