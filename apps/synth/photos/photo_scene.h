// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/camera.h>
#include <storey/surface/facade.h>
#include <storey/surface/rgb_image.h>

#include <cstdint>
#include <vector>

#include "synth/photos/facade_paint.h"
#include "synth/photos/occluders.h"
#include "synth/triangle_tree.h"

namespace storey::synth {

/// How photos are taken of a building. Lengths are the building's.
struct PhotoOptions {
  int views = 24;              ///< on a circle around the building, low and high by turns
  int width = 1024;            ///< pixels; the height is three quarters of it
  double field_of_view = 1.1;  ///< rad, across
  double window_pitch = 3.0;   ///< from window to window
  double recess = 0.0;         ///< depth of the windows; 0: they are painted
  int occluders = 12;          ///< poles, trees and cars
  double exposure = 0.25;      ///< factors from 1 / (1 + exposure) to 1 + exposure
  double pixel_noise = 2.0;    ///< standard deviation, grey levels
  std::uint64_t seed = 1;
};

/// The painted building, its surroundings, and photos of it.
class PhotoScene {
 public:
  PhotoScene(const PolyhedralModel& model, const PhotoOptions& options);

  const std::vector<Facade>& facades() const { return facades_; }
  const std::vector<FacadeFrame>& frames() const { return frames_; }
  const std::vector<FacadePaint>& paints() const { return paints_; }

  std::vector<Camera> placeCameras() const;

  /// The k-th photo: 2 x 2 rays a pixel, exposed, with noise.
  RgbImage photograph(const Camera& camera, int k) const;

  /// Whether a camera sees a point of a facade: in its image, from the front, nothing in between.
  bool isClear(const Camera& camera, std::size_t facade, const Eigen::Vector3d& point) const;

  /// A facade seen at right angles, without occluders, exposure and noise, 3 x 3 samples a texel;
  /// rows from the top. Texels whose middle is outside of the facade are black.
  RgbImage orthoImage(std::size_t facade, double texel_size) const;

 private:
  Eigen::Vector3d colorAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;
  Eigen::Vector3d facadeColor(std::size_t facade, const Eigen::Vector3d& at,
                              const Eigen::Vector3d& direction) const;
  Eigen::Vector3d groundColor(const Eigen::Vector3d& at) const;

  PhotoOptions options_;
  Eigen::AlignedBox3d box_;
  std::vector<Facade> facades_;
  std::vector<FacadeFrame> frames_;
  std::vector<FacadeOutline> outlines_;
  std::vector<FacadePaint> paints_;
  std::vector<FacadePaint> ground_paint_;  // of one
  std::vector<std::size_t> facade_of_;     // of each triangle
  TriangleTree tree_;
  Occluders occluders_;
};

}  // namespace storey::synth
