// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/pipeline.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "io/failure.h"
#include "stages/classes.h"
#include "stages/parts.h"
#include "stages/planar.h"
#include "stages/sampling.h"
#include "stages/stage_cloud_io.h"

namespace storey::reconstruct {
namespace {

using stages::StageCloud;

// What the stages of each method take for each point at their peak, measured by `bench
// performance`, and a third more for clouds that are less kind.
constexpr std::uint64_t kBuildingBytesPerPoint = 240;
constexpr std::uint64_t kPaperBytesPerPoint = 500;

io::CloudReaderOptions readerOptions(const Options& options) {
  io::CloudReaderOptions reader;
  reader.limits.max_memory = io::availableMemory();
  reader.limits.bytes_per_point =
      options.method == Method::Paper ? kPaperBytesPerPoint : kBuildingBytesPerPoint;
  reader.threads = options.threads;
  if (options.max_points > 0) {
    reader.limits.max_points = static_cast<std::uint64_t>(options.max_points);
  }
  return reader;
}

class Pipeline {
 public:
  Pipeline(const Options& options, const Observers& observers)
      : options_(options), observers_(observers) {}

  Result run(const std::function<io::LoadedCloud()>& load) {
    const stages::AttitudeOptions& attitude = options_.attitude;
    StageCloud& cloud = result_.cloud;
    stage("read", [&] { return take(load()); });
    stage("normals", [&] {
      return estimateMissingNormals(cloud, attitude, options_.threads, result_.attitude);
    });
    stage("sampling", [&] {
      return findSampleSize(cloud, {options_.structure_points, attitude.noise}, options_.threads);
    });
    stage("vertical",
          [&] { return setUpright(cloud, attitude, options_.threads, result_.attitude); });
    stage("orientation",
          [&] { return orientOutwards(cloud, attitude, options_.threads, result_.attitude); });
    stage("scale", [&] {
      return measureScale(cloud, attitude.noise, options_.threads, result_.attitude.scale);
    });
    observers_.cloud("01_upright", cloud);
    result_.all = cloud;
    takeSample();
    stage("planar",
          [&] { return measureConfidence(cloud, options_.kept_share, options_.threads); });
    observers_.cloud("02_confidence", cloud);
    stage("classes", [&] { return classify(cloud, options_.threads); });
    observers_.cloud("02_classes", cloud);
    stage("directions", [&] { return findDirections(cloud, options_.threads); });
    observers_.cloud("03_directions", cloud);
    if (options_.method == Method::Building) {
      stage("floorplans", [&] {
        return extractBlocks(cloud, options_.blocks, options_.simplicity, options_.threads,
                             result_.blocks, result_.building, options_.steps);
      });
    } else {
      extractSlices();
    }
    stage("model", [&] { return fitModel(); });
    result_.local_to_input = modelToInput(cloud, result_.model);
    return std::move(result_);
  }

 private:
  template <typename Work>
  void stage(const char* name, Work work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    const std::string found = tryOnSample(work);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const double cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    result_.times.push_back({name, seconds.count(), cpu_seconds});
    observers_.progress(stages::format("%-11s %6.2f s  %s", name, seconds.count(), found.c_str()));
  }

  /// Where a stage finds nothing in the few points that the user asked for, that may be why.
  template <typename Work>
  std::string tryOnSample(Work work) const {
    try {
      return work();
    } catch (const io::Failure& failure) {
      const bool is_asked_for = options_.structure_points > 0;
      const bool is_sample = is_asked_for || result_.loaded.thinned_out > 0;
      if (failure.status() != io::BadInput || !result_.cloud.points || !is_sample) throw;
      std::size_t looked_at = result_.cloud.points->size();
      if (is_asked_for) {
        looked_at = std::min(looked_at, static_cast<std::size_t>(options_.structure_points));
      }
      throw io::Failure(io::BadInput, "", failure.what(),
                        stages::format("only %zu points were looked at (%s)", looked_at,
                                       is_asked_for ? "--structure-points" : "--max-points"));
    }
  }

  std::string take(io::LoadedCloud loaded) {
    result_.loaded = std::move(loaded);
    result_.cloud = stages::fromLoaded(result_.loaded, options_.input);
    result_.cloud.state.crs = options_.attitude.crs;
    std::string found = stages::format("%zu points (%s)", result_.cloud.points->size(),
                                       result_.loaded.format.c_str());
    if (result_.loaded.thinned_out > 0) {
      found += stages::format(", thinned from %zu", result_.loaded.declared);
    }
    return found;
  }

  /// From here to the model only the structure is looked for. The paper's chain has all points: it
  /// sees those of one slice at a time.
  void takeSample() {
    StageCloud& cloud = result_.cloud;
    if (!isSampled(cloud)) return;
    if (options_.method == Method::Paper && options_.structure_points == 0) return;
    cloud = sampleOf(cloud);
    observers_.cloud("01_sampled", cloud);
  }

  /// The paper's chain, on a copy of the cloud: its stages leave only the points of slices.
  void extractSlices() {
    const unsigned int threads = options_.threads;
    StageCloud sliced = result_.cloud;
    stage("slices", [&] { return cutSlices(sliced, options_.slices.thickness); });
    observers_.cloud("04_slices", sliced);
    stage("smoothing", [&] { return smoothNormals(sliced, threads); });
    observers_.cloud("05_normals", sliced);
    stage("labels", [&] { return labelPoints(sliced, threads); });
    observers_.cloud("06_labels", sliced);
    stage("regions", [&] { return growRegions(sliced, threads); });
    observers_.cloud("07_regions", sliced);
    stage("positions", [&] { return refinePositions(sliced, threads); });
    observers_.cloud("08_refined", sliced);
    stage("floorplans",
          [&] { return outlineSlices(sliced, options_.slices.linking, threads, result_.slices); });
    result_.cloud.state.slices = sliced.state.slices;
  }

  std::string fitModel() {
    const stages::PartSource parts =
        partsOf(result_.loaded, result_.all, options_.attitude, options_.threads);
    result_.fitted_to_all = parts || result_.loaded.thinned_out == 0;
    const bool blocks = options_.method == Method::Building;
    const std::string found =
        buildModel(result_.all, blocks ? result_.blocks : result_.slices.layers, options_.method,
                   options_.simplicity, options_.model, options_.threads, result_.model, parts,
                   options_.steps);
    return result_.fitted_to_all ? found : found + ", fitted to the sample alone";
  }

  const Options& options_;
  const Observers& observers_;
  Result result_;
};

}  // namespace

Result reconstruct(const Options& options, const Observers& observers) {
  return Pipeline(options, observers).run([&] {
    return io::readCloud(options.input, readerOptions(options));
  });
}

Result reconstruct(io::LoadedCloud cloud, const Options& options, const Observers& observers) {
  return Pipeline(options, observers).run([&] { return std::move(cloud); });
}

}  // namespace storey::reconstruct
