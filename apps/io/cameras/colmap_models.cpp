// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iterator>

#include "io/cameras/camera_formats.h"

namespace storey::io {
namespace {

struct Model {
  std::string_view name;
  std::size_t num_parameters;
  bool one_focal_length;
};

// In the order of COLMAP's numbers.
constexpr Model kModels[] = {
    {"SIMPLE_PINHOLE", 3, true},         // f cx cy
    {"PINHOLE", 4, false},               // fx fy cx cy
    {"SIMPLE_RADIAL", 4, true},          // f cx cy k
    {"RADIAL", 5, true},                 // f cx cy k1 k2
    {"OPENCV", 8, false},                // fx fy cx cy k1 k2 p1 p2
    {"OPENCV_FISHEYE", 8, false},        // fx fy cx cy k1 k2 k3 k4
    {"FULL_OPENCV", 12, false},          // fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6
    {"FOV", 5, false},                   // fx fy cx cy omega
    {"SIMPLE_RADIAL_FISHEYE", 4, true},  // f cx cy k
    {"RADIAL_FISHEYE", 5, true},         // f cx cy k1 k2
    {"THIN_PRISM_FISHEYE", 12, false},   // fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1
};

Lens lensOf(int model, const double* k) {
  switch (model) {
    case 2:
      return Lens::perspective({k[0], 0.0, 0.0});
    case 3:
      return Lens::perspective({k[0], k[1], 0.0});
    case 4:
      return Lens::perspective({k[0], k[1], 0.0}, {}, {k[2], k[3]});
    case 5:
      return Lens::fisheye({k[0], k[1], k[2], k[3]});
    case 6:
      return Lens::perspective({k[0], k[1], k[4]}, {k[5], k[6], k[7]}, {k[2], k[3]});
    case 7:
      return Lens::fieldOfView(k[0]);
    case 8:
      return Lens::fisheye({k[0], 0.0, 0.0, 0.0});
    case 9:
      return Lens::fisheye({k[0], k[1], 0.0, 0.0});
    case 10:
      return Lens::fisheye({k[0], k[1], k[4], k[5]}, {k[2], k[3]}, {k[6], k[7]});
    default:
      return {};
  }
}

}  // namespace

std::size_t colmapParameters(int model) {
  return model >= 0 && model < static_cast<int>(std::size(kModels)) ? kModels[model].num_parameters
                                                                    : 0;
}

int colmapModel(std::string_view name) {
  for (int i = 0; i < static_cast<int>(std::size(kModels)); ++i) {
    if (kModels[i].name == name) return i;
  }
  return -1;
}

bool setColmapIntrinsics(int model, const double* parameters, Camera& camera) {
  const double* next = parameters;
  camera.focal.x() = *next++;
  camera.focal.y() = kModels[model].one_focal_length ? camera.focal.x() : *next++;
  camera.principal.x() = *next++;
  camera.principal.y() = *next++;
  for (std::size_t i = 0; i < colmapParameters(model); ++i) {
    if (!std::isfinite(parameters[i])) return false;
  }
  constexpr int kFieldOfView = 7;
  const bool bent_too_far = model == kFieldOfView && !(*next >= 0.0 && *next < M_PI);
  if (!(camera.focal.minCoeff() > 0.0) || bent_too_far) return false;
  camera.lens = lensOf(model, next);
  return true;
}

}  // namespace storey::io
