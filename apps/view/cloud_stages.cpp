// SPDX-License-Identifier: BSD-3-Clause
// The clouds of the stages, coloured by what the stage found out.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/failure.h"
#include "view/palette.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

constexpr std::size_t kBarColours = 128;
constexpr double kLevel = 0.7;  // length in plan of a normal that is more up or down than aside
constexpr std::size_t kMaxLegendEntries = 24;  // more do not fit beside the picture

// Label of point i less 1, or none.
std::optional<std::size_t> labelOf(const StageCloud& cloud, std::size_t i) {
  if (!(cloud.values[i] >= 1.0)) return std::nullopt;
  return static_cast<std::size_t>(cloud.values[i]) - 1;
}

std::size_t countLabelled(const StageCloud& cloud) {
  std::size_t count = 0;
  for (const double value : cloud.values) count += value >= 1.0 ? 1 : 0;
  return count;
}

std::string azimuthText(double degrees) {
  char text[32];
  // Rounded first, and 0 added: "-0.0" would look like a direction of its own.
  std::snprintf(text, sizeof text, "%.1f\u00b0", std::round(10.0 * degrees) / 10.0 + 0.0);
  return text;
}

// Of some points, as long as a fortieth of the cloud.
LineSet normalSticks(const StageCloud& cloud) {
  constexpr std::size_t kMaxSticks = 1500;
  constexpr float kLength = 0.025f;
  LineSet sticks;
  sticks.width = 1.2;
  if (cloud.positions.empty()) return sticks;
  Eigen::Vector3f low = cloud.positions.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& p : cloud.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const float length = kLength * (high - low).maxCoeff();
  for (const std::size_t i : evenlySpaced(cloud.positions.size(), kMaxSticks)) {
    const Eigen::Vector3f end = cloud.positions[i] + length * cloud.normals[i];
    if (!end.allFinite()) continue;
    sticks.lines.push_back({cloud.positions[i].cast<double>(), end.cast<double>()});
    sticks.colours.push_back(kDark);
  }
  return sticks;
}

}  // namespace

void addSequentialBar(Drawing& drawing, const std::string& title, double high) {
  drawing.bar = {title, sequentialColours(kBarColours), roundTicks(0.0, high)};
}

void addAzimuthBar(Drawing& drawing) {
  drawing.bar.title = "azimuth of the normal";
  for (std::size_t i = 0; i < kBarColours; ++i) {
    const double turns = (static_cast<double>(i) + 0.5) / static_cast<double>(kBarColours) - 0.5;
    drawing.bar.colours.push_back(azimuthColour(2.0 * M_PI * turns));
  }
  for (const int degrees : {-180, -90, 0, 90, 180}) {
    drawing.bar.ticks.push_back({(degrees + 180) / 360.0, std::to_string(degrees) + "\u00b0"});
  }
}

Drawing drawConfidence(const Reconstruction& r, View view) {
  const StageCloud cloud = readStageCloud(r.file("02_confidence.pcd"), "intensity");
  Drawing drawing;
  drawing.title = "Planar confidence";
  addCloud(drawing, cloud, view, [&](std::size_t i) { return sequentialColour(cloud.values[i]); });
  addSequentialBar(drawing, "planar confidence", 1.0);
  drawing.legend_title = "kept above " + shortNumber(r.report().planar_threshold);
  return drawing;
}

Drawing drawClasses(const Reconstruction& r, View view) {
  // In the order of `PointClass`.
  constexpr std::array kNames = {"wall",       "level", "ground", "sloped",
                                 "not planar", "apart", "small"};
  const StageCloud cloud = r.readLabels("02_classes.pcd", kNames.size(), "class");
  Drawing drawing;
  drawing.title = "What the points are of";
  std::array<std::size_t, kNames.size()> count{};
  addCloud(drawing, cloud, view, [&](std::size_t i) {
    const std::optional<std::size_t> c = labelOf(cloud, i);
    return c ? distinctColour(*c, kNames.size()) : kNoLabel;
  });
  for (std::size_t i = 0; i < cloud.values.size(); ++i) {
    if (const auto c = labelOf(cloud, i)) ++count[*c];
  }
  drawing.legend_title = "class: points";
  for (std::size_t c = 0; c < kNames.size(); ++c) {
    drawing.legend.push_back(
        {distinctColour(c, kNames.size()), kNames[c] + (": " + std::to_string(count[c]))});
  }
  return drawing;
}

