// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/window_confidence.h>
#include <storey/surface/detail/window_edges.h>
#include <storey/surface/detail/window_labels.h>
#include <storey/surface/detail/window_proposal.h>
#include <storey/surface/detail/window_search.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

/// Bands about the user's mark, in texels.
BandGrid bandsAbout(const TextureGrid& grid, const std::vector<Eigen::Vector2d>& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : outline) {
    box.extend(Eigen::Vector2d(corner.x(), grid.frame.height - corner.y()) / grid.texel);
  }
  const auto band = [](double begin, double end, int size) {
    const double first = std::clamp(std::floor(begin), 0.0, size - 1.0);
    return Band{first, std::clamp(std::ceil(end), first + 1.0, static_cast<double>(size))};
  };
  return {{band(box.min().x(), box.max().x(), grid.width)},
          {band(box.min().y(), box.max().y(), grid.height)}};
}

/// The texels within the user's mark.
std::vector<TexelMark> marksOf(const TextureGrid& grid,
                               const std::vector<Eigen::Vector2d>& outline) {
  std::vector<TexelMark> marks(static_cast<std::size_t>(grid.width * grid.height));
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const bool inside = isInside({outline}, grid.place(x + 0.5, y + 0.5));
      marks[static_cast<std::size_t>(y * grid.width + x)] =
          inside ? TexelMark::Window : TexelMark::Rest;
    }
  }
  return marks;
}

/// The texels within the windows found. Those at their edges, where a texel is both, and all of the
/// cells that look like wall, teach nothing.
std::vector<TexelMark> marksOf(const TextureGrid& grid, const BandGrid& bands,
                               const WindowScores& scores) {
  constexpr int kBlur = 2;  // texels
  std::vector<TexelMark> marks(static_cast<std::size_t>(grid.width * grid.height));
  const auto mark = [&](const Band& column, const Band& row, int margin, TexelMark value) {
    const int right = std::min(grid.width, static_cast<int>(column.end) + margin);
    const int bottom = std::min(grid.height, static_cast<int>(row.end) + margin);
    for (int y = std::max(0, static_cast<int>(row.begin) - margin); y < bottom; ++y) {
      for (int x = std::max(0, static_cast<int>(column.begin) - margin); x < right; ++x) {
        marks[static_cast<std::size_t>(y * grid.width + x)] = value;
      }
    }
  };
  for (const Band& row : bands.rows) {
    for (const Band& column : bands.columns) {
      mark(column, row, kBlur, TexelMark::Neither);
      const auto cell = scores.block(
          static_cast<Eigen::Index>(row.begin), static_cast<Eigen::Index>(column.begin),
          static_cast<Eigen::Index>(row.length()), static_cast<Eigen::Index>(column.length()));
      if (cell.mean() > 0.0f) mark(column, row, -kBlur, TexelMark::Window);
    }
  }
  return marks;
}

/// Only the photo that was drawn on, if it is among the views: what hides the marked window in
/// others would be learnt as window.
std::vector<RectifiedView> drawnOn(const std::vector<RectifiedView>& views, std::size_t photo) {
  for (const RectifiedView& view : views) {
    if (view.photo == static_cast<int>(photo)) return {view};
  }
  return views;
}

bool isOnFacade(const TextureGrid& grid, const FacadeWindow& window) {
  for (const double x : {window.min.x(), window.max.x()}) {
    for (const double y : {window.min.y(), window.max.y()}) {
      if (!isInside(grid.outline, {x, y})) return false;
    }
  }
  return true;
}

/// Bands of one length may come to overlap: of two windows that do, the less confident is doubtful.
void doubtOverlaps(std::vector<FacadeWindow>& windows) {
  for (FacadeWindow& window : windows) {
    for (const FacadeWindow& other : windows) {
      const Eigen::Vector2d common =
          window.max.cwiseMin(other.max) - window.min.cwiseMax(other.min);
      const bool overlap = common.minCoeff() > 0.0;
      if (overlap && other.confidence > window.confidence) window.doubtful = true;
    }
  }
}

std::vector<FacadeWindow> windowsOf(const TextureGrid& grid, const BandGrid& bands,
                                    const WindowScores& scores) {
  constexpr double kLeastConfidence = 0.5;
  constexpr double kLeastSeen = 0.5;  // of the window
  std::vector<FacadeWindow> windows;
  for (std::size_t row = bands.rows.size(); row-- > 0;) {
    for (std::size_t column = 0; column < bands.columns.size(); ++column) {
      const Band& x = bands.columns[column];
      const Band& y = bands.rows[row];
      FacadeWindow window;
      window.min = grid.place(x.begin, y.end);
      window.max = grid.place(x.end, y.begin);
      window.column = static_cast<int>(column);
      window.row = static_cast<int>(bands.rows.size() - 1 - row);
      const WindowEvidence evidence = evidenceOf(scores, x, y);
      const bool is_wall = evidence.seen >= kLeastSeen && evidence.score <= 0.0;
      if (is_wall || !isOnFacade(grid, window)) continue;
      window.confidence = evidence.confidence;
      window.doubtful = evidence.seen < kLeastSeen || window.confidence < kLeastConfidence;
      windows.push_back(window);
    }
  }
  doubtOverlaps(windows);
  return windows;
}

}  // namespace

std::vector<FacadeWindow> searchFrom(const TextureGrid& grid,
                                     const std::vector<RectifiedView>& views, const BandGrid& first,
                                     const WindowScores& combined) {
  if (first.columns.empty() || first.rows.empty()) return {};
  const std::vector<WindowScores> scores = labelTexels(grid, views, marksOf(grid, first, combined));
  const WindowScores all = combineScores(views, scores);
  const BandGrid bands =
      fitBandGrid(all, first.columns[first.columns.size() / 2], first.rows[first.rows.size() / 2]);
  if (bands.columns.empty() || bands.rows.empty()) return {};
  return windowsOf(grid, fitEdges(views, scores, bands), all);
}

std::vector<FacadeWindow> searchMarked(const TextureGrid& grid,
                                       const std::vector<RectifiedView>& views, std::size_t photo,
                                       const std::vector<Eigen::Vector2d>& outline) {
  const BandGrid mark = bandsAbout(grid, outline);
  const WindowProposal repeated = proposeGridWith(grid, views, mark.columns[0], mark.rows[0]);
  if (repeated.problem.empty()) return searchFrom(grid, views, repeated.bands, repeated.scores);
  const std::vector<RectifiedView> drawn = drawnOn(views, photo);
  const WindowScores scores =
      combineScores(drawn, labelTexels(grid, drawn, marksOf(grid, outline)));
  return searchFrom(grid, views, fitBandGrid(scores, mark.columns[0], mark.rows[0]), scores);
}

}  // namespace storey::detail
