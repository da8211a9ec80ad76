// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/filters/detail/chunks.h>
#include <storey/surface/detail/edge_index.h>
#include <storey/surface/face_support.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace storey {
namespace {

constexpr double kGate = 3.0;           // noise deviations
constexpr double kSameSide = 0.5;       // cosine of 60 degrees
constexpr double kPointsInCell = 6.0;   // on average, where a face was seen
constexpr double kRounding = 1e-9;      // of an area
constexpr double kSeenShare = 1.0 / 3;  // of the area of a face; below, it is a guess

// A face in its own plane: u along a wall and v up, or x and y of a level face.
class FlatFace {
 public:
  FlatFace(const PolyhedralModel& model, const PolyhedralFace& face) {
    const Eigen::Vector3d first = vertexOf(model, face.outer[0]);
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < face.outer.size(); ++i) {
      twice += (vertexOf(model, face.outer[i]) - first)
                   .cross(vertexOf(model, face.outer[(i + 1) % face.outer.size()]) - first);
    }
    is_wall_ = face.label == FaceLabel::Wall;
    normal_ = is_wall_ ? Eigen::Vector3d(twice.x(), twice.y(), 0.0).normalized()
                       : Eigen::Vector3d(0.0, 0.0, twice.z() > 0.0 ? 1.0 : -1.0);
    offset_ = normal_.dot(first);
    addRing(model, face.outer);
    for (const std::vector<int>& ring : face.inner) addRing(model, ring);
    fills_box_ = area_ > (1.0 - kRounding) * box_.volume();
  }

  bool isWall() const { return is_wall_; }
  double height() const { return normal_.z() * offset_; }  // of a level face
  double area() const { return area_; }
  double across(const Eigen::Vector3d& p) const { return normal_.dot(p) - offset_; }

  Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    if (!is_wall_) return p.head<2>();
    return {normal_.x() * p.y() - normal_.y() * p.x(), p.z()};
  }

  // \param length of the normal
  bool agrees(const Eigen::Vector3d& normal, double length) const {
    return length > 0.0 ? normal.dot(normal_) >= kSameSide * length : is_wall_;
  }

  // By the even-odd rule over all rings.
  bool inside(const Eigen::Vector2d& p) const {
    if (!box_.contains(p)) return false;
    if (fills_box_) return true;
    bool odd = false;
    for (const auto& [a, b] : edges_) {
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      const double t = (p.y() - a.y()) / (b.y() - a.y());
      if (a.x() + t * (b.x() - a.x()) > p.x()) odd = !odd;
    }
    return odd;
  }

  // Where the face lies in plan.
  detail::WallStretch stretch(int id) const {
    const Eigen::Vector2d tangent(-normal_.y(), normal_.x());
    const Eigen::Vector2d start = offset_ * normal_.head<2>() + box_.min().x() * tangent;
    return {start, tangent, box_.sizes().x(), id};
  }

  const Eigen::AlignedBox2d& box() const { return box_; }

 private:
  static const Eigen::Vector3d& vertexOf(const PolyhedralModel& model, int v) {
    return model.vertices[static_cast<std::size_t>(v)];
  }

  void addRing(const PolyhedralModel& model, const std::vector<int>& ring) {
    double twice = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d a = project(vertexOf(model, ring[i]));
      const Eigen::Vector2d b = project(vertexOf(model, ring[(i + 1) % ring.size()]));
      edges_.emplace_back(a, b);
      box_.extend(a);
      twice += a.x() * b.y() - a.y() * b.x();
    }
    // The outer ring comes first, and holes run the other way.
    area_ = area_ == 0.0 ? 0.5 * std::abs(twice) : area_ - 0.5 * std::abs(twice);
  }

  bool is_wall_ = false;
  Eigen::Vector3d normal_;
  double offset_ = 0.0;
  double area_ = 0.0;
  Eigen::AlignedBox2d box_;
  bool fills_box_ = false;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges_;
};

