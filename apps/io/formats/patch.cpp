// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <cmath>

#include "io/formats/import_formats.h"
#include "io/limits.h"
#include "io/text_numbers.h"

namespace storey::io {
namespace {

constexpr std::uint64_t kLeastBytes = 33;  // of a patch: "PATCHS", 13 numbers of one digit

void expectWord(InputFile& file, const char* word) {
  std::string_view line;
  if (!file.nextBodyLine(line)) file.fail(std::string("ends where ") + word + " belongs");
  const std::vector<std::string_view> words = splitWords(line);
  if (words.size() != 1 || words[0] != word) file.failAtLine(std::string("is not ") + word);
}

/// A point or direction with four coordinates, the last of which is 1 or 0.
Eigen::Vector3d readHomogeneous(InputFile& file, TextNumbers& numbers, bool point) {
  Eigen::Vector4d v;
  for (int axis = 0; axis < 4; ++axis) v[axis] = numbers.next();
  if (point && !(std::abs(v[3]) > 0.0)) file.failAtLine("is a point without a scale");
  return point ? Eigen::Vector3d(v.head<3>() / v[3]) : Eigen::Vector3d(v.head<3>());
}

/// The photos whose texture agrees are kept, the others passed over.
void readPhotos(TextNumbers& numbers, RawCloud& raw) {
  for (const bool agrees : {true, false}) {
    const std::uint64_t count = numbers.nextCount(kMaxListLength);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t photo = numbers.nextCount(kMaxPoints);
      if (agrees) raw.viewers.photos.push_back(static_cast<std::uint32_t>(photo));
    }
  }
  raw.viewers.ends.push_back(raw.viewers.photos.size());
}

}  // namespace

RawCloud readPatches(InputFile& file, const ReadLimits& limits) {
  expectWord(file, "PATCHES");
  TextNumbers numbers(file);
  const std::uint64_t num_points = numbers.nextCount(kMaxPoints);
  numbers.expectLineEnd();
  checkPoints(file, num_points, limits.wholeFile());
  if (num_points > file.remaining() / kLeastBytes + 1) {
    file.fail("declares " + std::to_string(num_points) + " patches, more than it holds");
  }
  // A photo takes two bytes of the file at least, and four of memory.
  file.checkMemory(num_points * (kLoaderBytesPerPoint + 8) + 2 * file.remaining(),
                   limits.max_memory, std::to_string(num_points) + " patches");
  RawCloud raw;
  raw.format = "pmvs patches";
  raw.has_normal_fields = true;
  raw.declared = num_points;
  for (std::uint64_t i = 0; i < num_points; ++i) {
    expectWord(file, "PATCHS");
    const Eigen::Vector3d position = readHomogeneous(file, numbers, true);
    const Eigen::Vector3d normal = readHomogeneous(file, numbers, false);
    raw.positions.insert(raw.positions.end(), position.data(), position.data() + 3);
    for (int axis = 0; axis < 3; ++axis) raw.normals.push_back(static_cast<float>(normal[axis]));
    for (int k = 0; k < 3; ++k) numbers.next();  // how well the photos agree, and two of no use
    readPhotos(numbers, raw);
    numbers.expectLineEnd();
  }
  std::string_view line;
  if (file.nextBodyLine(line)) file.failAtLine("more patches than the header declares");
  return raw;
}

}  // namespace storey::io
