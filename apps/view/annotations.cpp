// SPDX-License-Identifier: BSD-3-Clause
#include "view/annotations.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

#include "view/palette.h"
#include "view/stages.h"

namespace storey::view {
namespace {

using Points = std::vector<Eigen::Vector2d>;

// Sizes in a picture of 1600 x 1200.
constexpr double kTitleFont = 34.0;
constexpr double kFont = 21.0;
constexpr double kLine = 30.0;  // from one line of the legend to the next
constexpr double kMargin = 24.0;
constexpr Colour kGrey{95, 95, 100};

enum class Align { Left, Centre, Right };

// Draws flat things onto a window, in its pixels.
class Sheet {
 public:
  Sheet(vtkRenderer& renderer, const Layout& layout) : renderer_(renderer), layout_(layout) {}

  /// Text with its middle height at `at`, set smaller if it would be wider than `max_width`.
  void text(const std::string& text, const Eigen::Vector2d& at, double font, double max_width,
            Colour colour, Align align = Align::Left) {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    vtkTextProperty* const style = actor->GetTextProperty();
    style->SetFontFamilyToArial();
    style->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    style->SetVerticalJustificationToCentered();
    style->SetJustification(align == Align::Left     ? VTK_TEXT_LEFT
                            : align == Align::Centre ? VTK_TEXT_CENTERED
                                                     : VTK_TEXT_RIGHT);
    style->SetFontSize(static_cast<int>(std::lround(font * layout_.unit)));
    double size[2] = {0.0, 0.0};
    actor->GetSize(&renderer_, size);
    if (size[0] > max_width) {
      style->SetFontSize(static_cast<int>(font * layout_.unit * max_width / size[0]));
    }
    actor->SetPosition(at.x(), at.y());
    renderer_.AddActor2D(actor);
  }

  void polygon(const Points& corners, Colour colour) { add(corners, colour, true, 1.0); }

  void line(const Points& corners, Colour colour, double width) {
    add(corners, colour, false, width);
  }

  void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Colour colour) {
    polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, colour);
  }

 private:
  void add(const Points& corners, Colour colour, bool filled, double width) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(static_cast<int>(corners.size()));
    for (const Eigen::Vector2d& p : corners) {
      cells->InsertCellPoint(points->InsertNextPoint(p.x(), p.y(), 0.0));
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    if (filled) {
      data->SetPolys(cells);
    } else {
      data->SetLines(cells);
    }
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    actor->GetProperty()->SetLineWidth(static_cast<float>(width * layout_.unit));
    renderer_.AddActor2D(actor);
  }

  vtkRenderer& renderer_;
  const Layout& layout_;
};

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
      Points ring;
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
  const std::string along = projection.shortening < 1.0 ? " along each axis" : "";
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
