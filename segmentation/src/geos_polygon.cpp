// SPDX-License-Identifier: BSD-3-Clause
#include "geos_polygon.h"

namespace storey::detail {

GeosGeometry makeLine(const GeosContext& context, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context.get(), 2, 2);
  if (sequence == nullptr) return own(context, nullptr);
  GEOSCoordSeq_setXY_r(context.get(), sequence, 0, from.x(), from.y());
  GEOSCoordSeq_setXY_r(context.get(), sequence, 1, to.x(), to.y());
  return own(context, GEOSGeom_createLineString_r(context.get(), sequence));
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
