// SPDX-License-Identifier: BSD-3-Clause
// Floorplans: those of all slices over each other, and one slice from its points to its floorplan.
#include <storey/segmentation/detail/segment_linking.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
  requireStep(chosen, slices.size());
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

StageCloud readOfSlices(const Reconstruction& r, const char* name, const char* field,
                        std::size_t total) {
  StageCloud cloud = readStageCloud(r.file(name), field);
  if (cloud.positions.size() != total) {
    throw io::Failure(io::BadInput, r.file("04_slices.pcd"),
                      std::string("is not of the same run as ") + name,
                      "run storey_reconstruct again");
  }
  return cloud;
}

// From the points as projected to the floorplan.
void addSteps(Drawing& drawing, const Reconstruction& r, const SliceRange& slice, std::size_t total,
              Lines floorplan) {
  const bool found = !floorplan.empty();
  const StageCloud before = readOfSlices(r, "05_normals.pcd", "", total);
  const StageCloud after = readOfSlices(r, "08_refined.pcd", "", total);
  layOver(drawing, before, after, std::move(floorplan), slice);
  drawing.legend = {{kProjected, "points as projected"},
                    {kStick, "normals, of some"},
                    {kFloorplan, found ? "floorplan" : "floorplan: none found"},
                    {kRefined, "refined points"}};
}

// Points of a slice that belong together.
using Members = std::vector<std::size_t>;

std::map<double, Members> regionsOf(const StageCloud& regions, const SliceRange& slice) {
  std::map<double, Members> members;
  for (std::size_t i = slice.first; i < slice.first + slice.count; ++i) {
    members[regions.values[i]].push_back(i);
  }
  return members;
}

// The line segment of a region, as the extraction of floorplans fits it; none where that has none.
std::optional<storey::detail::LineSegment> segmentOf(const StageCloud& cloud,
                                                     const Members& members) {
  constexpr std::size_t kLeastPoints = 5;
  constexpr double kPriorAngle = 0.02;  // rad
  std::vector<Eigen::Vector2d> positions;
  Eigen::Vector2d outward = Eigen::Vector2d::Zero();
  for (const std::size_t i : members) {
    positions.push_back(cloud.positions[i].head<2>().cast<double>());
    const Eigen::Vector2d normal = cloud.normals[i].head<2>().cast<double>();
    if (normal.allFinite()) outward += normal;
  }
  if (members.size() < kLeastPoints || outward.isZero()) return std::nullopt;
  return storey::detail::fitTrimmedSegment(positions, outward.normalized(), kPriorAngle, 0.0);
}

// The points of a slice by their edge region, and the line segment of each.
void addSegments(Drawing& drawing, const Reconstruction& r, const SliceRange& slice,
                 std::size_t total) {
  const StageCloud before = readOfSlices(r, "05_normals.pcd", "", total);  // scattered, to be seen
  const StageCloud refined = readOfSlices(r, "08_refined.pcd", "", total);
  PointSet set;
  set.size = 5.0;
  LineSet segments;
  segments.width = 3.0;
  std::size_t num_regions = 0;
  for (const auto& [label, members] :
       regionsOf(readOfSlices(r, "07_regions.pcd", "label", total), slice)) {
    const Colour colour = label >= 1.0 ? regionColour(num_regions++) : kNoLabel;
    for (const std::size_t i : members) {
      set.positions.emplace_back(before.positions[i].x(), before.positions[i].y(), 0.0f);
      set.colours.push_back(colour);
    }
    const auto segment = label >= 1.0 ? segmentOf(refined, members) : std::nullopt;
    if (!segment) continue;
    segments.lines.push_back(
        {{segment->start.x(), segment->start.y(), 0.0}, {segment->end.x(), segment->end.y(), 0.0}});
    segments.colours.push_back(kDark);
  }
  const double above = 1e-3 * extentOf(set);
  for (auto& line : segments.lines) {
    for (Eigen::Vector3d& p : line) p.z() = above;
  }
  drawing.subtitle += ", " + counted(num_regions, "region");
  drawing.legend_title = "colours tell regions apart";
  drawing.legend = {{kDark, "segments: " + std::to_string(segments.lines.size())},
                    {kNoLabel, "points in none"}};
  drawing.points.push_back(std::move(set));
  drawing.lines.push_back(std::move(segments));
}

}  // namespace

Drawing drawFloorplans(const Reconstruction& r) {
  Drawing drawing;
  drawing.title = "Floorplans";
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

Drawing drawSlice(const Reconstruction& r, Stage stage, std::optional<int> wanted) {
  const double thickness = r.report().slice_thickness;
  const bool have_lines = r.has("09_floorplans.vtk");
  const Lines lines = have_lines ? readVtkLines(r.file("09_floorplans.vtk")) : Lines{};
  const std::vector<SliceRange> slices =
      findSlices(r.readLabels("04_slices.pcd", r.report().num_slices), r.report().num_slices);
  const std::size_t chosen = chooseSlice(r, slices, lines, wanted);
  const SliceRange& slice = slices[chosen];
  const std::size_t total = slices.back().first + slices.back().count;
  Drawing drawing;
  const char* const what = stage == Stage::Segments ? "Edge regions of slice " : "Slice ";
  drawing.title =
      what + std::to_string(chosen) + " in plan (0 to " + std::to_string(slices.size() - 1) + ")";
  drawing.subtitle = counted(slice.count, "point") + ", " + shortNumber(thickness) + " thick";
  if (slice.count > 0) drawing.subtitle += ", around z = " + shortNumber(slice.middle());
  if (stage == Stage::Segments) {
    addSegments(drawing, r, slice, total);
  } else {
    addSteps(drawing, r, slice, total, linesOf(lines, slice, thickness));
  }
  return drawing;
}

}  // namespace storey::view::detail
