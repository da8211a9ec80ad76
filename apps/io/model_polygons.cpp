// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <limits>

#include "io/failure.h"
#include "io/label_names.h"
#include "io/model_io.h"

namespace storey::io {

PolygonSoup toPolygons(const PolyhedralModel& model, const std::string& crs) {
  PolygonSoup soup;
  soup.crs = crs;
  soup.vertices = model.vertices;
  for (std::size_t v = 0; v < model.covariances.size(); ++v) {
    soup.deviations.push_back(model.vertexDeviation(v));
  }
  for (const PolyhedralFace& face : model.faces) {
    PolygonSoup::Polygon polygon;
    polygon.label = fileLabel(face);
    polygon.wall = face.wall;
    polygon.shell = face.shell;
    polygon.hypothetical = face.hypothetical;
    polygon.support = static_cast<int>(
        std::min(face.support, static_cast<std::size_t>(std::numeric_limits<int>::max())));
    polygon.coverage = face.coverage;
    polygon.residual = face.residual;
    polygon.deviation = face.deviation;
    if (face.inner.empty()) {
      polygon.corners = face.outer;
      soup.polygons.push_back(polygon);
      continue;
    }
    std::vector<std::vector<int>> pieces = splitHoles(model, face);
    if (pieces.empty()) {
      throw Failure(Internal, "", "a face of the model cannot be cut at its holes",
                    "please report it with the input");
    }
    for (std::vector<int>& piece : pieces) {
      polygon.corners = std::move(piece);
      soup.polygons.push_back(polygon);
    }
  }
  return soup;
}

}  // namespace storey::io
