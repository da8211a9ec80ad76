// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <functional>
#include <string>
#include <vector>

namespace storey::bench {

/// Something that is done to a cloud, by us or by others, on one thread.
struct Peer {
  std::string name;
  std::function<void(const pcl::PointCloud<pcl::PointNormal>::ConstPtr&)> run;
  bool needs_all_faces = false;  ///< of walls alone it makes no surface
  bool is_slow = false;          ///< too slow for a quick look
};

/// The planar confidence and the normals of storey and what PCL has nearest to them, and the ways
/// of PCL and, where it is installed, of CGAL from points to outlines and surfaces.
std::vector<Peer> peers();

/// A sentence on those that are not there; empty if all are.
std::string missingPeers();

/// CGAL's polygonal surface reconstruction: planes by region growing, faces by an integer program
/// (Nan and Wonka, PolyFit, 2017).
void cgalPolygonalSurface(const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud);

}  // namespace storey::bench
