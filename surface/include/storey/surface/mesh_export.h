// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PolygonMesh.h>
#include <storey/surface/polyhedral_model.h>

#include <Eigen/Geometry>

namespace storey {

/// The model as triangles over float vertices x, y, z: the form that PCL shows and writes. The
/// vertices are the model's, moved by `transform`, in the same order; the header is left to the
/// caller.
/// \note floats carry 7 digits: keep the model in local coordinates.
pcl::PolygonMesh toPolygonMesh(const PolyhedralModel& model,
                               const Eigen::Isometry3d& transform = Eigen::Isometry3d::Identity());

}  // namespace storey
