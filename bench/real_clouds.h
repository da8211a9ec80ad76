// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace storey::bench {

/// The PLY files of a folder, in the order of their names. \throws io::Failure (MissingInput)
std::vector<std::string> cloudsIn(const std::string& folder);

/// Options of storey_reconstruct by name of cloud, from lines "NAME.ply options"; # starts a
/// comment. None for an empty path. \throws io::Failure (MissingInput)
std::map<std::string, std::string> readCloudOptions(const std::string& path);

/// Words that blanks separate.
std::vector<std::string> wordsOf(const std::string& text);

}  // namespace storey::bench
