// SPDX-License-Identifier: BSD-3-Clause
#include "synth/photos/facade_paint.h"

#include <algorithm>
#include <cmath>

#include "synth/random.h"

namespace storey::synth {
namespace {

constexpr double kWindowWidth = 0.45;  // of the pitch
constexpr double kWindowHeight = 0.6;  // of the pitch
constexpr double kFrame = 0.04;        // of the pitch
constexpr double kCourse = 0.08;       // height of a course of bricks, of the pitch
constexpr double kDarkest = 30.0;      // grey levels: room for exposures below and above
constexpr double kBrightest = 185.0;

/// Uniform in [-1, 1], the same for the same cell of the plane.
double cellValue(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  const auto key =
      static_cast<std::uint64_t>(x) * 0x8da6b343u + static_cast<std::uint64_t>(y) * 0xd8163841u;
  std::uint64_t h = (key ^ seed) * 0xbf58476d1ce4e5b9ULL;
  h = (h ^ (h >> 29)) * 0x94d049bb133111ebULL;
  return static_cast<double>((h ^ (h >> 32)) >> 11) * 0x1.0p-52 - 1.0;
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

FacadePaint::FacadePaint(const FacadeFrame& frame, const FacadeOutline& outline, bool has_windows,
                         double pitch, std::uint64_t seed)
    : pitch_(pitch), seed_(seed) {
  Random random(seed);
  for (int c = 0; c < 3; ++c) base_[c] = random.uniform(105.0, 150.0);
  columns_ = static_cast<int>(frame.width / pitch);
  const int rows = static_cast<int>(frame.height / pitch);
  if (!has_windows || columns_ == 0 || rows == 0) {
    columns_ = 0;
    return;
  }
  cell_ = {frame.width / columns_, frame.height / rows};
  const Eigen::Vector2d half = 0.5 * pitch * Eigen::Vector2d(kWindowWidth, kWindowHeight);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d middle = cell_.cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5));
      const PaintedWindow window = {middle - half, middle + half};
      const bool fits = isInside(outline, window.min) && isInside(outline, window.max) &&
                        isInside(outline, {window.min.x(), window.max.y()}) &&
                        isInside(outline, {window.max.x(), window.min.y()});
      window_in_.push_back(fits ? static_cast<int>(windows_.size()) : -1);
      if (fits) windows_.push_back(window);
    }
  }
}

const PaintedWindow* FacadePaint::windowAt(const Eigen::Vector2d& at) const {
  if (columns_ == 0 || at.minCoeff() < 0.0) return nullptr;
  const int column = static_cast<int>(at.x() / cell_.x());
  const auto cell =
      static_cast<std::size_t>(static_cast<int>(at.y() / cell_.y()) * columns_ + column);
  if (column >= columns_ || cell >= window_in_.size() || window_in_[cell] < 0) return nullptr;
  const PaintedWindow& window = windows_[static_cast<std::size_t>(window_in_[cell])];
  const bool inside = (at - window.min).minCoeff() >= 0.0 && (window.max - at).minCoeff() >= 0.0;
  return inside ? &window : nullptr;
}

double FacadePaint::noise(const Eigen::Vector2d& at, double wavelength) const {
  const Eigen::Vector2d scaled = at / wavelength;
  const double x = std::floor(scaled.x());
  const double y = std::floor(scaled.y());
  const double u = smooth(scaled.x() - x);
  const double v = smooth(scaled.y() - y);
  const auto i = static_cast<std::int64_t>(x);
  const auto j = static_cast<std::int64_t>(y);
  return (1.0 - v) * ((1.0 - u) * cellValue(i, j, seed_) + u * cellValue(i + 1, j, seed_)) +
         v * ((1.0 - u) * cellValue(i, j + 1, seed_) + u * cellValue(i + 1, j + 1, seed_));
}

Eigen::Vector3d FacadePaint::wallColor(const Eigen::Vector2d& at) const {
  const double stains = 18.0 * noise(at, pitch_) + 10.0 * noise(at, pitch_ / 5.0);
  const double grain = 6.0 * noise(at, pitch_ / 25.0);
  const double joint = std::cos(2.0 * M_PI * at.y() / (kCourse * pitch_));
  const Eigen::Vector3d color = base_ + Eigen::Vector3d::Constant(stains + grain - 5.0 * joint) +
                                8.0 * noise(at, pitch_ / 2.0) * Eigen::Vector3d(1.0, 0.0, -1.0);
  return color.cwiseMax(kDarkest).cwiseMin(kBrightest);
}

Eigen::Vector3d FacadePaint::windowColor(const PaintedWindow& window,
                                         const Eigen::Vector2d& at) const {
  const Eigen::Vector2d to_edge = (at - window.min).cwiseMin(window.max - at);
  const double to_mullion = std::abs(at.x() - 0.5 * (window.min.x() + window.max.x()));
  if (to_edge.minCoeff() < kFrame * pitch_ || to_mullion < 0.5 * kFrame * pitch_) {
    return {175.0, 172.0, 165.0};
  }
  const double height = (at.y() - window.min.y()) / (window.max.y() - window.min.y());
  const double curtain = 12.0 * noise(window.min, 0.37 * pitch_);
  return Eigen::Vector3d(45.0, 52.0, 62.0) + Eigen::Vector3d::Constant(25.0 * height + curtain);
}

Eigen::Vector3d FacadePaint::color(const Eigen::Vector2d& at) const {
  const PaintedWindow* const window = windowAt(at);
  return window == nullptr ? wallColor(at) : windowColor(*window, at);
}

}  // namespace storey::synth
