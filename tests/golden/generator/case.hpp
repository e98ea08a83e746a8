/* SPDX-License-Identifier: Apache-2.0 */
/* A case of the golden vectors: inputs, what the reference says, what the C library computes. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "random.hpp"

namespace vectors {

/* Words of one file: numbers, or an image when width > 0. */
struct Array {
    std::string name;
    int bits = 32;
    int q = 0; /* fractional bits of those words that are real numbers */
    std::vector<int64_t> words;
    int width = 0;
    int height = 0;
};

Array image_array(const std::string &name, const cv::Mat &image); /* CV_8U */
Array word_array(const std::string &name, int bits, int q, std::vector<int64_t> words);
cv::Mat image_of(const Array &array);

/* Bounds of an output's words: word i may differ by bound[i % size] LSB, CONF_UNDEFINED: it is not compared; an empty list
 * means that no bit may differ. */
using Bound = std::vector<uint64_t>;

struct Expected {
    Array array;
    Bound bound;
};

enum class Tier { ordinary, boundary, stress, must_reject };
const char *tier_name(Tier tier);

using Flags = std::vector<std::string>; /* the kinds of defect that the case shows */

struct Case {
    std::string stage, name;
    Tier tier;
    Flags flags;
    uint64_t seed;
    std::vector<Array> inputs;
    std::vector<Expected> reference, exact;

    std::string id() const { return stage + "/" + name; }
};

/* Seed of a case's random numbers: FNV-1a of its id, so that cases do not depend on one another. */
uint64_t seed_of(const std::string &id);

/* The cases in order of definition, each already run through the C library and the reference. */
class Set {
public:
    /* Stage that the following cases belong to. */
    void begin(const std::string &stage) { stage_ = stage; }
    /* Random numbers for the case of the given name. */
    accuracy::Random random(const std::string &name) const { return accuracy::Random(seed_of(stage_ + "/" + name)); }
    void add(const std::string &name, Tier tier, Flags flags, std::vector<Array> inputs);

    /* What the C library answers to inputs of that stage. */
    std::vector<Array> run(const std::vector<Array> &inputs) const;

    const std::vector<Case> &cases() const { return cases_; }
    /* Prints how far the C library is from the reference, stage by stage; false when a bound does not hold. */
    bool report() const;

private:
    std::string stage_;
    std::vector<Case> cases_;
};

/* Uniform integer in [low, high]. */
inline int between(accuracy::Random &random, int low, int high)
{
    return low + static_cast<int>(random.next() % static_cast<uint64_t>(high - low + 1));
}

/* Standard normal number. */
double normal(accuracy::Random &random);

/* The reference tier of a stage; 'exact' is the C library's answer, for those words that are defined by others. */
std::vector<Expected> reference_of(const std::string &stage, const std::vector<Array> &inputs,
                                   const std::vector<Array> &exact);

void add_smooth(Set &set);
void add_gradient(Set &set);
void add_canny(Set &set);
void add_mask(Set &set);
void add_arcs(Set &set);
void add_constraints(Set &set);
void add_select(Set &set);
void add_ellipse(Set &set);
void add_quality(Set &set);
void add_support(Set &set);
void add_cluster(Set &set);
void add_eigen(Set &set);
void add_undistort(Set &set);
void add_pose(Set &set);
void add_joint(Set &set);
void add_kalman(Set &set);
void add_frame(Set &set, const std::string &scenes_folder);
void add_config(Set &set);         /* of stage frame, after its other cases */
void add_narrow_regions(Set &set); /* of stage frame, too, but not to move thresholds on */
void add_decide(Set &set);
void add_look(Set &set);
void add_rim(Set &set);
void add_search(Set &set);
void add_acquire(Set &set);
void add_follow(Set &set);
void add_track(Set &set);

} // namespace vectors
