/* SPDX-License-Identifier: Apache-2.0 */
/* Markdown, gnuplot, bars and progress. */
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace accuracy {

namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

/* Probability of at least k failures in n trials at a share p. */
double tail(int k, int n, double p)
{
    double below = 0;
    for (int i = 0; i < k; i++) {
        below += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                          (n - i) * std::log1p(-p));
    }
    return 1 - below;
}

/* With its unit, if any. */
std::string with_unit(const std::string &number, const std::string &unit)
{
    return unit.empty() ? number : number + " " + unit;
}

std::string quoted(const std::string &text) /* for gnuplot: single quotes, doubled inside */
{
    std::string out = "'";
    for (const char c : text) {
        out += c;
        if (c == '\'') {
            out += c;
        }
    }
    return out + "'";
}

void write_file(const std::string &path, const std::string &content)
{
    std::ofstream out(path);
    out << content;
    out.close();
    if (!out) {
        throw std::runtime_error("cannot write " + path);
    }
}

std::string data_of(const Plot &plot)
{
    std::string data;
    for (const Series &s : plot.series) {
        if (s.x.size() != s.y.size()) {
            throw std::logic_error("plot " + plot.name + ": x and y differ in length");
        }
        data += "# " + s.title + "\n";
        for (size_t i = 0; i < s.x.size(); i++) {
            if (std::isfinite(s.x[i]) && std::isfinite(s.y[i])) {
                char line[64];
                std::snprintf(line, sizeof line, "%.9g %.9g\n", s.x[i], s.y[i]);
                data += line;
            }
        }
        data += "\n\n"; /* the next is another index */
    }
    return data;
}

std::string script_of(const Plot &plot)
{
    std::string script = "set terminal pngcairo size 900,600 font 'sans,11' linewidth 1.5 pointscale 1.2 noenhanced\n"
                         "set output " +
                         quoted(plot.name + ".png") + "\nset grid lc rgb '#b0b0b0'\nset key below\n";
    script += "set xlabel " + quoted(plot.x_label) + "\nset ylabel " + quoted(plot.y_label) + "\n";
    script += plot.log_x ? "set logscale x\n" : "";
    script += plot.log_y ? "set logscale y\n" : "";
    for (const std::string &command : plot.commands) {
        script += command + "\n";
    }
    for (size_t i = 0; i < plot.series.size(); i++) {
        const Series &s = plot.series[i];
        script += i == 0 ? "plot " : ", \\\n     ";
        script += quoted(plot.name + ".dat") + " index " + std::to_string(i) + " with " + s.with + " title " +
                  quoted(s.title);
    }
    return script + "\n";
}

} // namespace

std::string fixed(double value, int digits)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return std::isfinite(value) ? text : "-";
}

std::string plain(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.4g", value);
    return std::isfinite(value) ? text : "-";
}

std::string significant(double value, int digits)
{
    const int before =
        value != 0 && std::isfinite(value) ? static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1 : 1;
    return fixed(value, std::max(0, digits - before));
}

Report::Report(const std::string &folder, const std::string &title)
    : folder_(folder), title_(title), begin_(Clock::now()), spoken_(begin_)
{
    if (folder.find('\'') != std::string::npos) {
        throw std::runtime_error("no quote, please, in the name of the folder: " + folder);
    }
    std::filesystem::create_directories(folder);
}

void Report::section(const std::string &title)
{
    body_ += "\n## " + title + "\n";
    std::fprintf(stderr, "study: %s\n", title.c_str());
}

void Report::text(const std::string &paragraph) { body_ += "\n" + paragraph + "\n"; }

void Report::table(const Row &head, const std::vector<Row> &rows)
{
    const auto line = [](const Row &cells) {
        std::string out = "|";
        for (const std::string &cell : cells) {
            out += " " + cell + " |";
        }
        return out + "\n";
    };
    body_ += "\n" + line(head) + "| --- |";
    for (size_t i = 1; i < head.size(); i++) {
        body_ += " ---: |";
    }
    body_ += "\n";
    for (const Row &row : rows) {
        if (row.size() != head.size()) {
            throw std::logic_error("a row of a table is not as long as its head: " + line(row));
        }
        body_ += line(row);
    }
}

