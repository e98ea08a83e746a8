/* SPDX-License-Identifier: Apache-2.0 */
/* Frames measured with one threshold off its default, for every threshold: of the frames before them the smallest whose
 * words it changes. */
#include <algorithm>
#include <stdexcept>

#include "case.hpp"
#include "case_words.h"
#include "stages_words.h"

namespace vectors {

namespace {

using Words = std::vector<int64_t>;

constexpr size_t ANGLE = 5; /* of the outline, among the words of a frame */

struct Threshold {
    const char *member;
    bool real; /* Q16 */
};

#define THRESHOLD(type, member) {#member, std::string(#member).find("_q16") != std::string::npos},
const Threshold thresholds[CONF_CONFIG_WORDS] = {CONF_CONFIG_LIST(THRESHOLD)};
#undef THRESHOLD

Array config_array(const drogue_config &config)
{
    int32_t words[CONF_CONFIG_WORDS];
    conf_config_put(words, &config);
    return word_array("config", 32, 16, Words(words, words + CONF_CONFIG_WORDS));
}

/* The defaults but for one word; nothing where that is out of its range. */
bool moved(drogue_config &config, size_t which, int64_t word)
{
    int32_t words[CONF_CONFIG_WORDS];
    drogue_config_default(&config);
    conf_config_put(words, &config);
    if (word == words[which] || word < 0 || word > INT32_MAX) {
        return false;
    }
    words[which] = static_cast<int32_t>(word);
    conf_config_take(&config, words);
    return drogue_config_valid(&config) != 0;
}

/* Values to try: near the default first. */
Words values_of(size_t which)
{
    int32_t words[CONF_CONFIG_WORDS];
    drogue_config config;
    drogue_config_default(&config);
    conf_config_put(words, &config);
    const int64_t w = words[which];
    return thresholds[which].real ? Words{w / 2, 2 * w, w / 4, 4 * w, 65535 - (65536 - w) / 2, 16 * w, 0}
                                  : Words{w - 1, w + 1, w / 2, 2 * w, 4 * w, 0, 16 * w, 64 * w};
}

bool same(const std::vector<Array> &a, const std::vector<Expected> &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Array &x, const Expected &y) { return x.words == y.array.words; });
}

/* Is the angle of a frame's outline undefined? Then it is what its bins are counted from, too. */
bool is_circle(const Case &c)
{
    const Bound &bound = c.reference[0].bound;
    return bound.size() > ANGLE && bound[ANGLE] == CONF_UNDEFINED;
}

/* Does a case become one that measures too, and something else? */
bool changes(const Set &set, const Case &base, std::vector<Array> &inputs, bool measured)
{
    const std::vector<Array> now = set.run(inputs);
    const bool ok = base.exact[0].array.words[0] == 0 && now[0].words[0] == 0;
    return ok == measured && !same(now, base.exact);
}

std::string name_of(size_t which)
{
    std::string name = thresholds[which].member;
    if (thresholds[which].real) {
        name.erase(name.find("_q16"));
    }
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '_' || c == '.'; }, '-');
    return "config-" + name;
}

/* The smallest frame that notices a threshold, best one that is measured with both values. */
void add_threshold(Set &set, const std::vector<Case> &bases, size_t which)
{
    drogue_config config;
    for (const bool measured : {true, false}) {
        for (const Case &base : bases) {
            for (const int64_t value : values_of(which)) {
                std::vector<Array> inputs = base.inputs;
                if (!moved(config, which, value)) {
                    continue;
                }
                inputs.push_back(config_array(config));
                if (changes(set, base, inputs, measured)) {
                    set.add(name_of(which), Tier::boundary, {"config"}, std::move(inputs));
                    return;
                }
            }
        }
    }
    throw std::runtime_error(std::string("no frame notices the threshold ") + thresholds[which].member);
}

} // namespace

void add_config(Set &set)
{
    std::vector<Case> bases; /* which adding to the set does not move */
    std::copy_if(set.cases().begin(), set.cases().end(), std::back_inserter(bases),
                 [](const Case &c) { return c.stage == "frame" && !is_circle(c); });
    std::stable_sort(bases.begin(), bases.end(),
                     [](const Case &a, const Case &b) { return a.inputs[0].words.size() < b.inputs[0].words.size(); });
    set.begin("frame");
    for (size_t which = 0; which < CONF_CONFIG_WORDS; which++) {
        add_threshold(set, bases, which);
    }
}

} // namespace vectors
