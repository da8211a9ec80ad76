// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/palette_image.h>
#include <storey/surface/detail/window_proposal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace storey::detail {
namespace {

constexpr double kPixels = 40000.0;  // of the image searched: windows are some ten pixels wide
constexpr int kLeastPixels = 5;      // of a window's side: edges are blurred over one or two
constexpr int kLeastTexels = 8;      // of the raster, likewise
constexpr double kWorthless = 0.3;   // bits: any two places of a wall differ by as much

/// A rectangle of pixels.
struct Box {
  int left, top, width, height;

  int right() const { return left + width; }
  int bottom() const { return top + height; }
  int frame() const { return std::max(2, std::min(width, height) / 4); }
};

/// Sums over rectangles in constant time.
class IntegralImage {
 public:
  explicit IntegralImage(const Eigen::ArrayXXf& image)
      : sums_(Eigen::ArrayXXf::Zero(image.rows() + 1, image.cols() + 1)) {
    for (Eigen::Index x = 0; x < image.cols(); ++x) {
      float column = 0.0f;
      for (Eigen::Index y = 0; y < image.rows(); ++y) {
        column += image(y, x);
        sums_(y + 1, x + 1) = sums_(y + 1, x) + column;
      }
    }
  }

  float sum(const Box& box) const {
    return sums_(box.bottom(), box.right()) - sums_(box.top, box.right()) -
           sums_(box.bottom(), box.left) + sums_(box.top, box.left);
  }

 private:
  Eigen::ArrayXXf sums_;
};

/// Numbers of pixels of each colour.
using Histogram = Eigen::ArrayXd;

/// Search for the best grid in a facade's image.
class GridSearch {
 public:
  explicit GridSearch(const PaletteImage& image) : image_(image) {
    total_ = Histogram::Zero(image.num_colors);
    count({0, 0, width(), height()}, total_);
  }

  std::vector<Box> seeds() const;

  struct Found {
    BandGrid bands;
    Histogram inside;  // colours that its scores are learnt from
    std::vector<Box> windows;
    double information = 0.0;  // I, in bits
    double value = 0.0;
  };
  Found grow(const Box& seed) const;

  /// Scores, `WindowScores`, if pixels of these colours are window.
  WindowScores scoresOf(const Histogram& inside) const;

 private:
  int width() const { return static_cast<int>(image_.colors.cols()); }
  int height() const { return static_cast<int>(image_.colors.rows()); }
  int leastSide() const {
    return std::max(kLeastPixels, (kLeastTexels + image_.step - 1) / image_.step);
  }
  void count(const Box& box, Histogram& histogram) const;
  void seedsOf(const IntegralImage& levels, std::vector<Box>& seeds) const;
  std::optional<Box> mostDifferent(const IntegralImage& levels, const Box& size) const;
  std::vector<Box> windowsOf(const BandGrid& bands, const WindowScores& scores) const;
  void measure(Found& found) const;

