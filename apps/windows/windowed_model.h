// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/cameras/camera_set.h"
#include "windows/window_edit.h"

namespace storey::windows {

/// A model read from a file, ready to be cut, in an upright frame of its own.
struct SolidModel {
  PolyhedralModel model;
  Eigen::Isometry3d to_file = Eigen::Isometry3d::Identity();
};

/// \throws io::Failure (BadInput) if the file's polygons are no valid solid
SolidModel readSolid(const std::string& path);

/// The photo of that name, with or without folders and extension, or of that number in the file of
/// cameras. \throws io::Failure (BadInput), naming `path`, if there is none or several
std::size_t findView(const std::string& path, const io::CameraSet& cameras,
                     const std::string& name);

/// Four corners from "x1,y1,...,x4,y4"; nothing if it is not that.
std::optional<std::array<Eigen::Vector2d, 4>> parseQuad(const std::string& text);

/// The facades of a model and what its photos show of them, to find windows on.
class WindowSearch {
 public:
  /// \param cameras_path of the file that `cameras` are from, for messages
  WindowSearch(const SolidModel& solid, std::string cameras_path, const io::CameraSet& cameras,
               const std::vector<FacadePhoto>& photos);

  /// What is found by a mark or without one, changes left aside.
  /// \throws io::Failure (BadInput) if there is no such view; what else is wrong is the `problem`
  WindowGrid find(const FacadeEdit& facade) const;

  /// Each wall on which windows repeat, as it is found without a mark.
  std::vector<std::pair<FacadeEdit, WindowGrid>> findAll() const;

  /// Photos and cameras in the frame that the facades are in.
  const Camera& camera(std::size_t photo) const { return cameras_in_frame_[photo]; }

 private:
  std::string cameras_path_;
  const io::CameraSet& cameras_;
  std::vector<Camera> cameras_in_frame_;
  std::unique_ptr<WindowDetection> detection_;
};

/// A grid with the changes made: windows moved, left out, or no longer doubtful.
/// \throws std::invalid_argument if one is of a window that there is not
WindowGrid changed(WindowGrid grid, const std::vector<WindowChange>& changes);

/// Windows found, and which of them were cut.
struct CutWindows {
  WindowGrid grid;
  double depth = 0.0;  ///< that they were cut to
  std::vector<bool> cut;
};

/// Cuts the windows that are not doubtful into the model.
/// \param depth of the panes; nothing: what the photos show
CutWindows cutInto(SolidModel& solid, WindowGrid grid, const std::optional<double>& depth);

}  // namespace storey::windows
