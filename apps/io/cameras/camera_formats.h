// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/cameras/camera_set.h"
#include "io/input_file.h"

namespace storey::io {

// What a file may ask for: no honest one comes near.
constexpr std::uint64_t kMaxCameraFileBytes = std::uint64_t{8} << 30;
constexpr std::size_t kMaxNameBytes = 4096;
constexpr std::uint64_t kMaxImageSide = 1u << 20;  // pixels

CameraSet readBundler(const std::string& path);
CameraSet readPmvs(const std::string& folder);
CameraSet readColmapText(const std::string& folder);
CameraSet readColmapBinary(const std::string& folder);

/// Reads `count` finite numbers that fill the line; fails at the line otherwise.
void parseNumbers(const InputFile& file, std::string_view line, std::size_t count, double* numbers);

/// The pose of a world-to-camera rotation and translation. The rotation may be rounded, as files
/// have it, by up to 1e-3; false if it is none, or mirrors.
bool setPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation, Camera& camera);

/// The camera of a 3 x 4 projection matrix, whatever its scale and sign, for pixels whose centres
/// are at integers; false if the matrix is none. A matrix that mirrors is the same as one that
/// looks the other way: the camera always has a proper rotation.
bool setProjection(const Eigen::Matrix<double, 3, 4>& projection, Camera& camera);

/// Number of parameters of a COLMAP camera model, by its name or number; 0 if unknown.
std::size_t colmapParameters(int model);
int colmapModel(std::string_view name);  ///< -1 if unknown

/// Sets focal length, principal point and lens; false if the parameters are out of range.
bool setColmapIntrinsics(int model, const double* parameters, Camera& camera);

}  // namespace storey::io
