// SPDX-License-Identifier: BSD-3-Clause
#include "stages/parts.h"

#include "io/line_of_sight.h"
#include "io/raw_cloud.h"

namespace storey::stages {
namespace {

constexpr std::uint64_t kPartPoints = 500000;

// As the reader and the first stage leave them.
Cloud toFrame(const io::RawCloud& raw, const Eigen::Vector3d& offset, const StageState& state,
              unsigned int threads) {
  const Eigen::Isometry3d to_frame = state.frame_to_input.inverse() * Eigen::Translation3d(offset);
  const double side = state.inside ? -1.0 : 1.0;
  Cloud part = std::move(*io::distinctPoints(raw, offset, threads).cloud);
  std::size_t kept = 0;
  for (const Point& p : part) {
    const Eigen::Vector3f normal = p.getNormalVector3fMap();
    if (normal.isZero(0.0f)) continue;
    Point& to = part[kept++];
    to.getVector3fMap() = (to_frame * p.getVector3fMap().cast<double>()).cast<float>();
    to.getNormalVector3fMap() = (side * to_frame.linear() * normal.cast<double>()).cast<float>();
  }
  part.resize(kept);
  return part;
}

bool comesInParts(const std::string& format) {
  return format.rfind("ply", 0) == 0 || format.rfind("pcd", 0) == 0;
}

}  // namespace

PartSource partsOf(const io::LoadedCloud& loaded, const StageCloud& cloud,
                   const AttitudeOptions& options, unsigned int threads) {
  const bool as_in_file =
      loaded.has_normals && !options.estimate_normals && !options.sensor.allFinite();
  if (loaded.thinned_out == 0 || !as_in_file || !comesInParts(loaded.format) ||
      io::hasVisibility(cloud.name)) {
    return {};
  }
  return [name = cloud.name, offset = loaded.offset, state = cloud.state,
          threads](const PartVisitor& visit) {
    const auto take = [&](const io::RawCloud& raw) { visit(toFrame(raw, offset, state, threads)); };
    io::ReadLimits limits;
    limits.max_points = kPartPoints;
    limits.take_part = take;
    io::InputFile file(name, io::kDefaultMaxFileBytes);
    const io::RawCloud rest = io::readRawCloud(file, limits);
    if (rest.size() > 0) take(rest);
  };
}

}  // namespace storey::stages
