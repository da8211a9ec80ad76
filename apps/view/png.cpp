// SPDX-License-Identifier: BSD-3-Clause
#include "view/png.h"

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "io/output_file.h"

namespace storey::view {

void writePng(const std::string& path, vtkRenderWindow& window, int shrink) {
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(&window);
  grabber->SetInputBufferTypeToRGB();
  grabber->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(grabber->GetOutputPort());
  average->SetShrinkFactors(shrink, shrink, 1);
  average->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* const png = writer->GetResult();
  io::OutputFile file(path);
  file.write(png->GetPointer(0), static_cast<std::size_t>(png->GetNumberOfTuples()));
  file.commit();
}

}  // namespace storey::view
