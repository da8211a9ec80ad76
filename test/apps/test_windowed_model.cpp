// SPDX-License-Identifier: BSD-3-Clause
// What storey_windows reads and writes.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "export/formats.h"
#include "io/failure.h"
#include "synth/buildings.h"
#include "temporary_files.h"
#include "windows/windowed_model.h"

namespace storey::windows {
namespace {

/// A hexagon with two windows in its first wall.
PolyhedralModel windowedModel() {
  PolyhedralModel model = extrudeFloorplans(synth::makeBuilding("hexagon").layers);
  std::size_t wall = 0;
  while (model.faces[wall].label != FaceLabel::Wall) ++wall;
  const FacadeFrame frame = frameOf(facadesOf(model)[wall]);
  std::vector<FacadeWindow> found(2);
  found[0].min = {1.0, 1.0};
  found[0].max = {2.0, 2.5};
  found[1].min = {3.0, 1.0};
  found[1].max = {4.0, 2.5};
  const std::vector<bool> cut = cutWindows(model, wall, frame, found, 0.25);
  EXPECT_EQ(std::count(cut.begin(), cut.end(), true), 2);
  return model;
}

std::ptrdiff_t count(const PolyhedralModel& model, WindowPart part) {
  return std::count_if(model.faces.begin(), model.faces.end(),
                       [part](const PolyhedralFace& face) { return face.window == part; });
}

TEST(WindowedModel, IsReadBackAsTheSameSolid) {
  const test::TemporaryDirectory directory;
  const PolyhedralModel model = windowedModel();
  Eigen::Isometry3d to_file = Eigen::Isometry3d::Identity();
  to_file.translation() = Eigen::Vector3d(500.0, -20.0, 3.0);
  for (const char* name : {"model.ply", "model.obj"}) {
    const std::string path = directory.file(name);
    exports::formatOfFile(path)->write(path, {model, to_file});
    const SolidModel read = readSolid(path);
    EXPECT_EQ(count(read.model, WindowPart::Pane), 2) << name;
    EXPECT_EQ(count(read.model, WindowPart::Reveal), 8) << name;
    EXPECT_EQ(read.model.faces.size(), model.faces.size()) << name;
    EXPECT_NEAR(checkModel(read.model).volume, checkModel(model).volume,
                1e-5 * checkModel(model).volume);
    EXPECT_LT((read.to_file * read.model.vertices[0] - to_file * model.vertices[0]).norm(), 1e-6);
  }
}

TEST(WindowedModel, IsOfWindowsInCityJson) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("model.city.json");
  exports::findFormat("cityjson")->write(path, {windowedModel()});
  const auto city = nlohmann::json::parse(test::readAll(path));
  const auto& surfaces = city["CityObjects"]["building"]["geometry"][1]["semantics"]["surfaces"];
  EXPECT_EQ(std::count_if(surfaces.begin(), surfaces.end(),
                          [](const auto& surface) { return surface["type"] == "Window"; }),
            2);
}

TEST(WindowedModel, ThatIsNoSolidIsRefused) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("open.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n";
  EXPECT_THROW(readSolid(path), io::Failure);
}

TEST(Quadrilaterals, AreEightNumbers) {
  const auto quad = parseQuad("1,2,3.5,4,5,6e1,7,-8");
  ASSERT_TRUE(quad);
  EXPECT_EQ((*quad)[1], Eigen::Vector2d(3.5, 4.0));
  EXPECT_EQ((*quad)[3], Eigen::Vector2d(7.0, -8.0));
  for (const char* text : {"", "1,2,3,4,5,6,7", "1,2,3,4,5,6,7,8,9", "1,2,3,4,5,6,7,8 ",
                           "1,2,3,4,5,6,7,nan", "1;2;3;4;5;6;7;8", "1,2,3,4,5,6,7,"}) {
    EXPECT_FALSE(parseQuad(text)) << text;
  }
}

TEST(Views, AreFoundByNameOrNumber) {
  io::CameraSet set;
  for (const char* name : {"a/x.jpg", "b/x.jpg", "b/y.png"}) {
    io::Photo photo;
    photo.name = name;
    photo.index = set.photos.size();
    set.photos.push_back(photo);
  }
  EXPECT_EQ(findView("cameras", set, "b/x.jpg"), 1u);
  EXPECT_EQ(findView("cameras", set, "y.png"), 2u);
  EXPECT_EQ(findView("cameras", set, "y"), 2u);
  EXPECT_EQ(findView("cameras", set, "0"), 0u);
  EXPECT_THROW(findView("cameras", set, "x.jpg"), io::Failure);  // two
  EXPECT_THROW(findView("cameras", set, "z.jpg"), io::Failure);
}

}  // namespace
}  // namespace storey::windows
