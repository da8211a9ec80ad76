// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/color_mixture.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace storey::detail {
namespace {

constexpr std::size_t kMaxComponents = 5;
constexpr std::size_t kLeastSamples = 20;  // of a component: twice its 9 parameters
constexpr std::size_t kMaxSamples = 4000;  // more change nothing
constexpr int kIterations = 15;
constexpr float kLeastVariance = 9.0f;  // grey levels squared: noise of a photo

/// Evenly spaced ones, in the order of brightness.
std::vector<Eigen::Array3f> selectSamples(const std::vector<Eigen::Array3f>& colors) {
  const std::size_t step = 1 + (colors.size() - 1) / kMaxSamples;
  std::vector<Eigen::Array3f> samples;
  for (std::size_t i = 0; i < colors.size(); i += step) samples.push_back(colors[i]);
  std::stable_sort(
      samples.begin(), samples.end(),
      [](const Eigen::Array3f& a, const Eigen::Array3f& b) { return a.sum() < b.sum(); });
  return samples;
}

}  // namespace

ColorMixture::Component ColorMixture::fit(const std::vector<Eigen::Array3f>& colors,
                                          const Eigen::VectorXf& shares) const {
  Component component;
  const float total = shares.sum();
  component.mean.setZero();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    component.mean += shares[static_cast<int>(i)] / total * colors[i].matrix();
  }
  Eigen::Matrix3f covariance = kLeastVariance * Eigen::Matrix3f::Identity();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Eigen::Vector3f d = colors[i].matrix() - component.mean;
    covariance += shares[static_cast<int>(i)] / total * d * d.transpose();
  }
  const Eigen::Matrix3f root = covariance.llt().matrixL();
  component.whitening =
      root.triangularView<Eigen::Lower>().solve(Eigen::Matrix3f::Identity().eval());
  const float share = total / static_cast<float>(colors.size());
  component.log_weight = std::log(share) - root.diagonal().array().log().sum() -
                         1.5f * std::log(2.0f * static_cast<float>(M_PI));
  return component;
}

ColorMixture::ColorMixture(const std::vector<Eigen::Array3f>& colors) {
  const std::vector<Eigen::Array3f> samples = selectSamples(colors);
  const std::size_t num_components =
      std::clamp(samples.size() / kLeastSamples, std::size_t{1}, kMaxComponents);
  const auto rows = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXf shares = Eigen::MatrixXf::Zero(rows, static_cast<Eigen::Index>(num_components));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    shares(static_cast<int>(i), static_cast<int>(i * num_components / samples.size())) = 1.0f;
  }
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    components_.clear();
    for (Eigen::Index k = 0; k < shares.cols(); ++k) {
      const bool lives = shares.col(k).sum() >= 1.0f;  // else nothing is left to fit it to
      if (lives) components_.push_back(fit(samples, shares.col(k)));
    }
    shares.resize(rows, static_cast<Eigen::Index>(components_.size()));
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < components_.size(); ++k) {
        const Component& c = components_[k];
        const Eigen::Vector3f d = samples[static_cast<std::size_t>(i)].matrix() - c.mean;
        shares(i, static_cast<int>(k)) = c.log_weight - 0.5f * (c.whitening * d).squaredNorm();
      }
      shares.row(i) = (shares.row(i).array() - shares.row(i).maxCoeff()).exp();
      shares.row(i) /= shares.row(i).sum();
    }
  }
}

float ColorMixture::logDensity(const Eigen::Array3f& color) const {
  float highest = -std::numeric_limits<float>::infinity();
  std::array<float, kMaxComponents> logs{};
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const Component& c = components_[k];
    logs[k] = c.log_weight - 0.5f * (c.whitening * (color.matrix() - c.mean)).squaredNorm();
    highest = std::max(highest, logs[k]);
  }
  float sum = 0.0f;
  for (std::size_t k = 0; k < components_.size(); ++k) sum += std::exp(logs[k] - highest);
  return highest + std::log(sum);
}

}  // namespace storey::detail
