// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/window_depth.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr int kSamples = 24;                           // across a window and up it
constexpr int kLeastCommon = kSamples * kSamples / 4;  // samples that two photos must share
constexpr double kBlur = 1.5;  // pixels of a photo that an edge is spread over, to either side
constexpr std::size_t kMaxWindows = 40;  // more tell nothing new

/// A photo that sees a window. Nearer to the opening's edge than `rim`, its pixels mix in the wall.
struct WindowView {
  const TexturePhoto* photo;
  double rim;  // in the model's unit
};

/// Brightness of the samples of a window's pane in a photo; NaN where it does not show them.
using PaneSamples = Eigen::ArrayXf;

PaneSamples samplePane(const TextureGrid& grid, const WindowView& view, const FacadeWindow& window,
                       double depth) {
  const TexturePhoto& photo = *view.photo;
  PaneSamples samples =
      PaneSamples::Constant(kSamples * kSamples, std::numeric_limits<float>::quiet_NaN());
  const Eigen::Vector2d size = window.max - window.min;
  const Eigen::Vector3d normal = grid.frame.normal();
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const Eigen::Vector2d share((i % kSamples + 0.5) / kSamples, (i / kSamples + 0.5) / kSamples);
    const Eigen::Vector2d place = window.min + size.cwiseProduct(share);
    const Eigen::Vector3d point = grid.frame.point(place.x(), place.y()) - depth * normal;
    const Eigen::Vector3d to_eye = photo.center - point;
    const Eigen::Vector3d opening = point + depth / to_eye.dot(normal) * to_eye;
    const Eigen::Vector2d through = grid.frame.local(opening);
    Sighting sighting;
    if ((through - window.min).minCoeff() < view.rim) continue;
    if ((window.max - through).minCoeff() < view.rim) continue;
    if (!sight(photo, grid.frame, point, sighting)) continue;
    samples[i] =
        photo.pyramid.sample(sighting.pixel, sighting.pixels_per_length * grid.texel).mean();
  }
  return samples;
}

/// Normalised cross-correlation of the samples that both have; NaN if they are too few.
double correlation(const PaneSamples& a, const PaneSamples& b) {
  double n = 0.0, sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    const double u = a[i];
    const double v = b[i];
    n += 1.0;
    sum_a += u;
    sum_b += v;
    aa += u * u;
    bb += v * v;
    ab += u * v;
  }
  if (n < kLeastCommon) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kNoise = 4.0;  // variance of grey levels that is no pattern
  const double var_a = std::max(0.0, aa - sum_a * sum_a / n) + n * kNoise;
  const double var_b = std::max(0.0, bb - sum_b * sum_b / n) + n * kNoise;
  return (ab - sum_a * sum_b / n) / std::sqrt(var_a * var_b);
}

/// Mean correlation of all pairs of photos that see a window, at one depth; NaN if none do.
double agreement(const TextureGrid& grid, const std::vector<WindowView>& views,
                 const FacadeWindow& window, double depth) {
  std::vector<PaneSamples> samples;
  for (const WindowView& view : views) {
    samples.push_back(samplePane(grid, view, window, depth));
  }
  double sum = 0.0;
  int pairs = 0;
  for (std::size_t a = 0; a < samples.size(); ++a) {
    for (std::size_t b = a + 1; b < samples.size(); ++b) {
      const double c = correlation(samples[a], samples[b]);
      if (std::isnan(c)) continue;
      sum += c;
      ++pairs;
    }
  }
  return pairs > 0 ? sum / pairs : std::numeric_limits<double>::quiet_NaN();
}

/// Evenly drawn windows that are no doubt windows.
std::vector<FacadeWindow> select(const std::vector<FacadeWindow>& windows) {
  std::vector<FacadeWindow> clear;
  for (const FacadeWindow& window : windows) {
    if (!window.doubtful) clear.push_back(window);
  }
  const std::size_t step = 1 + (clear.size() - 1) / kMaxWindows;
  std::vector<FacadeWindow> selected;
  for (std::size_t i = 0; i < clear.size(); i += step) selected.push_back(clear[i]);
  return selected;
}

