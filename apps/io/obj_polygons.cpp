// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string_view>

#include "io/failure.h"
#include "io/label_names.h"
#include "io/limits.h"
#include "io/point_records.h"
#include "io/polygon_builder.h"
#include "io/scan.h"

namespace storey::io {
namespace {

using Words = std::vector<std::string_view>;

// "v 0 0 0" makes 24 bytes of 8, "f 1 2 3" some 100 bytes.
constexpr std::uint64_t kMemoryPerFileByte = 16;

// Statements without a bearing on the polygons. A material library among them is never opened.
constexpr std::string_view kPassedOver[] = {"vn",     "vt", "vp", "s", "usemtl",
                                            "mtllib", "l",  "p",  "mg"};

class ObjReader {
 public:
  explicit ObjReader(InputFile& file) : file_(file), builder_(file, true) {}

  PolygonSoup read() {
    std::string_view line;
    while (file_.nextBodyLine(line)) {
      const Words words = splitWords(line);
      if (words.empty()) continue;
      if (words[0][0] == '#') {
        if (auto note = noteOf(line.substr(line.find('#') + 1))) builder_.addNote(*note);
        continue;
      }
      statement(words);
    }
    return builder_.finish();
  }

 private:
  void statement(const Words& words) {
    if (words[0] == "v") {
      vertex(words);
    } else if (words[0] == "f") {
      face(words);
    } else if (words[0] == "o") {
      ++shell_;
    } else if (words[0] == "g") {
      attributes_.label = words.size() > 1 ? labelOf(words[1]) : std::uint8_t{0};
      attributes_.hypothetical =
          std::find(words.begin(), words.end(), "hypothetical") != words.end();
    } else if (std::find(std::begin(kPassedOver), std::end(kPassedOver), words[0]) ==
               std::end(kPassedOver)) {
      file_.failAtLine("'" + printable(std::string(words[0]), 40) + "' is no statement of a mesh",
                       "name a PLY or OBJ mesh");
    }
  }

  void vertex(const Words& words) {
    // A weight or a colour may follow the coordinates.
    double v[3];
    bool valid = words.size() >= 4 && words.size() <= 8;
    for (std::size_t i = 0; valid && i < 3; ++i) valid = parseNumber(words[i + 1], v[i]);
    if (!valid) file_.failAtLine("is not a vertex: three numbers expected");
    builder_.addVertex(v[0], v[1], v[2]);
  }

  void face(const Words& words) {
    std::vector<std::int64_t> corners;
    for (std::size_t i = 1; i < words.size(); ++i) corners.push_back(corner(words[i]));
    PolygonSoup::Polygon polygon = attributes_;
    polygon.shell = std::max(shell_, 0);
    builder_.addPolygon(corners, std::move(polygon));
  }

  /// "7", "7/1", "7//3", "7/1/3"; negative numbers count back from the last vertex.
  std::int64_t corner(std::string_view word) {
    const std::string_view number = word.substr(0, word.find('/'));
    const bool backwards = !number.empty() && number[0] == '-';
    std::uint64_t value = 0;
    if (!parseUnsigned(number.substr(backwards ? 1 : 0), value) || value == 0 ||
        value > kMaxPoints || (backwards && value > builder_.numVertices())) {
      file_.failAtLine("'" + printable(std::string(word), 40) + "' is not a corner of a face");
    }
    const auto index = static_cast<std::int64_t>(value);
    return backwards ? static_cast<std::int64_t>(builder_.numVertices()) - index : index - 1;
  }

  InputFile& file_;
  PolygonBuilder builder_;
  PolygonSoup::Polygon attributes_;
  int shell_ = -1;  // before the first object
};

}  // namespace

PolygonSoup readObjPolygons(InputFile& file, std::uint64_t max_memory) {
  file.checkMemory(file.size() * kMemoryPerFileByte, max_memory, "its polygons");
  return ObjReader(file).read();
}

}  // namespace storey::io
