// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PolygonMesh.h>
#include <pcl/TextureMesh.h>
#include <storey/surface/facade_texturing.h>
#include <storey/surface/polyhedral_model.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace storey {

/// The model as triangles over float vertices x, y, z: the form that PCL shows and writes. The
/// vertices are the model's, moved by `transform`, in the same order; the header is left to the
/// caller.
/// \note floats carry 7 digits: keep the model in local coordinates.
pcl::PolygonMesh toPolygonMesh(const PolyhedralModel& model,
                               const Eigen::Isometry3d& transform = Eigen::Isometry3d::Identity());

/// The same with a material and an image for each face, which `pcl::io::saveOBJFile` writes.
/// \param textures of the model's faces, in their order, as `FacadeTexturing` gives them
/// \param images   names of the image files to refer to, parallel to `textures`; saving the images
///        is left to the caller
/// \return empty, after a PCL_ERROR, if the numbers of faces, textures and images differ
pcl::TextureMesh toTextureMesh(const PolyhedralModel& model,
                               const std::vector<FacadeTexture>& textures,
                               const std::vector<std::string>& images);

}  // namespace storey
