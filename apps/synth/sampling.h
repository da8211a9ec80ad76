// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "synth/buildings.h"
#include "synth/defects.h"
#include "synth/surface_sampler.h"

namespace storey::synth {

/// Where a building stands in the coordinates of the files: x -> offset + scale R x, with R a turn
/// by `yaw` about the vertical, then a tilt by `tilt` about a horizontal axis at `tilt_azimuth`.
struct Pose {
  double yaw = 0.0;           ///< rad
  double tilt = 0.0;          ///< rad
  double tilt_azimuth = 0.5;  ///< rad
  double scale = 1.0;         ///< > 0
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Matrix3d rotation() const;
  Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
};

/// How a cloud is made of a building: the paper's protocol [Sui et al. 2016, Sec. 6.1], and what
/// may be wrong with it.
struct SamplingOptions {
  std::size_t points = 200000;  ///< drawn on the whole building, before anything is missing
  double noise = 0.1;           ///< standard deviation of each coordinate
  double normal_noise = 15.0 * M_PI / 180.0;  ///< standard deviation of the normals' angle, rad
  SampledFaces faces = SampledFaces::Walls;
  Defects defects;
  Pose pose;
  std::uint64_t seed = 1;
};

enum class PointSource : std::uint8_t { Building, Outlier, Ground, Tree };

/// A cloud in the coordinates of its pose. All three vectors are equally long.
struct SyntheticCloud {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;  ///< unit length
  std::vector<PointSource> sources;

  std::size_t size() const { return positions.size(); }
};

/// Points drawn uniformly by area on the faces of the building, displaced by N(0, noise) in each
/// coordinate; normals turned about a random axis at right angles to them by N(0, normal_noise).
/// Hidden points are left out, so that the density of what remains does not depend on them;
/// clutter comes on top. The order is random. Empty if the building is, or an option is out of
/// its range. The same options and seed give the same cloud; switching one defect on does not
/// change the other points.
SyntheticCloud sampleBuilding(const std::vector<FloorplanLayer>& layers,
                              const SamplingOptions& options);

}  // namespace storey::synth
