// SPDX-License-Identifier: BSD-3-Clause
#include "view/stages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/failure.h"

namespace storey::view {
namespace {

Drawing drawStage(const Reconstruction& r, Stage stage, View view, std::optional<int> slice) {
  switch (stage) {
    case Stage::Confidence:
      return detail::drawConfidence(r, view);
    case Stage::Directions:
    case Stage::Labels:
      return detail::drawDirections(r, stage, view);
    case Stage::Slices:
      return detail::drawSlices(r, view);
    case Stage::Normals:
      return detail::drawNormals(r, view);
    case Stage::Regions:
      return detail::drawRegions(r, view);
    case Stage::Refined:
      return detail::drawRefined(r, view);
    case Stage::Floorplans:
      return detail::drawFloorplans(r);
    case Stage::Overlay:
      return detail::drawOverlay(r);
    case Stage::Slice:
      return detail::drawSlice(r, slice);
    default:
      return detail::drawModel(r);
  }
}

}  // namespace

std::vector<std::string> filesOf(Stage stage) {
  switch (stage) {
    case Stage::Confidence:
      return {"02_confidence.pcd"};
    case Stage::Directions:
      return {"03_directions.pcd"};
    case Stage::Slices:
      return {"04_slices.pcd"};
    case Stage::Normals:
      return {"05_normals.pcd"};
    case Stage::Labels:
      return {"06_labels.pcd"};
    case Stage::Regions:
      return {"07_regions.pcd"};
    case Stage::Refined:
      return {"05_normals.pcd", "08_refined.pcd"};
    case Stage::Floorplans:
      return {"09_floorplans.vtk"};
    case Stage::Overlay:
      return {"01_upright.pcd", "model.ply", "floorplans.geojson"};
    case Stage::Slice:
      return {"04_slices.pcd", "05_normals.pcd", "08_refined.pcd", "09_floorplans.vtk"};
    default:
      return {"model.ply", "floorplans.geojson"};
  }
}

Drawing makeDrawing(const Reconstruction& reconstruction, Stage stage, View view,
                    std::optional<int> slice) {
  Drawing drawing = drawStage(reconstruction, stage, view, slice);
  drawing.view = view;
  drawing.subtitle = io::printable(reconstruction.report().input, 40) + ": " + drawing.subtitle;
  if (boundsOf(drawing, projectionOf(view)).empty()) {
    throw io::Failure(io::BadInput, reconstruction.file(filesOf(stage).back()),
                      "there is nothing in it to draw", "look at an earlier stage");
  }
  return drawing;
}

std::vector<std::size_t> evenlySpaced(std::size_t n, std::size_t at_most) {
  const std::size_t count = std::min(n, at_most);
  std::vector<std::size_t> chosen(count);
  for (std::size_t k = 0; k < count; ++k) chosen[k] = k * n / count;
  return chosen;
}

namespace detail {

std::string shortNumber(double value) {
  constexpr int kDigits = 3;  // more where the whole part has more: no exponent below a million
  const int whole =
      value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", std::clamp(whole, kDigits, 6), value);
  return text;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

Colour paler(Colour colour) {
  const auto raise = [](int c) { return static_cast<std::uint8_t>((c + 255) / 2); };
  return {raise(colour.r), raise(colour.g), raise(colour.b)};
}

std::vector<Tick> roundTicks(double low, double high) {
  constexpr double kLeastTicks = 4.0;
  constexpr int kMostTicks = 10;  // a round step is up to 2.5 times finer
  const double range = high - low;
  const double step = roundLength(range / kLeastTicks);
  const double first = std::ceil(low / step);
  std::vector<Tick> ticks;
  for (int k = 0; k <= kMostTicks; ++k) {
    const double value = (first + k) * step;
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value + 0.0);  // never "-0"
    if (value <= high) ticks.push_back({(value - low) / range, text});
  }
  return ticks;
}

}  // namespace detail
}  // namespace storey::view
