/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the golden vectors, or says where those of a folder differ from what would be written.
 *
 *  generate DIR          write the case files and manifest.json; DIR/VERSION and DIR/frame/NAME.png are read
 *  generate --check DIR  compare instead of writing, name the differences */
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "files.hpp"

namespace fs = std::filesystem;
using namespace vectors;

namespace {

std::string read(const fs::path &path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        throw std::runtime_error("cannot read " + path.string());
    }
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string version_of(const fs::path &folder)
{
    std::string text = read(folder / "VERSION");
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

/* Case files of the folder, by the endings that only they have. */
std::set<std::string> case_files(const fs::path &folder, const Files &files)
{
    std::set<std::string> found;
    std::set<std::string> stages;
    for (const auto &file : files) {
        stages.insert(fs::path(file.first).parent_path().string());
    }
    for (const std::string &stage : stages) {
        if (stage.empty() || !fs::is_directory(folder / stage)) {
            continue;
        }
        for (const auto &entry : fs::directory_iterator(folder / stage)) {
            const std::string name = entry.path().filename().string();
            if (entry.path().extension() == ".hex" || name.find('.') != name.rfind('.')) {
                found.insert(stage + "/" + name); /* case.array.png: pictures for people have one dot */
            }
        }
    }
    return found;
}

void write(const fs::path &folder, const Files &files)
{
    for (const std::string &path : case_files(folder, files)) {
        if (files.find(path) == files.end()) {
            fs::remove(folder / path);
            std::printf("removed %s\n", path.c_str());
        }
    }
    for (const auto &file : files) {
        fs::create_directories((folder / file.first).parent_path());
        std::ofstream out(folder / file.first, std::ios::binary);
        out.write(file.second.data(), static_cast<std::streamsize>(file.second.size()));
        out.close();
        if (!out) {
            throw std::runtime_error("cannot write " + file.first);
        }
    }
}

/* Number of differences; each is named. */
int check(const fs::path &folder, const Files &files)
{
    int differences = 0;
    for (const auto &file : files) {
        const bool there = fs::is_regular_file(folder / file.first);
        if (!there || read(folder / file.first) != file.second) {
            std::printf("%s: %s\n", there ? "differs" : "missing", file.first.c_str());
            differences++;
        }
    }
    for (const std::string &path : case_files(folder, files)) {
        if (files.find(path) == files.end()) {
            std::printf("not generated: %s\n", path.c_str());
            differences++;
        }
    }
    return differences;
}

/* What the set costs on disk, and compiled into an image: files that two arrays share count once. */
void print_sizes(const Set &set, const Files &files)
{
    std::set<std::vector<int64_t>> distinct;
    size_t binary = 0;
    size_t text = 0;
    const auto add = [&](const Array &a) {
        if (distinct.insert(a.words).second) {
            binary += a.words.size() * static_cast<size_t>(a.bits / 8);
        }
    };
    for (const Case &c : set.cases()) {
        for (const Array &a : c.inputs) {
            add(a);
        }
        for (const auto *tier : {&c.reference, &c.exact}) {
            for (const Expected &e : *tier) {
                add(e.array);
            }
        }
    }
    for (const auto &file : files) {
        text += file.second.size();
    }
    std::printf("%zu files, %zu KiB as files, %zu KiB as binary words\n", files.size(), text / 1024, binary / 1024);
}

} // namespace

int main(int argc, char **argv)
{
    const bool checking = argc == 3 && std::strcmp(argv[1], "--check") == 0;
    if (!checking && argc != 2) {
        std::fputs("usage: generate [--check] DIR\n", stderr);
        return 2;
    }
    try {
        const fs::path folder = argv[argc - 1];
        Set set;
        add_smooth(set);
        add_gradient(set);
        add_canny(set);
        add_mask(set);
        add_arcs(set);
        add_constraints(set);
        add_select(set);
        add_ellipse(set);
        add_quality(set);
        add_support(set);
        add_cluster(set);
        add_eigen(set);
        add_undistort(set);
        add_pose(set);
        add_joint(set);
        add_kalman(set);
        add_frame(set, (folder / "frame").string());
        add_config(set);
        add_narrow_regions(set);
        add_decide(set);
        add_look(set);
        add_rim(set);
        add_search(set);
        add_acquire(set);
        add_follow(set);
        add_track(set);
        const Files files = files_of(set, version_of(folder));
        const bool good = set.report();
        print_sizes(set, files);
        if (!good) {
            std::fputs("generate: the library is farther from the reference than stated; nothing written\n", stderr);
            return 1;
        }
        if (!checking) {
            write(folder, files);
            return 0;
        }
        const int differences = check(folder, files);
        std::printf("%s: %d of %zu files differ\n", folder.string().c_str(), differences, files.size());
        return differences > 0 ? 1 : 0;
    } catch (const std::exception &e) {
        std::fprintf(stderr, "generate: %s\n", e.what());
        return 2;
    }
}
