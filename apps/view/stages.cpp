// SPDX-License-Identifier: BSD-3-Clause
#include "view/stages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/failure.h"
#include "view/plan_files.h"

namespace storey::view {
namespace {

Drawing drawStage(const Reconstruction& r, Stage stage, View view, std::optional<int> slice) {
  switch (stage) {
    case Stage::Confidence:
      return detail::drawConfidence(r, view);
    case Stage::Classes:
      return detail::drawClasses(r, view);
    case Stage::Directions:
    case Stage::Labels:
      return detail::drawDirections(r, stage, view);
    case Stage::Slices:
      return detail::drawSlices(r, view);
    case Stage::Upright:
    case Stage::Normals:
      return detail::drawNormals(r, stage, view);
    case Stage::Regions:
      return detail::drawRegions(r, view);
    case Stage::Refined:
      return detail::drawRefined(r, view);
    case Stage::Floorplans:
      return detail::drawFloorplans(r);
    case Stage::Walls:
      return detail::drawWalls(r);
    case Stage::Cells:
      return detail::drawCells(r, slice);
    case Stage::Textured:
      return detail::drawTextured(r);
    case Stage::Types:
      return detail::drawTypes(r);
    case Stage::Slice:
    case Stage::Segments:
      return detail::drawSlice(r, stage, slice);
    default:
      return detail::drawModel(r, stage);
  }
}

}  // namespace

std::string missingFile(const Reconstruction& reconstruction, Stage stage) {
  for (const std::string& name : infoOf(stage).files) {
    if (!reconstruction.has(name)) return name;
  }
  return {};
}

std::size_t countSteps(const Reconstruction& reconstruction, Stage stage) {
  if (!isPlan(stage) || !missingFile(reconstruction, stage).empty()) return 0;
  if (stage != Stage::Cells) return reconstruction.report().num_slices;
  return readCells(reconstruction.file(infoOf(stage).files.front())).blocks.size();
}

Drawing makeDrawing(const Reconstruction& reconstruction, Stage stage, View view,
                    std::optional<int> slice, bool with_cloud) {
  Drawing drawing = drawStage(reconstruction, stage, view, slice);
  if (stage == Stage::Overlay || (with_cloud && canOverlay(stage))) {
    detail::layCloudOver(drawing, reconstruction);
  }
  drawing.view = view;
  drawing.subtitle = io::printable(reconstruction.report().input, 40) + ": " + drawing.subtitle;
  if (boundsOf(drawing, projectionOf(view)).empty()) {
    throw io::Failure(io::BadInput, reconstruction.file(infoOf(stage).files.back()),
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

void requireStep(std::size_t step, std::size_t num_steps) {
  if (step < num_steps) return;
  throw io::Failure(
      io::Usage, "",
      "--slice is " + std::to_string(step) + ", the last one is " + std::to_string(num_steps - 1),
      "");
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
