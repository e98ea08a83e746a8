/* SPDX-License-Identifier: Apache-2.0 */
/* A report of a study: Markdown with tables, plots by gnuplot, bars that are met or missed, progress on stderr. */
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace accuracy {

/* Numbers for tables; "-" when not finite. */
std::string fixed(double value, int digits);
std::string plain(double value);                   /* as short as it can be, to four digits: limits and marks */
std::string significant(double value, int digits); /* that many significant digits, no exponent */

struct Series {
    std::string title;
    std::vector<double> x, y;         /* of one length; points that are not finite are left out */
    std::string with = "linespoints"; /* gnuplot's style: linespoints, lines, points, boxes, steps */
};

struct Plot {
    std::string name; /* NAME.png, with NAME.dat and NAME.gp to draw it again */
    std::string caption;
    std::string x_label, y_label;
    std::vector<Series> series;
    bool log_x = false;
    bool log_y = false;
    std::vector<std::string> commands; /* further gnuplot lines before 'plot', such as "set key left" */
};

class Report {
public:
    using Row = std::vector<std::string>;

    /* Makes the folder when it is not there; throws when it cannot. */
    Report(const std::string &folder, const std::string &title);

    void section(const std::string &title);
    void text(const std::string &paragraph);
    /* The first column is aligned left, the others right. */
    void table(const Row &head, const std::vector<Row> &rows);
    /* Writes data and script, runs gnuplot, shows the picture; throws when gnuplot fails. */
    void plot(const Plot &plot);

    /* Bars, shown together at the top of the report; a figure that is not finite misses its bar. */
    void at_most(const std::string &what, double measured, double limit, const std::string &unit);
    void at_least(const std::string &what, double measured, double limit, const std::string &unit);
    void within(const std::string &what, double measured, double low, double high, const std::string &unit);
    /* A share of failures, judged with regard to the number of trials: missed when there are more than share * trials
     * and when, at exactly that share, so many would come about with less than 1 % probability or the expected number is
     * 1 or more. So a short run cannot miss by one unlucky trial, and a long run has the bar as it stands. */
    void rate_at_most(const std::string &what, int failures, int trials, double share);
    /* A bar that cannot be judged here, and why. */
    void not_judged(const std::string &what, const std::string &reason);
    /* A bar known to be missed: shown as missed with the reason, but no failure. Call before the bar is judged. */
    void known_missed(const std::string &what, const std::string &reason);

    /* A line on stderr now and then, and at the end. */
    void progress(const std::string &what, size_t done, size_t total);

    /* Writes report.md and prints the bars; true when no bar is missed but the known ones. */
    bool finish();

    const std::string &folder() const { return folder_; }

private:
    struct Bar {
        std::string what, measured, limit, verdict;
    };
    void judge(const std::string &what, const std::string &measured, const std::string &limit, bool met);
    std::string bars_table() const;

    std::string folder_, title_, body_;
    std::vector<Bar> bars_;
    std::map<std::string, std::string> known_;
    int missed_ = 0;       /* and not known */
    int known_missed_ = 0; /* missed as known */
    std::chrono::steady_clock::time_point begin_, spoken_;
};

} // namespace accuracy
