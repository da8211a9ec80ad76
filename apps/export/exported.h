// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Geometry>
#include <string>

namespace storey::exports {

/// What is written: a model in the cloud's local frame, and where that frame is.
struct Exported {
  const PolyhedralModel& model;
  Eigen::Isometry3d local_to_input = Eigen::Isometry3d::Identity();
  std::string crs = {};     ///< coordinate reference system of the input; empty: not known
  std::string report = {};  ///< what report.json holds, for report.html
};

}  // namespace storey::exports
