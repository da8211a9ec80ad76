// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace storey::exports {

/// A facade's image at right angles, where it lies on a sheet of the textured model, in texels of
/// the sheet.
struct FacadeImage {
  std::size_t facade = 0;
  int sheet = 0;  ///< index of the image in the GLB, whose materials are named photos_<sheet>
  int left = 0;
  int top = 0;
  int columns = 0;
  int rows = 0;
  double texel = 0.0;  ///< side of a texel of the sheet, in the model's unit
  double width = 0.0;  ///< of the facade, in the model's unit
  double height = 0.0;
  double seen = 0.0;  ///< share
};

/// Shows a textured model to be turned, and facades to be measured in, in the page that
/// `writeReportPage` made, in place of those that it has; in a page of their own if there is none.
/// \param glb     bytes of the model as binary glTF, `extras` of its first node with the vertical
/// \param facades in the order in which they are shown
/// \throws io::Failure (BadInput if it is no such page, CannotCreate, IoError)
void showTexturedModel(const std::string& path, const std::string& glb,
                       const std::vector<FacadeImage>& facades);

}  // namespace storey::exports
