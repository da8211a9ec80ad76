// SPDX-License-Identifier: BSD-3-Clause
#include "geos_polygon.h"

namespace storey::detail {

GeosGeometry makeLinearRing(const GeosContext& context,
                            const std::vector<Eigen::Vector2d>& vertices) {
  const auto n = static_cast<unsigned>(vertices.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context.get(), n + 1, 2);
  if (sequence == nullptr) return own(context, nullptr);
  for (unsigned i = 0; i <= n; ++i) {
    const Eigen::Vector2d& v = vertices[i % n];
    GEOSCoordSeq_setXY_r(context.get(), sequence, i, v.x(), v.y());
  }
  return own(context, GEOSGeom_createLinearRing_r(context.get(), sequence));
}

std::vector<Eigen::Vector2d> ringVertices(const GeosContext& context, const GEOSGeometry* ring) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context.get(), ring);
  unsigned size = 0;
  std::vector<Eigen::Vector2d> vertices;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(context.get(), sequence, &size) == 0) return {};
  for (unsigned i = 0; i + 1 < size; ++i) {
    double x = 0.0;
    double y = 0.0;
    GEOSCoordSeq_getXY_r(context.get(), sequence, i, &x, &y);
    vertices.emplace_back(x, y);
  }
  return vertices;
}

}  // namespace storey::detail
