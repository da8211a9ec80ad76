// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of every stage for clouds of rising size, beside PCL's and CGAL's algorithms and
// the floor of the machine in the same run; how they grow with slices and walls; real clouds.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "bench/performance/clouds.h"
#include "bench/performance/peers.h"
#include "bench/performance/real.h"
#include "bench/performance/results.h"
#include "bench/performance/slopes.h"
#include "bench/performance/stages.h"
#include "bench/performance/threads.h"
#include "cli/command_line.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "synth/buildings.h"

namespace storey::bench {
namespace {

// A peer is not run where, by its last size, it would take longer or more than half the machine.
constexpr double kPatience = 120.0;  // seconds of CPU
constexpr int kRuns = 3;             // of the program, where it is fast
constexpr std::size_t kFast = 1000000;
constexpr std::size_t kMostOfPaper = 1000000;  // points of the paper's chain with and without files

double halfTheMachine() {
  return 0.5 * static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGESIZE));
}

bool isBearable(const Results& results, const Peer& peer, std::size_t size) {
  std::size_t before = 0;
  for (const std::size_t smaller : results.sizes()) {
    if (smaller < size) before = smaller;
  }
  if (before == 0) return true;
  const Measured* last = results.find(peer.name, before);
  const double growth = static_cast<double>(size) / static_cast<double>(before);
  return last != nullptr && last->cpu * growth < kPatience &&
         last->bytes * growth < halfTheMachine();
}

// The peers see the points in random order, as they are in the file: our reader has ordered them.
std::vector<Measured> measurePeer(const std::string& path, const Peer& peer) {
  const auto loaded = io::readCloud(path);
  std::shuffle(loaded.cloud->begin(), loaded.cloud->end(), std::mt19937(1));
  Meter meter;
  peer.run(loaded.cloud);
  return {meter.lap(peer.name)};
}

void measurePeers(std::size_t size, const std::string& walls, const std::string& all_faces,
                  bool quick, Results& results) {
  for (const Peer& peer : peers()) {
    if ((quick && peer.is_slow) || !isBearable(results, peer, size)) continue;
    const std::string& path = peer.needs_all_faces ? all_faces : walls;
    results.add(size, "", measureAlone([&] { return measurePeer(path, peer); }));
  }
}

void measureSize(std::size_t size, const std::string& folder, bool quick, Results& results) {
  const std::string walls = folder + "/performance.ply";
  const std::string all_faces = folder + "/performance_faces.ply";
  measureAlone([&] {
    const auto building = synth::makeBuilding("syn1").layers;
    writeCloud(walls, building, size);
    writeCloud(all_faces, building, size, synth::SampledFaces::All);
    return std::vector<Measured>();
  });
  reconstruct::Options options;
  options.input = walls;
  options.threads = 1;
  results.add(size, "", measureAlone([&] { return measureFloor(walls); }));
  results.add(size, "building: ", measureAlone([&] { return measureStages(options); }));
  options.method = reconstruct::Method::Paper;
  results.add(size, "paper: ", measureAlone([&] { return measureStages(options); }));
  const int runs = quick || size > kFast ? 1 : kRuns;
  measurePrograms(size, walls, folder + "/performance", "building", runs, results);
  measureThinned(size, walls, folder + "/performance", results);
  if (size <= (quick ? results.sizes().front() : kMostOfPaper)) {
    measurePrograms(size, walls, folder + "/performance", "paper", runs, results);
  }
  measurePeers(size, walls, all_faces, quick, results);
  std::remove(walls.c_str());
  std::remove(all_faces.c_str());
}

int run(int argc, char** argv) {
  std::string folder;
  std::string clouds;
  bool quick = false;
  cli::CommandLine line("storey_performance", {"FOLDER [CLOUDS] [options]"},
                        "Measures the time and the memory of all stages, beside other programs', "
                        "and prints the tables of doc/performance.md.");
  line.argument("folder", folder, "for the clouds that are made and for tables as CSV");
  line.argument("clouds", clouds, "a folder of real .ply clouds, measured too");
  line.flag("quick", quick, "only up to a million points, without what is slow");
  if (!line.parse(argc, argv)) return io::Ok;
  if (folder.empty()) line.fail("expected a folder for clouds and tables");
  std::vector<std::size_t> sizes = {100000, 1000000, 4000000, 20000000};
  if (quick) sizes.resize(2);
  Results results(sizes);
  for (const std::size_t size : sizes) measureSize(size, folder, quick, results);
  if (quick)
    std::printf("Measured with `--quick`: up to a million points, without what is slow.\n\n");
  results.print();
  if (!missingPeers().empty()) std::printf("%s\n\n", missingPeers().c_str());
  results.writeCsv(folder + "/performance.csv");
  results.writeShares(folder + "/performance_shares.csv");
  printSpeedUps(results);
  measureSlopes(folder, quick);
  measureRealClouds(clouds, folder + "/performance");
  return io::Ok;
}

}  // namespace
}  // namespace storey::bench

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_performance", [&] { return storey::bench::run(argc, argv); });
}
