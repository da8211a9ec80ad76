// SPDX-License-Identifier: BSD-3-Clause
#include "io/images/image_files.h"

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>
#include <vtkTIFFReader.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

#include "io/failure.h"
#include "io/image_header.h"
#include "io/images/vtk_image.h"
#include "io/input_file.h"
#include "io/output_file.h"

namespace storey::io {
namespace {

constexpr const char* kHint = "save the photo again, with 8 bits a channel";

vtkSmartPointer<vtkImageReader2> makeReader(ImageFormat format) {
  switch (format) {
    case ImageFormat::Jpeg:
      return vtkSmartPointer<vtkJPEGReader>::New();
    case ImageFormat::Png:
      return vtkSmartPointer<vtkPNGReader>::New();
    default: {
      const auto reader = vtkSmartPointer<vtkTIFFReader>::New();
      constexpr unsigned kAsStored = 4;       // for VTK, the first row is the lowest
      reader->SetOrientationType(kAsStored);  // turning is done here, for all formats alike
      return reader;
    }
  }
}

/// The end that every whole file has. Decoders fill what is missing with grey.
void checkEnd(const std::string& path, ImageFormat format) {
  constexpr std::uint64_t kTail = 4096;  // some cameras write a few bytes behind the end
  if (format == ImageFormat::Tiff) return;
  InputFile file(path, kMaxImageBytes);
  if (file.size() > kTail) file.skip(file.size() - kTail);
  const std::string_view tail = file.peek(kTail);
  const bool whole = tail.find(format == ImageFormat::Png ? "IEND" : "\xff\xd9") != tail.npos;
  if (!whole) file.fail("ends early");
}

/// The image as it is stored.
RgbImage decode(const std::string& path, const ImageHeader& header) {
  checkEnd(path, header.format);
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by a Failure, in one line
  const vtkSmartPointer<vtkImageReader2> reader = makeReader(header.format);
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* const data = reader->GetOutput();
  const int* const size = data->GetDimensions();
  const bool as_declared = size[0] == header.stored_width && size[1] == header.stored_height;
  const int channels = data->GetNumberOfScalarComponents();
  if (reader->GetErrorCode() != 0 || !as_declared || data->GetScalarType() != VTK_UNSIGNED_CHAR ||
      data->GetScalarPointer() == nullptr || channels < 1 || channels > 4) {
    throw Failure(BadInput, path, "cannot be decoded", kHint);
  }
  const bool grey = channels < 3;
  const auto* from = static_cast<const unsigned char*>(data->GetScalarPointer());
  RgbImage image(size[0], size[1]);
  for (int y = size[1] - 1; y >= 0; --y) {  // VTK's rows go up
    for (int x = 0; x < size[0]; ++x, from += channels) {
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = from[grey ? 0 : c];
    }
  }
  return image;
}

/// Orientations 2 to 4 mirror or turn the picture by 180 degrees; 5 to 8 exchange its axes first.
RgbImage turnedUpright(const RgbImage& stored, int orientation) {
  const bool exchanged = orientation >= 5;
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_below =
      orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  RgbImage image(exchanged ? stored.height : stored.width,
                 exchanged ? stored.width : stored.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int column = from_right ? image.width - 1 - x : x;
      const int row = from_below ? image.height - 1 - y : y;
      const auto* const pixel = exchanged ? stored.at(row, column) : stored.at(column, row);
      std::copy(pixel, pixel + 3, image.at(x, y));
    }
  }
  return image;
}

/// The bytes of a file as one of VTK's writers makes it.
template <typename Writer>
std::string encode(Writer& writer, const RgbImage& image) {
  const vtkNew<vtkImageData> data = toVtkImage(image);
  writer.SetInputData(data);
  writer.WriteToMemoryOn();
  writer.Write();
  vtkUnsignedCharArray* const bytes = writer.GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfTuples())};
}

}  // namespace

RgbImage readImage(const std::string& path) {
  const ImageHeader header = readImageHeader(path);
  RgbImage stored = decode(path, header);
  return header.orientation == 1 ? stored : turnedUpright(stored, header.orientation);
}

RgbImage readImage(const Photo& photo) {
  const ImageHeader header = readImageHeader(photo.image);
  RgbImage stored = decode(photo.image, header);
  const bool as_seen =
      photo.camera.width == header.width() && photo.camera.height == header.height();
  if (!as_seen || header.orientation == 1) return stored;
  return turnedUpright(stored, header.orientation);
}

void writePng(const std::string& path, const RgbImage& image) {
  vtkNew<vtkPNGWriter> writer;
  OutputFile file(path);
  file.write(encode(*writer, image));
  file.commit();
}

std::string encodeJpeg(const RgbImage& image) {
  constexpr int kQuality = 92;  // differs from the image by less than a photo's noise
  vtkNew<vtkJPEGWriter> writer;
  writer->SetQuality(kQuality);
  return encode(*writer, image);
}

}  // namespace storey::io
