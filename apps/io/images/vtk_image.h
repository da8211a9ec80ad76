// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/rgb_image.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>

namespace storey::io {

/// An image as VTK has it, whose rows go from the bottom up.
inline vtkNew<vtkImageData> toVtkImage(const RgbImage& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < image.height; ++y) {
    const auto* const row = image.at(0, y);
    std::copy(row, row + 3 * image.width,
              static_cast<unsigned char*>(data->GetScalarPointer(0, image.height - 1 - y, 0)));
  }
  return data;
}

}  // namespace storey::io
