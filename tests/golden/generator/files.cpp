/* SPDX-License-Identifier: Apache-2.0 */
/* Words as hexadecimal lines, images as PNG, and the manifest in a fixed layout: a line an array. */
#include "files.hpp"

#include <stdexcept>

#include <opencv2/core/version.hpp>
#include <opencv2/imgcodecs.hpp>

#include "conformance.h"
#include "sha256.h"

namespace vectors {

namespace {

std::string quoted(const std::string &text)
{
    for (const char c : text) {
        if (c < ' ' || c > '~' || c == '"' || c == '\\') {
            throw std::runtime_error("not plain text: " + text);
        }
    }
    return "\"" + text + "\"";
}

/* What the file of an array is called: stage/case.array[.ref|.out].hex|png. */
std::string path_of(const Case &c, const Array &a, const char *tier)
{
    return c.id() + "." + a.name + tier + (a.width > 0 ? ".png" : ".hex");
}

std::string bytes_of(const Array &a) { return a.width > 0 ? png_bytes(a) : hex_text(a); }

/* An array's object without the closing brace. */
std::string describe(const Array &a, const std::string &path, const std::string &bytes)
{
    std::string text =
        "{\"name\": " + quoted(a.name) + ", \"file\": " + quoted(path) + ", \"bits\": " + std::to_string(a.bits);
    if (a.width > 0) {
        text += ", \"width\": " + std::to_string(a.width) + ", \"height\": " + std::to_string(a.height);
    } else {
        text += ", \"count\": " + std::to_string(a.words.size()) + ", \"q\": " + std::to_string(a.q);
    }
    return text + ", \"sha256\": " + quoted(sha256_of(bytes));
}

/* LSB, or why the word is undefined. */
std::string bound_text(const std::string &stage, const Expected &e, size_t i)
{
    return e.bound[i] != CONF_UNDEFINED ? std::to_string(e.bound[i])
                                        : quoted(conf_measure_of(stage.c_str(), e.array.name.c_str(), i)->undefined);
}

std::string class_of(const std::string &stage, const Expected &e)
{
    if (e.bound.empty()) {
        return ", \"class\": \"exact\"}";
    }
    std::string text = ", \"class\": \"lsb\", \"bound\": ";
    if (e.bound.size() == 1) {
        return text + bound_text(stage, e, 0) + "}";
    }
    text += "[";
    for (size_t i = 0; i < e.bound.size(); i++) {
        text += (i > 0 ? ", " : "") + bound_text(stage, e, i);
    }
    return text + "]}";
}

std::string list(const char *name, const std::vector<std::string> &objects)
{
    std::string text = std::string("     \"") + name + "\": [";
    for (size_t i = 0; i < objects.size(); i++) {
        text += (i > 0 ? ",\n       " : "\n       ") + objects[i];
    }
    return text + "]";
}

/* Objects of one tier; a file whose bytes the other tier has already is named, not repeated. */
std::vector<std::string> expected_objects(Files &files, const Case &c, const std::vector<Expected> &tier,
                                          const char *suffix)
{
    std::vector<std::string> objects;
    for (const Expected &e : tier) {
        const std::string bytes = bytes_of(e.array);
        std::string path = path_of(c, e.array, ".out");
        const auto other = files.find(path);
        if (other == files.end() || other->second != bytes) {
            path = path_of(c, e.array, suffix);
        }
        files[path] = bytes;
        objects.push_back(describe(e.array, path, bytes) + class_of(c.stage, e));
    }
    return objects;
}

std::string case_object(Files &files, const Case &c)
{
    std::vector<std::string> inputs;
    std::string flags;
    for (const Array &a : c.inputs) {
        const std::string path = path_of(c, a, "");
        const std::string bytes = bytes_of(a);
        files[path] = bytes;
        inputs.push_back(describe(a, path, bytes) + "}");
    }
    for (const std::string &f : c.flags) {
        flags += (flags.empty() ? "" : ", ") + quoted(f);
    }
    const std::vector<std::string> exact = expected_objects(files, c, c.exact, ".out");
    const std::vector<std::string> reference = expected_objects(files, c, c.reference, ".ref");
    return "    {\"id\": " + quoted(c.id()) + ", \"stage\": " + quoted(c.stage) +
           ", \"tier\": " + quoted(tier_name(c.tier)) + ", \"flags\": [" + flags +
           "], \"origin\": {\"seed\": " + std::to_string(c.seed) + ", \"generator\": " + quoted(c.stage) + "},\n" +
           list("inputs", inputs) + ",\n" + list("reference", reference) + ",\n" + list("exact", exact) + "}";
}

} // namespace

std::string hex_text(const Array &array)
{
    std::string text;
    for (const int64_t word : array.words) {
        char digits[CONF_HEX_WORD];
        conf_hex_word(digits, word, array.bits);
        text += digits;
        text += '\n';
    }
    return text;
}

std::string png_bytes(const Array &array)
{
    std::vector<uint8_t> bytes;
    const std::vector<int> how = {cv::IMWRITE_PNG_COMPRESSION, 9, cv::IMWRITE_PNG_STRATEGY,
                                  cv::IMWRITE_PNG_STRATEGY_DEFAULT};
    if (!cv::imencode(".png", image_of(array), bytes, how)) {
        throw std::runtime_error("cannot encode image " + array.name);
    }
    return std::string(bytes.begin(), bytes.end());
}

std::string sha256_of(const std::string &bytes)
{
    char hex[SHA256_HEX];
    sha256 s;
    sha256_init(&s);
    sha256_add(&s, bytes.data(), bytes.size());
    sha256_end(hex, &s);
    return hex;
}

Files files_of(const Set &set, const std::string &version)
{
    Files files;
    std::string manifest = "{\n  \"schema\": \"manifest.schema.json\",\n  \"version\": " + quoted(version) +
                           ",\n  \"opencv\": " + quoted(CV_VERSION) + ",\n  \"cases\": [\n";
    bool first = true;
    for (const Case &c : set.cases()) {
        manifest += (first ? "" : ",\n") + case_object(files, c);
        first = false;
    }
    files["manifest.json"] = manifest + "\n  ]\n}\n";
    return files;
}

} // namespace vectors
