// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/exposure_levelling.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr std::size_t kMaxBlocks = 20000;
constexpr std::size_t kMinShared = 20;  // blocks of a pair: a median of fewer is left out
constexpr double kLevelError = 0.02;    // deviation of a median: walls are not quite matt
constexpr double kUsualExposure = 0.3;  // deviation of the factors, as logarithms, from 1
constexpr float kDarkest = 8.0f;        // grey levels: ratios of darker or brighter ones say
constexpr float kBrightest = 247.0f;    // more of the sensor's range than of the exposure

using Logs = std::vector<Eigen::Array3f>;

/// Logarithm of a block's mean colour; false if it is too dark, too bright or not wholly shown.
bool logColor(const BlockView& view, Eigen::Array3f& log_color) {
  if (view.numShown() < kCells) return false;
  Eigen::Array3f mean = Eigen::Array3f::Zero();
  for (const Eigen::Array3f& color : view.colors) mean += color / static_cast<float>(kCells);
  if (mean.minCoeff() < kDarkest || mean.maxCoeff() > kBrightest) return false;
  log_color = mean.log();
  return true;
}

/// Logarithms of the ratios of the pairs k < l, at k * num_photos + l.
std::vector<Logs> collectRatios(const std::vector<std::vector<std::vector<BlockView>>>& views,
                                std::size_t num_photos) {
  std::size_t num_blocks = 0;
  for (const auto& facade : views) num_blocks += facade.size();
  const std::size_t step = num_blocks / kMaxBlocks + 1;
  std::vector<Logs> ratios(num_photos * num_photos);
  std::size_t block = 0;
  for (const auto& facade : views) {
    for (const auto& here : facade) {
      if (block++ % step != 0) continue;
      std::vector<std::pair<std::size_t, Eigen::Array3f>> logs;
      Eigen::Array3f log_color;
      for (const BlockView& view : here) {
        if (logColor(view, log_color)) logs.emplace_back(view.photo, log_color);
      }
      for (std::size_t a = 0; a < logs.size(); ++a) {
        for (std::size_t b = a + 1; b < logs.size(); ++b) {
          ratios[logs[a].first * num_photos + logs[b].first].push_back(logs[a].second -
                                                                       logs[b].second);
        }
      }
    }
  }
  return ratios;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median and its weight, from the scatter about it.
struct Ratio {
  double log = 0.0;
  double weight = 0.0;
};

Ratio summarize(const Logs& logs, int channel) {
  std::vector<double> values;
  for (const Eigen::Array3f& log : logs) values.push_back(log[channel]);
  Ratio ratio;
  ratio.log = medianOf(values);
  for (double& value : values) value = std::abs(value - ratio.log);
  constexpr double kDeviationOfMad = 1.4826;
  const double scatter = kDeviationOfMad * medianOf(values);
  ratio.weight = 1.0 / (kLevelError * kLevelError + scatter * scatter);
  return ratio;
}

}  // namespace

std::vector<Eigen::Array3f> levelExposures(
    const std::vector<std::vector<std::vector<BlockView>>>& views, std::size_t num_photos) {
  const std::vector<Logs> ratios = collectRatios(views, num_photos);
  const auto n = static_cast<Eigen::Index>(num_photos);
  std::vector<Eigen::Array3f> gains(num_photos);
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) / (kUsualExposure * kUsualExposure);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      for (Eigen::Index l = k + 1; l < n; ++l) {
        const Logs& logs = ratios[static_cast<std::size_t>(k * n + l)];
        if (logs.size() < kMinShared) continue;
        const Ratio ratio = summarize(logs, c);
        normal(k, k) += ratio.weight;
        normal(l, l) += ratio.weight;
        normal(k, l) -= ratio.weight;
        normal(l, k) -= ratio.weight;
        right(k) -= ratio.weight * ratio.log;
        right(l) += ratio.weight * ratio.log;
      }
    }
    const Eigen::VectorXd logs = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < num_photos; ++k) {
      gains[k][c] = static_cast<float>(std::exp(logs[static_cast<Eigen::Index>(k)]));
    }
  }
  return gains;
}

}  // namespace storey::detail
