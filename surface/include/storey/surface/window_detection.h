// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/facade_texturing.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace storey {

/// What a user draws: a quadrilateral around a window, on one photo.
struct WindowMark {
  std::size_t photo = 0;
  std::array<Eigen::Vector2d, 4> corners;  ///< pixels, around it in either sense
};

/// A window: an upright rectangle in the coordinates of its facade's frame.
struct FacadeWindow {
  Eigen::Vector2d min;
  Eigen::Vector2d max;
  int column = 0;  ///< of the grid, from the left
  int row = 0;     ///< of the grid, from below
  /// In [0, 1]: how far it differs from the wall about it, as the photos that show it say;
  /// doubtful below 0.5.
  double confidence = 0.0;
  bool doubtful = false;  ///< of little confidence, or seen by less than a half
};

/// The windows of a facade.
struct WindowGrid {
  std::string problem;  ///< why there are none; empty if there are some
  std::size_t facade = 0;
  FacadeFrame frame;
  double texel = 0.0;  ///< side of a texel of the images that were compared, in the model's unit
  std::vector<FacadeWindow> windows;  ///< by rows
  std::vector<int> photos;            ///< that show the facade
  /// How far the panes lie behind the facade (negative: in front of it), in the model's unit.
  double depth = 0.0;
  bool depth_known = false;  ///< two photos or more tell it
};

struct WindowDetectionOptions {
  Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< unit, upwards
  double max_texels = 1e6;                              ///< most texels of the facade's images
};

/// Windows of facades from photos of them [Sui et al. 2016, Sec. 5].
///
/// A mark's photo tells the facade that lies under it; the facade's plane takes the mark to all
/// photos that show the facade. In each, colours of the marked texels and of the rest of the facade
/// are two mixtures of normal distributions; the photos' labels together are approximated by a grid
/// of rectangles of rank one, whose pitch may vary and windows may be missing; from the grid, the
/// mixtures are learnt again. The edges are then measured in each photo, and one width and height
/// of all windows and the places of columns and rows found that fit them best, in pixels of the
/// photos. The depth follows from the panes' parallax.
///
/// Without a mark, the first grid is the one whose windows tell most about the colours of the
/// facade's image; the rest is the same.
/// \par Determinism Same input, same output, whatever the number of threads.
class WindowDetection {
 public:
  WindowDetection(std::vector<Facade> facades, const std::vector<FacadePhoto>& photos,
                  const WindowDetectionOptions& options = {});
  ~WindowDetection();

  const std::vector<Facade>& facades() const { return facades_; }

  /// All windows like the marked one, on its facade. None, and a `problem`, if the mark is no
  /// simple quadrilateral or does not lie on one wall.
  WindowGrid detect(const WindowMark& mark) const;

  /// The windows of a facade that repeat. None, and a `problem`, if the facade is no wall, less
  /// than half of it is in the photos, or nothing on it repeats.
  WindowGrid propose(std::size_t facade) const;

 private:
  struct Photos;  // made ready for sampling
  struct Raster;  // of a facade, with what each photo shows of it

  Raster rasterOf(std::size_t facade) const;
  WindowGrid resultOf(const Raster& raster, std::vector<FacadeWindow> windows,
                      const char* problem) const;

  std::vector<Facade> facades_;
  WindowDetectionOptions options_;
  std::unique_ptr<const Photos> photos_;
};

}  // namespace storey