// Finds the face that a point lies on.
class FaceIndex {
 public:
  FaceIndex(const std::vector<FlatFace>& faces, double noise)
      : faces_(faces), gate_(kGate * noise), walls_(stretches(faces), gate_) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!faces[f].isWall()) caps_.push_back(static_cast<int>(f));
    }
    std::sort(caps_.begin(), caps_.end(), [&](int a, int b) { return heightOf(a) < heightOf(b); });
  }

  // -1 if there is none.
  int faceOf(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    int best = -1;
    double best_distance = gate_;
    const double length = normal.norm();
    const auto consider = [&](int f) {
      const FlatFace& face = faces_[static_cast<std::size_t>(f)];
      const double distance = std::abs(face.across(point));
      if (distance > best_distance || !face.agrees(normal, length)) return;
      if (!face.inside(face.project(point))) return;
      best = f;
      best_distance = distance;
    };
    for (const int s : walls_.candidates(point.head<2>())) {
      consider(walls_[static_cast<std::size_t>(s)].wall);
    }
    auto cap = std::lower_bound(caps_.begin(), caps_.end(), point.z() - gate_,
                                [&](int f, double z) { return heightOf(f) < z; });
    for (; cap != caps_.end() && heightOf(*cap) <= point.z() + gate_; ++cap) consider(*cap);
    return best;
  }

 private:
  static std::vector<detail::WallStretch> stretches(const std::vector<FlatFace>& faces) {
    std::vector<detail::WallStretch> result;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (faces[f].isWall()) result.push_back(faces[f].stretch(static_cast<int>(f)));
    }
    return result;
  }

  double heightOf(int face) const { return faces_[static_cast<std::size_t>(face)].height(); }

  const std::vector<FlatFace>& faces_;
  double gate_;
  detail::EdgeIndex walls_;
  std::vector<int> caps_;  // by height
};

// The cells of a face, and which have points.
class Coverage {
 public:
  Coverage(const FlatFace& face, double cell) : face_(face) {
    const Eigen::Vector2d size = face.box().sizes();
    columns_ =
        std::max(std::ptrdiff_t{1}, static_cast<std::ptrdiff_t>(std::round(size.x() / cell)));
    rows_ = std::max(std::ptrdiff_t{1}, static_cast<std::ptrdiff_t>(std::round(size.y() / cell)));
    step_ = {size.x() / static_cast<double>(columns_), size.y() / static_cast<double>(rows_)};
    covered_.assign(static_cast<std::size_t>(columns_ * rows_), 0);
  }

  /// Several threads may add at once.
  void add(const Eigen::Vector2d& place) {
    const Eigen::Vector2d r = (place - face_.box().min()).cwiseQuotient(step_);
    const auto column =
        std::clamp(static_cast<std::ptrdiff_t>(r.x()), std::ptrdiff_t{0}, columns_ - 1);
    const auto row = std::clamp(static_cast<std::ptrdiff_t>(r.y()), std::ptrdiff_t{0}, rows_ - 1);
    char& covered = covered_[static_cast<std::size_t>(row * columns_ + column)];
#pragma omp atomic write
    covered = 1;
  }

  // Of the cells with their middle on the face; of all where there is none such.
  double share() const {
    std::size_t cells = 0;
    std::size_t covered = 0;
    for (std::ptrdiff_t row = 0; row < rows_; ++row) {
      for (std::ptrdiff_t column = 0; column < columns_; ++column) {
        const Eigen::Vector2d middle(static_cast<double>(column) + 0.5,
                                     static_cast<double>(row) + 0.5);
        if (!face_.inside(face_.box().min() + middle.cwiseProduct(step_))) continue;
        ++cells;
        covered += covered_[static_cast<std::size_t>(row * columns_ + column)] != 0;
      }
    }
    if (cells > 0) return static_cast<double>(covered) / static_cast<double>(cells);
    return std::count(covered_.begin(), covered_.end(), 1) > 0 ? 1.0 : 0.0;
  }

 private:
  const FlatFace& face_;
  std::ptrdiff_t columns_ = 1;
  std::ptrdiff_t rows_ = 1;
  Eigen::Vector2d step_;
  std::vector<char> covered_;
};

