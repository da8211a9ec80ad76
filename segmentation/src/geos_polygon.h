// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geos_c.h>
#include <storey/segmentation/floorplan.h>

#include <memory>
#include <vector>

namespace storey::detail {

/// One GEOS context: reentrant, and silent (what fails returns null and is handled).
class GeosContext {
 public:
  GeosContext() : handle_(GEOS_init_r()) {}
  ~GeosContext() { GEOS_finish_r(handle_); }
  GeosContext(const GeosContext&) = delete;
  GeosContext& operator=(const GeosContext&) = delete;

  GEOSContextHandle_t get() const { return handle_; }

 private:
  GEOSContextHandle_t handle_;
};

struct GeosGeometryDeleter {
  GEOSContextHandle_t handle;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
};
using GeosGeometry = std::unique_ptr<GEOSGeometry, GeosGeometryDeleter>;

inline GeosGeometry own(const GeosContext& context, GEOSGeometry* geometry) {
  return {geometry, GeosGeometryDeleter{context.get()}};
}

/// A line of two points; null if it cannot be one.
GeosGeometry makeLine(const GeosContext& context, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to);

/// Vertices of a linear ring, the closing one left out.
std::vector<Eigen::Vector2d> ringVertices(const GeosContext& context, const GEOSGeometry* ring);

}  // namespace storey::detail
