// SPDX-License-Identifier: BSD-3-Clause
#include "stages/attitude.h"

#include <pcl/common/transforms.h>
#include <storey/features/normal_side.h>
#include <storey/features/outward_normal_orientation.h>
#include <storey/features/pca_normals.h>
#include <storey/filters/detail/wall_relief.h>
#include <storey/segmentation/detail/wall_input.h>

#include <algorithm>
#include <cmath>

#include "stages/sampling.h"

namespace storey::stages {
namespace {

// The vertical is taken as +z if it is not further off than its accuracy explains.
constexpr double kLevelDeviations = 4.0;
constexpr double kLevelFloor = 1e-4;  // rad, where the accuracy is not known
// A building must show its walls: normals of all directions alike have a share of 0.105 within 6
// degrees of level, and buildings seen from a drone 0.14 and more.
constexpr double kMinWallShare = 0.07;
constexpr double kMaxWallTilt = 0.61;  // sin(35 degrees) = 0.57; see GravitySlicing

const char* const kWallsHint =
    "storey needs a cloud that shows the walls, from the ground or a drone";

/// \return the share of the normals that were turned
double turnToSensor(Cloud& cloud, const Eigen::Vector3f& sensor) {
  std::size_t turned = 0;
  for (Point& p : cloud) {
    if (p.getNormalVector3fMap().dot(sensor - p.getVector3fMap()) >= 0.0f) continue;
    p.getNormalVector3fMap() *= -1.0f;
    ++turned;
  }
  return static_cast<double>(turned) / static_cast<double>(std::max<std::size_t>(cloud.size(), 1));
}

}  // namespace

std::string estimateMissingNormals(StageCloud& cloud, const AttitudeOptions& options,
                                   unsigned int threads, Attitude& found) {
  std::string line = "given";
  if (!cloud.has_normals || options.estimate_normals) {
    found.normals_k = estimateNormals(*cloud.points, 0, threads);
    cloud.has_normals = true;
    line = format("estimated from %d neighbours", found.normals_k);
  }
  if (options.sensor.allFinite()) {
    const Eigen::Vector3d sensor = cloud.state.frame_to_input.inverse() * options.sensor;
    const double turned = turnToSensor(*cloud.points, sensor.cast<float>());
    line += format(", %.0f %% of them turned to the sensor", 100.0 * turned);
  }
  return line;
}

std::string setUpright(StageCloud& cloud, const AttitudeOptions& options, unsigned int threads,
                       Attitude& found) {
  VerticalDirectionEstimation<Point> estimation;
  estimation.setInputCloud(samplePoints(cloud));
  estimation.setInitialUp(options.up);
  estimation.setNumberOfThreads(threads);
  if (!estimation.compute(found.up)) refuse(cloud, "the vertical cannot be found", "give --up");
  found.vertical = estimation.getQuality();
  const double tilt = std::acos(std::clamp(found.up.z(), -1.0, 1.0));
  found.level = tilt <= std::max(kLevelDeviations * found.vertical.deviation, kLevelFloor);
  if (found.level) {
    found.up = Eigen::Vector3d::UnitZ();
  } else {
    const Eigen::Quaterniond upright = estimation.getRotation();
    pcl::transformPointCloudWithNormals(*cloud.points, *cloud.points,
                                        Eigen::Affine3f(Eigen::Quaternionf(upright.cast<float>())));
    cloud.state.frame_to_input.rotate(upright.conjugate());
  }
  if (found.vertical.wall_share < kMinWallShare) {
    refuse(cloud,
           format("only %.1f %% of the normals are level, too few walls for a model",
                  100.0 * found.vertical.wall_share),
           kWallsHint);
  }
  return format("up = %.4f %.4f %.4f, %.3f deg off z%s, %.0f %% of the normals are level",
                found.up.x(), found.up.y(), found.up.z(), tilt * 180.0 / M_PI,
                found.level ? " (taken as z)" : "", 100.0 * found.vertical.wall_share);
}

std::string orientOutwards(StageCloud& cloud, const AttitudeOptions& options, unsigned int threads,
                           Attitude& found) {
  bool& inside = cloud.state.inside;
  if (found.normals_k > 0 && !options.sensor.allFinite()) {
    OutwardNormalOrientation<Point> orientation;
    orientation.setInputCloud(cloud.points);
    orientation.setNumberOfThreads(threads);
    orientation.orient(*cloud.points);
    inside = options.side == SpaceSide::Inside;
    found.side_reason = "normals estimated";
  } else {
    const NormalSideEvidence side =
        detectNormalSide(*samplePoints(cloud), Eigen::Vector3d::UnitZ());
    inside = options.side == SpaceSide::Inside ||
             (options.side == SpaceSide::Auto && side.side == NormalSide::Space);
    found.side_reason = format("outwardness %.2f", side.outwardness);
  }
  // Inside a space the normals of its walls point to its middle: turned, they point out of it.
  if (inside) {
    for (Point& p : *cloud.points) p.getNormalVector3fMap() *= -1.0f;
  }
  return format("%s (%s)", inside ? "a space seen from inside" : "a building seen from outside",
                found.side_reason.c_str());
}

std::string measureScale(StageCloud& cloud, double given_noise, unsigned int threads,
                         CloudScale& scale) {
  requireNormals(cloud);
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  const Cloud::ConstPtr sample = samplePoints(cloud);
  positions.reserve(sample->size());  // a list that grows takes its memory twice
  normals.reserve(sample->size());
  for (const Point& p : *sample) {
    if (std::abs(p.normal_z) < std::sin(kMaxWallTilt)) {
      positions.push_back(p.getVector3fMap());
      normals.push_back(p.getNormalVector3fMap());
    }
  }
  if (positions.empty()) refuse(cloud, "none of its normals is level: no walls", kWallsHint);
  scale = storey::detail::estimateCloudScale(positions, kDefaultScaleSeed, threads);
  if (given_noise > 0.0 && given_noise < storey::detail::kLeastWallNoise * scale.extent) {
    refuse(cloud, format("is too large for --noise %g", given_noise),
           format("give at least %.2g, a hundred-thousandth of its extent",
                  storey::detail::kLeastWallNoise * scale.extent));
  }
  scale.density *= static_cast<double>(cloud.points->size()) / static_cast<double>(sample->size());
  cloud.state.density = scale.density;
  cloud.state.noise = given_noise > 0.0
                          ? given_noise
                          : storey::detail::estimateWallNoise(positions, normals, scale.noise,
                                                              scale.extent, threads);
  return format("noise %.3g (walls %.3g), spacing %.3g, %.3g points per unit of wall, extent %.3g",
                scale.noise, cloud.state.noise, scale.spacing, scale.density, scale.extent);
}

void ensureScale(StageCloud& cloud) {
  if (cloud.state.noise > 0.0 && cloud.state.density > 0.0) return;
  CloudScale scale;
  measureScale(cloud, cloud.state.noise, 1, scale);
}

}  // namespace storey::stages