Drawing drawDirections(const Reconstruction& r, Stage stage, View view) {
  const std::size_t n = r.report().azimuths.size();
  const bool labels = stage == Stage::Labels;
  const StageCloud cloud = r.readLabels(infoOf(stage).files.front(), n);
  Drawing drawing;
  drawing.title = labels ? "Directions after labelling in the slices" : "Dominant directions";
  addCloud(drawing, cloud, view, [&](std::size_t i) {
    const std::optional<std::size_t> label = labelOf(cloud, i);
    return label ? distinctColour(*label, n) : kNoLabel;
  });
  std::vector<std::size_t> count(n, 0);
  for (std::size_t i = 0; i < cloud.values.size(); ++i) {
    if (const auto label = labelOf(cloud, i)) ++count[*label];
  }
  drawing.legend_title = "azimuth: points";
  for (std::size_t k = 0; k < std::min(n, kMaxLegendEntries); ++k) {
    drawing.legend.push_back({distinctColour(k, n), azimuthText(r.report().azimuths[k]) + ": " +
                                                        std::to_string(count[k])});
  }
  if (n > kMaxLegendEntries) drawing.subtitle += ", " + std::to_string(n) + " directions";
  drawing.legend.push_back(
      {kNoLabel, "none: " + std::to_string(cloud.values.size() - countLabelled(cloud))});
  return drawing;
}

Drawing drawSlices(const Reconstruction& r, View view) {
  const std::size_t n = r.report().num_slices;
  const StageCloud cloud = r.readLabels("04_slices.pcd", n);
  Drawing drawing;
  drawing.title = "Slices";
  addCloud(drawing, cloud, view, [&](std::size_t i) {
    const std::optional<std::size_t> slice = labelOf(cloud, i);
    return slice ? sliceColour(*slice) : kNoLabel;
  });
  drawing.subtitle += ", slices " + shortNumber(r.report().slice_thickness) + " thick";
  drawing.bar.title = "slice";
  for (std::size_t k = 0; k < n; ++k) drawing.bar.colours.push_back(sliceColour(k));
  const double quarter = std::max(1.0, static_cast<double>(n) / 4.0);
  const auto step = static_cast<std::size_t>(roundLength(quarter));
  for (std::size_t k = 0; k < n; k += step) {  // at mid-height of its band
    const double at = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    drawing.bar.ticks.push_back({at, std::to_string(k)});
  }
  drawing.legend.push_back({kNoLabel, "in no slice"});
  return drawing;
}

Drawing drawNormals(const Reconstruction& r, Stage stage, View view) {
  const StageCloud cloud = readStageCloud(r.file(infoOf(stage).files.front()), "");
  Drawing drawing;
  drawing.title = stage == Stage::Upright ? "Upright cloud and its normals" : "Smoothed normals";
  addCloud(drawing, cloud, view, [&](std::size_t i) {
    const Eigen::Vector3d normal = cloud.normals[i].cast<double>();
    if (!normal.allFinite() || normal.head<2>().norm() < kLevel) return kNoLabel;
    return azimuthColour(std::atan2(normal.y(), normal.x()));
  });
  addAzimuthBar(drawing);
  drawing.legend = {{kDark, "normals, of some"}, {kNoLabel, "level, or no normal"}};
  drawing.lines.push_back(normalSticks(cloud));
  return drawing;
}

Drawing drawRegions(const Reconstruction& r, View view) {
  const StageCloud cloud = r.readLabels("07_regions.pcd", 0);
  Drawing drawing;
  drawing.title = "Edge regions";
  addCloud(drawing, cloud, view, [&](std::size_t i) {
    const std::optional<std::size_t> region = labelOf(cloud, i);
    return region ? regionColour(*region) : kNoLabel;
  });
  double num_regions = 0.0;
  for (const double label : cloud.values) num_regions = std::max(num_regions, label);
  drawing.subtitle += ", " + counted(static_cast<std::size_t>(num_regions), "region");
  drawing.legend_title = "colours tell regions apart";
  drawing.legend.push_back(
      {kNoLabel, "in none: " + std::to_string(cloud.values.size() - countLabelled(cloud))});
  return drawing;
}

Drawing drawRefined(const Reconstruction& r, View view) {
  const StageCloud before = readStageCloud(r.file("05_normals.pcd"), "");
  const StageCloud after = readStageCloud(r.file("08_refined.pcd"), "");
  if (before.positions.size() != after.positions.size()) {
    throw io::Failure(io::BadInput, r.file("08_refined.pcd"),
                      "has not as many points as 05_normals.pcd", "run storey_reconstruct again");
  }
  std::vector<double> moved;
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    moved.push_back(static_cast<double>((after.positions[i] - before.positions[i]).norm()));
  }
  // The bar ends where all but few points do: a single one that went far would hide the others.
  std::vector<double> sorted = moved;
  std::sort(sorted.begin(), sorted.end());
  const double q99 = sorted.empty() ? 0.0 : sorted[sorted.size() * 99 / 100];
  const double high = q99 > 0.0 ? q99 : 1.0;
  Drawing drawing;
  drawing.title = "Refined positions";
  addCloud(drawing, after, view, [&](std::size_t i) { return sequentialColour(moved[i] / high); });
  addSequentialBar(drawing, "moved by (length)", high);
  drawing.legend_title = "99 % moved less than " + shortNumber(high);
  return drawing;
}

}  // namespace storey::view::detail
