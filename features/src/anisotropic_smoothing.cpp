// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/anisotropic_smoothing.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

constexpr int kMaxIterations = 50;
// The normals rest when they turn by less than this (root mean square, rad: 0.1 degree).
constexpr double kRestingTurn = 1.7453293e-3;
constexpr std::size_t kBlock = 4096;  // points whose change is summed in one go, by one thread

float inverseSquare(double sigma) {
  return sigma > 0.0 ? static_cast<float>(1.0 / (sigma * sigma)) : 0.0f;
}

float inverseOfPsi(double sigma_n) { return static_cast<float>(1.0 / (1.0 - std::cos(sigma_n))); }

// Equation (2), left: phi(d) = exp(-(d / sigma_p)^2).
std::vector<float> phiOf(const std::vector<float>& distances, double sigma_p) {
  const float inverse = inverseSquare(sigma_p);
  std::vector<float> phi(distances.size());
  for (std::size_t i = 0; i < phi.size(); ++i) {
    phi[i] = fastExpOfMinus(distances[i] * distances[i] * inverse);
  }
  return phi;
}

// The neighbours of one point, gathered coordinate by coordinate, so that all that follows runs
// over flat arrays, four at a time.
class Kernel {
 public:
  explicit Kernel(const SmoothingParameters& parameters)
      : inverse_psi_(inverseOfPsi(parameters.sigma_n)),
        alpha_(static_cast<float>(parameters.alpha)) {}

  // Where a point stands among its own neighbours, in the row of a copy of it, its representative
  // belongs.
  void gather(const PaddedNormals& normals, const std::uint32_t* neighbors, const float* phi,
              std::size_t count, std::uint32_t self, std::uint32_t representative) {
    reserve(count);
    size_ = static_cast<Eigen::Index>(count);
    float* x = x_.data();
    float* y = y_.data();
    float* z = z_.data();
    const Eigen::Vector4f* all = normals.data();
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t j = neighbors[k];
      const float* n = all[j == self ? representative : j].data();
      x[k] = n[0];
      y[k] = n[1];
      z[k] = n[2];
    }
    std::copy(phi, phi + count, weight_.data());
  }

  // Equation (3) with psi of equation (2), right. Without any weight the normal stays.
  Eigen::Vector4f update(const Eigen::Vector4f& normal, const Eigen::Vector4f& prior) {
    const float nx = normal.x();
    const float ny = normal.y();
    const float nz = normal.z();
    const float* x = x_.data();
    const float* y = y_.data();
    const float* z = z_.data();
    float* weight = weight_.data();
    const Eigen::Index size = size_;
    const float inverse_psi = inverse_psi_;
    for (Eigen::Index k = 0; k < size; ++k) {
      const float t = (1.0f - (nx * x[k] + ny * y[k] + nz * z[k])) * inverse_psi;
      weight[k] *= fastExpOfMinus(t * t);
    }
    const auto w = weight_.head(size_);
    const Eigen::Vector4f sum =
        alpha_ * prior + Eigen::Vector4f((w * x_.head(size_)).sum(), (w * y_.head(size_)).sum(),
                                         (w * z_.head(size_)).sum(), 0.0f);
    const float length = sum.norm();
    if (!(length > 0.0f)) {
      return normal;
    }
    return sum * ((sum.dot(prior) < 0.0f ? -1.0f : 1.0f) / length);
  }

 private:
  void reserve(std::size_t count) {
    if (static_cast<std::size_t>(weight_.size()) < count) {
      for (Eigen::ArrayXf* array : {&x_, &y_, &z_, &weight_}) {
        array->resize(static_cast<Eigen::Index>(count));
      }
    }
  }

  float inverse_psi_;
  float alpha_;
  Eigen::Index size_ = 0;
  Eigen::ArrayXf x_, y_, z_;
  Eigen::ArrayXf weight_;
};

// Updates the points [begin, end) and returns the sum of their squared changes.
double updateBlock(const PaddedNormals& priors, const PaddedNormals& normals,
                   const Neighborhoods& hoods, const std::vector<float>& phi, std::size_t begin,
                   std::size_t end, Kernel& kernel, PaddedNormals& updated) {
  double change = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t row = hoods.row_of_point[i];
    if (row == Neighborhoods::kNoRow || priors[i].isZero()) {
      continue;
    }
    const std::size_t first = hoods.first[row];
    kernel.gather(normals, hoods.neighbor.data() + first, phi.data() + first,
                  hoods.first[row + 1] - first, static_cast<std::uint32_t>(i),
                  hoods.representative[row]);
    updated[i] = kernel.update(normals[i], priors[i]);
    change += static_cast<double>((updated[i] - normals[i]).squaredNorm());
  }
  return change;
}

}  // namespace

double medianReach(const Neighborhoods& hoods) {
  std::vector<float> reach;
  for (std::size_t row = 0; row < hoods.numRows(); ++row) {
    const auto begin = hoods.distance.begin() + static_cast<std::ptrdiff_t>(hoods.first[row]);
    const auto end = hoods.distance.begin() + static_cast<std::ptrdiff_t>(hoods.first[row + 1]);
    if (begin != end) {
      reach.push_back(*std::max_element(begin, end));
    }
  }
  if (reach.empty()) {
    return 0.0;
  }
  const auto middle = reach.begin() + static_cast<std::ptrdiff_t>(reach.size() / 2);
  std::nth_element(reach.begin(), middle, reach.end());
  return static_cast<double>(*middle);
}

PaddedNormals smoothNormals(const PaddedNormals& priors, const Neighborhoods& hoods,
                            const SmoothingParameters& parameters, int* iterations) {
  const std::vector<float> phi = phiOf(hoods.distance, parameters.sigma_p);
  PaddedNormals normals = priors;
  PaddedNormals updated = priors;
  const std::size_t n = priors.size();
  const auto num_blocks = static_cast<std::ptrdiff_t>((n + kBlock - 1) / kBlock);
  std::vector<double> change(static_cast<std::size_t>(num_blocks));
  const int limit = parameters.iterations > 0 ? parameters.iterations : kMaxIterations;
  int done = 0;
  for (bool moving = n > 0; moving && done < limit; ++done) {
#pragma omp parallel num_threads(parameters.num_threads)
    {
      Kernel kernel(parameters);
#pragma omp for schedule(dynamic, 1)
      for (std::ptrdiff_t b = 0; b < num_blocks; ++b) {
        const std::size_t begin = static_cast<std::size_t>(b) * kBlock;
        change[static_cast<std::size_t>(b)] = updateBlock(
            priors, normals, hoods, phi, begin, std::min(n, begin + kBlock), kernel, updated);
      }
    }
    normals.swap(updated);
    double sum = 0.0;
    for (const double c : change) {
      sum += c;
    }
    const double resting = kRestingTurn * kRestingTurn * static_cast<double>(n);
    moving = parameters.iterations > 0 || sum > resting;
  }
  *iterations = done;
  return normals;
}

Eigen::Vector4f updatedNormal(const Eigen::Vector4f& normal, const Eigen::Vector4f& prior,
                              const std::vector<std::uint32_t>& neighbors,
                              const std::vector<float>& distances, const PaddedNormals& normals,
                              const SmoothingParameters& parameters) {
  const std::vector<float> phi = phiOf(distances, parameters.sigma_p);
  Kernel kernel(parameters);
  kernel.gather(normals, neighbors.data(), phi.data(), neighbors.size(), Neighborhoods::kNoRow,
                Neighborhoods::kNoRow);
  return kernel.update(normal, prior);
}

}  // namespace storey::detail
