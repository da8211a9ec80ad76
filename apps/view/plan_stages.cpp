// SPDX-License-Identifier: BSD-3-Clause
// Floorplans: those of all slices over each other, and one slice from its points to its floorplan.
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/failure.h"
#include "view/palette.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

using Lines = std::vector<std::vector<Eigen::Vector3d>>;

constexpr std::size_t kBarColours = 128;
constexpr std::size_t kMaxSticks = 400;
constexpr double kStickShare = 0.03;  // length of a normal's stick over the extent of the slice

constexpr Colour kProjected{160, 190, 225};
constexpr Colour kRefined{20, 40, 110};
constexpr Colour kStick{90, 160, 90};
constexpr Colour kFloorplan{245, 150, 130};

// A slice in the clouds of the stages: the height of its points in the cloud, and which points of
// 05_normals.pcd and 08_refined.pcd are its own. Those clouds hold one slice after the other.
struct SliceRange {
  std::size_t first = 0;
  std::size_t count = 0;
  double z_min = std::numeric_limits<double>::infinity();
  double z_max = -std::numeric_limits<double>::infinity();

  double middle() const { return 0.5 * (z_min + z_max); }
};

std::vector<SliceRange> findSlices(const StageCloud& labelled, std::size_t num_slices) {
  std::vector<SliceRange> slices(num_slices);
  for (std::size_t i = 0; i < labelled.values.size(); ++i) {
    if (!(labelled.values[i] >= 1.0)) continue;
    SliceRange& slice = slices[static_cast<std::size_t>(labelled.values[i]) - 1];
    const auto z = static_cast<double>(labelled.positions[i].z());
    slice.z_min = std::min(slice.z_min, z);
    slice.z_max = std::max(slice.z_max, z);
    ++slice.count;
  }
  for (std::size_t s = 1; s < slices.size(); ++s) {
    slices[s].first = slices[s - 1].first + slices[s - 1].count;
  }
  return slices;
}

// Floorplans lie at mid-height of their slice, and the points are inside of it: the middle of the
// points is less than half a slice away from the slice's own, more than half from all others.
Lines linesOf(const Lines& lines, const SliceRange& slice, double thickness) {
  Lines own;
  for (const auto& line : lines) {
    if (!line.empty() && std::abs(line.front().z() - slice.middle()) < 0.5 * thickness) {
      own.push_back(line);
    }
  }
  return own;
}

std::size_t middleSlice(const std::vector<SliceRange>& slices, const Lines& lines,
                        double thickness) {
  const std::size_t middle = slices.size() / 2;
  for (std::size_t distance = 0; distance <= middle; ++distance) {
    for (const std::size_t s : {middle - distance, middle + distance}) {
      if (s < slices.size() && !linesOf(lines, slices[s], thickness).empty()) return s;
    }
  }
  return middle;
}

std::size_t chooseSlice(const Reconstruction& r, const std::vector<SliceRange>& slices,
                        const Lines& lines, std::optional<int> wanted) {
  if (slices.empty()) {
    throw io::Failure(io::BadInput, r.file("04_slices.pcd"), "has no slices", "");
  }
  if (!wanted) return middleSlice(slices, lines, r.report().slice_thickness);
  const auto chosen = static_cast<std::size_t>(*wanted);
  if (chosen >= slices.size()) {
    throw io::Failure(io::Usage, "",
                      "--slice is " + std::to_string(*wanted) + ", the last one is " +
                          std::to_string(slices.size() - 1),
                      "");
  }
  return chosen;
}

PointSet flatPoints(const StageCloud& cloud, const SliceRange& slice, Colour colour, double size,
                    float z) {
  PointSet set;
  set.size = size;
  for (const std::size_t i : evenlySpaced(slice.count, kMaxDrawnPoints)) {
    const Eigen::Vector3f& p = cloud.positions[slice.first + i];
    set.positions.emplace_back(p.x(), p.y(), z);
    set.colours.push_back(colour);
  }
  return set;
}

LineSet normalSticks(const StageCloud& cloud, const SliceRange& slice, double length, double z) {
  LineSet set;
  set.width = 1.5;
  for (const std::size_t i : evenlySpaced(slice.count, kMaxSticks)) {
    const Eigen::Vector3d p = cloud.positions[slice.first + i].cast<double>();
    const Eigen::Vector3d n = cloud.normals[slice.first + i].cast<double>();
    if (!n.allFinite()) continue;
    const Eigen::Vector3d from(p.x(), p.y(), z);
    set.lines.push_back({from, from + length * Eigen::Vector3d(n.x(), n.y(), 0.0)});
    set.colours.push_back(kStick);
  }
  return set;
}

