// SPDX-License-Identifier: BSD-3-Clause
// What storey_texture writes, read back.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/images/image_files.h"
#include "io/model_io.h"
#include "synth/buildings.h"
#include "temporary_files.h"
#include "texture/drawn_image.h"
#include "texture/textured_model.h"

namespace storey::texture {
namespace {

PolyhedralModel modelOf(const char* name) {
  return extrudeFloorplans(synth::makeBuilding(name).layers);
}

TEST(ModelFacades, PiecesOfAFaceAreOneFacade) {
  const PolyhedralModel model = modelOf("courtyard");  // its roof has a hole: it is cut in pieces
  const io::PolygonSoup soup = io::toPolygons(model);
  ASSERT_GT(soup.polygons.size(), model.faces.size());
  const ModelFacades grouped = groupFacades("model", soup);
  EXPECT_EQ(grouped.facades.size(), model.faces.size());
  // Inside is where it is inside of the model's own face.
  const std::vector<Facade> faces = facadesOf(model);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::size_t same = grouped.facades.size();
    for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
      const Eigen::Vector3d& corner =
          soup.vertices[static_cast<std::size_t>(soup.polygons[i].corners[0])];
      const double off = faces[f].normal.dot(corner - faces[f].rings[0][0]);
      const double cosine = faces[f].normal.dot(grouped.facades[grouped.facade_of[i]].normal);
      if (std::abs(off) < 1e-9 && cosine > 0.999) same = grouped.facade_of[i];
    }
    ASSERT_LT(same, grouped.facades.size());
    const FacadeFrame frame = frameOf(faces[f]);
    for (int k = 0; k < 100; ++k) {
      const Eigen::Vector2d at(frame.width * (k % 10 + 0.47) / 10,
                               frame.height * (k / 10 + 0.53) / 10);
      EXPECT_EQ(isInside(frame.outline(faces[f]), at),
                isInside(frame.outline(grouped.facades[same]), at));
    }
  }
}

TEST(ModelFacades, TurnToCamerasInside) {
  ModelFacades model = groupFacades("model", io::toPolygons(modelOf("box")));
  const std::vector<Facade> before = model.facades;
  FacadePhoto outside;
  outside.camera.world_to_camera.translation() = Eigen::Vector3d(1000.0, 0.0, 0.0);
  EXPECT_FALSE(turnToCameras({outside}, model.facades));
  EXPECT_EQ(model.facades[0].normal, before[0].normal);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : modelOf("box").vertices) middle += v / 8.0;
  FacadePhoto inside;
  inside.camera.world_to_camera.translation() = -middle;
  EXPECT_TRUE(turnToCameras({inside}, model.facades));
  EXPECT_EQ(model.facades[0].normal, -before[0].normal);
}

// A room of which all but the floor was guessed: only what is above is taken for sky.
TEST(ModelFacades, OpenLidsAreForgotten) {
  io::PolygonSoup soup = io::toPolygons(modelOf("box"));
  for (io::PolygonSoup::Polygon& polygon : soup.polygons) polygon.hypothetical = true;
  ModelFacades model = groupFacades("model", soup);
  for (Facade& facade : model.facades) facade.normal *= -1.0;
  FacadeTexturing texturing;
  texturing.setFacades(model.facades);
  std::vector<FacadeTexture> textures;
  ASSERT_TRUE(texturing.texture(textures));
  for (FacadeTexture& t : textures) t.states.assign(t.states.size(), TexelState::Seen);
  forgetOpenLids(model, Eigen::Vector3d::UnitZ(), textures);
  for (std::size_t f = 0; f < textures.size(); ++f) {
    EXPECT_EQ(textures[f].seenShare(), model.facades[f].normal.z() < -0.5 ? 0.0 : 1.0);
  }
  soup.polygons[0].hypothetical = false;
  EXPECT_FALSE(groupFacades("model", soup).guessed[0]);
}

