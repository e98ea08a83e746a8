/* SPDX-License-Identifier: Apache-2.0 */
/* Mai, Bai, Liu and Qiao: three ways to tell which arcs are one ellipse's. */
#include "detectors.hpp"

#include <algorithm>
#include <limits>

#include "edges.hpp"

namespace accuracy {

namespace {

constexpr size_t most_arcs = 40;      /* the longest */
constexpr double max_residual_px = 1; /* of a joint fit, root mean square */
constexpr double min_gap_px = 5;      /* ends this near meet */
constexpr double gap_share = 0.2;     /* or nearer than this share of the shorter arc */

using Group = std::vector<const Chain *>;

std::vector<Chain> longest_arcs(const cv::Mat &grey)
{
    std::vector<Chain> arcs = convex_arcs_of(EdgeImage(grey));
    arcs.resize(std::min(arcs.size(), most_arcs));
    return arcs;
}

double residual_px(const Ellipse &e, const Group &group)
{
    double worst = 0;
    for (const Chain *arc : group) {
        worst = std::max(worst, rms_px(e, *arc));
    }
    return worst;
}

/* Fits a group; false when an arc of it is far from what comes out. */
bool holds(Ellipse &e, const Group &group) { return fit_arcs(e, group) && residual_px(e, group) <= max_residual_px; }

void keep(std::vector<Ellipse> &found, const Group &group)
{
    Ellipse e;
    if (fit_arcs(e, group)) {
        found.push_back(e);
    }
}

bool ends_meet(const Chain &a, const Chain &b)
{
    const double gap = std::max(min_gap_px, gap_share * static_cast<double>(std::min(a.size(), b.size())));
    for (const cv::Point &p : {a.front().at, a.back().at}) {
        for (const cv::Point &q : {b.front().at, b.back().at}) {
            if (cv::norm(p - q) <= gap) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

/* Connectivity and curvature: arcs that meet end to end and turn alike are one, and so on from each to the next. */
std::vector<Ellipse> detect_mai(const cv::Mat &grey)
{
    const std::vector<Chain> arcs = longest_arcs(grey);
    std::vector<bool> used(arcs.size());
    std::vector<Ellipse> found;
    for (size_t first = 0; first < arcs.size(); first++) {
        if (used[first]) {
            continue;
        }
        Group group = {&arcs[first]};
        used[first] = true;
        for (size_t k = 0; k < group.size(); k++) {
            for (size_t i = 0; i < arcs.size(); i++) {
                if (!used[i] && ends_meet(*group[k], arcs[i]) && face_each_other(*group[k], arcs[i])) {
                    used[i] = true;
                    group.push_back(&arcs[i]);
                }
            }
        }
        keep(found, group);
    }
    return found;
}

/* Concavity: from each arc on, those that it faces and that face it, as long as the joint fit holds. */
std::vector<Ellipse> detect_bai(const cv::Mat &grey)
{
    const std::vector<Chain> arcs = longest_arcs(grey);
    std::vector<Ellipse> found;
    for (size_t first = 0; first < arcs.size(); first++) {
        Group group = {&arcs[first]};
        Ellipse e;
        for (size_t i = 0; i < arcs.size(); i++) {
            const bool faced = i != first && std::all_of(group.begin(), group.end(), [&](const Chain *member) {
                                   return face_each_other(*member, arcs[i]);
                               });
            if (faced) {
                group.push_back(&arcs[i]);
                if (!holds(e, group)) {
                    group.pop_back();
                }
            }
        }
        keep(found, group);
    }
    return found;
}

/* Hierarchy: every arc stands for an ellipse; the two groups whose joint fit is best are joined, level by level. */
std::vector<Ellipse> detect_liu_qiao(const cv::Mat &grey)
{
    const std::vector<Chain> arcs = longest_arcs(grey);
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<Group> groups;
    std::vector<Ellipse> found;
    for (const Chain &arc : arcs) {
        groups.push_back({&arc});
    }
    const size_t n = groups.size();
    const auto joined = [&](size_t i, size_t j) {
        Group both = groups[i];
        both.insert(both.end(), groups[j].begin(), groups[j].end());
        return both;
    };
    const auto cost_of = [&](size_t i, size_t j) {
        Ellipse e;
        if (groups[i].empty() || groups[j].empty() || !face_each_other(*groups[i][0], *groups[j][0])) {
            return never;
        }
        const Group both = joined(i, j);
        return fit_arcs(e, both) ? residual_px(e, both) : never;
    };
    std::vector<std::vector<double>> cost(n, std::vector<double>(n, never));
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) {
            cost[i][j] = cost_of(i, j);
        }
    }
    for (;;) {
        size_t at_i = 0, at_j = 0;
        double least = max_residual_px;
        for (size_t i = 0; i < n; i++) {
            for (size_t j = i + 1; j < n; j++) {
                if (cost[i][j] < least) {
                    least = cost[i][j];
                    at_i = i, at_j = j;
                }
            }
        }
        if (at_i == at_j) {
            break;
        }
        groups[at_i] = joined(at_i, at_j);
        groups[at_j].clear();
        for (size_t k = 0; k < n; k++) {
            cost[std::min(k, at_j)][std::max(k, at_j)] = never;
            if (k != at_i) {
                cost[std::min(k, at_i)][std::max(k, at_i)] = cost_of(std::min(k, at_i), std::max(k, at_i));
            }
        }
    }
    for (const Group &group : groups) {
        if (!group.empty()) {
            keep(found, group);
        }
    }
    return found;
}

} // namespace accuracy
