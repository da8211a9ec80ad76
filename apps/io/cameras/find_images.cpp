// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "io/cameras/camera_formats.h"
#include "io/failure.h"
#include "io/image_header.h"

namespace storey::io {
namespace {

namespace fs = std::filesystem;

bool isImage(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {".jpg", ".jpeg", ".png", ".tif", ".tiff"}) {
    if (extension == known) return true;
  }
  return false;
}

/// The images of a folder by name.
std::vector<fs::path> imagesOf(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (isImage(entry.path())) images.push_back(entry.path());
  }
  if (error) throw Failure(MissingInput, folder, "cannot be listed", "name the photos' folder");
  std::sort(images.begin(), images.end());
  return images;
}

std::string findImage(const Photo& photo, const std::string& folder,
                      const std::vector<fs::path>& images, bool in_order) {
  const fs::path name(photo.name);
  std::error_code ignored;
  for (const fs::path& candidate :
       {fs::path(folder) / name.relative_path(), fs::path(folder) / name.filename()}) {
    if (!photo.name.empty() && fs::is_regular_file(candidate, ignored)) return candidate.string();
  }
  for (const fs::path& image : images) {  // PMVS's names have no extension
    if (!photo.name.empty() && image.stem() == name) return image.string();
  }
  return in_order && photo.index < images.size() ? images[photo.index].string() : std::string();
}

void takeSize(const ImageHeader& header, Photo& photo) {
  Camera& camera = photo.camera;
  if (camera.width == 0) {
    camera.width = header.width();
    camera.height = header.height();
    if (photo.principal_from_middle) {
      camera.principal += 0.5 * Eigen::Vector2d(camera.width, camera.height);
      photo.principal_from_middle = false;
    }
    return;
  }
  const bool as_seen = camera.width == header.width() && camera.height == header.height();
  const bool as_stored =
      camera.width == header.stored_width && camera.height == header.stored_height;
  if (as_seen || as_stored) return;
  throw Failure(BadInput, photo.image,
                "has " + std::to_string(header.width()) + " x " + std::to_string(header.height()) +
                    " pixels, its camera " + std::to_string(camera.width) + " x " +
                    std::to_string(camera.height),
                "give the photos that the cameras were computed from");
}

}  // namespace

void findImages(const std::string& folder, CameraSet& cameras) {
  const std::vector<fs::path> images = imagesOf(folder);
  const bool nameless = cameras.format == "PMVS" || cameras.photos.front().name.empty();
  const bool in_order = nameless && images.size() > cameras.photos.back().index;
  for (Photo& photo : cameras.photos) {
    photo.image = findImage(photo, folder, images, in_order);
    if (photo.image.empty()) {
      throw Failure(
          MissingInput, folder,
          "has no image '" + photo.name + "' (number " + std::to_string(photo.index) + ")",
          "name the folder that the photos' names are relative to");
    }
    takeSize(readImageHeader(photo.image), photo);
  }
}

}  // namespace storey::io