void Report::plot(const Plot &plot)
{
    write_file(folder_ + "/" + plot.name + ".dat", data_of(plot));
    write_file(folder_ + "/" + plot.name + ".gp", script_of(plot));
    const std::string command = "cd '" + folder_ + "' && gnuplot '" + plot.name + ".gp'";
    if (std::system(command.c_str()) != 0) {
        throw std::runtime_error("gnuplot failed on " + plot.name + ".gp (is gnuplot installed?)");
    }
    body_ += "\n![" + plot.caption + "](" + plot.name + ".png)\n\n" + plot.caption + "\n";
}

void Report::judge(const std::string &what, const std::string &measured, const std::string &limit, bool met)
{
    const auto known = known_.find(what);
    const bool listed = known != known_.end();
    std::string verdict = met ? "met" : "**missed**";
    if (listed) {
        verdict += met ? " (listed as missed)" : ", known: " + known->second;
    }
    missed_ += !met && !listed;
    known_missed_ += !met && listed;
    bars_.push_back({what, measured, limit, verdict});
}

void Report::at_most(const std::string &what, double measured, double limit, const std::string &unit)
{
    judge(what, with_unit(significant(measured, 3), unit), "at most " + with_unit(plain(limit), unit),
          measured <= limit);
}

void Report::at_least(const std::string &what, double measured, double limit, const std::string &unit)
{
    judge(what, with_unit(significant(measured, 4), unit), "at least " + with_unit(plain(limit), unit),
          measured >= limit);
}

void Report::within(const std::string &what, double measured, double low, double high, const std::string &unit)
{
    judge(what, with_unit(significant(measured, 3), unit), with_unit(plain(low) + " to " + plain(high), unit),
          measured >= low && measured <= high);
}

void Report::rate_at_most(const std::string &what, int failures, int trials, double share)
{
    const bool more = failures > share * trials;
    const bool certain = share * trials >= 1 || tail(failures, trials, share) < 0.01;
    judge(what, std::to_string(failures) + " of " + std::to_string(trials), "at most " + plain(100 * share) + " %",
          trials > 0 && !(more && certain));
}

void Report::not_judged(const std::string &what, const std::string &reason)
{
    bars_.push_back({what, "-", "-", "not judged: " + reason});
}

void Report::known_missed(const std::string &what, const std::string &reason) { known_[what] = reason; }

void Report::progress(const std::string &what, size_t done, size_t total)
{
    const Clock::time_point now = Clock::now();
    if (done == total || seconds(now - spoken_) >= 10) {
        std::fprintf(stderr, "study: %s %zu/%zu, %.0f s\n", what.c_str(), done, total, seconds(now - begin_));
        spoken_ = now;
    }
}

std::string Report::bars_table() const
{
    std::string out = "\n| bar | measured | asked | verdict |\n| --- | ---: | ---: | --- |\n";
    for (const Bar &b : bars_) {
        out += "| " + b.what + " | " + b.measured + " | " + b.limit + " | " + b.verdict + " |\n";
    }
    return out;
}

bool Report::finish()
{
    write_file(folder_ + "/report.md", "# " + title_ + "\n\n## Bars\n" + bars_table() + body_);
    for (const Bar &b : bars_) {
        std::printf("%-66s %18s  %-22s %s\n", b.what.c_str(), b.measured.c_str(), b.limit.c_str(), b.verdict.c_str());
    }
    std::printf("study: bars=%zu missed=%d known=%d seconds=%.0f report=%s/report.md\n", bars_.size(), missed_,
                known_missed_, seconds(Clock::now() - begin_), folder_.c_str());
    return missed_ == 0;
}

} // namespace accuracy
