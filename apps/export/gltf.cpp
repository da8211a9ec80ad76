// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: VTK's vtkGLTFWriter has no GLB, no translation of nodes and no materials without
// textures, its vtkGLTFExporter wants a window to render in, and either would bring VTK into
// storey_reconstruct, which is free of it. tinygltf wants the same buffers, views and accessors
// filled in that are filled in here, and saves a header of 20 bytes.
#include "export/gltf.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "export/local_mesh.h"
#include "export/materials.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

template <typename Vector>
Vector yUp(const Vector& v) {
  return {v.x(), v.z(), -v.y()};
}

// The corners of one primitive, three a triangle: neighbours share none, their normals differ.
struct Corners {
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> faces;
};

class GltfBuilder {
 public:
  explicit GltfBuilder(const Exported& exported)
      : exported_(exported), mesh_(toLocalMesh(exported)) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "storey"}};
    if (!exported.crs.empty()) json_["asset"]["extras"] = {{"crs", exported.crs}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    const Eigen::Vector3d origin = yUp(mesh_.origin);
    json_["nodes"] = Json::array(
        {{{"name", "building"}, {"translation", {origin.x(), origin.y(), origin.z()}}}});
    for (int shell = 0; shell < exported.model.num_shells; ++shell) addShell(shell);
    json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  }

  std::string json() const { return json_.dump(); }
  const std::string& bytes() const { return bytes_; }

 private:
  // The index in the file of a material, which has only those that are used.
  std::size_t useMaterial(std::size_t material) {
    const auto [found, is_new] = materials_.emplace(material, materials_.size());
    if (is_new) {
      const auto [red, green, blue] = materialColour(material);
      json_["materials"].push_back({{"name", materialName(material)},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", {red, green, blue, 1.0}},
                                      {"metallicFactor", 0.0},
                                      {"roughnessFactor", 0.9}}}});
    }
    return found->second;
  }

  void addShell(int shell) {
    std::vector<Corners> corners(kNumMaterials);
    for (const LocalMesh::Face& face : mesh_.faces) {
      const PolyhedralFace& source = exported_.model.faces[face.face];
      if (source.shell == shell) append(face, corners[materialOf(source)]);
    }
    Json primitives = Json::array();
    for (std::size_t m = 0; m < kNumMaterials; ++m) {
      if (corners[m].faces.empty()) continue;
      Json attributes = {{"POSITION", addAccessor(corners[m].positions, 3, "VEC3")},
                         {"NORMAL", addAccessor(corners[m].normals, 3, "VEC3")},
                         {"_FACE", addAccessor(corners[m].faces, 1, "SCALAR")}};
      primitives.push_back({{"attributes", std::move(attributes)}, {"material", useMaterial(m)}});
    }
    const std::string name = "shell_" + std::to_string(shell);
    json_["nodes"][0]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", name}, {"mesh", shell}});
    json_["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
  }

  void append(const LocalMesh::Face& face, Corners& corners) const {
    const Eigen::Vector3f normal = yUp(face.normal);
    for (const std::array<int, 3>& triangle : face.triangles) {
      for (const int index : triangle) {
        const Eigen::Vector3f p = yUp(mesh_.vertices[static_cast<std::size_t>(index)]);
        corners.positions.insert(corners.positions.end(), p.begin(), p.end());
        corners.normals.insert(corners.normals.end(), normal.begin(), normal.end());
        corners.faces.push_back(static_cast<float>(face.face));
      }
    }
  }

  // \return the index of the accessor
  std::size_t addAccessor(const std::vector<float>& values, std::size_t width, const char* type) {
    Json view = {{"buffer", 0},
                 {"byteOffset", bytes_.size()},
                 {"byteLength", values.size() * sizeof(float)},
                 {"target", kArrayBuffer}};
    bytes_.append(reinterpret_cast<const char*>(values.data()),  // the host is little-endian
                  values.size() * sizeof(float));
    std::vector<float> low(width, std::numeric_limits<float>::infinity());
    std::vector<float> high(width, -std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % width] = std::min(low[i % width], values[i]);
      high[i % width] = std::max(high[i % width], values[i]);
    }
    json_["bufferViews"].push_back(std::move(view));
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", kFloat},
                                  {"count", values.size() / width},
                                  {"type", type},
                                  {"min", low},
                                  {"max", high}});
    return json_["accessors"].size() - 1;
  }

  const Exported& exported_;
  LocalMesh mesh_;
  Json json_;
  std::map<std::size_t, std::size_t> materials_;
  std::string bytes_;
};

void writeInteger(io::OutputFile& file, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  file.write(&word, sizeof word);
}

}  // namespace

void writeGltf(const std::string& path, const Exported& exported) {
  const GltfBuilder gltf(exported);
  std::string json = gltf.json();
  json.resize((json.size() + 3) / 4 * 4, ' ');  // chunks are whole words; floats are already
  io::OutputFile file(path);
  writeInteger(file, kMagic);
  writeInteger(file, 2);
  writeInteger(file, 12 + 8 + json.size() + 8 + gltf.bytes().size());
  writeInteger(file, json.size());
  writeInteger(file, kJsonChunk);
  file.write(json);
  writeInteger(file, gltf.bytes().size());
  writeInteger(file, kBinChunk);
  file.write(gltf.bytes());
  file.commit();
}

}  // namespace storey::exports
