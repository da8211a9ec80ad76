// SPDX-License-Identifier: BSD-3-Clause
#include "export/gltf.h"

#include <map>

#include "export/glb_file.h"
#include "export/local_mesh.h"
#include "export/materials.h"

namespace storey::exports {
namespace {

// The corners of one primitive, three a triangle: neighbours share none, their normals differ.
struct Corners {
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> faces;
};

class GltfBuilder {
 public:
  explicit GltfBuilder(const Exported& exported)
      : exported_(exported), mesh_(toLocalMesh(exported)), file_("building", mesh_.origin) {
    if (!exported.crs.empty()) file_.json()["asset"]["extras"] = {{"crs", exported.crs}};
    for (int shell = 0; shell < exported.model.num_shells; ++shell) addShell(shell);
  }

  const GlbFile& file() const { return file_; }

 private:
  // The index in the file of a material, which has only those that are used.
  std::size_t useMaterial(std::size_t material) {
    const auto [found, is_new] = materials_.emplace(material, materials_.size());
    if (is_new) {
      const auto [red, green, blue] = materialColour(material);
      file_.json()["materials"].push_back({{"name", materialName(material)},
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
    GlbFile::Json primitives = GlbFile::Json::array();
    for (std::size_t m = 0; m < kNumMaterials; ++m) {
      if (corners[m].faces.empty()) continue;
      GlbFile::Json attributes = {{"POSITION", file_.addAccessor(corners[m].positions, 3, "VEC3")},
                                  {"NORMAL", file_.addAccessor(corners[m].normals, 3, "VEC3")},
                                  {"_FACE", file_.addAccessor(corners[m].faces, 1, "SCALAR")}};
      primitives.push_back({{"attributes", std::move(attributes)}, {"material", useMaterial(m)}});
    }
    const std::string name = "shell_" + std::to_string(shell);
    GlbFile::Json& json = file_.json();
    json["nodes"][0]["children"].push_back(json["nodes"].size());
    json["nodes"].push_back({{"name", name}, {"mesh", shell}});
    json["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
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

  const Exported& exported_;
  LocalMesh mesh_;
  GlbFile file_;
  std::map<std::size_t, std::size_t> materials_;
};

}  // namespace

void writeGltf(const std::string& path, const Exported& exported) {
  GltfBuilder(exported).file().write(path);
}

}  // namespace storey::exports