/// Agreement of each window (rows) at each depth (columns).
Eigen::ArrayXXd agreements(const TextureGrid& grid, const FacadeSight& facades,
                           const std::vector<TexturePhoto>& photos,
                           const std::vector<RectifiedView>& views,
                           const std::vector<FacadeWindow>& windows, const Eigen::ArrayXd& depths) {
  Eigen::ArrayXXd table(windows.size(), depths.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t w = 0; w < static_cast<std::ptrdiff_t>(windows.size()); ++w) {
    const FacadeWindow& window = windows[static_cast<std::size_t>(w)];
    const Eigen::Vector2d middle = 0.5 * (window.min + window.max);
    const Eigen::Vector3d point = grid.frame.point(middle.x(), middle.y());
    std::vector<WindowView> seeing;
    for (const RectifiedView& view : views) {
      const TexturePhoto& photo = photos[static_cast<std::size_t>(view.photo)];
      if (facades.isBlocked(photo.center, point, grid.facade)) continue;
      seeing.push_back({&photo, kBlur * grid.texel / std::min(1.0, view.sharpness)});
    }
    for (Eigen::Index d = 0; d < depths.size(); ++d) {
      table(w, d) = agreement(grid, seeing, window, depths[d]);
    }
  }
  return table;
}

/// Place of the greatest of values at -1, 0 and 1, on the parabola through them.
double peak(double before, double here, double behind) {
  const double curvature = before - 2.0 * here + behind;
  return curvature < 0.0 ? std::clamp(0.5 * (before - behind) / curvature, -0.5, 0.5) : 0.0;
}

/// Whether windows agree better at a depth than on the facade, beyond their scatter.
bool isBetter(const Eigen::ArrayXd& at_depth, const Eigen::ArrayXd& on_facade) {
  constexpr double kDeviations = 3.0;
  const Eigen::ArrayXd gains = at_depth - on_facade;
  const auto n = static_cast<double>(gains.size());
  const double mean = gains.mean();
  const double deviation = std::sqrt((gains - mean).square().sum() / std::max(1.0, n - 1.0));
  return mean > kDeviations * deviation / std::sqrt(n);
}

}  // namespace

WindowDepth findDepth(const TextureGrid& grid, const FacadeSight& facades,
                      const std::vector<TexturePhoto>& photos,
                      const std::vector<RectifiedView>& views,
                      const std::vector<FacadeWindow>& windows) {
  constexpr double kLeastAgreement = 0.5;  // correlation: half of what photos show is the same
  constexpr double kStep = 0.5;            // texels: a quarter of what edges are blurred over
  const std::vector<FacadeWindow> selected = select(windows);
  if (selected.empty() || views.size() < 2) return {};
  const Eigen::Vector2d size = selected[0].max - selected[0].min;
  const auto reach =
      static_cast<Eigen::Index>(std::ceil(0.5 * size.minCoeff() / (kStep * grid.texel)));
  const auto last = static_cast<double>(reach);
  const Eigen::ArrayXd depths =
      kStep * grid.texel * Eigen::ArrayXd::LinSpaced(2 * reach + 1, -last, last);
  const Eigen::ArrayXXd table = agreements(grid, facades, photos, views, selected, depths);

  Eigen::ArrayXd means = Eigen::ArrayXd::Constant(depths.size(), -1.0);
  for (Eigen::Index d = 0; d < depths.size(); ++d) {
    const auto known = table.col(d) == table.col(d);
    if (2 * known.count() > table.rows()) {
      means[d] = known.select(table.col(d), 0.0).sum() / static_cast<double>(known.count());
    }
  }
  Eigen::Index best = 0;
  means.maxCoeff(&best);
  WindowDepth result;
  result.known = means[best] > kLeastAgreement;
  if (!result.known || best == 0 || best == depths.size() - 1) return result;
  const double depth =
      depths[best] + kStep * grid.texel * peak(means[best - 1], means[best], means[best + 1]);
  std::vector<Eigen::Index> both;
  for (Eigen::Index w = 0; w < table.rows(); ++w) {
    if (std::isfinite(table(w, best)) && std::isfinite(table(w, reach))) both.push_back(w);
  }
  Eigen::ArrayXd at_depth(static_cast<Eigen::Index>(both.size()));
  Eigen::ArrayXd on_facade(at_depth.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    at_depth[static_cast<Eigen::Index>(i)] = table(both[i], best);
    on_facade[static_cast<Eigen::Index>(i)] = table(both[i], reach);
  }
  const bool stands_off = std::abs(depth) > grid.texel && isBetter(at_depth, on_facade);
  result.depth = stands_off ? depth : 0.0;
  return result;
}

}  // namespace storey::detail
