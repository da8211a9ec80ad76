// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <tuple>
#include <type_traits>

#include "io/label_names.h"
#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::io {
namespace {

std::size_t maxCorners(const PolygonSoup& soup) {
  std::size_t most = 0;
  for (const auto& polygon : soup.polygons) most = std::max(most, polygon.corners.size());
  return most;
}

void writeTriple(OutputFile& file, const Eigen::Vector3d& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) file.write(" ");
    file.writeNumber(v[axis]);
  }
  file.write("\n");
}

std::string plyHeader(const PolygonSoup& soup, const char* format, const char* count_type) {
  const bool fitted = !soup.deviations.empty();
  return std::string("ply\nformat ") + format +
         " 1.0\n"
         "comment made by storey, in the coordinates of the input cloud\n"
         "comment label: 0 wall, 1 roof, 2 ground, 3 ceiling, 4 window, 5 reveal\n" +
         (soup.crs.empty() ? "" : "comment storey crs " + soup.crs + "\n") + "element vertex " +
         std::to_string(soup.vertices.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\n" +
         (fitted ? "property float deviation\n" : "") + "element face " +
         std::to_string(soup.polygons.size()) + "\nproperty list " + count_type +
         " int vertex_indices\n"
         "property uchar label\nproperty int wall\nproperty int shell\n"
         "property uchar hypothetical\n" +
         (fitted ? "property int support\nproperty float coverage\nproperty float residual\n"
                   "property float deviation\n"
                 : "") +
         "end_header\n";
}

// The same numbers as text or as bytes.
class PlyValues {
 public:
  PlyValues(OutputFile& file, bool ascii) : file_(file), ascii_(ascii) {}

  template <typename T>
  void put(T value) {
    if (!ascii_) {
      file_.write(&value, sizeof value);  // the host is little-endian
      return;
    }
    if (!first_) file_.write(" ");
    first_ = false;
    if constexpr (std::is_floating_point_v<T>) {
      file_.writeNumber(value);
    } else {
      file_.writeNumber(static_cast<long long>(value));
    }
  }

  void endRow() {
    if (ascii_) file_.write("\n");
    first_ = true;
  }

 private:
  OutputFile& file_;
  bool ascii_;
  bool first_ = true;
};

void putFace(PlyValues& values, const PolygonSoup::Polygon& polygon, bool wide, bool fitted) {
  if (wide) {
    values.put(static_cast<std::uint32_t>(polygon.corners.size()));
  } else {
    values.put(static_cast<std::uint8_t>(polygon.corners.size()));
  }
  for (const int corner : polygon.corners) values.put(corner);
  values.put(polygon.label);
  values.put(static_cast<std::int32_t>(polygon.wall));
  values.put(static_cast<std::int32_t>(polygon.shell));
  values.put(static_cast<std::uint8_t>(polygon.hypothetical));
  if (fitted) {
    values.put(static_cast<std::int32_t>(polygon.support));
    values.put(static_cast<float>(polygon.coverage));
    values.put(static_cast<float>(polygon.residual));
    values.put(static_cast<float>(polygon.deviation));
  }
  values.endRow();
}

void writeObjFaces(OutputFile& file, const PolygonSoup& soup, bool materials) {
  const auto key = [&soup](std::size_t i) {
    const auto& polygon = soup.polygons[i];
    return std::make_tuple(polygon.shell, polygon.label, polygon.hypothetical);
  };
  std::vector<std::size_t> order(soup.polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& polygon = soup.polygons[order[k]];
    const bool first = k == 0;
    if (first || polygon.shell != soup.polygons[order[k - 1]].shell) {
      file.write("o shell_" + std::to_string(polygon.shell) + "\n");
    }
    if (first || key(order[k]) != key(order[k - 1])) {
      const std::string label = labelName(polygon.label);
      file.write("g " + label + (polygon.hypothetical ? " hypothetical\n" : "\n"));
      if (materials) {
        file.write("usemtl " + label + (polygon.hypothetical ? "_hypothetical\n" : "\n"));
      }
    }
    file.write("f");
    for (const int corner : polygon.corners) {
      file.write(" ");
      file.writeNumber(static_cast<long long>(corner) + 1);
    }
    file.write("\n");
  }
}

}  // namespace

void writePolygonsPly(const std::string& path, const PolygonSoup& soup,
                      const Eigen::Isometry3d& local_to_input, PlyEncoding encoding) {
  OutputFile file(path);
  const bool ascii = encoding == PlyEncoding::Ascii;
  const bool wide = maxCorners(soup) > 255;
  file.write(plyHeader(soup, ascii ? "ascii" : "binary_little_endian", wide ? "uint" : "uchar"));
  PlyValues values(file, ascii);
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    const Eigen::Vector3d v = local_to_input * soup.vertices[i];
    for (int axis = 0; axis < 3; ++axis) values.put(v[axis]);
    if (!soup.deviations.empty()) values.put(static_cast<float>(soup.deviations[i]));
    values.endRow();
  }
  for (const auto& polygon : soup.polygons) {
    putFace(values, polygon, wide, !soup.deviations.empty());
  }
  file.commit();
}

void writePolygonsObj(const std::string& path, const PolygonSoup& soup,
                      const Eigen::Isometry3d& local_to_input, const std::string& materials) {
  OutputFile file(path);
  file.write("# made by storey, in the coordinates of the input cloud\n");
  if (!soup.crs.empty()) file.write("# storey crs " + soup.crs + "\n");
  if (!materials.empty()) file.write("mtllib " + materials + "\n");
  for (const Eigen::Vector3d& vertex : soup.vertices) {
    file.write("v ");
    writeTriple(file, local_to_input * vertex);
  }
  writeObjFaces(file, soup, !materials.empty());
  file.commit();
}

}  // namespace storey::io
