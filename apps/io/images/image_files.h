// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/rgb_image.h>

#include <string>

#include "io/cameras/camera_set.h"

namespace storey::io {

/// Reads a JPEG, PNG or TIFF file of 8 bits a channel (grey, with or without alpha, colour) as it
/// is meant to be seen, its orientation tag obeyed. \throws Failure (BadInput, MissingInput,
/// IoError)
RgbImage readImage(const std::string& path);

/// The image of a photo that `findImages` found, in the pixels of its camera: as it is meant to be
/// seen if that is of the camera's size, else as it is stored (programs that compute cameras often
/// ignore the orientation tag).
RgbImage readImage(const Photo& photo);

/// Writes a PNG. \throws Failure (CannotCreate, IoError)
void writePng(const std::string& path, const RgbImage& image);

/// The bytes of a JPEG file.
std::string encodeJpeg(const RgbImage& image);

}  // namespace storey::io
