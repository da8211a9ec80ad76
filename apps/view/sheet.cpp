// SPDX-License-Identifier: BSD-3-Clause
#include "view/sheet.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>

namespace storey::view {

void Sheet::text(const std::string& text, const Eigen::Vector2d& at, double font, double max_width,
                 Colour colour, Align align) {
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

void Sheet::add(const Points& corners, Colour colour, bool filled, double width) {
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
  add(data, colour, width);
}

void Sheet::segments(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& ends,
                     Colour colour, double width) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : ends) {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(points->InsertNextPoint(a.x(), a.y(), 0.0));
    cells->InsertCellPoint(points->InsertNextPoint(b.x(), b.y(), 0.0));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  add(data, colour, width);
}

void Sheet::add(vtkPolyData* data, Colour colour, double width) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width * layout_.unit));
  renderer_.AddActor2D(actor);
}

}  // namespace storey::view
