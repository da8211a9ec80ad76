// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/slopes.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/markdown.h"
#include "bench/performance/clouds.h"
#include "bench/performance/stages.h"
#include "io/failure.h"
#include "synth/buildings.h"

namespace storey::bench {
namespace {

constexpr std::size_t kPoints = 500000;
constexpr rlim_t kPatience = 60;        // seconds of CPU
constexpr double kLeastSeconds = 0.02;  // of a stage whose slope says something
constexpr const char* kSlicesText = R"(## Over the number of slices

The paper's chain on the building of the first table with 500,000 points, CPU seconds on one thread. The exponent is that of the
least squares line of log time over log count; stages that never take 0.02 s are left out. A run that takes longer than
%.0f s ends there.

)";
constexpr const char* kWallsText = R"(## Over the number of walls

The building's chain on a block whose sides are cut into teeth, no two walls in one plane; 500,000 points, CPU seconds on one
thread. The block grows longer with its teeth: the least area of a wall is set to half of a tooth's, where the default is the
extent's.

)";

struct Series {
  std::vector<double> counts;
  std::vector<std::vector<Measured>> runs;  ///< parallel to `counts`; none where `missing` says why
  std::vector<std::string> missing;
};

double exponentOf(const std::vector<double>& counts, const std::vector<double>& seconds) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double u = std::log(counts[i]);
    const double v = std::log(std::max(seconds[i], 1e-3));  // the clock's resolution
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  const auto n = static_cast<double>(counts.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void print(const std::string& what, const Series& series) {
  std::vector<std::string> header = {what};
  for (const double count : series.counts) header.push_back(fixed(count, 0));
  header.emplace_back("exponent");
  Table table(header);
  for (std::size_t stage = 0; stage < series.runs[0].size(); ++stage) {
    std::vector<std::string> cells = {series.runs[0][stage].work};
    std::vector<double> counts;
    std::vector<double> seconds;
    for (std::size_t i = 0; i < series.runs.size(); ++i) {
      const bool ended = !series.runs[i].empty();
      cells.push_back(ended ? fixed(series.runs[i][stage].cpu, 2) : series.missing[i]);
      if (!ended) continue;
      counts.push_back(series.counts[i]);
      seconds.push_back(series.runs[i][stage].cpu);
    }
    if (*std::max_element(seconds.begin(), seconds.end()) < kLeastSeconds) continue;
    cells.push_back(counts.size() > 1 ? fixed(exponentOf(counts, seconds), 2) : "-");
    table.add(cells);
  }
  table.print();
}

void measure(Series& series, double count, const reconstruct::Options& options) {
  series.counts.push_back(count);
  series.runs.emplace_back();
  series.missing.emplace_back();
  try {
    series.runs.back() = measureAlone([&] {
      const rlimit limit{kPatience, kPatience};
      setrlimit(RLIMIT_CPU, &limit);
      return measureStages(options);
    });
    std::fprintf(stderr, "%.0f: %.2f s\n", count, series.runs.back().back().cpu);
  } catch (const io::Failure& failure) {
    const bool ended = std::string(failure.what()).find("CRASH") != std::string::npos;
    series.missing.back() = ended ? "> " + std::to_string(kPatience) + " in all" : "refused";
    std::fprintf(stderr, "%.0f: %s\n", count, failure.what());
  }
}

void measureSlices(const std::string& cloud, bool quick) {
  const std::vector<FloorplanLayer> building = synth::makeBuilding("syn1").layers;
  const double height = building.back().z_max - building.front().z_min;
  measureAlone([&] {
    writeCloud(cloud, building, kPoints);
    return std::vector<Measured>();
  });
  Series series;
  for (const double count : {100.0, 300.0, 1000.0}) {
    if (quick && count > 100.0) continue;
    reconstruct::Options options;
    options.input = cloud;
    options.threads = 1;
    options.method = reconstruct::Method::Paper;
    options.slices.thickness = height / count;
    measure(series, count, options);
  }
  std::printf(kSlicesText, static_cast<double>(kPatience));
  print("slices", series);
}

void measureWalls(const std::string& cloud, bool quick) {
  Series series;
  for (const std::size_t walls : {16, 48, 152, 504}) {
    if (quick && walls > 48) continue;
    measureAlone([&] {
      writeCloud(cloud, toothedBlock(walls), kPoints);
      return std::vector<Measured>();
    });
    reconstruct::Options options;
    options.input = cloud;
    options.threads = 1;
    options.blocks.min_wall_area = 0.5 * kToothArea;
    measure(series, static_cast<double>(walls), options);
  }
  std::printf("%s", kWallsText);
  print("walls", series);
}

}  // namespace

void measureSlopes(const std::string& scratch, bool quick) {
  const std::string cloud = scratch + "/slopes.ply";
  measureSlices(cloud, quick);
  measureWalls(cloud, quick);
  std::remove(cloud.c_str());
}

}  // namespace storey::bench
