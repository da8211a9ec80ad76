// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/console/print.h>
#include <storey/surface/detail/wall_corners.h>
#include <storey/surface/detail/wall_round.h>
#include <storey/surface/detail/wall_solving.h>

#include <cmath>

namespace storey {
namespace {

using detail::FittedWall;
using detail::FittedWalls;
using detail::WallMoments;

// From the frame that the points of a wall were gathered in to that of its line by now.
class FrameChange {
 public:
  FrameChange(const detail::WallFrame& from, const FittedWall& to)
      : along_(partsOf(from, to, to.tangent())), across_(partsOf(from, to, to.normal)) {}

  double along(const detail::WallPlace& p) const { return sum(along_, p); }
  double across(const detail::WallPlace& p) const { return sum(across_, p); }

 private:
  static Eigen::Vector3d partsOf(const detail::WallFrame& from, const FittedWall& to,
                                 const Eigen::Vector2d& axis) {
    return {axis.dot(from.reference - to.reference), axis.dot(from.tangent()),
            axis.dot(from.normal)};
  }
  static double sum(const Eigen::Vector3d& parts, const detail::WallPlace& p) {
    return parts[0] + parts[1] * static_cast<double>(p.along) +
           parts[2] * static_cast<double>(p.across);
  }

  Eigen::Vector3d along_;
  Eigen::Vector3d across_;
};

// The points, gathered by wall, and the lines that are fitted to them.
struct WallPoints {
  const detail::PointsByWall& by_wall;
  unsigned int threads;

  // Sums over the points of each wall what `work(wall, along, across, sum)` adds.
  template <typename Sum, typename Work>
  std::vector<Sum> sum(const FittedWalls& walls, const Work& work) const {
    using Place = detail::WallPlace;
    return by_wall.sum<Sum>(threads,
                            [&](std::size_t k, const Place* begin, const Place* end, Sum& total) {
                              const FrameChange change(by_wall.frames()[k], walls[k]);
                              for (const Place* p = begin; p != end; ++p) {
                                work(walls[k], change.along(*p), change.across(*p), total);
                              }
                            });
  }
};

// Sums of `sumResiduals` and `sumMoments` over points that come in parts.
template <typename Sum>
void addTo(std::vector<Sum>& total, const std::vector<Sum>& part) {
  total.resize(part.size());
  for (std::size_t k = 0; k < part.size(); ++k) total[k] += part[k];
}

std::vector<detail::WallResiduals> sumResiduals(const WallPoints& points, double noise,
                                                const FittedWalls& walls) {
  return points.sum<detail::WallResiduals>(
      walls, [noise](const FittedWall&, double, double across, detail::WallResiduals& sum) {
        sum.histogram.add(across / noise);
        ++sum.points;
      });
}

// \return whether there are any
bool findPanes(const std::vector<detail::WallResiduals>& residuals, unsigned int threads,
               FittedWalls& walls) {
  std::vector<FittedWall*> seen;
  std::vector<detail::ResidualHistogram> histograms;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    walls[k].panes = {};
    if (residuals[k].points < detail::kMinWallSupport) continue;
    seen.push_back(&walls[k]);
    histograms.push_back(residuals[k].histogram);
  }
  const std::vector<detail::WallPanes> all_panes = detail::fitPanes(histograms, threads);
  for (std::size_t k = 0; k < all_panes.size(); ++k) seen[k]->panes = all_panes[k];
  return !all_panes.empty();
}

// Tukey's weights; where the wall has panes, one step of expectation and maximisation.
std::vector<WallMoments> sumMoments(const WallPoints& points, double noise,
                                    const FittedWalls& walls) {
  return points.sum<WallMoments>(
      walls, [noise](const FittedWall& wall, double along, double across, WallMoments& sum) {
        if (wall.panes.in_use) {
          const auto expected = wall.panes.expected(across / noise);
          sum.add(along, expected.residual * noise, expected.weight);
          return;
        }
        const double weight = detail::tukeyWeight(across / noise);
        if (weight > 0.0) sum.add(along, across, weight);
      });
}

void setMoments(const std::vector<WallMoments>& sums, FittedWalls& walls) {
  for (std::size_t k = 0; k < walls.size(); ++k) walls[k].sums = sums[k];
}

}  // namespace

std::map<int, WallFit> detail::fitWalls(std::vector<FloorplanLayer>& layers,
                                        const FitPoints& points, const FitOptions& options,
                                        PointsByWall& by_wall) {
  if (!(options.noise > 0.0) || std::isinf(options.noise)) {
    PCL_ERROR("[storey::fitWalls] noise is %g, expected finite and > 0.\n", options.noise);
    return {};
  }
  if (points.normals.size() != points.positions.size()) {
    PCL_ERROR("[storey::fitWalls] %zu normals for %zu points.\n", points.normals.size(),
              points.positions.size());
    return {};
  }
  if (layers.empty()) return {};
  std::map<int, WallFit> fits;
  FittedWalls walls;
  bool panes = false;
  for (int round = 0; round < options.rounds; ++round) {
    const bool anew = by_wall.gather(layers, points, options.noise, options.threads);
    if (anew || round == 0) walls = wallsOf(by_wall.frames());
    const WallPoints of_walls{by_wall, options.threads};
    // About lines that are nearly right; what was not there is not there for the same points.
    if (options.find_panes && round > 0 && (anew || round == 1 || panes)) {
      panes = findPanes(sumResiduals(of_walls, options.noise, walls), options.threads, walls);
    }
    setMoments(sumMoments(of_walls, options.noise, walls), walls);
    fits = solveWalls(walls, options.noise);
    if (options.share_directions) shareDirections(walls, fits);
    moveCorners(layers, fits);
  }
  return fits;
}

std::map<int, WallFit> fitWalls(std::vector<FloorplanLayer>& layers, const FitPoints& points,
                                const FitOptions& options) {
  detail::PointsByWall by_wall;
  return detail::fitWalls(layers, points, options, by_wall);
}

detail::WallRound::WallRound(const std::vector<FloorplanLayer>& layers, const FitPoints& sample,
                             const FitOptions& options)
    : layers_(layers), options_(options) {
  PointsByWall by_wall;
  by_wall.gather(layers_, sample, options_.noise, options_.threads);
  walls_ = wallsOf(by_wall.frames());
  if (!options_.find_panes) return;
  const WallPoints of_walls{by_wall, options_.threads};
  findPanes(sumResiduals(of_walls, options_.noise, walls_), options_.threads, walls_);
}

void detail::WallRound::add(const FitPoints& part) {
  PointsByWall by_wall;
  by_wall.gather(layers_, part, options_.noise, options_.threads);
  const WallPoints of_walls{by_wall, options_.threads};
  addTo(residuals_, sumResiduals(of_walls, options_.noise, walls_));
  addTo(moments_, sumMoments(of_walls, options_.noise, walls_));
}

std::map<int, WallFit> detail::WallRound::solve() {
  if (moments_.empty()) return {};
  if (options_.find_panes) findPanes(residuals_, options_.threads, walls_);
  setMoments(moments_, walls_);
  std::map<int, WallFit> fits = solveWalls(walls_, options_.noise);
  if (options_.share_directions) shareDirections(walls_, fits);
  return fits;
}

}  // namespace storey
