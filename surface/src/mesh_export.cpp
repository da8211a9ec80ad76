// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/conversions.h>
#include <pcl/point_types.h>
#include <storey/surface/mesh_export.h>
#include <storey/surface/triangulation.h>

namespace storey {

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

}  // namespace storey
