// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/camera.h>
#include <storey/surface/rgb_image.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace storey::cameras {

/// What the cameras are checked against.
struct CloudPoints {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;  ///< empty, or parallel to `positions`; 0 where unknown
};

/// Indices of the points that a photo shows: inside the image, facing the camera, and no point of
/// the cloud in front of them. What is in front is told from a depth map of cells that about 16
/// points fall into if the image is full; surfaces seen at a grazing angle partly hide themselves.
std::vector<std::size_t> shownPoints(const CloudPoints& cloud, const Camera& camera);

/// How well a photo agrees with the others about the brightness of the points it shows.
struct PhotoAgreement {
  std::size_t points = 0;    ///< that this photo and another one show
  double correlation = 0.0;  ///< of its brightness with the mean of the others', in [-1, 1]
};

/// If the cameras are right, a point has the same brightness in all photos but for a factor of
/// exposure, and the correlations are near 1; with wrong cameras they are near 0. Brightness is the
/// mean over 3 x 3 pixels.
std::vector<PhotoAgreement> measureAgreement(const CloudPoints& cloud,
                                             const std::vector<Camera>& cameras,
                                             const std::vector<RgbImage>& images);

/// Mean of the photos' correlations; those that share too few points with others count as 0.
double meanCorrelation(const std::vector<PhotoAgreement>& agreement);

/// A common mistake, and how well the photos would agree if it were undone.
struct Suspicion {
  std::string mistake;
  double correlation = 0.0;
};

/// Undoes one common mistake after the other: mirrored images, cameras that look along -z, poses
/// that are camera to world, principal points in the wrong place, intrinsics of an image of another
/// size, positions in another unit. Sorted by the agreement reached, best first.
std::vector<Suspicion> suspectMistakes(const CloudPoints& cloud, const std::vector<Camera>& cameras,
                                       const std::vector<RgbImage>& images);

}  // namespace storey::cameras
