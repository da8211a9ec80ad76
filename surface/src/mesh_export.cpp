// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>
#include <storey/surface/mesh_export.h>
#include <storey/surface/triangulation.h>

#include <algorithm>

namespace storey {
namespace {

pcl::TexMaterial materialOf(std::size_t face, const std::string& image) {
  pcl::TexMaterial material;
  material.tex_name = "face_" + std::to_string(face);
  material.tex_file = image;
  material.tex_Ka = {1.0f, 1.0f, 1.0f};
  material.tex_Kd = {1.0f, 1.0f, 1.0f};
  material.tex_Ks = {0.0f, 0.0f, 0.0f};
  material.tex_d = 1.0f;
  material.tex_Ns = 0.0f;
  material.tex_illum = 1;
  return material;
}

/// PCL's writer insists on normals of the vertices: the mean of those of their faces.
pcl::PCLPointCloud2 verticesWithNormals(const PolyhedralModel& model,
                                        const std::vector<FacadeTexture>& textures) {
  std::vector<Eigen::Vector3d> normals(model.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const auto add = [&](const std::vector<int>& ring) {
      for (const int v : ring) normals[static_cast<std::size_t>(v)] += textures[f].frame.normal();
    };
    add(model.faces[f].outer);
    std::for_each(model.faces[f].inner.begin(), model.faces[f].inner.end(), add);
  }
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Eigen::Vector3f p = model.vertices[v].cast<float>();
    const Eigen::Vector3f n = normals[v].normalized().cast<float>();
    cloud.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
  }
  pcl::PCLPointCloud2 message;
  pcl::toPCLPointCloud2(cloud, message);
  return message;
}

}  // namespace

pcl::PolygonMesh toPolygonMesh(const PolyhedralModel& model, const Eigen::Isometry3d& transform) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const Eigen::Vector3d& v : model.vertices) {
    const Eigen::Vector3f p = (transform * v).cast<float>();
    cloud.push_back({p.x(), p.y(), p.z()});
  }
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(cloud, mesh.cloud);
  for (const PolyhedralFace& face : model.faces) {
    for (const std::array<int, 3>& triangle : triangulateFace(model, face)) {
      pcl::Vertices polygon;
      polygon.vertices.assign(triangle.begin(), triangle.end());
      mesh.polygons.push_back(std::move(polygon));
    }
  }
  return mesh;
}

pcl::TextureMesh toTextureMesh(const PolyhedralModel& model,
                               const std::vector<FacadeTexture>& textures,
                               const std::vector<std::string>& images) {
  pcl::TextureMesh mesh;
  if (textures.size() != model.faces.size() || images.size() != model.faces.size()) {
    PCL_ERROR("[storey::toTextureMesh] %zu faces, but %zu textures and %zu images.\n",
              model.faces.size(), textures.size(), images.size());
    return mesh;
  }
  mesh.cloud = verticesWithNormals(model, textures);
  std::uint32_t num_coordinates = 0;  // over all materials: so the writer counts them
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    mesh.tex_materials.push_back(materialOf(f, images[f]));
    mesh.tex_polygons.emplace_back();
    mesh.tex_coordinates.emplace_back();
    mesh.tex_coord_indices.emplace_back();
    for (const std::array<int, 3>& triangle : triangulateFace(model, model.faces[f])) {
      pcl::Vertices polygon;
      pcl::Vertices coordinates;
      for (const int corner : triangle) {
        const Eigen::Vector3d& vertex = model.vertices[static_cast<std::size_t>(corner)];
        polygon.vertices.push_back(corner);
        coordinates.vertices.push_back(static_cast<pcl::index_t>(num_coordinates++));
        mesh.tex_coordinates[f].push_back(textures[f].coordinates(vertex).cast<float>());
      }
      mesh.tex_polygons[f].push_back(polygon);
      mesh.tex_coord_indices[f].push_back(coordinates);
    }
  }
  return mesh;
}

}  // namespace storey
