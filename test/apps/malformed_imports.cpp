// SPDX-License-Identifier: BSD-3-Clause
// Files of the formats that are imported.
#include <cmath>
#include <cstring>

#include "malformed_files.h"

namespace storey::test {
namespace {

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(&bytes[at], &value, sizeof value);
}

std::string changed(std::string bytes, std::size_t at, std::uint8_t value) {
  bytes[at] = static_cast<char>(value);
  return bytes;
}

template <typename T>
std::string with(std::string bytes, std::size_t at, T value) {
  put(bytes, at, value);
  return bytes;
}

/// Numbers in the byte order of VTK's binary files.
std::string bigEndianRows(int n) {
  std::string rows = binaryRows(n);
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    std::swap(rows[i], rows[i + 3]);
    std::swap(rows[i + 1], rows[i + 2]);
  }
  return rows;
}

std::string vtk(const std::string& kind, const std::string& rest) {
  return "# vtk DataFile Version 3.0\ntitle\n" + kind + "\nDATASET POLYDATA\n" + rest;
}

/// A patch file whose n-th patch is "PATCHS", the sample point and `rest`.
std::string patches(const std::string& count, int n, const std::string& rest) {
  std::string text = "PATCHES\n" + count + "\n";
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p = samplePoint(i);
    text += "PATCHS\n" + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
            std::to_string(p.z()) + " 1\n" + rest;
  }
  return text;
}

const char* const kGoodPatch = "0 0 1 0\n0.9 1 2\n2\n0 1\n0\n\n";

}  // namespace