double extentOf(const PointSet& set) {
  if (set.positions.empty()) return 1.0;
  Eigen::Vector3f low = set.positions.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& p : set.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return static_cast<double>((high - low).maxCoeff());
}

// Steps of the heights that keep what is drawn later on top, in a plan seen from above.
void layOver(Drawing& drawing, const StageCloud& before, const StageCloud& after, Lines floorplan,
             const SliceRange& slice) {
  drawing.points.push_back(flatPoints(before, slice, kProjected, 3.0, 0.0f));
  const double extent = extentOf(drawing.points.front());
  const double step = 1e-3 * extent;
  drawing.lines.push_back(normalSticks(before, slice, kStickShare * extent, step));
  LineSet lines;
  lines.width = 6.0;
  for (auto& line : floorplan) {
    for (Eigen::Vector3d& p : line) p.z() = 2.0 * step;
    lines.lines.push_back(std::move(line));
    lines.colours.push_back(kFloorplan);
  }
  drawing.lines.push_back(std::move(lines));
  drawing.points.push_back(flatPoints(after, slice, kRefined, 2.5, static_cast<float>(3.0 * step)));
}

}  // namespace

Drawing drawFloorplans(const Reconstruction& r) {
  Drawing drawing;
  drawing.title = "Floorplans of the slices";
  LineSet set;
  set.lines = readVtkLines(r.file("09_floorplans.vtk"));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& line : set.lines) {
    for (const Eigen::Vector3d& p : line) {
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
  }
  if (!(high > low)) high = low + 1.0;  // a single slice
  for (const auto& line : set.lines) {
    const double z = line.empty() ? low : line.front().z();
    set.colours.push_back(sequentialColour(0.85 * (z - low) / (high - low)));  // yellow is faint
  }
  drawing.subtitle = counted(set.lines.size(), "ring");
  if (!set.lines.empty()) {
    drawing.bar.title = "height";
    for (std::size_t i = 0; i < kBarColours; ++i) {
      drawing.bar.colours.push_back(
          sequentialColour(0.85 * (static_cast<double>(i) + 0.5) / kBarColours));
    }
    drawing.bar.ticks = roundTicks(low, high);
  }
  drawing.lines.push_back(std::move(set));
  return drawing;
}

Drawing drawSlice(const Reconstruction& r, std::optional<int> wanted) {
  const double thickness = r.report().slice_thickness;
  const Lines lines = readVtkLines(r.file("09_floorplans.vtk"));
  const std::vector<SliceRange> slices =
      findSlices(r.readLabels("04_slices.pcd", r.report().num_slices), r.report().num_slices);
  const std::size_t chosen = chooseSlice(r, slices, lines, wanted);
  const SliceRange& slice = slices[chosen];
  const StageCloud before = readStageCloud(r.file("05_normals.pcd"), "");
  const StageCloud after = readStageCloud(r.file("08_refined.pcd"), "");
  const std::size_t total = slices.back().first + slices.back().count;
  if (before.positions.size() != total || after.positions.size() != total) {
    throw io::Failure(io::BadInput, r.file("04_slices.pcd"),
                      "is not of the same run as 05_normals.pcd and 08_refined.pcd",
                      "run storey_reconstruct again");
  }
  Lines floorplan = linesOf(lines, slice, thickness);
  const std::size_t num_rings = floorplan.size();
  Drawing drawing;
  drawing.title = "Slice " + std::to_string(chosen) + " in plan (0 to " +
                  std::to_string(slices.size() - 1) + ")";
  drawing.subtitle = counted(slice.count, "point") + ", " + shortNumber(thickness) + " thick";
  if (slice.count > 0) drawing.subtitle += ", around z = " + shortNumber(slice.middle());
  layOver(drawing, before, after, std::move(floorplan), slice);
  drawing.legend = {{kProjected, "points as projected"},
                    {kStick, "normals, of some"},
                    {kFloorplan, num_rings > 0 ? "floorplan" : "floorplan: none found"},
                    {kRefined, "refined points"}};
  return drawing;
}

}  // namespace storey::view::detail
