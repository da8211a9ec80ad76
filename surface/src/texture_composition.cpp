// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/detail/hidden_views.h>
#include <storey/surface/detail/texture_composition.h>

#include <algorithm>
#include <cmath>

namespace storey::detail {
namespace {

/// What a photo contributes to a texel.
struct Share {
  int photo;
  float weight;
  Eigen::Array3f correction;  // weighted
};

class Composer {
 public:
  Composer(const TextureGrid& grid, const FacadeSight& facades,
           const std::vector<TexturePhoto>& photos, const std::vector<Eigen::Array3f>& gains,
           const std::vector<std::vector<BlockView>>& views, const std::vector<int>& selected,
           const std::vector<Eigen::Array3f>& corrections)
      : grid_(grid),
        facades_(facades),
        photos_(photos),
        gains_(gains),
        views_(views),
        selected_(selected),
        corrections_(corrections) {}

  /// Colour of the texel in column x and row y, and the photo that most of it is from; -1: none.
  int compose(int x, int y, Eigen::Array3f& color) const {
    const Eigen::Vector3d point = grid_.point(x + 0.5, y + 0.5);
    const std::vector<BlockView>& own = views_[grid_.block(x / kBlockTexels, y / kBlockTexels)];
    std::array<Share, kCells> shares;
    const int num_shares = sharesAt(x, y, shares);
    color.setZero();
    float sum = 0.0f;
    int photo = -1;
    float most = 0.0f;
    for (int i = 0; i < num_shares; ++i) {
      const Share& share = shares[static_cast<std::size_t>(i)];
      Eigen::Array3f sample;
      if (!isGood(own, share.photo) || !look(share.photo, own, point, sample)) continue;
      color += share.correction * sample;
      sum += share.weight;
      if (share.weight > most) {
        most = share.weight;
        photo = share.photo;
      }
    }
    if (sum > 0.0f) {
      color /= sum;
      return photo;
    }
    return lookAnywhere(own, point, color);
  }

 private:
  /// The photos of the four blocks about a texel, each once.
  int sharesAt(int x, int y, std::array<Share, kCells>& shares) const {
    const double column = (x + 0.5) / kBlockTexels - 0.5;
    const double row = (y + 0.5) / kBlockTexels - 0.5;
    const int left = static_cast<int>(std::floor(column));
    const int above = static_cast<int>(std::floor(row));
    const auto u = static_cast<float>(column - left);
    const auto v = static_cast<float>(row - above);
    int count = 0;
    for (int i = 0; i < kCells; ++i) {
      const int c = std::clamp(left + i % 2, 0, grid_.columns - 1);
      const int r = std::clamp(above + i / 2, 0, grid_.rows - 1);
      const std::size_t block = grid_.block(c, r);
      if (selected_[block] < 0) continue;
      const int photo = views_[block][static_cast<std::size_t>(selected_[block])].photo;
      const float weight = (i % 2 == 0 ? 1.0f - u : u) * (i / 2 == 0 ? 1.0f - v : v);
      int at = 0;
      while (at < count && shares[static_cast<std::size_t>(at)].photo != photo) ++at;
      if (at == count)
        shares[static_cast<std::size_t>(count++)] = {photo, 0.0f, Eigen::Array3f::Zero()};
      shares[static_cast<std::size_t>(at)].weight += weight;
      shares[static_cast<std::size_t>(at)].correction += weight * corrections_[block];
    }
    return count;
  }

  /// Whether nothing is known to be in front of the block in this photo, or of all its photos.
  static bool isGood(const std::vector<BlockView>& own, int photo) {
    const BlockView* const view = findView(own, photo);
    if (view == nullptr || !view->hidden) return true;
    return std::all_of(own.begin(), own.end(), [](const BlockView& v) { return v.hidden; });
  }

  bool look(int photo, const std::vector<BlockView>& own, const Eigen::Vector3d& point,
            Eigen::Array3f& color) const {
    const TexturePhoto& from = photos_[static_cast<std::size_t>(photo)];
    Sighting sighting;
    if (!sight(from, grid_.frame, point, sighting)) return false;
    const BlockView* const view = findView(own, photo);
    const bool whole = view != nullptr && view->numShown() == kCells;
    if (!whole && facades_.isBlocked(from.center, point, grid_.facade)) return false;
    color = from.pyramid.sample(sighting.pixel, sighting.pixels_per_length * grid_.texel) *
            gains_[static_cast<std::size_t>(photo)];
    return true;
  }

  int lookAnywhere(const std::vector<BlockView>& own, const Eigen::Vector3d& point,
                   Eigen::Array3f& color) const {
    std::vector<const BlockView*> order;
    for (const BlockView& view : own) order.push_back(&view);
    std::sort(order.begin(), order.end(), [](const BlockView* a, const BlockView* b) {
      return std::make_tuple(a->hidden, -a->quality, a->photo) <
             std::make_tuple(b->hidden, -b->quality, b->photo);
    });
    for (const BlockView* view : order) {
      if (look(view->photo, own, point, color)) return view->photo;
    }
    return -1;
  }

  const TextureGrid& grid_;
  const FacadeSight& facades_;
  const std::vector<TexturePhoto>& photos_;
  const std::vector<Eigen::Array3f>& gains_;
  const std::vector<std::vector<BlockView>>& views_;
  const std::vector<int>& selected_;
  const std::vector<Eigen::Array3f>& corrections_;
};

}  // namespace

FacadeTexture composeTexture(const TextureGrid& grid, const FacadeSight& facades,
                             const std::vector<TexturePhoto>& photos,
                             const std::vector<Eigen::Array3f>& gains,
                             const std::vector<std::vector<BlockView>>& views,
                             const std::vector<int>& selected,
                             const std::vector<Eigen::Array3f>& corrections) {
  FacadeTexture texture;
  texture.frame = grid.frame;
  texture.texel = grid.texel;
  texture.image = RgbImage(grid.width, grid.height);
  const std::size_t num_texels = texture.image.channels.size() / 3;
  texture.states.assign(num_texels, TexelState::Outside);
  texture.photos.assign(num_texels, -1);
  const Composer composer(grid, facades, photos, gains, views, selected, corrections);
#pragma omp parallel for schedule(dynamic, 8)
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!isInside(grid.outline, grid.place(x + 0.5, y + 0.5))) continue;
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                            static_cast<std::size_t>(x);
      Eigen::Array3f color;
      texture.photos[i] = composer.compose(x, y, color);
      texture.states[i] = texture.photos[i] < 0 ? TexelState::Unseen : TexelState::Seen;
      if (texture.photos[i] < 0) continue;
      for (int c = 0; c < 3; ++c) {
        texture.image.at(x, y)[c] =
            static_cast<std::uint8_t>(std::lround(std::clamp(color[c], 0.0f, 255.0f)));
      }
    }
  }
  return texture;
}

}  // namespace storey::detail
