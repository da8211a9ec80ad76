// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/threads.h>
#include <storey/segmentation/detail/point_blocks.h>
#include <storey/segmentation/detail/wall_ends.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kGate = 2.5;          // noise deviations
constexpr double kMinOccupancy = 0.3;  // of the expected points of a bin
constexpr double kBand = 10.0;         // noise deviations of height
constexpr double kBin = 3.0;           // noise deviations along a wall
constexpr double kBinPoints = 6.0;
constexpr double kTail = 0.399;  // noise deviations of a wall have strayed past its end

// Where a wall ends in one band of heights.
struct BandEnd {
  double s;
  bool far;  // the end towards larger s
  std::size_t band;
};

// The places along a wall of its points in one band, ascending.
using Places = std::vector<double>;

// Runs of a wall in one band, as ranges of its places.
std::vector<std::pair<std::size_t, std::size_t>> runsOf(const Places& places, double bin,
                                                        double least) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  bool seen_before = false;
  for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
    const double number = std::floor((places[from] - places.front()) / bin);
    while (to < places.size() && std::floor((places[to] - places.front()) / bin) == number) ++to;
    const bool seen = static_cast<double>(to - from) >= least;
    const bool next =
        from > 0 && std::floor((places[from - 1] - places.front()) / bin) == number - 1.0;
    if (seen && seen_before && next) {
      runs.back().second = to;
    } else if (seen) {
      runs.emplace_back(from, to);
    }
    seen_before = seen;
  }
  return runs;
}

class EndFinder {
 public:
  EndFinder(const std::vector<WallLine>& walls, const std::vector<WallPoint>& points,
            const WallScale& scale, const HeightDensity& density, unsigned int threads)
      : walls_(walls), scale_(scale), threads_(threads), density_(density) {
    double high = -std::numeric_limits<double>::infinity();
    low_ = -high;
    for (const WallPoint& p : points) {
      low_ = std::min(low_, p.z);
      high = std::max(high, p.z);
    }
    band_ = kBand * scale.noise;
    num_bands_ = static_cast<std::size_t>((high - low_) / band_) + 1;
    places_.resize(walls.size() * num_bands_);
    const std::vector<std::size_t> wall_of = wallsOf(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t wall = wall_of[i];
      if (wall == walls_.size()) continue;
      const auto band = static_cast<std::size_t>((points[i].z - low_) / band_);
      places_[wall * num_bands_ + band].push_back(walls_[wall].along(points[i].position));
    }
  }

