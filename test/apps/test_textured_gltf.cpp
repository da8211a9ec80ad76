// SPDX-License-Identifier: BSD-3-Clause
// A textured GLB read back: what is at a place of the model is what was painted there.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <Eigen/Geometry>
#include <cmath>

#include "export/glb.h"
#include "io/images/image_files.h"
#include "io/model_io.h"
#include "painted_model.h"
#include "synth/buildings.h"
#include "temporary_files.h"
#include "texture/textured_gltf.h"

namespace storey::texture {
namespace {

const Eigen::Vector3d kFar(1e7, -3e7, 500.0);

PaintedModel paintedFarAway(const char* name) {
  io::PolygonSoup soup = io::toPolygons(extrudeFloorplans(synth::makeBuilding(name).layers));
  for (Eigen::Vector3d& vertex : soup.vertices) vertex += kFar;
  return {std::move(soup), kFar};
}

test::Glb write(const PaintedModel& painted) {
  return test::Glb(toTexturedGlb(painted.soup, painted.model, painted.textures, painted.sheets(),
                                 Eigen::Vector3d::UnitZ())
                       .bytes());
}

/// What the file says of a place: where it is, what colour, which way it faces.
struct Sample {
  Eigen::Vector3d at;
  Eigen::Array3d color;
  Eigen::Vector3d normal;
  Eigen::Vector3d turn;  ///< of the triangle's corners
  std::size_t facade;
};

std::vector<RgbImage> imagesOf(const test::Glb& glb) {
  const test::TemporaryDirectory directory;
  std::vector<RgbImage> images;
  for (std::size_t i = 0; i < glb.json["images"].size(); ++i) {
    EXPECT_EQ(glb.json["images"][i]["mimeType"], "image/jpeg");
    images.push_back(io::readImage(directory.write("image.jpg", glb.image(i))));
  }
  return images;
}

/// Samples of all triangles with a texture, at the middle and near the corners.
std::vector<Sample> samplesOf(const test::Glb& glb) {
  const std::vector<RgbImage> images = imagesOf(glb);
  std::vector<Sample> samples;
  for (const auto& primitive : glb.json["meshes"][0]["primitives"]) {
    const auto& attributes = primitive["attributes"];
    const auto& material = glb.json["materials"][primitive["material"].get<std::size_t>()];
    if (!attributes.contains("TEXCOORD_0")) continue;
    const auto& texture =
        glb.json["textures"]
                [material["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<std::size_t>()];
    const RgbImage& image = images.at(texture["source"].get<std::size_t>());
    const std::vector<float> p = glb.values(attributes["POSITION"]);
    const std::vector<float> n = glb.values(attributes["NORMAL"]);
    const std::vector<float> t = glb.values(attributes["TEXCOORD_0"]);
    const std::vector<float> f = glb.values(attributes["_FACE"]);
    for (std::size_t i = 0; i < f.size(); i += 3) {
      Eigen::Matrix3d corners;
      Eigen::Matrix<double, 2, 3> places;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto corner = i + static_cast<std::size_t>(k);
        // From y up back to z up.
        corners.col(k) << p[3 * corner], -p[3 * corner + 2], p[3 * corner + 1];
        places.col(k) << t[2 * corner], t[2 * corner + 1];
      }
      const Eigen::Vector3d turn =
          (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
      const Eigen::Vector3d normal(n[3 * i], -n[3 * i + 2], n[3 * i + 1]);
      for (const Eigen::Vector3d& share :
           {Eigen::Vector3d(0.34, 0.33, 0.33), Eigen::Vector3d(0.9, 0.05, 0.05),
            Eigen::Vector3d(0.05, 0.9, 0.05), Eigen::Vector3d(0.05, 0.05, 0.9)}) {
        const Eigen::Vector3d moved = glb.translation();
        const Eigen::Vector3d origin(moved.x(), -moved.z(), moved.y());
        samples.push_back({corners * share + origin, bilinear(image, places * share), normal, turn,
                           static_cast<std::size_t>(f[i])});
      }
    }
  }
  return samples;
}

// JPEG changes smooth waves by a level or two, and a few more beside another image of the sheet.
constexpr double kJpeg = 8.0;

TEST(TexturedGltf, ShowsEveryPlaceInItsColour) {
  for (const char* name : {"box", "two_towers", "syn2"}) {  // images by themselves, and on a sheet
    const PaintedModel painted = paintedFarAway(name);
    const test::Glb glb = write(painted);
    const bool few = painted.textures.size() <= 16;
    EXPECT_EQ(glb.json["images"].size(), few ? painted.textures.size() : 1u) << name;
    const std::vector<Sample> samples = samplesOf(glb);
    EXPECT_EQ(samples.size(), 4 * painted.model.triangles.size());
    for (const Sample& sample : samples) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(sample.color[c], paint(sample.at - kFar, c), kJpeg) << name;
      }
      const Eigen::Vector3d& normal = painted.model.facades.at(sample.facade).normal;
      EXPECT_TRUE(sample.normal.isApprox(normal, 1e-6));
      EXPECT_GT(sample.turn.dot(normal), 0.0);
    }
  }
}

TEST(TexturedGltf, FacesTheCamerasInside) {
  PaintedModel painted = paintedFarAway("box");
  for (Facade& facade : painted.model.facades) facade.normal *= -1.0;
  for (const Sample& sample : samplesOf(write(painted))) {
    EXPECT_GT(sample.turn.dot(painted.model.facades.at(sample.facade).normal), 0.0);
  }
}

TEST(TexturedGltf, WhatNoPhotoSawIsMarked) {
  PaintedModel painted = paintedFarAway("box");
  FacadeTexture& half = painted.textures[0];
  for (std::size_t i = 0; i < half.states.size() / 2; ++i) half.states[i] = TexelState::Unseen;
  FacadeTexture& none = painted.textures[1];
  none.states.assign(none.states.size(), TexelState::Unseen);
  const test::Glb glb = write(painted);
  EXPECT_EQ(glb.json["images"].size(), painted.textures.size() - 1);
  std::size_t striped = 0;
  for (const Sample& sample : samplesOf(glb)) {
    EXPECT_NE(sample.facade, 1u);
    const double up = half.frame.local(sample.at).y() / half.frame.height;
    if (sample.facade != 0 || up < 0.55) continue;  // the upper half is the first half of the rows
    ++striped;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.color[c], (150.0 + 185.0) / 2, 35.0);
    EXPECT_NEAR(sample.color.maxCoeff(), sample.color.minCoeff(), kJpeg);
  }
  EXPECT_GT(striped, 0u);
  const auto& last = glb.json["meshes"][0]["primitives"].back();
  const auto& material = glb.json["materials"][last["material"].get<std::size_t>()];
  EXPECT_EQ(material["name"], "unseen");
  EXPECT_FALSE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
  for (const float facade : glb.values(last["attributes"]["_FACE"])) EXPECT_EQ(facade, 1.0f);
}

// Beyond what graphics cards take, an image is halved; many small ones fill more than one sheet.
TEST(TextureSheets, NoneIsTooLargeAndNoImageLost) {
  std::vector<RgbImage> images;
  for (int i = 0; i < 20; ++i) {
    images.emplace_back(i == 0 ? 9000 : 1500 + i, i == 0 ? 30 : 1000);
    for (std::size_t k = 0; k < images.back().channels.size(); ++k) {
      images.back().channels[k] = static_cast<std::uint8_t>(10 * i + 5);
    }
  }
  images.emplace_back();  // of a facade that no photo sees
  const TextureSheets laid = laySheets(images);
  EXPECT_GE(laid.sheets.size(), 2u);
  for (const RgbImage& sheet : laid.sheets) EXPECT_LE(std::max(sheet.width, sheet.height), 4096);
  EXPECT_EQ(laid.places[0].shrink, 4);
  EXPECT_EQ(laid.places.back().sheet, -1);
  std::vector<RgbImage> free = laid.sheets;  // each texel is of one image
  for (std::size_t i = 0; i + 1 < images.size(); ++i) {
    const SheetPlace& place = laid.places[i];
    RgbImage& sheet = free.at(static_cast<std::size_t>(place.sheet));
    for (int y = -1; y <= images[i].height / place.shrink; ++y) {
      for (int x = -1; x <= images[i].width / place.shrink; ++x) {
        auto* const texel = sheet.at(place.left + x, place.top + y);
        ASSERT_EQ(*texel, 10 * static_cast<int>(i) + 5);
        *texel = 0;
      }
    }
  }
}

}  // namespace
}  // namespace storey::texture
