// SPDX-License-Identifier: BSD-3-Clause
#include <storey/features/detail/normal_counts.h>
#include <storey/features/detail/vertical_kernels.h>
#include <storey/filters/detail/chunks.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace storey::detail {
namespace {

constexpr int kCandidates = 4000;              // 2.3 degrees apart on the hemisphere
constexpr std::size_t kScoredNormals = 20000;  // enough for shares to 0.4 %
constexpr double kWallGate = 0.1;              // |n.u| of a wall, 6 degrees
constexpr double kGuessWallGate = 0.2;         // the guess may be tilted by as much more
constexpr double kGuessLevelGate = 0.9;        // |n.u| of a roof or the ground
constexpr double kGuessGoodAs = 0.8;           // share of the best score that bears the guess out
constexpr double kElsewhere = 0.8660254;       // cos 30 degrees
constexpr double kNormalGate = 0.35;           // |n.u| of a wall with noise of 15 degrees
constexpr double kSpreadOverNoise = 4.0;       // variances; the gate halves that of the noise
constexpr int kNormalRounds = 40;
constexpr double kSettled = 1e-7;         // rad
constexpr double kLevelCone = 0.9063078;  // cos 25 degrees
constexpr double kFewLevel = 0.05;        // share of level points below which they say nothing
constexpr int kLevelRounds = 10;

Vectors3d everyNth(const Vectors3d& all, std::size_t limit) {
  const std::size_t step = std::max<std::size_t>(1, (all.size() + limit - 1) / limit);
  Vectors3d some;
  for (std::size_t i = 0; i < all.size(); i += step) {
    some.push_back(all[i]);
  }
  return some;
}

// Of the normals across each of the candidates.
std::vector<double> sharesAcross(const Vectors3d& normals, const Vectors3d& candidates,
                                 int num_threads) {
  std::array<std::vector<double>, 3> columns;
  for (const Eigen::Vector3d& n : normals) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[axis].push_back(n[static_cast<Eigen::Index>(axis)]);
    }
  }
  const VectorColumns vectors = {columns[0].data(), columns[1].data(), columns[2].data(),
                                 normals.size()};
  std::vector<double> shares(candidates.size(), 0.0);
  if (normals.empty()) {
    return shares;
  }
#pragma omp parallel for num_threads(num_threads) schedule(dynamic, 64)
  for (std::ptrdiff_t c = 0; c < static_cast<std::ptrdiff_t>(candidates.size()); ++c) {
    const auto i = static_cast<std::size_t>(c);
    shares[i] = static_cast<double>(countAcross(vectors, candidates[i].data(), kWallGate)) /
                static_cast<double>(normals.size());
  }
  return shares;
}

// Roofs and ground speak for the guess too: seen from the air they are most of the points, and
// then every horizontal direction has more normals across it than the vertical.
bool isBorneOut(const Vectors3d& normals, const Eigen::Vector3d& guess, double best_score) {
  const double walls = shareAcross(normals, guess, kGuessWallGate);
  const double level = 1.0 - shareAcross(normals, guess, kGuessLevelGate);
  return walls + level >= kGuessGoodAs * best_score;
}

// The normal equations of the turn that takes the wall normals across `up`, and how far off they
// are.
struct TurnEquations {
  Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  double noise = 0.0;

  TurnEquations& operator+=(const TurnEquations& other) {
    a += other.a;
    b += other.b;
    noise += other.noise;
    return *this;
  }
};

TurnEquations equationsAt(const Vectors3d& normals, const Eigen::Vector3d& up,
                          const Eigen::Matrix<double, 3, 2>& frame, int num_threads) {
  const auto add = [&](std::size_t begin, std::size_t end, std::vector<TurnEquations>& sums) {
    TurnEquations e;
    for (std::size_t i = begin; i < end; ++i) {
      const double lean = normals[i].dot(up);
      const double t = lean / kNormalGate;
      if (t * t < 1.0) {
        const double weight = (1.0 - t * t) * (1.0 - t * t);
        const Eigen::Vector2d h = frame.transpose() * normals[i];
        e.a += weight * h * h.transpose();
        e.b -= weight * lean * h;
        e.noise += weight * lean * lean;
      }
    }
    sums[0] += e;
  };
  const std::vector<TurnEquations> zero(1);
  return sumByChunks(normals.size(), static_cast<unsigned int>(num_threads), zero, add)[0];
}