  std::vector<WallEnd> find() {
    std::vector<std::vector<WallEnd>> of_walls(walls_.size());
#pragma omp parallel for num_threads(threadsFor(threads_)) schedule(dynamic, 1)
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(of_walls.size()); ++i) {
      const auto w = static_cast<std::size_t>(i);
      std::vector<BandEnd> of_bands;
      for (std::size_t b = 0; b < num_bands_; ++b) addBandEnds(w, b, of_bands);
      joinBands(walls_[w], std::move(of_bands), of_walls[w]);
    }
    std::vector<WallEnd> ends;
    for (const std::vector<WallEnd>& of_wall : of_walls) {
      ends.insert(ends.end(), of_wall.begin(), of_wall.end());
    }
    return ends;
  }

 private:
  std::vector<std::size_t> wallsNear(const PointBlocks& blocks, std::size_t block) const {
    std::vector<std::size_t> near;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      if (blocks.mayBeNear(block, walls_[w].normal, walls_[w].offset, kGate * scale_.noise)) {
        near.push_back(w);
      }
    }
    return near;
  }

  // The nearest wall that each point confirms; the number of walls if there is none.
  std::vector<std::size_t> wallsOf(const std::vector<WallPoint>& points) const {
    const PointBlocks blocks(points);
    std::vector<std::size_t> wall_of(points.size());
#pragma omp parallel for num_threads(threadsFor(threads_)) schedule(dynamic, 64)
    for (std::ptrdiff_t b = 0; b < static_cast<std::ptrdiff_t>(blocks.size()); ++b) {
      const auto block = static_cast<std::size_t>(b);
      const std::vector<std::size_t> near = wallsNear(blocks, block);
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
        wall_of[i] = wallOf(points[i], near);
      }
    }
    return wall_of;
  }

  std::size_t wallOf(const WallPoint& p, const std::vector<std::size_t>& near) const {
    double nearest = kGate * scale_.noise;
    std::size_t wall = walls_.size();
    for (const std::size_t w : near) {
      const double d = std::abs(walls_[w].across(p.position));
      if (d >= nearest || walls_[w].normal.dot(p.normal) < kMinAgreement) continue;
      nearest = d;
      wall = w;
    }
    return wall;
  }

  void addBandEnds(std::size_t wall, std::size_t band, std::vector<BandEnd>& ends) {
    Places& places = places_[wall * num_bands_ + band];
    std::sort(places.begin(), places.end());
    const double per_length = band_ * density_.at(low_ + band_ * (static_cast<double>(band) + 0.5));
    const double bin = std::max(kBin * scale_.noise, kBinPoints / per_length);
    for (const auto& [from, to] : runsOf(places, bin, kMinOccupancy * per_length * bin)) {
      const double length = places[to - 1] - places[from];
      if (length < kMinEndedRun * scale_.noise) continue;
      // The points of the noise's tail have strayed past the end.
      const auto tail =
          static_cast<std::size_t>(kTail * scale_.noise * static_cast<double>(to - from) / length);
      ends.push_back({places[from + tail], false, band});
      ends.push_back({places[to - 1 - tail], true, band});
    }
  }

  // What hides a part of a wall has any outline; where the wall ends, it does so at all heights.
  void joinBands(const WallLine& wall, std::vector<BandEnd> of_bands, std::vector<WallEnd>& ends) {
    std::stable_sort(of_bands.begin(), of_bands.end(),
                     [](const BandEnd& a, const BandEnd& b) { return a.s < b.s; });
    while (true) {
      Stretch best;
      for (std::size_t i = 0; i < of_bands.size(); ++i) {
        const Stretch stretch = stretchFrom(of_bands, i);
        if (stretch.score > best.score) best = stretch;
      }
      if (best.score * band_ < kMinEndHeight * scale_.noise) return;
      const double s = best.places[best.places.size() / 2];
      ends.push_back({wall.offset * wall.normal + s * wall.tangent(), wall.normal,
                      (best.far ? 1.0 : -1.0) * wall.tangent(),
                      low_ + band_ * static_cast<double>(best.first),
                      low_ + band_ * static_cast<double>(best.last + 1), best.score * band_});
      const auto taken = [&](const BandEnd& end) {
        return end.far == best.far && end.s >= best.places.front() && end.s <= best.places.back() &&
               end.band >= best.first && end.band <= best.last;
      };
      of_bands.erase(std::remove_if(of_bands.begin(), of_bands.end(), taken), of_bands.end());
    }
  }

  // Bands in which a wall ends at one place. Each of them counts one, each other between them takes
  // one away.
  struct Stretch {
    double score = 0.0;
    std::size_t first = 0;
    std::size_t last = 0;
    bool far = false;
    std::vector<double> places;  // ascending
  };

  // The best one at the place of an end and up to the reach beyond it.
  Stretch stretchFrom(const std::vector<BandEnd>& ends, std::size_t from) const {
    std::vector<std::size_t> bands;
    const bool far = ends[from].far;
    std::size_t to = from;
    for (; to < ends.size() && ends[to].s - ends[from].s < kEndReach * scale_.noise; ++to) {
      if (ends[to].far == far) bands.push_back(ends[to].band);
    }
    std::sort(bands.begin(), bands.end());
    Stretch best;
    best.far = far;
    double score = 0.0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const double gap =
          i > 0 ? static_cast<double>(bands[i]) - static_cast<double>(bands[i - 1]) : 1.0;
      score += std::min(1.0, 2.0 - gap);
      if (score < 1.0) {
        score = 1.0;
        first = bands[i];
      }
      if (i == 0) first = bands[0];
      if (score <= best.score) continue;
      best.score = score;
      best.first = first;
      best.last = bands[i];
    }
    for (std::size_t i = from; i < to; ++i) {
      const BandEnd& end = ends[i];
      if (end.far == far && end.band >= best.first && end.band <= best.last) {
        best.places.push_back(end.s);
      }
    }
    return best;
  }

  const std::vector<WallLine>& walls_;
  const WallScale& scale_;
  unsigned int threads_;
  const HeightDensity& density_;
  double low_ = 0.0;
  double band_ = 1.0;
  std::size_t num_bands_ = 0;
  std::vector<Places> places_;  // wall by wall and band
};

}  // namespace

std::vector<WallEnd> findWallEnds(const std::vector<WallLine>& walls,
                                  const std::vector<WallPoint>& points, const WallScale& scale,
                                  const HeightDensity& density, unsigned int threads) {
  if (walls.empty() || points.empty()) return {};
  return EndFinder(walls, points, scale, density, threads).find();
}

}  // namespace storey::detail
