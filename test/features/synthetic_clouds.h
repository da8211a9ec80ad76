// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/// A piece of a plane and its true normal: corner + u [0, 1] + v [0, 1].
struct Panel {
  Eigen::Vector3d corner, u, v, normal;
  double area() const { return u.cross(v).norm(); }
};

/// The upright walls of a polygon given counter-clockwise, normals to the right of its edges: out.
/// A clockwise polygon gives the walls of a courtyard.
inline std::vector<Panel> wallsOf(const std::vector<Eigen::Vector2d>& polygon, double bottom,
                                  double top) {
  std::vector<Panel> walls;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d d = polygon[(i + 1) % polygon.size()] - a;
    walls.push_back({{a.x(), a.y(), bottom},
                     {d.x(), d.y(), 0.0},
                     {0.0, 0.0, top - bottom},
                     Eigen::Vector3d(d.y(), -d.x(), 0.0).normalized()});
  }
  return walls;
}

inline std::vector<Eigen::Vector2d> regularPolygon(int sides, double radius) {
  std::vector<Eigen::Vector2d> polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

inline std::vector<Eigen::Vector2d> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct Noise {
  double position = 0.0;  // standard deviation, along each axis
  double normal = 0.0;    // standard deviation of the angle, rad
  std::uint32_t seed = 1;
};

/// Samples n points evenly over the panels, panel after panel.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr sampled(const std::vector<Panel>& panels, int n,
                                              const Noise& noise) {
  std::mt19937 random(noise.seed);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double total = 0.0;
  for (const Panel& p : panels) {
    total += p.area();
  }
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const Panel& p : panels) {
    const int count = static_cast<int>(std::lround(n * p.area() / total));
    for (int i = 0; i < count; ++i) {
      const double s = uniform(random);
      const double t = uniform(random);
      Eigen::Vector3d x = p.corner + s * p.u + t * p.v;
      for (int a = 0; a < 3; ++a) {
        x[a] += noise.position * gauss(random);
      }
      const double turn = 2.0 * M_PI * uniform(random);
      const Eigen::Vector3d axis = Eigen::AngleAxisd(turn, p.normal) * p.normal.unitOrthogonal();
      const Eigen::Vector3d m = Eigen::AngleAxisd(noise.normal * gauss(random), axis) * p.normal;
      PointT point;
      point.getVector3fMap() = x.cast<float>();
      point.getNormalVector3fMap() = m.cast<float>();
      cloud->push_back(point);
    }
  }
  return cloud;
}

// A flattened slice of a square building: four lines of points, all with z = 0.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr flattenedSlice(int n, const Noise& noise) {
  auto cloud = sampled<PointT>(wallsOf(rectangle(0, 0, 26, 26), 0, 1), n, noise);
  for (PointT& p : *cloud) {
    p.z = 0.0f;
    p.curvature = 0.25f;
  }
  return cloud;
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr transformed(
    const pcl::PointCloud<PointT>& cloud, const Eigen::Matrix3d& rotation,
    const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  auto result = pcl::make_shared<pcl::PointCloud<PointT>>(cloud);
  for (PointT& p : *result) {
    p.getVector3fMap() =
        (rotation * p.getVector3fMap().template cast<double>() + shift).template cast<float>();
    p.getNormalVector3fMap() =
        (rotation * p.getNormalVector3fMap().template cast<double>()).template cast<float>();
  }
  return result;
}

template <typename PointT>
bool sameNormals(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b) {
  if (a.size() != b.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].getNormalVector3fMap() != b[i].getNormalVector3fMap()) {
      return false;
    }
  }
  return true;
}

constexpr double kDegree = M_PI / 180.0;
