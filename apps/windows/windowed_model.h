// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>
#include <storey/surface/window_detection.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/cameras/camera_set.h"
#include "windows/found_facade.h"

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

/// By what name `findView` finds a photo.
std::string viewName(const io::Photo& photo);

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
  std::vector<FoundFacade> findAll() const;

  /// What is found for each facade of an edit.
  /// \param path of what the edit is from, for messages
  /// \throws io::Failure (BadInput) if there is nothing, or not what is to be changed
  std::vector<FoundFacade> findEach(const std::string& path, const WindowEdit& edit) const;

  /// In the frame that the facades are in.
  const Camera& camera(std::size_t photo) const { return cameras_in_frame_[photo]; }

 private:
  std::string cameras_path_;
  const io::CameraSet& cameras_;
  std::vector<Camera> cameras_in_frame_;
  std::unique_ptr<WindowDetection> detection_;
};

/// Windows found, and which of them were cut.
struct CutWindows {
  WindowGrid grid;
  double depth = 0.0;  ///< that they were cut to
  std::vector<bool> cut;
};

/// Cuts the windows of a facade, as they are after its changes, into the model, but for those that
/// are doubtful still.
CutWindows cutInto(SolidModel& solid, const FoundFacade& facade);

}  // namespace storey::windows