// Points per area on the face that the point in the middle lies on.
double typicalDensity(const std::vector<FlatFace>& faces, const PolyhedralModel& model) {
  std::vector<std::pair<double, std::size_t>> densities;
  std::size_t points = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t support = model.faces[f].support;
    if (support == 0 || !(faces[f].area() > 0.0)) continue;
    densities.emplace_back(static_cast<double>(support) / faces[f].area(), support);
    points += support;
  }
  std::sort(densities.begin(), densities.end());
  std::size_t below = 0;
  for (const auto& [density, support] : densities) {
    below += support;
    if (2 * below >= points) return density;
  }
  return 0.0;
}

double cellSize(const std::vector<FlatFace>& faces, const PolyhedralModel& model, double noise,
                std::size_t num_points) {
  double area = 0.0;
  for (const FlatFace& face : faces) area += face.box().volume();
  double cell = std::max(kGate * noise, std::sqrt(area / static_cast<double>(num_points)));
  const double density = typicalDensity(faces, model);
  if (density > 0.0) cell = std::max(cell, std::sqrt(kPointsInCell / density));
  return cell;
}

struct FacePoints {
  std::size_t count = 0;
  double squares = 0.0;  // of their distances across

  FacePoints& operator+=(const FacePoints& other) {
    count += other.count;
    squares += other.squares;
    return *this;
  }
};

// Support and residual of the faces. \return the face of each point, or -1
std::vector<int> findFaces(const FitPoints& points, const std::vector<FlatFace>& faces,
                           double noise, unsigned int threads, PolyhedralModel& model) {
  const FaceIndex index(faces, noise);
  std::vector<int> face_of(points.positions.size());
  const std::vector<FacePoints> sums =
      detail::sumByChunks(face_of.size(), threads, std::vector<FacePoints>(faces.size()),
                          [&](std::size_t begin, std::size_t end, std::vector<FacePoints>& part) {
                            for (std::size_t i = begin; i < end; ++i) {
                              const Eigen::Vector3d p = points.positions[i].cast<double>();
                              face_of[i] = index.faceOf(p, points.normals[i].cast<double>());
                              if (face_of[i] < 0) continue;
                              const auto f = static_cast<std::size_t>(face_of[i]);
                              const double across = faces[f].across(p);
                              part[f] += {1, across * across};
                            }
                          });
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [count, squares] = sums[f];
    model.faces[f].support = count;
    model.faces[f].residual = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  }
  return face_of;
}

void measureCoverage(const FitPoints& points, const std::vector<int>& face_of,
                     const std::vector<FlatFace>& faces, double noise, unsigned int threads,
                     PolyhedralModel& model) {
  const double cell = cellSize(faces, model, noise, points.positions.size());
  std::vector<Coverage> coverages;
  for (const FlatFace& face : faces) coverages.emplace_back(face, cell);
  const auto work = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (face_of[i] < 0) continue;
      const auto f = static_cast<std::size_t>(face_of[i]);
      coverages[f].add(faces[f].project(points.positions[i].cast<double>()));
    }
  };
  detail::forEachChunk(face_of.size(), threads, work);
  for (std::size_t f = 0; f < faces.size(); ++f) model.faces[f].coverage = coverages[f].share();
}

}  // namespace

void measureSupport(const FitPoints& points, double noise, PolyhedralModel& model,
                    unsigned int threads) {
  if (!(noise > 0.0) || std::isinf(noise) || points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::measureSupport] noise is %g, and there are %zu normals for %zu points.\n",
              noise, points.normals.size(), points.positions.size());
    return;
  }
  std::vector<FlatFace> faces;
  for (PolyhedralFace& face : model.faces) {
    faces.emplace_back(model, face);
    face.support = 0;
    face.coverage = 0.0;
  }
  const std::vector<int> face_of = findFaces(points, faces, noise, threads, model);
  if (std::any_of(face_of.begin(), face_of.end(), [](int f) { return f >= 0; })) {
    measureCoverage(points, face_of, faces, noise, threads, model);
  }
  for (PolyhedralFace& face : model.faces) {
    face.hypothetical = face.hypothetical || face.coverage < kSeenShare;
  }
}

}  // namespace storey
