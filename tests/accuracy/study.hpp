/* SPDX-License-Identifier: Apache-2.0 */
/* The sections of the accuracy study: each in a file of its own, each adds tables, plots and bars to the report. */
#pragma once

#include <string>
#include <vector>

#include "evaluate.hpp"
#include "report.hpp"

namespace accuracy {

struct StudyOptions {
    bool quick = false; /* all sections, few scenes: the whole study in less than two minutes on two cores */
    uint64_t seed = 1;
    int threads = 0;   /* 0: as many as the machine has */
    std::string cache; /* folder of rendered regions that sections share; empty at the start unless asked otherwise */

    int pick(int full, int few) const { return quick ? few : full; }
};

/* How run_trials() is to run in a section: threads, cache, progress under a name. */
RunOptions run_options(Report &report, const StudyOptions &options, const std::string &what);

/* The scenes over all conditions that sections share: 1008, quick 60; condition by condition. */
std::vector<Trial> study_trials(const StudyOptions &options);

/* Medians on plain scenes per distance, beside the prototype's. */
void section_distances(Report &report, const StudyOptions &options);
/* Right, wrong, unmeasured, accuracy and calibration over study_trials(), and by condition. */
void section_conditions(Report &report, const StudyOptions &options);
/* The paper's Fig. 6: extraction of the ellipse under illumination and blur. */
void section_extraction(Report &report, const StudyOptions &options);
/* Fixed point beside the same pipeline in floating point. */
void section_loss(Report &report, const StudyOptions &options);
/* Photographs of circle boards. */
void section_boards(Report &report, const StudyOptions &options);
/* The paper's Fig. 7 to 9, tables 1 to 3: the pose under noise on the ellipse. */
void section_pose_noise(Report &report, const StudyOptions &options);
/* The paper's Fig. 12 to 14, table 4: positions over the range, a sequence with swing. */
void section_approach(Report &report, const StudyOptions &options);
/* The paper's table 5: baselines, and parts of the method left out. */
void section_table5(Report &report, const StudyOptions &options);
/* The related systems side by side: one table, one plot; then detectors and regions. */
void section_systems(Report &report, const StudyOptions &options);
/* Ellipse detectors beside ours on scenes and boards. */
void section_detectors(Report &report, const StudyOptions &options);
/* Ways to find the drogue in a whole frame beside ours. */
void section_regions(Report &report, const StudyOptions &options);
/* Whole frames: how often the search sights the drogue. */
void section_search(Report &report, const StudyOptions &options);
/* Sequences at three levels of turbulence, raw against filtered, and a long one with blanked frames. */
void section_sequences(Report &report, const StudyOptions &options);
/* Courses that disturb the tracker, and painted whole frames. */
void section_tracking(Report &report, const StudyOptions &options);

} // namespace accuracy
