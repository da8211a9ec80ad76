// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/agreement.h"

#include <storey/segmentation/detail/point_classes.h>

#include <cmath>
#include <vector>

#include "io/model_io.h"
#include "synth/polygon_mesh.h"
#include "synth/triangle_tree.h"

namespace storey::reconstruct {
namespace {

constexpr std::size_t kMaxSample = 200000;
constexpr double kReach = 3.0;  // noise deviations
constexpr int kWall = static_cast<int>(detail::PointClass::Wall);

}  // namespace

Agreement agreementWith(const Result& result) {
  const Cloud& cloud = *result.cloud.points;
  const std::vector<int>& classes = result.cloud.groups(stages::Class);
  std::vector<std::size_t> upright;
  Agreement agreement;
  for (const pcl::index_t index : planarPoints(result.cloud)) {
    const auto i = static_cast<std::size_t>(index);
    if (std::abs(cloud[i].normal_z) >= detail::kUprightNormalZ) continue;
    upright.push_back(i);
    agreement.building += classes[i] == kWall ? 1 : 0;
  }
  agreement.upright = upright.size();
  const std::size_t step = upright.size() / kMaxSample + 1;
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::size_t> of_building;
  for (std::size_t k = 0; k < upright.size(); k += step) {
    const Point& p = cloud[upright[k]];
    positions.push_back(result.model.upright * p.getVector3fMap().cast<double>());
    of_building.push_back(classes[upright[k]] == kWall ? 1U : 0U);
  }
  const synth::TriangleTree tree(synth::measurable(io::toPolygons(result.model.model)).triangles);
  const std::vector<double> distances =
      tree.distances(positions, kReach * result.cloud.state.noise);
  double near[2] = {0.0, 0.0};
  double all[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < distances.size(); ++k) {
    all[of_building[k]] += 1.0;
    if (std::isfinite(distances[k])) near[of_building[k]] += 1.0;
  }
  if (all[0] + all[1] > 0.0) agreement.explained = (near[0] + near[1]) / (all[0] + all[1]);
  if (all[1] > 0.0) agreement.explained_of_building = near[1] / all[1];
  return agreement;
}

}  // namespace storey::reconstruct
