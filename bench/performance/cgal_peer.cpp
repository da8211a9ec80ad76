// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/GLPK_mixed_integer_program_traits.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/Surface_mesh.h>
#include <storey/filters/cloud_scale.h>

#include <stdexcept>
#include <tuple>

#include "bench/performance/peers.h"

namespace storey::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Item = std::tuple<Kernel::Point_3, Kernel::Vector_3, int>;  // int: of its plane
using Items = std::vector<Item>;
using PointMap = CGAL::Nth_of_tuple_property_map<0, Item>;
using NormalMap = CGAL::Nth_of_tuple_property_map<1, Item>;
using PlaneMap = CGAL::Nth_of_tuple_property_map<2, Item>;
namespace Detection = CGAL::Shape_detection::Point_set;
using Neighbors = Detection::K_neighbor_query<Kernel, Items, PointMap>;
using Planes = Detection::Least_squares_plane_fit_region<Kernel, Items, PointMap, NormalMap>;

constexpr int kNeighbors = 30;
constexpr double kDistance = 4.0;         // deviations of the noise
constexpr double kAngle = 45.0;           // degrees: normals err by 15
constexpr std::size_t kLeastShare = 500;  // a plane has a 500th of the points, at least

void growPlanes(Items& items, double noise) {
  Neighbors neighbors(items, kNeighbors);
  Planes planes(items, kDistance * noise, kAngle, items.size() / kLeastShare + 3);
  CGAL::Shape_detection::Region_growing<Items, Neighbors, Planes> growing(items, neighbors, planes);
  std::vector<std::vector<std::size_t>> regions;
  growing.detect(std::back_inserter(regions));
  for (std::size_t plane = 0; plane < regions.size(); ++plane) {
    for (const std::size_t i : regions[plane]) std::get<2>(items[i]) = static_cast<int>(plane);
  }
}

}  // namespace

void cgalPolygonalSurface(const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud) {
  Items items;
  for (const pcl::PointNormal& p : *cloud) {
    items.emplace_back(Kernel::Point_3(p.x, p.y, p.z),
                       Kernel::Vector_3(p.normal_x, p.normal_y, p.normal_z), -1);
  }
  growPlanes(items, estimateCloudScale(*cloud).noise);
  CGAL::Polygonal_surface_reconstruction<Kernel> reconstruction(items, PointMap(), NormalMap(),
                                                                PlaneMap());
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  if (!reconstruction.reconstruct<CGAL::GLPK_mixed_integer_program_traits<double>>(surface)) {
    throw std::runtime_error(reconstruction.error_message());
  }
}

}  // namespace storey::bench
