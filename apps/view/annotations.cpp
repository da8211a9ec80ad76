// SPDX-License-Identifier: BSD-3-Clause
#include "view/annotations.h"

#include <algorithm>
#include <cmath>

#include "view/palette.h"
#include "view/sheet.h"
#include "view/stages.h"

namespace storey::view {
namespace {

// Sizes in a picture of 1600 x 1200.
constexpr double kTitleFont = 34.0;

void addTitle(Sheet& sheet, const Layout& layout, const Drawing& drawing) {
  const double u = layout.unit;
  const double width = layout.width - 2.0 * kMargin * u;
  sheet.text(drawing.title, {kMargin * u, layout.height - 38.0 * u}, kTitleFont, width, kDark);
  sheet.text(drawing.subtitle, {kMargin * u, layout.height - 80.0 * u}, kFont, width, kGrey);
}

// Returns the height at which the legend ends.
double addLegend(Sheet& sheet, const Layout& layout, const Drawing& drawing) {
  constexpr double kSwatch = 20.0;
  const double u = layout.unit;
  const double left = layout.right + kMargin * u;
  const double room = layout.width - left - 0.5 * kMargin * u;
  double y = layout.top - 0.5 * kLine * u;
  if (!drawing.legend_title.empty()) {
    sheet.text(drawing.legend_title, {left, y}, kFont, room, kGrey);
    y -= 1.2 * kLine * u;
  }
  for (const LegendEntry& entry : drawing.legend) {
    const double half = 0.5 * kSwatch * u;
    sheet.rectangle({left, y - half}, {left + 2.0 * half, y + half}, entry.colour);
    const double indent = 1.6 * kSwatch * u;
    sheet.text(entry.text, {left + indent, y}, kFont, room - indent, kDark);
    y -= kLine * u;
  }
  return y;
}

void addBar(Sheet& sheet, const Layout& layout, const ColourBar& bar, double top) {
  constexpr double kWidth = 34.0;
  const double u = layout.unit;
  const double left = layout.right + kMargin * u;
  const double room = layout.width - left - 0.5 * kMargin * u;
  sheet.text(bar.title, {left, top - 0.5 * kLine * u}, kFont, room, kDark);
  const double high = top - 2.0 * kLine * u;
  const double low = layout.bottom + kMargin * u;
  const auto at = [&](double share) { return low + share * (high - low); };
  const auto n = static_cast<double>(bar.colours.size());
  for (std::size_t i = 0; i < bar.colours.size(); ++i) {
    const auto k = static_cast<double>(i);
    sheet.rectangle({left, at(k / n)}, {left + kWidth * u, at((k + 1.0) / n)}, bar.colours[i]);
  }
  const double right = left + kWidth * u;
  sheet.line({{left, low}, {right, low}, {right, high}, {left, high}, {left, low}}, kDark, 1.5);
  for (const Tick& tick : bar.ticks) {
    sheet.line({{right, at(tick.at)}, {right + 8.0 * u, at(tick.at)}}, kDark, 1.5);
    sheet.text(tick.text, {right + 16.0 * u, at(tick.at)}, kFont, room - (kWidth + 16.0) * u,
               kDark);
  }
}

void addArrow(Sheet& sheet, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double unit) {
  constexpr double kHead = 12.0;
  const Eigen::Vector2d along = kHead * unit * (to - from).normalized();
  const Eigen::Vector2d across = 0.4 * Eigen::Vector2d(-along.y(), along.x());
  sheet.line({from, to - 0.8 * along}, kDark, 2.5);
  sheet.polygon({to, to - along + across, to - along - across}, kDark);
}

// The axes as arrows; one that points at the eye is a dot in a ring.
void addAxes(Sheet& sheet, const Layout& layout, const Projection& projection) {
  constexpr double kLength = 62.0;
  constexpr double kLeast = 0.1;  // of the length, below which an axis is seen end on
  const char* const names[] = {"x", "y", "z = up"};
  const double u = layout.unit;
  const Eigen::Vector2d origin(95.0 * u, 48.0 * u);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d seen = projection.apply(Eigen::Vector3d::Unit(axis));
    if (std::abs(seen.z()) > 1.0 - kLeast * kLeast) {
      std::vector<Eigen::Vector2d> ring;
      for (int k = 0; k <= 24; ++k) {
        const double angle = 2.0 * M_PI * k / 24.0;
        ring.push_back(origin + 9.0 * u * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
      // The axis to the south eye is -y: a ring without a dot would be y going away.
      sheet.polygon(ring, {255, 255, 255});
      sheet.line(ring, kDark, 2.0);
      const double r = 3.0 * u;
      if (seen.z() > 0.0) sheet.rectangle(origin.array() - r, origin.array() + r, kDark);
      sheet.text(names[axis], origin + Eigen::Vector2d(-14.0 * u, -26.0 * u), kFont, 90.0 * u,
                 kDark);
      continue;
    }
    const Eigen::Vector2d to = origin + kLength * u * seen.head<2>();
    addArrow(sheet, origin, to, u);
    const Eigen::Vector2d beyond = to + 16.0 * u * seen.head<2>().normalized();
    sheet.text(names[axis], beyond, kFont, 90.0 * u, kDark, Align::Centre);
  }
}

void addScaleBar(Sheet& sheet, const Layout& layout, const Projection& projection, double pixels) {
  constexpr double kMaxLength = 300.0;
  const double u = layout.unit;
  const double length = roundLength(kMaxLength * u / (pixels * projection.shortening));
  const double left = 260.0 * u;
  const double right = left + length * pixels * projection.shortening;
  const double y = 40.0 * u;
  const double end = 8.0 * u;
  sheet.line({{left, y + end}, {left, y - end}}, kDark, 2.5);
  sheet.line({{left, y}, {right, y}}, kDark, 2.5);
  sheet.line({{right, y + end}, {right, y - end}}, kDark, 2.5);
  const bool oblique = projection.towards.cwiseAbs().maxCoeff() < 1.0 - 1e-9;
  const std::string along = projection.shortening < 1.0 ? " along each axis"
                            : oblique                   ? " across the line of sight"
                                                        : "";
  sheet.text(detail::shortNumber(length) + along + " (unit of the cloud)", {left, y + 30.0 * u},
             kFont, layout.width - left, kDark);
}

}  // namespace

void addAnnotations(vtkRenderer& renderer, const Layout& layout, const Drawing& drawing,
                    const Projection& projection, double pixels) {
  Sheet sheet(renderer, layout);
  addTitle(sheet, layout, drawing);
  const double legend_end = addLegend(sheet, layout, drawing);
  if (!drawing.bar.colours.empty()) addBar(sheet, layout, drawing.bar, legend_end);
  addAxes(sheet, layout, projection);
  addScaleBar(sheet, layout, projection, pixels);
}

}  // namespace storey::view
