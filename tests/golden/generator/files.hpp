/* SPDX-License-Identifier: Apache-2.0 */
/* Files of the golden vectors: words, images and the manifest that names them. */
#pragma once

#include <map>
#include <string>

#include "case.hpp"

namespace vectors {

using Files = std::map<std::string, std::string>; /* path below the vectors' folder -> bytes */

std::string hex_text(const Array &array); /* a word a line, for $readmemh */
std::string png_bytes(const Array &array);
std::string sha256_of(const std::string &bytes);

/* All files of a set with the manifest, fixed in every byte. */
Files files_of(const Set &set, const std::string &version);

} // namespace vectors
