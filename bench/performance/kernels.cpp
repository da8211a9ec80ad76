// SPDX-License-Identifier: BSD-3-Clause
// storey_kernels FOLDER: the inner parts one by one, by Google Benchmark, on one thread.
#include <benchmark/benchmark.h>
#include <storey/filters/detail/distinct_positions.h>
#include <storey/filters/detail/neighbor_search.h>
#include <storey/filters/detail/planar_confidence.h>
#include <storey/segmentation/max_flow.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/floorplan_fitting.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "bench/performance/clouds.h"
#include "bench/performance/kernel_table.h"
#include "io/cloud_reader.h"
#include "synth/buildings.h"
#include "synth/random.h"
#include "synth/sampling.h"

namespace storey::bench {
namespace {

constexpr std::size_t kPoints = 100000;
constexpr std::size_t kNeighbors = 30;

const char* const kText = R"(## Kernels

By Google Benchmark, CPU time of one thread.

)";

const synth::SyntheticCloud& cloud() {
  static const synth::SyntheticCloud kCloud = [] {
    synth::SamplingOptions sampling;
    sampling.points = kPoints;
    return synth::sampleBuilding(synth::makeBuilding("syn1").layers, sampling);
  }();
  return kCloud;
}

std::vector<Eigen::Vector3f> positions() {
  std::vector<Eigen::Vector3f> result;
  for (const Eigen::Vector3d& p : cloud().positions) result.push_back(p.cast<float>());
  return result;
}

void count(benchmark::State& state, std::size_t items, const char* what) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(items));
  state.SetLabel(what);
}

void mortonOrder(benchmark::State& state) {
  const std::vector<Eigen::Vector3f> input = positions();
  for (auto _ : state) benchmark::DoNotOptimize(detail::findDistinctPositions(input));
  count(state, input.size(), "points");
}

void neighborSearch(benchmark::State& state) {
  const detail::DistinctPositions distinct = detail::findDistinctPositions(positions());
  const detail::NeighborSearch search(distinct.cloud);
  const std::vector<char> wanted(distinct.cloud->size(), 1);
  for (auto _ : state) {
    search.forEachMoments(kNeighbors, wanted, 1, [](const detail::MomentBatch& batch) {
      benchmark::DoNotOptimize(batch.ids);
    });
  }
  count(state, wanted.size(), "points");
}

void planarConfidence(benchmark::State& state) {
  const detail::DistinctPositions distinct = detail::findDistinctPositions(positions());
  std::vector<detail::MomentBatch> batches;
  detail::NeighborSearch(distinct.cloud)
      .forEachMoments(kNeighbors, std::vector<char>(distinct.cloud->size(), 1), 1,
                      [&](const detail::MomentBatch& batch) { batches.push_back(batch); });
  for (auto _ : state) {
    for (const detail::MomentBatch& batch : batches) {
      benchmark::DoNotOptimize(detail::planarConfidences(batch));
    }
  }
  count(state, distinct.cloud->size(), "neighbourhoods");
}

// A grid of four neighbours, its terminals and edges at random.
void maxFlow(benchmark::State& state) {
  constexpr std::size_t kSide = 200;
  for (auto _ : state) {
    synth::Random random(1);
    MaxFlow graph(kSide * kSide);
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
      graph.addTerminalCapacities(i, random.below(100), random.below(100));
      if (i % kSide > 0) graph.addEdge(i - 1, i, random.below(60), random.below(60));
      if (i >= kSide) graph.addEdge(i - kSide, i, random.below(60), random.below(60));
    }
    benchmark::DoNotOptimize(graph.solve());
  }
  count(state, kSide * kSide, "nodes");
}

void wallFit(benchmark::State& state) {
  FitPoints points;
  points.positions = positions();
  for (const Eigen::Vector3d& n : cloud().normals) points.normals.push_back(n.cast<float>());
  FitOptions options;
  options.noise = synth::SamplingOptions().noise;
  options.max_shift = 10.0 * options.noise;
  for (auto _ : state) {
    std::vector<FloorplanLayer> layers = synth::makeBuilding("syn1").layers;
    benchmark::DoNotOptimize(fitWalls(layers, points, options));
  }
  count(state, points.positions.size(), "points");
}

void triangulation(benchmark::State& state) {
  const PolyhedralModel model = extrudeFloorplans(toothedBlock(504));
  const PolyhedralFace& largest = *std::max_element(
      model.faces.begin(), model.faces.end(),
      [](const auto& a, const auto& b) { return a.outer.size() < b.outer.size(); });
  for (auto _ : state) benchmark::DoNotOptimize(triangulateFace(model, largest));
  count(state, largest.outer.size(), "corners of one polygon");
}

void reading(benchmark::State& state, const std::string& path) {
  for (auto _ : state) benchmark::DoNotOptimize(io::readCloud(path));
  count(state, kPoints, "points");
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: storey_kernels FOLDER [options of Google Benchmark]\n");
    return 2;
  }
  const std::string path = std::string(argv[1]) + "/kernels.ply";
  writeCloud(path, synth::makeBuilding("syn1").layers, kPoints);
  benchmark::RegisterBenchmark("Morton order", mortonOrder);
  benchmark::RegisterBenchmark("30 nearest neighbours", neighborSearch);
  benchmark::RegisterBenchmark("planar confidence from moments", planarConfidence);
  benchmark::RegisterBenchmark("maximum flow", maxFlow);
  benchmark::RegisterBenchmark("wall fit", wallFit);
  benchmark::RegisterBenchmark("triangulation", triangulation);
  benchmark::RegisterBenchmark("reading binary PLY", reading, path);
  argv[1] = argv[0];
  --argc;
  benchmark::Initialize(&argc, ++argv);
  std::printf("%s", kText);
  KernelTable table;
  benchmark::RunSpecifiedBenchmarks(&table);
  std::remove(path.c_str());
  return 0;
}

}  // namespace
}  // namespace storey::bench

int main(int argc, char** argv) { return storey::bench::run(argc, argv); }
