// SPDX-License-Identifier: BSD-3-Clause
#include "view/stage_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/input_file.h"
#include "io/limits.h"
#include "io/scalar.h"
#include "io/scan.h"

namespace storey::view {
namespace {

using io::InputFile;
using Words = std::vector<std::string_view>;

constexpr std::size_t kNumberBytes = 4;  // of every field of our clouds

struct CloudHeader {
  std::vector<std::string> names;
  std::vector<io::Scalar> types;
  std::uint64_t num_points = 0;

  std::size_t find(const InputFile& file, const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) file.fail("its points have no " + name);
    return static_cast<std::size_t>(at - names.begin());
  }
};

void requireAll(const InputFile& file, const Words& words, std::string_view expected) {
  const auto other = [&](std::string_view word) { return word != expected; };
  if (std::any_of(words.begin() + 1, words.end(), other)) {
    file.failAtLine(std::string(words[0]) + " is not " + std::string(expected) + " throughout");
  }
}

CloudHeader readHeader(InputFile& file) {
  CloudHeader header;
  for (bool at_data = false; !at_data;) {
    const Words words = io::splitWords(file.nextHeaderLine());
    if (words.size() < 2 || words[0][0] == '#') continue;
    if (words[0] == "FIELDS") header.names.assign(words.begin() + 1, words.end());
    if (words[0] == "SIZE") requireAll(file, words, "4");
    if (words[0] == "COUNT") requireAll(file, words, "1");
    if (words[0] == "TYPE") {
      for (std::size_t i = 1; i < words.size(); ++i) {
        header.types.push_back(words[i] == "U" ? io::Scalar::UInt32 : io::Scalar::Float32);
      }
    }
    if (words[0] == "POINTS" && !io::parseUnsigned(words[1], header.num_points)) {
      file.failAtLine("POINTS is not a number");
    }
    at_data = words[0] == "DATA";
    if (at_data) requireAll(file, words, "binary");
  }
  const std::size_t record_bytes = kNumberBytes * header.names.size();
  if (record_bytes == 0 || header.types.size() != header.names.size()) {
    file.fail("its header has no FIELDS, or another number of TYPE");
  }
  if (header.num_points > file.remaining() / record_bytes) {
    file.fail("is shorter than its " + std::to_string(header.num_points) + " points");
  }
  return header;
}

std::string_view requireLine(InputFile& file) {
  std::string_view line;
  if (!file.nextBodyLine(line)) file.fail("ends before its last line");
  return line;
}

// The count in a line "KEYWORD count ...".
std::uint64_t readCount(InputFile& file, std::string_view keyword) {
  const Words words = io::splitWords(requireLine(file));
  std::uint64_t count = 0;
  if (words.size() < 2 || words[0] != keyword || !io::parseUnsigned(words[1], count)) {
    file.failAtLine("is not '" + std::string(keyword) + "' and a number");
  }
  if (count > file.remaining()) file.failAtLine("announces more than the file holds");
  return count;
}

std::vector<Eigen::Vector3d> readVtkPoints(InputFile& file) {
  std::vector<Eigen::Vector3d> points(readCount(file, "POINTS"));
  for (Eigen::Vector3d& p : points) {
    const Words words = io::splitWords(requireLine(file));
    bool good = words.size() == 3;
    for (std::size_t i = 0; good && i < 3; ++i) {
      double& coordinate = p[static_cast<Eigen::Index>(i)];
      good = io::parseNumber(words[i], coordinate) && std::isfinite(coordinate);
    }
    if (!good) file.failAtLine("is not a point");
  }
  return points;
}

}  // namespace

StageCloud readStageCloud(const std::string& path, const std::string& value_field) {
  InputFile file(path, io::kDefaultMaxFileBytes);
  const CloudHeader header = readHeader(file);
  std::vector<std::size_t> columns;
  for (const char* const name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"}) {
    columns.push_back(header.find(file, name));
  }
  if (!value_field.empty()) columns.push_back(header.find(file, value_field));

  StageCloud cloud;
  std::vector<double> numbers(columns.size());
  for (std::uint64_t i = 0; i < header.num_points; ++i) {
    const unsigned char* const record = file.take(kNumberBytes * header.names.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      numbers[c] =
          io::decodeScalar(record + kNumberBytes * columns[c], header.types[columns[c]], false);
    }
    const Eigen::Vector3d position(numbers[0], numbers[1], numbers[2]);
    if (!position.allFinite()) file.failAtByte("a point is not finite");
    cloud.positions.push_back(position.cast<float>());
    cloud.normals.push_back(Eigen::Vector3d(numbers[3], numbers[4], numbers[5]).cast<float>());
    if (!value_field.empty()) cloud.values.push_back(numbers[6]);
  }
  file.expectEnd();
  return cloud;
}

std::vector<std::vector<Eigen::Vector3d>> readVtkLines(const std::string& path) {
  InputFile file(path, io::kDefaultMaxFileBytes);
  constexpr int kHeaderLines = 4;  // version, title, ASCII, DATASET POLYDATA
  for (int i = 0; i < kHeaderLines; ++i) file.nextHeaderLine();
  const std::vector<Eigen::Vector3d> points = readVtkPoints(file);
  std::vector<std::vector<Eigen::Vector3d>> lines(readCount(file, "LINES"));
  for (std::vector<Eigen::Vector3d>& line : lines) {
    const Words words = io::splitWords(requireLine(file));
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::uint64_t corner = 0;
      if (!io::parseUnsigned(words[i], corner) || corner >= points.size()) {
        file.failAtLine("has a corner that is not a point");
      }
      line.push_back(points[corner]);
    }
  }
  return lines;
}

}  // namespace storey::view
