// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/cameras/camera_set.h"

namespace storey::windows {

/// A model read from a file, ready to be cut, in an upright frame of its own.
struct SolidModel {
  PolyhedralModel model;
  Eigen::Isometry3d to_file = Eigen::Isometry3d::Identity();
  std::string crs;  ///< of the file; empty: not known
};

/// \throws io::Failure (BadInput) if the file's polygons are no valid solid
SolidModel readSolid(const std::string& path);

/// The photo of that name, with or without folders and extension, or of that number in the file of
/// cameras. \throws io::Failure (BadInput), naming `path`, if there is none or several
std::size_t findView(const std::string& path, const io::CameraSet& cameras,
                     const std::string& name);

/// Four corners from "x1,y1,...,x4,y4"; nothing if it is not that.
std::optional<std::array<Eigen::Vector2d, 4>> parseQuad(const std::string& text);

/// Windows found, and which of them were cut.
struct CutWindows {
  WindowGrid grid;
  double depth = 0.0;  ///< that they were cut to
  std::vector<bool> cut;
};

/// Finds windows and cuts those that are not doubtful.
/// \param depth of the panes; nothing: what the photos show
CutWindows addWindows(const std::vector<FacadePhoto>& photos, const WindowMark& mark,
                      const std::optional<double>& depth, SolidModel& solid);

}  // namespace storey::windows
