// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>

#include <cstdlib>

#include "io/failure.h"
#include "io/images/image_files.h"
#include "temporary_files.h"

namespace storey {
namespace {

using test::TemporaryDirectory;

/// Every pixel differs from every other one, and smoothly, for JPEG's sake.
RgbImage gradient(int width, int height) {
  RgbImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(4 * x);
      image.at(x, y)[1] = static_cast<std::uint8_t>(6 * y);
      image.at(x, y)[2] = static_cast<std::uint8_t>(100 + x - y);
    }
  }
  return image;
}

template <typename Writer>
void writeByVtk(const std::string& path, const RgbImage& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        data->SetScalarComponentFromDouble(x, image.height - 1 - y, 0, c, image.at(x, y)[c]);
      }
    }
  }
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
}

/// An uncompressed TIFF by its specification: rows from the top (the default orientation).
std::string tiffOf(const RgbImage& image) {
  const auto bytes = [](std::size_t value, int size) {
    std::string text;
    for (int i = 0; i < size; ++i) text += static_cast<char>(value >> 8 * i & 255);
    return text;
  };
  const std::string pixels(image.channels.begin(), image.channels.end());
  const std::size_t tags[][2] = {{256, static_cast<std::size_t>(image.width)},
                                 {257, static_cast<std::size_t>(image.height)},
                                 {258, 8},  // bits a channel
                                 {259, 1},  // not compressed
                                 {262, 2},  // RGB
                                 {273, 8},  // where the pixels are
                                 {277, 3},  // channels
                                 {278, static_cast<std::size_t>(image.height)},
                                 {279, pixels.size()}};
  std::string text = std::string("II*\0", 4) + bytes(8 + pixels.size(), 4) + pixels;
  text += bytes(std::size(tags), 2);
  for (const auto& [tag, value] : tags) {
    text += bytes(tag, 2) + bytes(4, 2) + bytes(1, 4) + bytes(value, 4);
  }
  return text + bytes(0, 4);
}

int largestDifference(const RgbImage& a, const RgbImage& b) {
  if (a.width != b.width || a.height != b.height) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    largest = std::max(largest, std::abs(a.channels[i] - b.channels[i]));
  }
  return largest;
}

TEST(Images, ThreeFormatsGiveTheSamePicture) {
  const TemporaryDirectory directory;
  const RgbImage image = gradient(48, 32);
  io::writePng(directory.file("a.png"), image);
  EXPECT_EQ(largestDifference(io::readImage(directory.file("a.png")), image), 0);
  directory.write("a.tif", tiffOf(image));
  EXPECT_EQ(largestDifference(io::readImage(directory.file("a.tif")), image), 0);
  writeByVtk<vtkJPEGWriter>(directory.file("a.jpg"), image);
  EXPECT_LE(largestDifference(io::readImage(directory.file("a.jpg")), image), 12);
}

/// The JPEG with an EXIF orientation put in after its first two bytes.
std::string withOrientation(const std::string& jpeg, char orientation) {
  std::string exif(
      "\xff\xe1\x00\x22"
      "Exif\0\0"
      "MM\0*\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0",
      29);
  exif += orientation;
  exif += std::string(6, '\0');
  return jpeg.substr(0, 2) + exif + jpeg.substr(2);
}

// Orientation o says where the picture's top left corner is stored: the corner's colour, and that
// of the top right corner, must be found there.
TEST(Images, OrientationIsObeyed) {
  const TemporaryDirectory directory;
  const RgbImage stored = gradient(48, 32);
  writeByVtk<vtkJPEGWriter>(directory.file("a.jpg"), stored);
  const std::string jpeg = test::readAll(directory.file("a.jpg"));
  struct Corners {
    bool top_left_x, top_left_y, top_right_x, top_right_y;  // stored at the far end of that axis
  };
  const Corners corners[] = {{false, false, true, false}, {true, false, false, false},
                             {true, true, false, true},   {false, true, true, true},
                             {false, false, false, true}, {false, true, false, false},
                             {true, true, true, false},   {true, false, true, true}};
  for (int o = 1; o <= 8; ++o) {
    const RgbImage seen =
        io::readImage(directory.write("b.jpg", withOrientation(jpeg, static_cast<char>(o))));
    ASSERT_EQ(seen.width, o >= 5 ? 32 : 48) << o;
    const Corners& c = corners[o - 1];
    const auto* const top_left = stored.at(c.top_left_x ? 47 : 0, c.top_left_y ? 31 : 0);
    const auto* const top_right = stored.at(c.top_right_x ? 47 : 0, c.top_right_y ? 31 : 0);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(seen.at(0, 0)[k], top_left[k], 12) << o;
      EXPECT_NEAR(seen.at(seen.width - 1, 0)[k], top_right[k], 12) << o;
    }
  }
}

TEST(Images, APhotoIsReadInThePixelsOfItsCamera) {
  const TemporaryDirectory directory;
  writeByVtk<vtkJPEGWriter>(directory.file("a.jpg"), gradient(48, 32));
  const std::string jpeg = test::readAll(directory.file("a.jpg"));
  io::Photo photo;
  photo.image = directory.write("b.jpg", withOrientation(jpeg, 6));
  photo.camera.width = 32;
  photo.camera.height = 48;
  EXPECT_EQ(io::readImage(photo).width, 32);
  std::swap(photo.camera.width, photo.camera.height);
  EXPECT_EQ(io::readImage(photo).width, 48);
}

TEST(Images, WhatCannotBeDecodedIsRefused) {
  const TemporaryDirectory directory;
  io::writePng(directory.file("a.png"), gradient(48, 32));
  const std::string png = test::readAll(directory.file("a.png"));
  const std::string cut = directory.write("cut.png", png.substr(0, png.size() / 2));
  EXPECT_THROW(io::readImage(cut), io::Failure);
  writeByVtk<vtkJPEGWriter>(directory.file("a.jpg"), gradient(48, 32));
  const std::string jpeg = test::readAll(directory.file("a.jpg"));
  const std::string grey_below = directory.write("cut.jpg", jpeg.substr(0, jpeg.size() - 100));
  EXPECT_THROW(io::readImage(grey_below), io::Failure);
  EXPECT_THROW(io::readImage(directory.write("text.jpg", "no image")), io::Failure);
}

}  // namespace
}  // namespace storey
