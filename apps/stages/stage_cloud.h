// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace storey::stages {

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

/// What the stages found out so far that belongs to no single point. Zero or empty: not yet known.
struct StageState {
  /// Takes the points to the coordinates of the file that the first stage read.
  Eigen::Isometry3d frame_to_input = Eigen::Isometry3d::Identity();
  std::string crs;               ///< of the input's coordinates, as the user gave it
  bool inside = false;           ///< the points enclose a space and were seen from inside it
  double noise = 0.0;            ///< standard deviation of the points about their walls
  double density = 0.0;          ///< points per unit of wall area
  std::size_t sample_size = 0;   ///< of the points that show all of the structure
  float planar_threshold = 0.0;  ///< least confidence of a planar point
  std::vector<Eigen::Vector3d> directions;        ///< dominant ones, unit
  std::vector<std::pair<double, double>> slices;  ///< z_min, z_max of each, bottom to top
};

/// Groups that points can be in. In this order, the last one that a cloud has is its newest.
enum Group : std::size_t { Class, Slice, Direction, Region, Wall };
constexpr std::array<const char*, 5> kGroupNames = {"class", "slice", "direction", "region",
                                                    "wall"};

/// A cloud on its way through the stages: upright (+z is up), with outward normals.
struct StageCloud {
  std::string name;  ///< of its file, for messages
  Cloud::Ptr points = pcl::make_shared<Cloud>();
  bool has_normals = false;
  StageState state;
  pcl::Indices sample;  ///< places of the `state.sample_size` points, where they are at hand
  std::vector<float> confidences;  ///< planar confidence of each point, or none
  /// By `Group`: of each point, -1 none; or none.
  std::array<std::vector<int>, kGroupNames.size()> groups_of;

  const std::vector<int>& groups(Group group) const { return groups_of[group]; }
  std::vector<int>& groups(Group group) { return groups_of[group]; }
};

/// The points whose confidence reaches the threshold; all where it is not known.
pcl::Indices planarPoints(const StageCloud& cloud);

/// \throws io::Failure (BadInput) that names the cloud's file
[[noreturn]] void refuse(const StageCloud& cloud, const std::string& reason,
                         const std::string& hint);

/// Refuses a cloud whose points are in no such groups. \param program that finds them
void requireGroups(const StageCloud& cloud, Group group, const std::string& program);

/// Refuses a cloud without normals.
void requireNormals(const StageCloud& cloud);

/// printf to a string.
std::string format(const char* text, ...) __attribute__((format(printf, 1, 2)));

}  // namespace storey::stages
