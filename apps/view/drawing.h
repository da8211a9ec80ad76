// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/rgb_image.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace storey::view {

struct Colour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
};

inline bool operator==(const Colour& a, const Colour& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// Where a drawing is seen from, in parallel projection: from the south-east above with all three
/// axes shortened alike, from above (north up), from the south; or free: isometric until someone
/// turns it, and so that nothing drawn depends on where it is seen from.
enum class View { Isometric, Top, Front, Free };

struct PointSet {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Colour> colours;  ///< parallel to `positions`
  double size = 0.0;            ///< pixels in a picture 1200 high; 0: so that surfaces close
};

struct LineSet {
  std::vector<std::vector<Eigen::Vector3d>> lines;
  std::vector<Colour> colours;  ///< parallel to `lines`
  double width = 2.0;           ///< pixels in a picture 1200 high
};

struct FacetSet {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`
  std::vector<Colour> colours;                ///< parallel to `triangles`, shading included
  double opacity = 1.0;
};

/// Triangles that an image is drawn on, seen from their front side only, that from which their
/// corners run counter-clockwise.
struct TexturedSet {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector2d> coordinates;   ///< parallel; (0, 0): lower left corner of the image
  std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`
  RgbImage image;
};

struct LegendEntry {
  Colour colour;
  std::string text;
};

struct Tick {
  double at = 0.0;  ///< 0 = bottom of the bar, 1 = top
  std::string text;
};

/// A vertical strip of colours with a scale beside it.
struct ColourBar {
  std::string title;
  std::vector<Colour> colours;  ///< bottom to top; none: there is no bar
  std::vector<Tick> ticks;
};

/// A picture as plain data: what it shows, in the upright local frame of the cloud, and what is
/// written about it. Whoever draws it, off-screen or in a window, needs no more than this.
struct Drawing {
  std::string title;
  std::string subtitle;
  View view = View::Isometric;
  std::vector<PointSet> points;
  std::vector<LineSet> lines;
  std::vector<FacetSet> facets;
  std::vector<TexturedSet> textured;
  std::string legend_title;
  std::vector<LegendEntry> legend;
  ColourBar bar;
};

}  // namespace storey::view
