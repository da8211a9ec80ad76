// SPDX-License-Identifier: BSD-3-Clause
#include "stages/parts.h"

#include "io/line_of_sight.h"
#include "io/raw_cloud.h"

namespace storey::stages {
namespace {

constexpr std::uint64_t kPartPoints = 500000;

// As the reader and the first stage leave them.
Cloud toFrame(const io::RawCloud& raw, const StageState& state) {
  const Eigen::Isometry3d to_frame = state.frame_to_input.inverse();
  const double side = state.inside ? -1.0 : 1.0;
  Cloud part;
  part.reserve(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Eigen::Vector3d position =
        to_frame * Eigen::Map<const Eigen::Vector3d>(&raw.positions[3 * i]);
    const Eigen::Vector3d normal =
        side * to_frame.linear() *
        Eigen::Map<const Eigen::Vector3f>(&raw.normals[3 * i]).cast<double>();
    const double length = normal.norm();
    if (!position.allFinite() || !(length > 0.0) || !std::isfinite(length)) continue;
    Point p;
    p.getVector3fMap() = position.cast<float>();
    p.getNormalVector3fMap() = (normal / length).cast<float>();
    part.push_back(p);
  }
  return part;
}

bool comesInParts(const std::string& format) {
  return format.rfind("ply", 0) == 0 || format.rfind("pcd", 0) == 0;
}

}  // namespace

PartSource partsOf(const io::LoadedCloud& loaded, const StageCloud& cloud,
                   const AttitudeOptions& options) {
  const bool as_in_file =
      loaded.has_normals && !options.estimate_normals && !options.sensor.allFinite();
  if (loaded.thinned_out == 0 || !as_in_file || !comesInParts(loaded.format) ||
      io::hasVisibility(cloud.name)) {
    return {};
  }
  return [name = cloud.name, state = cloud.state](const PartVisitor& visit) {
    const auto take = [&](const io::RawCloud& raw) { visit(toFrame(raw, state)); };
    io::ReadLimits limits;
    limits.max_points = kPartPoints;
    limits.take_part = take;
    io::InputFile file(name, io::kDefaultMaxFileBytes);
    const io::RawCloud rest = io::readRawCloud(file, limits);
    if (rest.size() > 0) take(rest);
  };
}

}  // namespace storey::stages
