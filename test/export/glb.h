// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace storey::test {

/// A GLB taken apart.
struct Glb {
  nlohmann::json json;
  std::string bytes;

  explicit Glb(const std::string& file) {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(word(file, 4), 2u);
    EXPECT_EQ(word(file, 8), file.size());
    const std::size_t size = word(file, 12);
    EXPECT_EQ(file.substr(16, 4), "JSON");
    json = nlohmann::json::parse(file.substr(20, size));
    EXPECT_EQ(file.substr(24 + size, 4), std::string("BIN\0", 4));
    EXPECT_EQ(word(file, 20 + size), file.size() - 28 - size);
    bytes = file.substr(28 + size);
    EXPECT_EQ(bytes.size(), json["buffers"][0]["byteLength"]);
  }

  static std::size_t word(const std::string& file, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, file.data() + at, sizeof value);
    return value;
  }

  std::vector<float> values(const nlohmann::json& accessor_index) const {
    const nlohmann::json& accessor = json["accessors"][accessor_index.get<std::size_t>()];
    const nlohmann::json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<float> result(view["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(result.data(), bytes.data() + view["byteOffset"].get<std::size_t>(),
                result.size() * sizeof(float));
    return result;
  }

  /// The bytes of an image.
  std::string image(std::size_t index) const {
    const nlohmann::json& view =
        json["bufferViews"][json["images"][index]["bufferView"].get<std::size_t>()];
    return bytes.substr(view["byteOffset"], view["byteLength"]);
  }

  Eigen::Vector3d translation() const {
    const nlohmann::json& t = json["nodes"][0]["translation"];
    return {t[0].get<double>(), t[1].get<double>(), t[2].get<double>()};
  }
};

}  // namespace storey::test
