// SPDX-License-Identifier: BSD-3-Clause
#include "synth/cloud_writer.h"

#include <Eigen/Geometry>
#include <limits>

#include "io/output_file.h"

namespace storey::synth {
namespace {

template <typename Scalar>
void writeVector(io::OutputFile& file, const Eigen::Vector3d& vector) {  // the host's byte order
  const Eigen::Matrix<Scalar, 3, 1> numbers = vector.cast<Scalar>();
  file.write(numbers.data(), sizeof(Scalar) * 3);
}

std::string header(std::size_t count, const std::string& type, bool with_normals) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + "\n";
  for (const char* name : {"x", "y", "z"}) {
    text += "property " + type + " " + name + "\n";
  }
  if (with_normals) {
    text += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  return text + "end_header\n";
}

}  // namespace

bool needsDouble(const SyntheticCloud& cloud) {
  constexpr double kAllowedStep = 1e-6;  // of the diagonal
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : cloud.positions) {
    box.extend(position);
  }
  if (box.isEmpty()) {
    return false;
  }
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double step = largest * static_cast<double>(std::numeric_limits<float>::epsilon());
  return step > kAllowedStep * box.diagonal().norm();
}

void writeCloudPly(const std::string& path, const SyntheticCloud& cloud, bool double_positions,
                   bool with_normals) {
  io::OutputFile file(path);
  file.write(header(cloud.size(), double_positions ? "double" : "float", with_normals));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (double_positions) {
      writeVector<double>(file, cloud.positions[i]);
    } else {
      writeVector<float>(file, cloud.positions[i]);
    }
    if (with_normals) {
      writeVector<float>(file, cloud.normals[i]);
    }
  }
  file.commit();
}

}  // namespace storey::synth