std::string lasFile(int num_points, int minor, int format) {
  constexpr double kScale = 0.0009765625;  // 2^-10: the sample points are exact multiples
  constexpr std::size_t kRecords[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const std::size_t header = minor < 3 ? 227 : minor < 4 ? 235 : 375;
  const std::size_t record = kRecords[format];
  std::string bytes(header + record * static_cast<std::size_t>(num_points), '\0');
  bytes.replace(0, 4, "LASF");
  put(bytes, 24, std::uint8_t{1});
  put(bytes, 25, static_cast<std::uint8_t>(minor));
  put(bytes, 94, static_cast<std::uint16_t>(header));
  put(bytes, 96, static_cast<std::uint32_t>(header));
  put(bytes, 104, static_cast<std::uint8_t>(format));
  put(bytes, 105, static_cast<std::uint16_t>(record));
  const auto count = static_cast<std::uint32_t>(num_points);
  if (minor < 4) {
    put(bytes, 107, count);
  } else {
    put(bytes, 247, std::uint64_t{count});
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double offset = axis == 0 ? -2.0 : 0.0;
    put(bytes, 131 + 8 * axis, kScale);
    put(bytes, 155 + 8 * axis, offset);
    for (int i = 0; i < num_points; ++i) {
      const double steps = (samplePoint(i)[static_cast<int>(axis)] - offset) / kScale;
      put(bytes, header + record * static_cast<std::size_t>(i) + 4 * axis,
          static_cast<std::int32_t>(std::lround(steps)));
    }
  }
  return bytes;
}

std::vector<CorpusFile> malformedLas() {
  const std::string good = lasFile(3, 2, 0);
  const std::string wide = lasFile(3, 4, 6);
  const double nan = std::nan("");
  return {{"legal_1_2", good, 3, ""},
          {"legal_1_3", lasFile(3, 3, 5), 3, ""},
          {"legal_1_4", wide, 3, ""},
          {"legal_more_follows", good + "waveforms", 3, ""},
          {"only_magic", "LASF", 0, "header"},
          {"short_header", good.substr(0, 226), 0, "header"},
          {"short_wide_header", wide.substr(0, 300), 0, "header"},
          {"no_points", good.substr(0, 227), 0, "more than it holds"},
          {"cut", good.substr(0, good.size() - 1), 0, "more than it holds"},
          {"version_2", changed(good, 24, 2), 0, "LAS 2.2"},
          {"version_1_9", changed(good, 25, 9), 0, "LAS 1.9"},
          {"laz", changed(good, 104, 0x80), 0, "laszip"},
          {"format_11", changed(good, 104, 11), 0, "format 11"},
          {"record_short", with(good, 105, std::uint16_t{19}), 0, "too short"},
          {"record_zero", with(good, 105, std::uint16_t{0}), 0, "too short"},
          {"none", with(good, 107, std::uint32_t{0}), 0, "no points"},
          {"many", with(good, 107, std::uint32_t{0x7fffffff}), 0, ""},
          {"too_many", with(good, 107, std::uint32_t{0xffffffff}), 0, "limit"},
          {"overflow", with(wide, 247, std::uint64_t{1} << 62), 0, "limit"},
          {"overflow_small", with(wide, 247, ~std::uint64_t{0} / 30 + 2), 0, "limit"},
          {"points_in_header", with(good, 96, std::uint32_t{100}), 0, "cannot be"},
          {"points_beyond", with(good, 96, std::uint32_t{100000}), 0, "cannot be"},
          {"header_size_0", with(good, 94, std::uint16_t{0}), 0, "cannot be"},
          {"scale_0", with(good, 131, 0.0), 0, "scale"},
          {"scale_negative", with(good, 139, -1.0), 0, "scale"},
          {"scale_nan", with(good, 147, nan), 0, "scale"},
          {"offset_nan", with(good, 155, nan), 0, "offset"}};
}

std::vector<CorpusFile> malformedVtk() {
  const std::string points = "POINTS 3 float\n" + asciiRows(3);
  const std::string normals = "POINT_DATA 3\nNORMALS n float\n";
  return {
      {"legal_ascii", vtk("ASCII", points), 3, ""},
      {"legal_double", vtk("ASCII", "POINTS 3 double\n" + asciiRows(3)), 3, ""},
      {"legal_binary", vtk("BINARY", "POINTS 3 float\n" + bigEndianRows(3) + "\n"), 3, ""},
      {"legal_cells", vtk("ASCII", points + "VERTICES 1 4\n3 0 1 2\n"), 3, ""},
      {"legal_normals", vtk("ASCII", points + normals + "0 0 1 0 0 1 0 0 1\n"), 3, ""},
      {"legal_other_data", vtk("ASCII", points + "POINT_DATA 3\nSCALARS s float\n"), 3, ""},
      {"title_only", "# vtk DataFile Version 3.0\n", 0, "header"},
      {"no_kind", "# vtk DataFile Version 3.0\nt\nTEXT\n", 0, "line 3"},
      {"no_dataset", "# vtk DataFile Version 3.0\nt\nASCII\n", 0, "POLYDATA"},
      {"grid", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n", 0, "POLYDATA"},
      {"no_points", vtk("ASCII", ""), 0, "POINTS"},
      {"none", vtk("ASCII", "POINTS 0 float\n"), 0, "no points"},
      {"type_int", vtk("ASCII", "POINTS 3 int\n" + asciiRows(3)), 0, "int"},
      {"negative", vtk("ASCII", "POINTS -3 float\n" + asciiRows(3)), 0, "line 5"},
      {"many", vtk("ASCII", "POINTS 2000000000 float\n" + asciiRows(3)), 0, ""},
      {"too_many", vtk("BINARY", "POINTS 18446744073709551615 float\n"), 0, "limit"},
      {"overflow", vtk("BINARY", "POINTS 6148914691236517206 float\n"), 0, "limit"},
      {"too_few", vtk("ASCII", "POINTS 3 float\n" + asciiRows(2)), 0, "ends within"},
      {"too_long_row",
       vtk("ASCII", "POINTS 3 float\n" + asciiRows(3).substr(0, asciiRows(3).size() - 1) + " 7\n"),
       0, "too many"},
      {"word", vtk("ASCII", "POINTS 3 float\n" + asciiRows(2) + "0 0 zero\n"), 0, "line 8"},
      {"binary_cut", vtk("BINARY", "POINTS 3 float\n" + bigEndianRows(2)), 0, "holds"},
      {"normals_cut", vtk("ASCII", points + normals + "0 0 1\n"), 0, "announces"},
      {"cells_cut", vtk("ASCII", points + "VERTICES 1 4\n3 0 1\n"), 0, "announces"},
      {"cells_many", vtk("ASCII", points + "VERTICES 1 99999999999\n3 0 1\n"), 0, "line 9"}};
}

std::vector<CorpusFile> malformedPatches() {
  const auto bad = [](const char* rest) { return patches("3", 3, rest); };
  return {
      {"legal", patches("3", 3, kGoodPatch), 3, ""},
      {"legal_scaled",
       "PATCHES\n3\nPATCHS\n0 -14.5 6 2\n0 0 1 0\n1 0 0\n0\n\n0\n\n" +
           patches("3", 3, kGoodPatch).substr(patches("3", 1, kGoodPatch).size()),
       3, ""},
      {"word_only", "PATCHES", 0, "ends"},
      {"no_count", "PATCHES\n", 0, "ends"},
      {"count_word", patches("three", 3, kGoodPatch), 0, "line 2"},
      {"count_negative", patches("-3", 3, kGoodPatch), 0, "line 2"},
      {"count_half", patches("2.5", 3, kGoodPatch), 0, "line 2"},
      {"count_nan", patches("nan", 3, kGoodPatch), 0, "line 2"},
      {"none", patches("0", 0, kGoodPatch), 0, "no points"},
      {"too_many", patches("99999999999", 3, kGoodPatch), 0, "line 2"},
      {"many", patches("2147483647", 3, kGoodPatch), 0, ""},
      {"too_few", patches("4", 3, kGoodPatch), 0, "PATCHS"},
      {"more", patches("2", 3, kGoodPatch), 0, "more patches"},
      {"no_scale", patches("3", 3, kGoodPatch).replace(patches("3", 0, "").size() + 7 + 28, 1, "0"),
       0, "without a scale"},
      {"photos_negative", bad("0 0 1 0\n1 0 0\n-1\n"), 0, "line 7"},
      {"photos_many", bad("0 0 1 0\n1 0 0\n99999999\n"), 0, "line 7"},
      {"photos_too_few", bad("0 0 1 0\n1 0 0\n3\n0 1\n0\n"), 0, ""},
      {"photo_word", bad("0 0 1 0\n1 0 0\n1\nfirst\n0\n"), 0, "line 8"}};
}

std::vector<CorpusFile> malformedXyz() {
  const std::string rows = asciiRows(3);
  return {{"legal", rows, 3, ""},
          {"legal_comments", "# x y z\n// by hand\n" + rows, 3, ""},
          {"legal_names", "X Y Z\n" + rows, 3, ""},
          {"legal_count", "3\n" + rows, 3, ""},
          {"count_wrong", "4\n" + rows, 0, "announces"},
          {"names_twice", "X Y Z\nX Y Z\n" + rows, 0, "line 2"},
          {"names_late", rows + "X Y Z\n", 0, "line 4"},
          {"two_columns", "1 2\n3 4\n", 0, "fewer than 3"},
          {"uneven", rows + "1 2 3 4\n", 0, "line 4"},
          {"short_row", rows + "1 2\n", 0, "line 4"},
          {"no_number", rows + "1 2 3m\n", 0, "line 4"},
          {"too_large", rows + "1 2 1e999\n", 0, "line 4"},
          {"comments_only", "# nothing\n", 0, "no points"},
          {"binary", std::string("1 2 3\n\0\xff\n", 9), 0, "line 2"}};
}

}  // namespace storey::test
