// SPDX-License-Identifier: BSD-3-Clause
#include "io/polygon_builder.h"

#include <algorithm>
#include <cmath>

#include "io/limits.h"
#include "io/model_io.h"

namespace storey::io {
namespace {

std::size_t countDistinct(std::vector<int> corners) {
  std::sort(corners.begin(), corners.end());
  return static_cast<std::size_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
}

}  // namespace

void PolygonBuilder::addVertex(double x, double y, double z) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    fail("a vertex is not finite");
  }
  if (soup_.vertices.size() == kMaxPoints) fail("too many vertices");
  soup_.vertices.emplace_back(x, y, z);
}

void PolygonBuilder::addPolygon(const std::vector<std::int64_t>& corners,
                                PolygonSoup::Polygon polygon) {
  for (const std::int64_t corner : corners) {
    if (corner < 0 || corner >= static_cast<std::int64_t>(kMaxPoints)) {
      fail("a face has the corner " + std::to_string(corner) + ", counted from 0");
    }
    polygon.corners.push_back(static_cast<int>(corner));
  }
  if (countDistinct(polygon.corners) < 3) fail("a face has fewer than 3 distinct corners");
  soup_.polygons.push_back(std::move(polygon));
}

PolygonSoup PolygonBuilder::finish() {
  if (soup_.polygons.empty()) file_.fail("has no faces", "name a polygon mesh");
  for (const auto& polygon : soup_.polygons) {
    const int last = *std::max_element(polygon.corners.begin(), polygon.corners.end());
    if (static_cast<std::size_t>(last) >= soup_.vertices.size()) {
      file_.fail("a face has the corner " + std::to_string(last) + ", counted from 0, of " +
                 std::to_string(soup_.vertices.size()) + " vertices");
    }
  }
  return std::move(soup_);
}

void PolygonBuilder::fail(const std::string& reason) const {
  if (by_line_) file_.failAtLine(reason);
  file_.failAtByte(reason);
}

PolygonSoup readPolygons(const std::string& path, const PolygonReaderOptions& options) {
  InputFile file(path, options.max_bytes);
  const std::string_view start = file.peek(5);
  const bool is_ply = start.substr(0, 4) == "ply\n" || start == "ply\r\n";
  return is_ply ? readPlyPolygons(file, options.max_memory)
                : readObjPolygons(file, options.max_memory);
}

}  // namespace storey::io
