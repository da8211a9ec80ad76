// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/texture_fill.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace storey::detail {
namespace {

constexpr int kMaxSamples = 256;  // along the longer side, to look for repetitions in
constexpr double kLeastCorrelation = 0.3;
constexpr double kLeastOverlap = 0.25;  // of the seen samples
constexpr int kShortestPeriod = 4;      // samples: texture, not windows, repeats more often

/// Brightness of a facade, thinned; NaN where it was not seen.
Eigen::ArrayXXd thinned(const FacadeTexture& texture, int step) {
  const int columns = texture.image.width / step;
  const int rows = texture.image.height / step;
  Eigen::ArrayXXd bright = Eigen::ArrayXXd::Constant(rows, columns, std::nan(""));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      double sum = 0.0;
      int count = 0;
      for (int i = 0; i < step * step; ++i) {
        const int x = c * step + i % step;
        const int y = r * step + i / step;
        const auto texel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.image.width) +
            static_cast<std::size_t>(x);
        if (texture.states[texel] != TexelState::Seen) continue;
        const std::uint8_t* const p = texture.image.at(x, y);
        sum += p[0] + p[1] + p[2];
        ++count;
      }
      if (2 * count > step * step) bright(r, c) = sum / (3.0 * count);
    }
  }
  return bright;
}

/// Correlation of the image with itself shifted; nothing if too little overlaps.
std::optional<double> correlation(const Eigen::ArrayXXd& bright, int dx, int dy, int num_seen) {
  double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (Eigen::Index c = 0; c + dx < bright.cols(); ++c) {
    for (Eigen::Index r = 0; r + dy < bright.rows(); ++r) {
      const double first = bright(r, c);
      const double second = bright(r + dy, c + dx);
      if (std::isnan(first) || std::isnan(second)) continue;
      n += 1.0;
      a += first;
      b += second;
      aa += first * first;
      bb += second * second;
      ab += first * second;
    }
  }
  const double spread = (n * aa - a * a) * (n * bb - b * b);
  if (n < kLeastOverlap * num_seen || !(spread > 0.0)) return std::nullopt;
  return (n * ab - a * b) / std::sqrt(spread);
}

/// The best local maximum of the correlations at the shifts 0, 1, ...; 0 if there is none.
int bestShift(const std::vector<std::optional<double>>& at) {
  int best = 0;
  double highest = kLeastCorrelation;
  for (std::size_t s = kShortestPeriod; s + 1 < at.size(); ++s) {
    if (!at[s] || !at[s - 1] || !at[s + 1]) continue;
    const bool is_peak = *at[s] >= *at[s - 1] && *at[s] >= *at[s + 1];
    // A multiple of the period correlates as well: it must be clearly better to be taken.
    constexpr double kClearly = 0.05;
    if (is_peak && *at[s] > highest + (best > 0 ? kClearly : 0.0)) {
      highest = *at[s];
      best = static_cast<int>(s);
    }
  }
  return best;
}

using Colors = std::vector<Eigen::Array4f>;  // red, green, blue, weight

/// Fills what has no weight from means of 2 x 2, of those of 4 x 4, and so on.
void fillSmoothly(Colors& colors, int width, int height) {
  if (width * height <= 1) return;
  const int half_width = (width + 1) / 2;
  const int half_height = (height + 1) / 2;
  Colors half(static_cast<std::size_t>(half_width * half_height), Eigen::Array4f::Zero());
  const auto halfAt = [&](int x, int y) -> Eigen::Array4f& {
    return half[static_cast<std::size_t>(y / 2 * half_width + x / 2)];
  };
  bool any_missing = false;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Array4f& color = colors[static_cast<std::size_t>(y * width + x)];
      any_missing |= color[3] == 0.0f;
      halfAt(x, y) += color;
    }
  }
  if (!any_missing) return;
  for (Eigen::Array4f& color : half) {
    if (color[3] > 0.0f) color /= color[3];
  }
  fillSmoothly(half, half_width, half_height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Array4f& color = colors[static_cast<std::size_t>(y * width + x)];
      if (color[3] == 0.0f) color = halfAt(x, y);
    }
  }
}

