// SPDX-License-Identifier: BSD-3-Clause
// Textures of generated buildings against what they were painted with.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/facade_texturing.h>
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "synth/buildings.h"
#include "synth/photos/photo_scene.h"
#include "synth/triangle_tree.h"

namespace storey::synth {
namespace {

constexpr double kTargetPsnr = 28.0;  // dB

struct Rendered {
  PolyhedralModel model;
  PhotoScene scene;
  std::vector<FacadePhoto> photos;

  Rendered(const char* name, const PhotoOptions& options)
      : model(extrudeFloorplans(makeBuilding(name).layers)), scene(model, options) {
    for (const Camera& camera : scene.placeCameras()) {
      photos.push_back({camera, scene.photograph(camera, static_cast<int>(photos.size()))});
    }
  }
};

PhotoOptions smallPhotos() {
  PhotoOptions options;
  options.views = 14;
  options.width = 480;
  return options;
}

/// Sums over the seen texels of all facades.
struct Comparison {
  double squares = 0.0;
  double channels = 0.0;
  double psnr() const { return 10.0 * std::log10(255.0 * 255.0 * channels / squares); }
};

/// Compares after the one factor, for each channel, that no method can know: the exposure of all.
Comparison compare(const PhotoScene& scene, const std::vector<FacadeTexture>& textures) {
  Comparison all;
  for (int c = 0; c < 3; ++c) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t f = 0; f < textures.size(); ++f) {
      const RgbImage truth = scene.orthoImage(f, textures[f].texel);
      for (std::size_t i = 0; i < textures[f].states.size(); ++i) {
        if (textures[f].states[i] != TexelState::Seen) continue;
        const double a = textures[f].image.channels[3 * i + static_cast<std::size_t>(c)];
        const double b = truth.channels[3 * i + static_cast<std::size_t>(c)];
        ab += a * b;
        aa += a * a;
        bb += b * b;
        all.channels += 1.0;
      }
    }
    all.squares += bb - ab * ab / aa;  // least of sum (b - s a)^2 over s
  }
  return all;
}

/// Share of the texels on facades whose state is not what a ray to each camera says.
double maskErrors(const Rendered& rendered, const std::vector<FacadeTexture>& textures) {
  TriangleMesh mesh;
  std::vector<std::size_t> facade_of;
  mesh.vertices = rendered.model.vertices;
  for (std::size_t f = 0; f < rendered.model.faces.size(); ++f) {
    for (const auto& triangle : triangulateFace(rendered.model, rendered.model.faces[f])) {
      mesh.triangles.push_back(triangle);
      facade_of.push_back(f);
    }
  }
  const TriangleTree tree(mesh);
  const double kGrazing = 0.1;  // the cosine below which nothing counts as seen
  std::size_t wrong = 0;
  std::size_t total = 0;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    for (std::size_t i = 0; i < t.states.size(); i += 7) {
      if (t.states[i] == TexelState::Outside) continue;
      const int x = static_cast<int>(i) % t.image.width;
      const int y = static_cast<int>(i) / t.image.width;
      const Eigen::Vector3d point =
          t.frame.point((x + 0.5) * t.texel, t.frame.height - (y + 0.5) * t.texel);
      bool seen = false;
      for (const FacadePhoto& photo : rendered.photos) {
        const Eigen::Vector3d center = photo.camera.center();
        const auto pixel = photo.camera.project(point);
        if (!pixel || !photo.camera.contains(*pixel)) continue;
        if ((center - point).normalized().dot(t.frame.normal()) <= kGrazing) continue;
        const auto hit = tree.firstHit(center, point - center);
        seen |= !hit || hit->distance > 1.0 - 1e-6 || facade_of[hit->triangle] == f;
      }
      wrong += seen != (t.states[i] == TexelState::Seen);
      ++total;
    }
  }
  return static_cast<double>(wrong) / static_cast<double>(total);
}

TEST(RenderedTexturing, Explore) {
  for (const char* name : {"l_shape", "two_towers"}) {
    for (const int occluders : {0, 12}) {
      PhotoOptions options = smallPhotos();
      options.occluders = occluders;
      const Rendered rendered(name, options);
      const auto start = clock();
      const auto textures = textureFacades(rendered.model.empty() ? std::vector<Facade>{} : facadesOf(rendered.model), rendered.photos);
      const double seconds = static_cast<double>(clock() - start) / CLOCKS_PER_SEC;
      std::printf("%s occluders %d: PSNR %.2f, mask %.4f, %.2f s\n", name, occluders, compare(rendered.scene, textures).psnr(), maskErrors(rendered, textures), seconds);
      for (std::size_t f = 0; f < textures.size(); ++f) {
        const Comparison one = compare(rendered.scene, {textures[f]});
        (void)one;
        std::printf("  %zu: %d x %d texel %.4f seen %.3f\n", f, textures[f].image.width, textures[f].image.height, textures[f].texel, textures[f].seenShare());
      }
    }
  }
}

}  // namespace
}  // namespace storey::synth
