// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/marked_facade.h>
#include <storey/surface/detail/rank_one_grid.h>
#include <storey/surface/detail/window_confidence.h>
#include <storey/surface/detail/window_depth.h>
#include <storey/surface/detail/window_edges.h>
#include <storey/surface/detail/window_labels.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <cmath>

namespace storey {
namespace {

using detail::Band;
using detail::BandGrid;
using detail::RectifiedView;
using detail::TexelMark;
using detail::TextureGrid;
using detail::WindowScores;

/// Size of the raster's texels: what the photos resolve, but no more texels than wanted.
double texelSize(const FacadeFrame& frame, double resolved, double max_texels) {
  return std::max(resolved, std::sqrt(frame.width * frame.height / max_texels));
}

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

/// The grid of the windows, its edges fitted, and the scores it was found in. The first grid is
/// learnt from the mark, the second in all photos from the first.
BandGrid findGrid(const TextureGrid& grid, const std::vector<RectifiedView>& views,
                  std::size_t photo, const std::vector<Eigen::Vector2d>& outline,
                  WindowScores& combined) {
  const std::vector<RectifiedView> first = drawnOn(views, photo);
  combined = detail::combineScores(first, detail::labelTexels(grid, first, marksOf(grid, outline)));
  BandGrid bands = bandsAbout(grid, outline);
  bands = detail::fitBandGrid(combined, bands.columns[0], bands.rows[0]);
  if (bands.columns.empty() || bands.rows.empty()) return {};

  const std::vector<WindowScores> scores =
      detail::labelTexels(grid, views, marksOf(grid, bands, combined));
  combined = detail::combineScores(views, scores);
  bands = detail::fitBandGrid(combined, bands.columns[bands.columns.size() / 2],
                              bands.rows[bands.rows.size() / 2]);
  if (bands.columns.empty() || bands.rows.empty()) return {};
  return detail::fitEdges(views, scores, bands);
}

bool isOnFacade(const TextureGrid& grid, const FacadeWindow& window) {
  for (const double x : {window.min.x(), window.max.x()}) {
    for (const double y : {window.min.y(), window.max.y()}) {
      if (!isInside(grid.outline, {x, y})) return false;
    }
  }
  return true;
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
      const detail::WindowEvidence evidence = detail::evidenceOf(scores, x, y);
      const bool is_wall = evidence.seen >= kLeastSeen && evidence.score <= 0.0;
      if (is_wall || !isOnFacade(grid, window)) continue;
      window.confidence = evidence.confidence;
      window.doubtful = evidence.seen < kLeastSeen || window.confidence < kLeastConfidence;
      windows.push_back(window);
    }
  }
  return windows;
}

}  // namespace

WindowGrid detectWindows(const std::vector<Facade>& facades, const std::vector<FacadePhoto>& photos,
                         const WindowMark& mark, const WindowDetectionOptions& options) {
  WindowGrid result;
  if (mark.photo >= photos.size()) {
    result.problem = "there is no such photo";
    return result;
  }
  const detail::MarkedFacade marked =
      detail::findMarked(facades, photos[mark.photo].camera, mark, options.vertical);
  result.problem = marked.problem;
  if (!marked.problem.empty()) return result;
  result.facade = marked.facade;
  result.frame = marked.frame;

  std::vector<detail::TexturePhoto> prepared;
  for (const FacadePhoto& photo : photos) {
    prepared.push_back({photo.camera, photo.camera.center(), detail::ImagePyramid(photo.image)});
  }
  const detail::FacadeSight sight(facades);
  const FacadeOutline outline = marked.frame.outline(facades[marked.facade]);
  const double resolved =
      detail::resolvedTexel(marked.frame, outline, marked.facade, sight, prepared);
  result.texel = texelSize(marked.frame, resolved, options.max_texels);
  const TextureGrid grid(marked.facade, marked.frame, outline, result.texel);
  const std::vector<RectifiedView> views = detail::rectifyViews(grid, sight, prepared);
  if (views.empty()) {
    result.problem = "no photo shows enough of the facade";
    return result;
  }
  for (const RectifiedView& view : views) result.photos.push_back(view.photo);
  WindowScores scores;
  const BandGrid bands = findGrid(grid, views, mark.photo, marked.outline, scores);
  result.windows = windowsOf(grid, bands, scores);
  if (result.windows.empty()) {
    result.problem = "nothing on the facade looks like what the quadrilateral marks";
    return result;
  }
  const detail::WindowDepth depth = detail::findDepth(grid, sight, prepared, views, result.windows);
  result.depth = depth.depth;
  result.depth_known = depth.known;
  return result;
}

}  // namespace storey
