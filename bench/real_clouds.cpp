// SPDX-License-Identifier: BSD-3-Clause
#include "bench/real_clouds.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/failure.h"

namespace storey::bench {

namespace fs = std::filesystem;

std::vector<std::string> cloudsIn(const std::string& folder) {
  std::vector<std::string> clouds;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".ply") clouds.push_back(entry.path().string());
  }
  if (error) throw io::Failure(io::MissingInput, folder, error.message(), "");
  std::sort(clouds.begin(), clouds.end());
  return clouds;
}

std::map<std::string, std::string> readCloudOptions(const std::string& path) {
  std::map<std::string, std::string> options;
  if (path.empty()) return options;
  std::ifstream file(path);
  if (!file) throw io::Failure(io::MissingInput, path, "cannot be read", "");
  for (std::string line; std::getline(file, line);) {
    std::istringstream stream(line.substr(0, line.find('#')));
    std::string name;
    if (stream >> name) std::getline(stream, options[name]);
  }
  return options;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace storey::bench
