// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/residuals.h"

#include <storey/surface/triangulation.h>

#include <vector>

#include "synth/triangle_tree.h"

namespace storey::reconstruct {
namespace {

constexpr std::size_t kMaxPoints = 50000;
constexpr std::size_t kBinsInNoise = 4;
constexpr std::size_t kNumBins = 6 * kBinsInNoise;

synth::TriangleMesh toTriangles(const PolyhedralModel& model) {
  synth::TriangleMesh mesh;
  mesh.vertices = model.vertices;
  for (const PolyhedralFace& face : model.faces) {
    const auto triangles = triangulateFace(model, face);
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  }
  return mesh;
}

}  // namespace

ResidualHistogram measureResiduals(const Result& result) {
  ResidualHistogram histogram;
  const stages::Cloud& cloud = *result.cloud.points;
  histogram.bin = result.cloud.state.noise / kBinsInNoise;
  histogram.counts.assign(kNumBins, 0);
  const synth::TriangleTree surface(toTriangles(result.model.model));
  const std::size_t step = (cloud.size() + kMaxPoints - 1) / kMaxPoints;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    positions.push_back(result.model.upright * cloud[i].getVector3fMap().cast<double>());
  }
  const double reach = histogram.bin * static_cast<double>(kNumBins);
  for (const double distance : surface.distances(positions, reach)) {
    ++histogram.points;
    const double bins = distance / histogram.bin;
    if (bins < static_cast<double>(kNumBins)) {
      ++histogram.counts[static_cast<std::size_t>(bins)];
    } else {
      ++histogram.beyond;
    }
  }
  return histogram;
}

}  // namespace storey::reconstruct