Eigen::Vector3d convergeOnNormals(const Vectors3d& normals, const Eigen::Vector3d& start,
                                  int num_threads) {
  // Converges to the smallest eigenvector of the wall normals. Where all walls face one way, that
  // is drawn at random from the plane across; so `up` moves only in directions in which the normals
  // spread by more than their noise, which is how much they spread along `up`.
  Eigen::Vector3d up = start;
  for (int round = 0; round < kNormalRounds; ++round) {
    const Eigen::Matrix<double, 3, 2> frame = tangentFrame(up);
    const TurnEquations e = equationsAt(normals, up, frame, num_threads);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(e.a);
    Eigen::Vector2d turn = Eigen::Vector2d::Zero();
    for (int k = 0; k < 2; ++k) {
      if (solver.eigenvalues()[k] > kSpreadOverNoise * e.noise && solver.eigenvalues()[k] > 0.0) {
        const Eigen::Vector2d axis = solver.eigenvectors().col(k);
        turn += axis * (axis.dot(e.b) / solver.eigenvalues()[k]);
      }
    }
    up = (up + frame * turn).normalized();
    if (turn.norm() < kSettled) {
      break;
    }
  }
  return up;
}

}  // namespace

Eigen::Matrix<double, 3, 2> tangentFrame(const Eigen::Vector3d& up) {
  Eigen::Matrix<double, 3, 2> frame;
  frame.col(0) = up.unitOrthogonal();
  frame.col(1) = up.cross(frame.col(0));
  return frame;
}

Vectors3d fibonacciHemisphere(int count) {
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  Vectors3d directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (i + 0.5) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
  }
  return directions;
}

double shareAcross(const Vectors3d& normals, const Eigen::Vector3d& u, double gate) {
  std::size_t count = 0;
  for (const Eigen::Vector3d& n : normals) {
    count += std::abs(n.dot(u)) < gate ? 1 : 0;
  }
  return normals.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(normals.size());
}

VerticalStart findVerticalStart(const Vectors3d& normals, const Eigen::Vector3d& guess, bool forced,
                                int num_threads) {
  const Vectors3d some = everyNth(normals, kScoredNormals);
  const Vectors3d candidates = fibonacciHemisphere(kCandidates);
  const std::vector<double> scores = sharesAcross(some, candidates, num_threads);
  const auto best = static_cast<std::size_t>(
      std::distance(scores.begin(), std::max_element(scores.begin(), scores.end())));
  VerticalStart start;
  start.up = guess;
  if (!forced && !isBorneOut(some, guess, scores[best])) {
    start.up = candidates[best].dot(guess) < 0.0 ? -candidates[best] : candidates[best];
  }
  start.score = shareAcross(some, start.up, kWallGate);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (std::abs(candidates[i].dot(start.up)) < kElsewhere) {
      start.second_score = std::max(start.second_score, scores[i]);
    }
  }
  return start;
}

Eigen::Vector3d refineByNormals(const Vectors3d& normals, const Eigen::Vector3d& start,
                                int num_threads) {
  // Some of the normals lead to where all need but a round or two.
  const Eigen::Vector3d near =
      convergeOnNormals(everyNth(normals, kScoredNormals), start, 1);  // too few for more
  return convergeOnNormals(normals, near, num_threads);
}

Eigen::Vector3d refineByHorizontals(const Vectors3d& normals, const Eigen::Vector3d& start,
                                    const Eigen::Vector3d& axis) {
  Eigen::Vector3d up = start;
  for (int round = 0; round < kLevelRounds; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (const Eigen::Vector3d& n : normals) {
      if (std::abs(n.dot(up)) > kLevelCone) {
        sum += n.dot(up) < 0.0 ? Eigen::Vector3d(-n) : n;
        ++count;
      }
    }
    if (static_cast<double>(count) < kFewLevel * static_cast<double>(normals.size())) {
      return start;
    }
    const Eigen::Vector3d across = (axis - up * up.dot(axis)).normalized();
    up = (up + across * (sum.dot(across) / sum.dot(up))).normalized();
  }
  return up;
}

}  // namespace storey::detail
