// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace storey::io {

constexpr std::uint64_t kMaxImageBytes = std::uint64_t{4} << 30;  ///< largest file read

enum class ImageFormat { Jpeg, Png, Tiff };

/// What an image file says of itself before it is decoded.
struct ImageHeader {
  ImageFormat format = ImageFormat::Jpeg;
  int stored_width = 0;   ///< pixels as they are stored
  int stored_height = 0;  ///< pixels as they are stored
  /// Tag 274 of TIFF and EXIF, 1 to 8: which side of the picture the first stored row (of 5 to 8:
  /// column) is. 1: nothing is to be turned.
  int orientation = 1;

  bool turned() const { return orientation >= 5; }
  int width() const { return turned() ? stored_height : stored_width; }   ///< as meant to be seen
  int height() const { return turned() ? stored_width : stored_height; }  ///< as meant to be seen
};

/// Reads the header of a JPEG, PNG or TIFF file, told apart by content.
/// \throws Failure (BadInput, MissingInput, IoError)
ImageHeader readImageHeader(const std::string& path);

}  // namespace storey::io
