// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "view/drawing.h"
#include "view/options.h"
#include "view/projection.h"
#include "view/reconstruction.h"

namespace storey::view {

constexpr std::size_t kMaxDrawnPoints = 300000;  // of a cloud; more only hide each other

/// The first of the files that a stage is drawn from that is not there; empty: all are.
std::string missingFile(const Reconstruction& reconstruction, Stage stage);

/// How many slices or blocks there are to see one by one; 0 for stages that show all at once.
std::size_t countSteps(const Reconstruction& reconstruction, Stage stage);

/// What there is to see of a stage. The slice (or block) is for stages in plan; none: the slice
/// nearest the middle that has a floorplan, the middle block.
/// \param with_cloud lay the cloud over what `canOverlay`; always so for `Stage::Overlay`
/// \throws io::Failure (Usage, BadInput, MissingInput, IoError)
Drawing makeDrawing(const Reconstruction& reconstruction, Stage stage, View view,
                    std::optional<int> slice, bool with_cloud = false);

/// min(n, at_most) of the numbers 0 .. n - 1 at even distances, ascending.
std::vector<std::size_t> evenlySpaced(std::size_t n, std::size_t at_most);

namespace detail {

// The parts of `makeDrawing`, by what they draw; the view and the name of the cloud are set there.
Drawing drawConfidence(const Reconstruction& reconstruction, View view);
Drawing drawClasses(const Reconstruction& reconstruction, View view);
Drawing drawDirections(const Reconstruction& reconstruction, Stage stage, View view);
Drawing drawSlices(const Reconstruction& reconstruction, View view);
Drawing drawNormals(const Reconstruction& reconstruction, Stage stage, View view);
Drawing drawRegions(const Reconstruction& reconstruction, View view);
Drawing drawRefined(const Reconstruction& reconstruction, View view);
Drawing drawFloorplans(const Reconstruction& reconstruction);
Drawing drawWalls(const Reconstruction& reconstruction);
Drawing drawCells(const Reconstruction& reconstruction, std::optional<int> block);
Drawing drawTypes(const Reconstruction& reconstruction);
Drawing drawModel(const Reconstruction& reconstruction, Stage stage);
Drawing drawTextured(const Reconstruction& reconstruction);
Drawing drawSlice(const Reconstruction& reconstruction, Stage stage, std::optional<int> slice);

/// Lays the upright cloud over a drawing and lets it shine through facets.
void layCloudOver(Drawing& drawing, const Reconstruction& reconstruction);

/// Refuses a slice or block beyond the last one. \throws io::Failure (Usage)
void requireStep(std::size_t step, std::size_t num_steps);

/// The bar of `azimuthColour`.
void addAzimuthBar(Drawing& drawing);

/// A bar of `sequentialColour` from 0 to `high`.
void addSequentialBar(Drawing& drawing, const std::string& title, double high);

/// The number with three significant digits, or its whole part if that is longer.
std::string shortNumber(double value);

/// A count and its noun: "1 point", "5 points".
std::string counted(std::size_t count, const std::string& noun);

/// Ticks at round values of a bar that goes from `low` to `high`; needs low < high.
std::vector<Tick> roundTicks(double low, double high);

/// The colour, half-way to white.
Colour paler(Colour colour);

/// A thinned cloud; colour(i) is that of point i. What is seen from behind is paler, or the far
/// walls of a building without a roof would look like its roof. Sets the subtitle.
template <typename ColourOf>
void addCloud(Drawing& drawing, const StageCloud& cloud, View view, const ColourOf& colour) {
  constexpr float kBehind = -0.05f;  // cosine; level normals seen from above are not behind
  const std::size_t n = cloud.positions.size();
  const Eigen::Vector3f towards = projectionOf(view).towards.cast<float>();
  PointSet set;
  for (const std::size_t i : evenlySpaced(n, kMaxDrawnPoints)) {
    set.positions.push_back(cloud.positions[i]);
    const bool behind = view != View::Free && cloud.normals[i].dot(towards) < kBehind;
    set.colours.push_back(behind ? paler(colour(i)) : colour(i));
  }
  drawing.subtitle = counted(n, "point");
  if (set.positions.size() < n) {
    drawing.subtitle += ", " + std::to_string(set.positions.size()) + " drawn";
  }
  if (view != View::Free) drawing.subtitle += ", paler where seen from behind";
  drawing.points.push_back(std::move(set));
}

}  // namespace detail
}  // namespace storey::view
