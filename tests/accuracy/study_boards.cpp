/* SPDX-License-Identifier: Apache-2.0 */
/* Photographs of circle boards in the study. */
#include "boards.hpp"
#include "study.hpp"

namespace accuracy {

void section_boards(Report &report, const StudyOptions &)
{
    report.section("Photographs of circle boards");
    if (!boards_there(boards_folder)) {
        report.text("The photographs are not there: not measured.");
        report.not_judged("circle boards", "the photographs are not there");
        return;
    }
    report.text("Each circle alone, in a region of 2.5 semi-axes, against the pose from hand-labelled ellipses of all "
                "boards jointly; a flat circle allows two poses: the one with the better axis counts. Means.");
    const Boards boards = measure_boards(boards_folder, 1.25, false);
    std::vector<Report::Row> rows;
    const auto add = [&](const std::string &name, const BoardErrors &e) {
        rows.push_back({name, std::to_string(e.circles), fixed(e.measured_percent(), 1), fixed(mean(e.dx), 3),
                        fixed(mean(e.dy), 3), fixed(mean(e.dz), 3), fixed(mean(e.axis), 2), fixed(median(e.axis), 2),
                        fixed(mean(e.ellipse), 2)});
    };
    for (size_t i = 0; i < boards.names.size(); i++) {
        add(boards.names[i], boards.errors[i]);
    }
    add("all", boards.total);
    report.table(
        {"photograph", "circles", "measured, %", "x, %", "y, %", "z, %", "axis, degrees", "its median", "outline, px"},
        rows);
    report.at_least("circle boards: measured", boards.total.measured_percent(), 100, "%");
    report.at_most("circle boards: z, mean", mean(boards.total.dz), 0.22, "%");
    report.at_most("circle boards: axis, mean", mean(boards.total.axis), 0.85, "degrees");
}

} // namespace accuracy