class Filler {
 public:
  explicit Filler(FacadeTexture& texture) : texture_(texture) {}

  void fill() {
    const auto any = std::find(texture_.states.begin(), texture_.states.end(), TexelState::Seen);
    if (any == texture_.states.end()) return;
    const Repetition period = findRepetition(texture_);
    bool all = true;
    const RgbImage seen = texture_.image;
    std::vector<char> filled(texture_.states.size(), 0);
    for (int y = 0; y < seen.height; ++y) {
      for (int x = 0; x < seen.width; ++x) {
        if (stateAt(x, y) != TexelState::Unseen) continue;
        const std::optional<Eigen::Vector2i> from = findSeen(x, y, period);
        all &= from.has_value();
        if (!from) continue;
        std::copy_n(seen.at(from->x(), from->y()), 3, texture_.image.at(x, y));
        filled[indexOf(x, y)] = 1;
      }
    }
    if (!all) smoothOver(filled);
    std::replace(texture_.states.begin(), texture_.states.end(), TexelState::Unseen,
                 TexelState::Filled);
  }

 private:
  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(texture_.image.width) +
           static_cast<std::size_t>(x);
  }
  TexelState stateAt(int x, int y) const { return texture_.states[indexOf(x, y)]; }
  bool isSeen(int x, int y) const {
    return x >= 0 && y >= 0 && x < texture_.image.width && y < texture_.image.height &&
           stateAt(x, y) == TexelState::Seen;
  }

  /// The nearest seen texel that is i periods across and j upwards away.
  std::optional<Eigen::Vector2i> findSeen(int x, int y, const Repetition& period) const {
    const int most_i = period.across > 0 ? texture_.image.width / period.across : 0;
    const int most_j = period.upwards > 0 ? texture_.image.height / period.upwards : 0;
    for (int ring = 1; ring <= std::max(most_i, most_j); ++ring) {
      for (int j = -std::min(ring, most_j); j <= std::min(ring, most_j); ++j) {
        for (int i = -std::min(ring, most_i); i <= std::min(ring, most_i); ++i) {
          if (std::max(std::abs(i), std::abs(j)) != ring) continue;
          const Eigen::Vector2i from(x + i * period.across, y + j * period.upwards);
          if (isSeen(from.x(), from.y())) return from;
        }
      }
    }
    return std::nullopt;
  }

  void smoothOver(const std::vector<char>& filled) {
    const int width = texture_.image.width;
    const int height = texture_.image.height;
    Colors colors(texture_.states.size(), Eigen::Array4f::Zero());
    const auto isMissing = [&](std::size_t i) {
      return texture_.states[i] == TexelState::Unseen && filled[i] == 0;
    };
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (texture_.states[i] == TexelState::Outside || isMissing(i)) continue;
      const std::uint8_t* const p = texture_.image.channels.data() + 3 * i;
      colors[i] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]),
                   1.0f};
    }
    fillSmoothly(colors, width, height);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (!isMissing(i)) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        texture_.image.channels[3 * i + c] =
            static_cast<std::uint8_t>(std::lround(colors[i][static_cast<Eigen::Index>(c)]));
      }
    }
  }

  FacadeTexture& texture_;
};

}  // namespace

Repetition findRepetition(const FacadeTexture& texture) {
  const int longer = std::max(texture.image.width, texture.image.height);
  const int step = std::max(1, longer / kMaxSamples);
  const Eigen::ArrayXXd bright = thinned(texture, step);
  const auto num_seen = static_cast<int>((!bright.isNaN()).count());
  std::vector<std::optional<double>> across;
  std::vector<std::optional<double>> upwards;
  for (int s = 0; s < bright.cols(); ++s) across.push_back(correlation(bright, s, 0, num_seen));
  for (int s = 0; s < bright.rows(); ++s) upwards.push_back(correlation(bright, 0, s, num_seen));
  return {step * bestShift(across), step * bestShift(upwards)};
}

void fillUnseen(FacadeTexture& texture) { Filler(texture).fill(); }

}  // namespace storey::detail
