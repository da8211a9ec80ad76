// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>

namespace storey::io {

/// Adds a coordinate reference system to a GeoJSON collection, in the form of its first edition
/// (RFC 7946 knows longitude and latitude only), which GIS read. Nothing if `crs` is empty.
inline void addCrs(const std::string& crs, nlohmann::ordered_json& collection) {
  if (crs.empty()) return;
  collection["crs"] = {{"type", "name"}, {"properties", {{"name", crs}}}};
}

/// A 4 x 4 matrix by rows.
inline nlohmann::ordered_json matrixRows(const Eigen::Isometry3d& transform) {
  auto rows = nlohmann::ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d r = transform.matrix().row(row);
    rows.push_back({r[0], r[1], r[2], r[3]});
  }
  return rows;
}

}  // namespace storey::io