  const PaletteImage& image_;
  Histogram total_;
};

void GridSearch::count(const Box& box, Histogram& histogram) const {
  for (int x = std::max(0, box.left); x < std::min(width(), box.right()); ++x) {
    for (int y = std::max(0, box.top); y < std::min(height(), box.bottom()); ++y) {
      const int color = image_.colors(y, x);
      if (color != PaletteImage::kUnseen) histogram[color] += 1.0;
    }
  }
}

/// Of each size the box that differs most from what is around it.
void GridSearch::seedsOf(const IntegralImage& levels, std::vector<Box>& seeds) const {
  constexpr double kLadder = 1.3;  // from size to size; bands may be 0.6 to 1.25 as long
  constexpr double kShapes[] = {0.4, 0.6, 0.9, 1.4};  // width over height
  for (double h = leastSide(); h < 0.5 * height(); h *= kLadder) {
    for (const double shape : kShapes) {
      const Box size{0, 0, static_cast<int>(std::lround(shape * h)),
                     static_cast<int>(std::lround(h))};
      if (size.width < leastSide() || 2 * size.width > width()) continue;
      const std::optional<Box> best = mostDifferent(levels, size);
      if (best) seeds.push_back(*best);
    }
  }
}

/// Where the mean in a box of this size is farthest above that in the frame about it.
std::optional<Box> GridSearch::mostDifferent(const IntegralImage& levels, const Box& size) const {
  const int frame = size.frame();
  const Box whole{0, 0, size.width + 2 * frame, size.height + 2 * frame};
  const auto inner = static_cast<float>(size.width * size.height);
  const float outer = static_cast<float>(whole.width * whole.height) - inner;
  std::optional<Box> best;
  float highest = 0.0f;
  for (int top = 0; top + whole.height <= height(); ++top) {
    for (int left = 0; left + whole.width <= width(); ++left) {
      const Box box{left + frame, top + frame, size.width, size.height};
      const float in = levels.sum(box);
      const float all = levels.sum({left, top, whole.width, whole.height});
      const float contrast = in / inner - (all - in) / outer;
      if (contrast <= highest) continue;
      highest = contrast;
      best = box;
    }
  }
  return best;
}

std::vector<Box> GridSearch::seeds() const {
  constexpr double kShares[] = {0.06, 0.12, 0.2, 0.35, 0.5};  // of the facade that is darker
  std::vector<Box> seeds;
  for (const double share : kShares) {
    for (const bool dark : {true, false}) {
      double sum = 0.0;
      int level = 0;  // colours on this side of it are window
      while (level < image_.num_colors && sum < share * total_.sum()) {
        sum += total_[dark ? level : image_.num_colors - 1 - level];
        ++level;
      }
      Eigen::ArrayXXf levels(height(), width());
      for (int x = 0; x < width(); ++x) {
        for (int y = 0; y < height(); ++y) {
          const int color = image_.colors(y, x);
          const bool in = dark ? color < level : color >= image_.num_colors - level;
          levels(y, x) = color == PaletteImage::kUnseen ? 0.0f : (in ? 1.0f : -1.0f);
        }
      }
      seedsOf(IntegralImage(levels), seeds);
    }
  }
  return seeds;
}

WindowScores GridSearch::scoresOf(const Histogram& inside) const {
  const Histogram outside = total_ - inside;
  const auto shares = [](const Histogram& counts) {  // none is quite impossible
    return ((counts + 1.0) / (counts + 1.0).sum()).log().eval();
  };
  const Eigen::ArrayXf odds = (0.5 * (shares(inside) - shares(outside))).tanh().cast<float>();
  WindowScores scores(height(), width());
  for (int x = 0; x < width(); ++x) {
    for (int y = 0; y < height(); ++y) {
      const int color = image_.colors(y, x);
      scores(y, x) = color == PaletteImage::kUnseen ? 0.0f : odds[color];
    }
  }
  return scores;
}

/// The cells of a grid that look like windows.
std::vector<Box> GridSearch::windowsOf(const BandGrid& bands, const WindowScores& scores) const {
  std::vector<Box> windows;
  for (const Band& row : bands.rows) {
    for (const Band& column : bands.columns) {
      const Box box{static_cast<int>(column.begin), static_cast<int>(row.begin),
                    static_cast<int>(column.length()), static_cast<int>(row.length())};
      if (std::min(box.width, box.height) < leastSide()) continue;
      if (scores.block(box.top, box.left, box.height, box.width).mean() > 0.0f) {
        windows.push_back(box);
      }
    }
  }
  return windows;
}

double entropyBits(const Histogram& counts) {
  const double sum = counts.sum();
  return sum > 0.0 ? -(counts > 0.0).select(counts / sum * (counts / sum).log(), 0.0).sum() / M_LN2
                   : 0.0;
}

void GridSearch::measure(Found& found) const {
  Histogram inside = Histogram::Zero(image_.num_colors);
  Histogram around = inside;
  for (const Box& box : found.windows) {
    const int frame = box.frame();
    count(box, inside);
    count({box.left - frame, box.top, frame, box.height}, around);
    count({box.right(), box.top, frame, box.height}, around);
    count({box.left, box.top - frame, box.width, frame}, around);
    count({box.left, box.bottom(), box.width, frame}, around);
  }
  const double in = inside.sum();
  const double all = in + around.sum();
  if (all == 0.0) return;
  const double apart = in * entropyBits(inside) + (all - in) * entropyBits(around);
  const auto m = static_cast<double>(found.windows.size());
  found.information = entropyBits(inside + around) - apart / all;
  found.value = all * (found.information - kWorthless) * (m - 1.0) / m;
}

GridSearch::Found GridSearch::grow(const Box& seed) const {
  constexpr int kTurns = 3;
  Found found;
  Histogram inside = Histogram::Zero(image_.num_colors);
  count(seed, inside);
  Band column{static_cast<double>(seed.left), static_cast<double>(seed.right())};
  Band row{static_cast<double>(seed.top), static_cast<double>(seed.bottom())};
  for (int turn = 0; turn < kTurns; ++turn) {
    const WindowScores scores = scoresOf(inside);
    found.inside = inside;
    found.bands = fitBandGrid(scores, column, row);
    found.windows = windowsOf(found.bands, scores);
    if (found.windows.empty()) return {};
    inside.setZero();
    for (const Box& box : found.windows) count(box, inside);
    column = found.bands.columns[found.bands.columns.size() / 2];
    row = found.bands.rows[found.bands.rows.size() / 2];
  }
  measure(found);
  return found;
}

/// Grids grown from all seeds, at the same time.
std::vector<GridSearch::Found> growAll(const GridSearch& search, const std::vector<Box>& seeds) {
  std::vector<GridSearch::Found> found(seeds.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(seeds.size()); ++i) {
    const auto seed = static_cast<std::size_t>(i);
    found[seed] = search.grow(seeds[seed]);
  }
  return found;
}

/// The first of the grids of greatest value among those that are eligible; null if none is.
template <typename Eligible>
const GridSearch::Found* bestOf(const std::vector<GridSearch::Found>& found,
                                const Eligible& eligible) {
  const GridSearch::Found* best = nullptr;
  for (const GridSearch::Found& grid : found) {
    if (grid.windows.size() < 2 || grid.value <= 0.0 || !eligible(grid)) continue;
    if (best == nullptr || grid.value > best->value) best = &grid;
  }
  return best;
}

/// What is in common of two boxes, of their union.
double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.left, b.left);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top);
  const double both = std::max(0.0, width) * std::max(0.0, height);
  return both / (a.width * a.height + b.width * b.height - both);
}