/// A wall of 8 x 6 whose hole [2, 6] x [1, 5] has a pane of the same size behind it.
TEST(DrawnImages, HolesShowTheirPanes) {
  FacadeTexture wall;
  wall.frame.width = 8.0;
  wall.frame.height = 6.0;
  wall.frame.up = Eigen::Vector3d::UnitZ();
  wall.texel = 0.1;
  wall.image = RgbImage(80, 60);
  for (int i = 0; i < 80 * 60; ++i) {
    const int x = i % 80;
    const int y = i / 80;
    const bool hole = x >= 20 && x < 60 && y >= 10 && y < 50;
    wall.states.push_back(hole ? TexelState::Outside : TexelState::Seen);
    std::fill_n(wall.image.at(x, y), 3, std::uint8_t(hole ? 0 : 200));
  }
  FacadeTexture pane = wall;
  pane.frame.origin = {2.0, 0.3, 1.0};  // the wall looks to -y
  pane.frame.width = pane.frame.height = 4.0;
  pane.texel = 0.2;
  pane.image = RgbImage(20, 20);
  pane.states.assign(400, TexelState::Seen);
  for (int i = 0; i < 400; ++i) {  // dark above, bright below
    std::fill_n(pane.image.at(i % 20, i / 20), 3, std::uint8_t(i / 20 < 10 ? 40 : 100));
  }
  const std::vector<RgbImage> images = drawnImages({wall, pane});
  for (int i = 0; i < 80 * 60; ++i) {
    const int x = i % 80;
    const int y = i / 80;
    // The wall's own colour goes two texels into the hole.
    const bool in_pane = x >= 22 && x < 58 && y >= 12 && y < 48;
    ASSERT_EQ(*images[0].at(x, y), !in_pane ? 200 : (y < 30 ? 40 : 100)) << x << " " << y;
  }
  EXPECT_EQ(images[1].channels, pane.image.channels);
}

TEST(TexturedModel, FilesSayWhereEachCornerIs) {
  const test::TemporaryDirectory directory;
  const io::PolygonSoup soup = io::toPolygons(modelOf("l_shape"));
  const ModelFacades model = groupFacades("model", soup);
  FacadeTexturing texturing;
  texturing.setFacades(model.facades);
  texturing.setTexelSize(0.5);
  std::vector<FacadeTexture> textures;
  ASSERT_TRUE(texturing.texture(textures));
  writeTexturedModel(directory.path(), soup, model, textures, Eigen::Vector3d::UnitZ());

  const io::PolygonSoup read = io::readPolygons(directory.file("textured.obj"));
  ASSERT_EQ(read.polygons.size(), soup.polygons.size());
  for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
    EXPECT_EQ(read.vertices[v], soup.vertices[v]);
  }
  const auto plan = nlohmann::json::parse(test::readAll(directory.file("facades.json")));
  ASSERT_EQ(plan["facades"].size(), textures.size());
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const auto& facade = plan["facades"][f];
    EXPECT_EQ(facade["texel"], 0.5);
    const RgbImage image = io::readImage(directory.file(facade["image"]));
    const RgbImage mask = io::readImage(directory.file(facade["mask"]));
    EXPECT_EQ(image.width, std::ceil(textures[f].frame.width / 0.5));
    EXPECT_EQ(mask.height, image.height);
  }
  // Corner by corner: x along the wall in texels, y from the image's lower edge.
  std::istringstream lines(test::readAll(directory.file("textured.obj")));
  std::vector<Eigen::Vector2d> coordinates;
  std::size_t polygon = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    double u = 0.0;
    double v = 0.0;
    if (words >> keyword && keyword == "vt" && words >> u >> v) coordinates.emplace_back(u, v);
    if (keyword != "f") continue;
    const FacadeTexture& t = textures[model.facade_of[polygon]];
    const std::vector<int>& corners = soup.polygons[polygon++].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d at = coordinates[coordinates.size() - corners.size() + k];
      const Eigen::Vector3d& vertex = soup.vertices[static_cast<std::size_t>(corners[k])];
      const double x = at.x() * t.image.width * 0.5;
      const double y = t.frame.height - (1.0 - at.y()) * t.image.height * 0.5;
      EXPECT_TRUE(t.frame.point(x, y).isApprox(vertex, 1e-9));
    }
  }
  EXPECT_EQ(polygon, soup.polygons.size());
}

}  // namespace
}  // namespace storey::texture
