// SPDX-License-Identifier: BSD-3-Clause
#include "view/scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "io/images/vtk_image.h"

namespace storey::view {
namespace {

// Colours are shown as they are, the legend's equal the scene's: no light.
vtkNew<vtkActor> unlitActor(vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToDefault();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkNew<vtkUnsignedCharArray> toVtk(const std::vector<Colour>& colours) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const unsigned char rgb[3] = {colours[i].r, colours[i].g, colours[i].b};
    array->SetTypedTuple(static_cast<vtkIdType>(i), rgb);
  }
  return array;
}

// Wide enough that points on a surface close it, as if the whole cloud were one layer.
double closingSize(const PointSet& set, const ProjectedBounds& bounds, double pixels) {
  constexpr double kOverlap = 2.2;
  constexpr double kMost = 8.0;
  const Eigen::Vector3d size = pixels * (bounds.max - bounds.min);
  const double area = size.x() * size.y() / static_cast<double>(set.positions.size());
  return std::clamp(kOverlap * std::sqrt(area), 1.0, kMost);
}

void addPoints(vtkRenderer& renderer, const PointSet& set, double size) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const auto n = static_cast<vtkIdType>(set.positions.size());
  points->SetNumberOfPoints(n);
  cells->InsertNextCell(static_cast<int>(n));
  for (vtkIdType i = 0; i < n; ++i) {
    points->SetPoint(i, set.positions[static_cast<std::size_t>(i)].data());
    cells->InsertCellPoint(i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetPointData()->SetScalars(toVtk(set.colours));
  const vtkNew<vtkActor> actor = unlitActor(data);
  actor->GetProperty()->SetPointSize(static_cast<float>(size));
  renderer.AddActor(actor);
}

vtkActor* addLines(vtkRenderer& renderer, const LineSet& set, double width) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto& line : set.lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Eigen::Vector3d& p : line) {
      cells->InsertCellPoint(points->InsertNextPoint(p.data()));
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetCellData()->SetScalars(toVtk(set.colours));
  const vtkNew<vtkActor> actor = unlitActor(data);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer.AddActor(actor);
  return actor;
}

void addFacets(vtkRenderer& renderer, const FacetSet& set) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& p : set.vertices) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const std::array<int, 3>& triangle : set.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(toVtk(set.colours));
  const vtkNew<vtkActor> actor = unlitActor(data);
  actor->GetProperty()->SetOpacity(set.opacity);
  renderer.AddActor(actor);
}

vtkNew<vtkTexture> toVtk(const RgbImage& image) {
  const vtkNew<vtkImageData> data = io::toVtkImage(image);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(data);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  return texture;
}

void addTextured(vtkRenderer& renderer, const TexturedSet& set) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < set.vertices.size(); ++i) {
    points->InsertNextPoint(set.vertices[i].data());
    coordinates->InsertNextTuple(set.coordinates[i].data());
  }
  vtkNew<vtkCellArray> cells;
  for (const std::array<int, 3>& triangle : set.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetTCoords(coordinates);
  const vtkNew<vtkActor> actor = unlitActor(data);
  actor->SetTexture(toVtk(set.image));
  actor->GetProperty()->BackfaceCullingOn();
  renderer.AddActor(actor);
}

}  // namespace

std::vector<vtkActor*> addScene(vtkRenderer& renderer, const Drawing& drawing, const Layout& layout,
                                double pixels) {
  const ProjectedBounds bounds = boundsOf(drawing, projectionOf(drawing.view));
  for (const FacetSet& set : drawing.facets) addFacets(renderer, set);
  for (const TexturedSet& set : drawing.textured) addTextured(renderer, set);
  for (const PointSet& set : drawing.points) {
    if (set.positions.empty()) continue;
    const double size = set.size > 0.0 ? set.size * layout.unit : closingSize(set, bounds, pixels);
    addPoints(renderer, set, size);
  }
  std::vector<vtkActor*> lines;
  for (const LineSet& set : drawing.lines) {
    if (set.lines.empty()) continue;
    lines.push_back(addLines(renderer, set, set.width * layout.unit));
  }
  return lines;
}

void liftLines(const std::vector<vtkActor*>& lines, const Drawing& drawing, const Layout& layout,
               const Eigen::Vector3d& towards, double pixels) {
  constexpr double kLiftPixels = 2.0;
  if (drawing.facets.empty()) return;
  const Eigen::Vector3d lift = kLiftPixels * layout.unit / pixels * towards;
  for (vtkActor* const actor : lines) actor->SetPosition(lift.x(), lift.y(), lift.z());
}

void aimCamera(vtkRenderer& renderer, const Layout& layout, const Projection& projection,
               const ProjectedBounds& bounds, double pixels) {
  // The camera looks at the middle of the window; the bounds are to be centred in the scene.
  const double aside = 0.5 * (layout.width - layout.left - layout.right) / pixels;
  const double above = 0.5 * (layout.height - layout.bottom - layout.top) / pixels;
  const Eigen::Vector3d middle =
      0.5 * (bounds.min + bounds.max) + Eigen::Vector3d(aside, above, 0.0);
  const Eigen::Vector3d focus =
      middle.x() * projection.right + middle.y() * projection.up + middle.z() * projection.towards;
  const double depth = bounds.max.z() - bounds.min.z();
  const double room = 0.1 * depth + layout.height / pixels;  // before and behind; never 0
  const Eigen::Vector3d eye = focus + (0.5 * depth + room) * projection.towards;
  vtkCamera* const camera = renderer.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(projection.up.x(), projection.up.y(), projection.up.z());
  camera->SetParallelScale(0.5 * layout.height / pixels);
  camera->SetClippingRange(0.5 * room, depth + 1.5 * room);
}

}  // namespace storey::view
