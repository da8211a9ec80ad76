// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace storey::exports {

/// Coordinates with z up as glTF has them, with y up.
template <typename Vector>
Vector yUp(const Vector& v) {
  return {v.x(), v.z(), -v.y()};
}

/// A binary glTF 2.0 file (.glb) in the making: its JSON, to be filled in by the user, and the
/// numbers and images that the JSON refers to.
class GlbFile {
 public:
  using Json = nlohmann::ordered_json;

  /// One scene with one node, 0, whose translation is in JSON and so in double.
  /// \param origin of all vertices, in the input's coordinates
  GlbFile(const std::string& name, const Eigen::Vector3d& origin);

  Json& json() { return json_; }

  /// Floats of the vertices of triangles, `width` each. \return the index of the accessor
  std::size_t addAccessor(const std::vector<float>& values, std::size_t width, const char* type);

  /// A JPEG file, and a texture that shows it up to its edges. \return the index of the texture
  std::size_t addTexture(const std::string& jpeg);

  /// \throws io::Failure (CannotCreate, IoError)
  void write(const std::string& path) const;
  std::string bytes() const;

 private:
  Json& addView(const void* data, std::size_t size);

  Json json_;
  std::string buffer_;
};

}  // namespace storey::exports
