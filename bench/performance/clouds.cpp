// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/clouds.h"

#include "synth/cloud_writer.h"
#include "synth/outlines.h"
#include "synth/random.h"
#include "synth/sampling.h"

namespace storey::bench {
namespace {

constexpr double kPitch = 6.0;  // of teeth and of gaps: 60 deviations of the noise
constexpr double kHeight = kToothArea / kPitch;

// One long side from x = 0 to the given length: how far each tooth and each gap is from the middle.
synth::Outline side(std::size_t teeth, double length, synth::Random& random) {
  synth::Outline outline;
  double begin = 0.0;
  for (std::size_t i = 0; i < 2 * teeth; ++i) {
    const bool last = i + 1 == 2 * teeth;
    const double end =
        last ? length : kPitch * (static_cast<double>(i + 1) + random.uniform(-0.2, 0.2));
    const double depth = i % 2 == 0 ? random.uniform(16.0, 20.0) : random.uniform(8.0, 12.0);
    outline.emplace_back(begin, depth);
    outline.emplace_back(end, depth);
    begin = end;
  }
  return outline;
}

}  // namespace

// A tooth is four walls: up, along its top, down, and along the gap; the ends of the block stand in
// for the last gap's ends.
std::vector<FloorplanLayer> toothedBlock(std::size_t walls) {
  synth::Random random(walls);
  const std::size_t teeth = walls / 8;  // of a side
  const double length = kPitch * static_cast<double>(2 * teeth);
  synth::Outline outline;
  for (const Eigen::Vector2d& corner : side(teeth, length, random)) {
    outline.emplace_back(corner.x(), -corner.y());
  }
  for (const Eigen::Vector2d& corner : side(teeth, length, random)) {
    outline.emplace_back(length - corner.x(), corner.y());
  }
  return synth::stackStages({{kHeight, {{outline, {}}}}});
}

void writeCloud(const std::string& path, const std::vector<FloorplanLayer>& building,
                std::size_t points, synth::SampledFaces faces) {
  synth::SamplingOptions sampling;
  sampling.points = points;
  sampling.faces = faces;
  synth::writeCloudPly(path, synth::sampleBuilding(building, sampling), false, true);
}

}  // namespace storey::bench
