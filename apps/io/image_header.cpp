// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_header.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "io/input_file.h"

namespace storey::io {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 30;

/// Numbers of either byte order at places of a piece of memory; 0 outside.
class Bytes {
 public:
  Bytes(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  std::uint32_t number(std::uint64_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = big_endian_ ? i : size - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at) + place]);
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool big_endian_;
};

bool isTiff(std::string_view bytes) {
  return bytes.substr(0, 4) == std::string_view("II*\0", 4) ||
         bytes.substr(0, 4) == std::string_view("MM\0*", 4);
}

/// The tags of the first directory of a TIFF, which is also how EXIF is written.
void readTiffTags(std::string_view tiff, ImageHeader& header) {
  constexpr std::uint32_t kWidth = 256;
  constexpr std::uint32_t kHeight = 257;
  constexpr std::uint32_t kOrientation = 274;
  constexpr std::uint32_t kShort = 3;
  constexpr std::uint64_t kEntryBytes = 12;
  if (!isTiff(tiff)) return;
  const Bytes bytes(tiff, tiff[0] == 'M');
  const std::uint64_t directory = bytes.number(4, 4);
  const std::uint32_t count = bytes.number(directory, 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t entry = directory + 2 + kEntryBytes * i;
    const std::uint32_t tag = bytes.number(entry, 2);
    const std::size_t size = bytes.number(entry + 2, 2) == kShort ? 2 : 4;
    const auto value = static_cast<std::uint64_t>(bytes.number(entry + 8, size));
    const int side = static_cast<int>(std::min<std::uint64_t>(value, kMaxPixels));
    if (tag == kWidth) header.stored_width = side;
    if (tag == kHeight) header.stored_height = side;
    if (tag == kOrientation && value >= 1 && value <= 8) header.orientation = side;
  }
}

// Segments of a marker (FF xx) and a length each, up to the frame's, which has the size.
void readJpeg(InputFile& file, ImageHeader& header) {
  file.skip(2);
  for (;;) {
    const unsigned char* start = file.take(2);
    if (start[0] != 0xff) file.failAtByte("is no JPEG segment");
    unsigned marker = start[1];
    while (marker == 0xff) marker = *file.take(1);  // fill bytes
    const unsigned char* length_bytes = file.take(2);
    const std::size_t length = static_cast<std::size_t>(length_bytes[0] << 8 | length_bytes[1]);
    if (length < 2) file.failAtByte("a JPEG segment has no length");
    const std::string_view body(reinterpret_cast<const char*>(file.take(length - 2)), length - 2);
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      const Bytes bytes(body, true);
      header.stored_height = static_cast<int>(bytes.number(1, 2));
      header.stored_width = static_cast<int>(bytes.number(3, 2));
      return;
    }
    constexpr std::string_view kExif("Exif\0\0", 6);
    if (marker == 0xe1 && body.substr(0, 6) == kExif) {
      ImageHeader exif;
      readTiffTags(body.substr(6), exif);
      header.orientation = exif.orientation;
    }
  }
}

}  // namespace

ImageHeader readImageHeader(const std::string& path) {
  InputFile file(path, kMaxImageBytes);
  ImageHeader header;
  const std::string_view start = file.peek(24);
  if (start.substr(0, 3) == "\xff\xd8\xff") {
    readJpeg(file, header);
  } else if (start.substr(0, 8) == std::string_view("\x89PNG\r\n\x1a\n", 8)) {
    header.format = ImageFormat::Png;
    const Bytes bytes(start, true);
    header.stored_width =
        static_cast<int>(std::min<std::uint64_t>(bytes.number(16, 4), kMaxPixels));
    header.stored_height =
        static_cast<int>(std::min<std::uint64_t>(bytes.number(20, 4), kMaxPixels));
  } else if (isTiff(start)) {
    header.format = ImageFormat::Tiff;
    readTiffTags(file.peek(static_cast<std::size_t>(file.size())), header);
  } else {
    file.fail("is neither a JPEG, a PNG nor a TIFF image", "convert the photo to one of them");
  }
  const auto pixels = static_cast<std::uint64_t>(header.stored_width) *
                      static_cast<std::uint64_t>(header.stored_height);
  if (header.stored_width <= 0 || header.stored_height <= 0 || pixels > kMaxPixels) {
    file.fail("has no size, or more than " + std::to_string(kMaxPixels) + " pixels");
  }
  return header;
}

}  // namespace storey::io