/// Bands of the raster in pixels of its image, at least one in it.
Box boxOf(const PaletteImage& image, const Band& columns, const Band& rows) {
  const auto range = [&image](const Band& band, Eigen::Index size) {
    const auto last = static_cast<int>(size) - 1;
    const int begin = std::clamp(static_cast<int>(std::lround(band.begin / image.step)), 0, last);
    const int end =
        std::clamp(static_cast<int>(std::lround(band.end / image.step)), begin + 1, last + 1);
    return std::make_pair(begin, end - begin);
  };
  const auto [left, width] = range(columns, image.colors.cols());
  const auto [top, height] = range(rows, image.colors.rows());
  return {left, top, width, height};
}

/// On the facade's own raster.
WindowProposal onRaster(const TextureGrid& grid, const PaletteImage& image,
                        const GridSearch& search, const GridSearch::Found& found) {
  const double step = image.step;
  const auto scaled = [step](std::vector<Band> bands) {
    for (Band& band : bands) band = {step * band.begin, step * band.end};
    return bands;
  };
  WindowProposal proposal;
  proposal.bands = {scaled(found.bands.columns), scaled(found.bands.rows)};
  proposal.scores = WindowScores::Zero(grid.height, grid.width);
  const WindowScores scores = search.scoresOf(found.inside);
  for (Eigen::Index y = 0; y < image.step * scores.rows(); ++y) {
    for (Eigen::Index x = 0; x < image.step * scores.cols(); ++x) {
      proposal.scores(y, x) = scores(y / image.step, x / image.step);
    }
  }
  return proposal;
}

double seenShare(const TextureGrid& grid, const std::vector<RectifiedView>& views) {
  double on = 0.0;
  double seen = 0.0;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!isInside(grid.outline, grid.place(x + 0.5, y + 0.5))) continue;
      const auto texel = static_cast<std::size_t>(y * grid.width + x);
      on += 1.0;
      seen += std::any_of(views.begin(), views.end(),
                          [&](const RectifiedView& view) { return view.seen[texel] != 0; });
    }
  }
  return on > 0.0 ? seen / on : 0.0;
}

}  // namespace

WindowProposal proposeGrid(const TextureGrid& grid, const std::vector<RectifiedView>& views) {
  constexpr double kLeastSeen = 0.5;  // of the facade
  // Bits. Stains of blank walls give 0.35, and more if but a few places need to be alike.
  constexpr double kLeastOfMany = 0.35;
  constexpr double kLeastOfOne = 0.45;  // more
  WindowProposal none;
  none.problem = "less than half of it is in the photos";
  if (seenShare(grid, views) < kLeastSeen) return none;
  const PaletteImage image = paletteImage(grid, views, kPixels);
  const GridSearch search(image);
  const std::vector<GridSearch::Found> found = growAll(search, search.seeds());
  const GridSearch::Found* const best = bestOf(found, [](const GridSearch::Found& candidate) {
    const auto windows = static_cast<double>(candidate.windows.size());
    return candidate.information >= kLeastOfMany + kLeastOfOne / windows;
  });
  none.problem = "nothing on it repeats as windows do";
  return best == nullptr ? none : onRaster(grid, image, search, *best);
}

WindowProposal proposeGridWith(const TextureGrid& grid, const std::vector<RectifiedView>& views,
                               const Band& columns, const Band& rows) {
  constexpr double kSame = 0.5;  // of the union of mark and window, which may be drawn loosely
  const PaletteImage image = paletteImage(grid, views, kPixels);
  const GridSearch search(image);
  const Box mark = boxOf(image, columns, rows);
  std::vector<Box> seeds = search.seeds();
  seeds.push_back(mark);
  const std::vector<GridSearch::Found> found = growAll(search, seeds);
  const GridSearch::Found* const best = bestOf(found, [&mark](const GridSearch::Found& candidate) {
    return std::any_of(candidate.windows.begin(), candidate.windows.end(),
                       [&mark](const Box& window) { return overlap(mark, window) >= kSame; });
  });
  WindowProposal none;
  none.problem = "nothing on it repeats as the marked window does";
  return best == nullptr ? none : onRaster(grid, image, search, *best);
}

}  // namespace storey::detail
