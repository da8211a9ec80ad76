// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/camera.h>

#include <cstddef>
#include <string>
#include <vector>

namespace storey::io {

/// A photo as a camera file describes it.
struct Photo {
  /// As the file has it; empty where the format has no names. Never a path to write to.
  std::string name;
  /// Place of the photo in the file, from 0, photos without a camera counted: formats without
  /// names take the images of a folder in this order.
  std::size_t index = 0;
  Camera camera;  ///< width and height are 0 where the format does not say
  /// The format counts pixels from the middle of an image whose size it does not know.
  bool principal_from_middle = false;
  std::string image;  ///< file of the image, once `findImages` has found it
};

/// What a structure-from-motion program left: photos with cameras, and the points it saw.
struct CameraSet {
  std::vector<Photo> photos;            ///< in the order of the file
  std::vector<Eigen::Vector3d> points;  ///< sparse points, in the cameras' world
  std::string format;                   ///< e.g. "COLMAP text"
};

/// Reads cameras from `path`, told apart by content:
///   - a COLMAP model, text or binary: the folder of `cameras`, `images` and, if there, `points3D`
///     (.txt or .bin), or one above with it in `sparse` or `sparse/0`;
///   - Bundler: a `bundle.out`, or the folder that it is in; names from `list.txt` beside it;
///   - PMVS: the folder of `00000000.txt`, ..., or one above with it in `txt`.
/// No number in the files is trusted. Photos that the file lists without a camera (Bundler's
/// focal length 0) are left out.
/// \throws Failure (BadInput, MissingInput, IoError)
CameraSet readCameras(const std::string& path);

/// Finds the image of each photo in a folder: by its name there, by the last part of the name, or,
/// where the format has no names, by its number or its place among the images of the folder.
/// Where the format does not say the size, takes it from the image; else checks it: the size must
/// be the image's as it is meant to be seen (its orientation tag obeyed).
/// \throws Failure (BadInput, MissingInput, IoError)
void findImages(const std::string& folder, CameraSet& cameras);

}  // namespace storey::io
