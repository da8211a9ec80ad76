// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/camera.h>
#include <storey/surface/facade.h>
#include <storey/surface/rgb_image.h>

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace storey {

/// A photo and its camera, in the coordinates of the facades; the image has the camera's size.
struct FacadePhoto {
  Camera camera;
  RgbImage image;
};

enum class TexelState : std::uint8_t {
  Outside = 0,  ///< not on the facade
  Seen = 1,     ///< from a photo
  Unseen = 2,   ///< no photo sees it; black
  Filled = 3,   ///< no photo sees it; filled from what was seen
};

/// A facade seen at right angles: a plan to measure in. Texel (i, j), counted from the upper left
/// corner, is the square of side `texel` about frame.point((i + 1/2) texel,
/// frame.height - (j + 1/2) texel).
struct FacadeTexture {
  FacadeFrame frame;
  double texel = 0.0;  ///< side of a texel, in the model's unit
  RgbImage image;
  std::vector<TexelState> states;  ///< of each texel, by rows
  std::vector<int> photos;         ///< that most of each texel's colour is from; -1: none

  double seenShare() const;  ///< of the texels on the facade

  /// Texture coordinates of a point of the facade: (0, 0) is the lower left corner of the image,
  /// (1, 1) the upper right one.
  Eigen::Vector2d coordinates(const Eigen::Vector3d& point) const;
};

/// An image of each facade, put together from the photos that see it [Sui et al. 2016, Sec. 6.3].
///
/// A texel is seen by a photo if it lies in the image, at an angle of more than 6 degrees to the
/// line of sight, and no facade is in between. Exposures are levelled by a factor for each photo
/// and channel: the least-squares solution of the median ratios of all pairs of photos. In blocks
/// of 8 x 8 texels, photos that differ from the densest group of those that see the block show
/// something in front of it (a tree, a car, a pole); a minimum cut (alpha-expansion) chooses one
/// of the others for each block, preferring near, frontal, sharp ones, and few seams. Across
/// seams, colours change linearly over the width of a block.
/// \par Determinism Same input, same output, whatever the number of threads.
class FacadeTexturing {
 public:
  /// The faces of the model are the facades, in their order. The model is not kept.
  void setModel(const PolyhedralModel& model) { facades_ = facadesOf(model); }
  /// Facades that are not the faces of a `PolyhedralModel`, in place of a model.
  void setFacades(std::vector<Facade> facades) { facades_ = std::move(facades); }
  const std::vector<Facade>& getFacades() const { return facades_; }

  /// Photos and their cameras, in the coordinates of the model.
  void setPhotos(std::vector<FacadePhoto> photos) { photos_ = std::move(photos); }
  const std::vector<FacadePhoto>& getPhotos() const { return photos_; }

  /// Unit vector, upwards; default +z. The images' rows are at right angles to it.
  void setVertical(const Eigen::Vector3d& vertical) { vertical_ = vertical; }
  const Eigen::Vector3d& getVertical() const { return vertical_; }

  /// Side of a texel, in the model's unit, >= 0. 0 (default): for each facade what the photo that
  /// sees it best resolves, in the median over the facade.
  void setTexelSize(double length) { texel_size_ = length; }
  double getTexelSize() const { return texel_size_; }

  /// Most texels of all facades together, >= 1; default 64 million. Texels of all facades grow to
  /// keep to it.
  void setMaxTexels(double texels) { max_texels_ = texels; }
  double getMaxTexels() const { return max_texels_; }

  /// Whether what no photo saw is filled from the facade's own repetition; default false.
  void setFillUnseen(bool fill) { fill_unseen_ = fill; }
  bool getFillUnseen() const { return fill_unseen_; }

  /// \param textures one for each facade, in their order; of facades that no photo sees, all texels
  ///        are unseen
  /// \return false, after a PCL_ERROR and without textures, if there is no facade, a parameter is
  ///         out of range, or an image does not have its camera's size
  bool texture(std::vector<FacadeTexture>& textures) const;

 private:
  bool inputValid() const;

  std::vector<Facade> facades_;
  std::vector<FacadePhoto> photos_;
  Eigen::Vector3d vertical_ = Eigen::Vector3d::UnitZ();
  double texel_size_ = 0.0;
  double max_texels_ = 64e6;
  bool fill_unseen_ = false;
};

/// Whether a point lies inside the closed surface that the facades make. If the cameras do, the
/// model is an enclosed space, and its facades are to be turned to be seen.
bool isEnclosed(const std::vector<Facade>& facades, const Eigen::Vector3d& point);

}  // namespace storey
