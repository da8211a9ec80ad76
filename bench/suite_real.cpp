// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <numeric>
#include <type_traits>

#include "bench/isolation.h"
#include "bench/markdown.h"
#include "bench/real_clouds.h"
#include "bench/suites.h"
#include "io/model_io.h"
#include "reconstruct/agreement.h"
#include "reconstruct/pipeline.h"
#include "synth/cloud_evaluation.h"

namespace storey::bench {
namespace {

constexpr const char* kRealText = R"(## Real clouds

No truth is known. Upright points are those of planar surroundings (85 %% of the cloud, stage 2) whose normals lie within 17 degrees of
level: of the building, but also of its neighbours, of trees and cars. The deviation is that of the points about their walls,
relief included. Explained: upright points within 3 deviations of the model. Of the building: the same of the points classed as wall
(see "Classes of points" in method.md), that is without surfaces that lean by more than 8 degrees, without what is no surface of the size of
a wall and beside none, such as crowns of trees, and without small groups that a gap separates from the rest; no model takes part in that. Supported: area of the model's walls with upright points
within 3 deviations, those at corners and reveals that stage 2 leaves out among them, for a wall was seen there all the same;
walls that trees hide or that nobody was behind have none. Not guessed: the same of the walls that the model does not mark
as hypothetical.

)";

namespace fs = std::filesystem;

/// What can be said of a model without the truth.
struct Agreement {
  std::size_t points = 0;
  double noise = 0.0;
  double explained = 0.0;        ///< share of the upright points within 3 deviations
  double of_building = 0.0;      ///< the same of those that are of upright surfaces and not apart
  double supported = 0.0;        ///< share of the model's wall area with upright points
  double supported_shown = 0.0;  ///< the same of the walls that are not marked as guessed
  std::size_t polygons = 0;
  std::size_t blocks = 0;
  bool valid = false;
  double seconds = 0.0;
};

reconstruct::Options optionsOf(const std::string& cloud, const std::string& text) {
  std::vector<std::string> words = {"storey_reconstruct", cloud, "-o", "unused", "--threads", "1"};
  for (const std::string& word : wordsOf(text)) words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  reconstruct::Options options;
  parseOptions(static_cast<int>(arguments.size()), arguments.data(), options);
  return options;
}

pcl::Indices allPoints(const stages::StageCloud& cloud) {
  pcl::Indices indices(cloud.points->size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

synth::CloudEvaluation evaluate(const reconstruct::Result& result, const pcl::Indices& indices) {
  const Eigen::Isometry3d& upright = result.model.upright;  // the model's frame
  std::vector<synth::OrientedPosition> points;
  for (const pcl::index_t i : indices) {
    const reconstruct::Point& p = (*result.cloud.points)[static_cast<std::size_t>(i)];
    points.push_back({upright * p.getVector3fMap().cast<double>(),
                      upright.linear() * p.getNormalVector3fMap().cast<double>()});
  }
  return synth::evaluateAgainstCloud(io::toPolygons(result.model.model), points,
                                     Eigen::Vector3d::UnitZ(), result.cloud.state.noise,
                                     result.cloud.state.density);
}

// What stage 2 leaves out, crowns of trees and the corners of walls, no model has to explain; but
// it shows where walls were seen.
Agreement agreementOf(const reconstruct::Options& options) {
  const std::clock_t start = std::clock();
  const reconstruct::Result result = reconstruct::reconstruct(options);
  Agreement a;
  a.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const synth::CloudEvaluation of_planar = evaluate(result, planarPoints(result.cloud));
  const synth::CloudEvaluation of_all = evaluate(result, allPoints(result.cloud));
  a.points = result.cloud.points->size();
  a.noise = result.cloud.state.noise;
  a.explained = of_planar.explainedShare();
  a.of_building = reconstruct::agreementWith(result).explained_of_building;
  a.supported = of_all.supportedShare();
  a.supported_shown = of_all.supportedShownShare();
  a.polygons = result.model.model.faces.size();
  a.blocks = result.model.model.storeys.size();
  a.valid = result.model.check.ok();
  return a;
}

std::string bytesOf(const Agreement& agreement) {
  static_assert(std::is_trivially_copyable_v<Agreement>);
  return {reinterpret_cast<const char*>(&agreement), sizeof agreement};
}

void addRow(const std::string& cloud, const Report& report, Table& table) {
  const std::string name = fs::path(cloud).filename().string();
  if (!report.failure.empty()) {
    const bool has_path = report.failure.rfind(cloud + ": ", 0) == 0;
    const std::string reason = report.failure.substr(has_path ? cloud.size() + 2 : 0);
    table.add({name, "-", "-", "-", "-", "-", "-", "-", "-", "-", "-", reason});
    return;
  }
  Agreement a;
  std::memcpy(&a, report.result.data(), sizeof a);
  char noise[32];
  std::snprintf(noise, sizeof noise, "%.3g", a.noise);
  table.add({name, std::to_string(a.points), noise, fixed(100.0 * a.explained, 1) + " %",
             fixed(100.0 * a.of_building, 1) + " %", fixed(100.0 * a.supported, 1) + " %",
             fixed(100.0 * a.supported_shown, 1) + " %", std::to_string(a.polygons),
             std::to_string(a.blocks), a.valid ? "yes" : "no", fixed(a.seconds, 1), ""});
}

}  // namespace

void measureReal(const Request& request) {
  const std::vector<std::string> clouds = cloudsIn(request.folder);
  std::map<std::string, std::string> given = readCloudOptions(request.cloud_options);
  std::vector<reconstruct::Options> options;
  std::vector<Task> tasks;
  for (const std::string& cloud : clouds) {
    options.push_back(optionsOf(cloud, given[fs::path(cloud).filename().string()]));
    if (request.method) options.back().method = *request.method;
  }
  for (const reconstruct::Options& cloud : options) {
    tasks.emplace_back([&cloud] { return bytesOf(agreementOf(cloud)); });
  }
  const std::vector<Report> reports =
      runIsolated(tasks, request.jobs, [&](std::size_t i, const Report& report) {
        std::fprintf(stderr, "%s %s\n", clouds[i].c_str(), report.failure.c_str());
      });
  std::printf(kRealText);
  Table table({"cloud", "points", "noise", "explained", "of the building", "supported",
               "not guessed", "polygons", "blocks", "valid", "CPU s", "what is wrong"});
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    addRow(clouds[i], reports[i], table);
  }
  table.print();
}

}  // namespace storey::bench
