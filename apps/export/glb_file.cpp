// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: VTK's vtkGLTFWriter has no GLB, no translation of nodes and no materials without
// textures, its vtkGLTFExporter wants a window to render in, and either would bring VTK into
// storey_reconstruct, which is free of it. tinygltf wants the same buffers, views and accessors
// filled in that are filled in here, and saves a header of 20 bytes.
#include "export/glb_file.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "io/output_file.h"

namespace storey::exports {
namespace {

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kClampToEdge = 33071;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

// Chunks, and what is in them, are whole words.
std::string inWords(std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  return bytes;
}

void appendInteger(std::string& bytes, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);  // the host is little-endian
}

}  // namespace

GlbFile::GlbFile(const std::string& name, const Eigen::Vector3d& origin) {
  json_["asset"] = {{"version", "2.0"}, {"generator", "storey"}};
  json_["scene"] = 0;
  json_["scenes"] = Json::array({{{"nodes", {0}}}});
  const Eigen::Vector3d at = yUp(origin);
  json_["nodes"] = Json::array({{{"name", name}, {"translation", {at.x(), at.y(), at.z()}}}});
}

GlbFile::Json& GlbFile::addView(const void* data, std::size_t size) {
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}});
  buffer_.append(static_cast<const char*>(data), size);
  buffer_ = inWords(std::move(buffer_), '\0');
  return json_["bufferViews"].back();
}

std::size_t GlbFile::addAccessor(const std::vector<float>& values, std::size_t width,
                                 const char* type) {
  addView(values.data(), values.size() * sizeof(float))["target"] = kArrayBuffer;
  std::vector<float> low(width, std::numeric_limits<float>::infinity());
  std::vector<float> high(width, -std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % width] = std::min(low[i % width], values[i]);
    high[i % width] = std::max(high[i % width], values[i]);
  }
  json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                {"componentType", kFloat},
                                {"count", values.size() / width},
                                {"type", type},
                                {"min", low},
                                {"max", high}});
  return json_["accessors"].size() - 1;
}

std::size_t GlbFile::addTexture(const std::string& jpeg) {
  addView(jpeg.data(), jpeg.size());
  json_["images"].push_back(
      {{"bufferView", json_["bufferViews"].size() - 1}, {"mimeType", "image/jpeg"}});
  json_["samplers"] = Json::array({{{"magFilter", kLinear},
                                    {"minFilter", kLinearMipmapLinear},
                                    {"wrapS", kClampToEdge},
                                    {"wrapT", kClampToEdge}}});
  json_["textures"].push_back({{"sampler", 0}, {"source", json_["images"].size() - 1}});
  return json_["textures"].size() - 1;
}

std::string GlbFile::bytes() const {
  Json json = json_;
  json["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  const std::string text = inWords(json.dump(), ' ');
  std::string bytes;
  appendInteger(bytes, kMagic);
  appendInteger(bytes, 2);
  appendInteger(bytes, 12 + 8 + text.size() + 8 + buffer_.size());
  appendInteger(bytes, text.size());
  appendInteger(bytes, kJsonChunk);
  bytes += text;
  appendInteger(bytes, buffer_.size());
  appendInteger(bytes, kBinChunk);
  return bytes + buffer_;
}

void GlbFile::write(const std::string& path) const {
  io::OutputFile file(path);
  file.write(bytes());
  file.commit();
}

}  // namespace storey::exports
