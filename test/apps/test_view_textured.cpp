// SPDX-License-Identifier: BSD-3-Clause
// What storey_view draws of a textured model, and of one with windows.
#include <gtest/gtest.h>

#include "io/failure.h"
#include "io/label_names.h"
#include "painted_model.h"
#include "view/stages.h"
#include "view_files.h"

namespace storey::view {
namespace {

using test::BoxReconstruction;

/// The box of the reconstruction, painted and written in the input's frame.
void writeTextured(const BoxReconstruction& box) {
  io::PolygonSoup soup = test::boxSoup();
  for (Eigen::Vector3d& vertex : soup.vertices) vertex = box.localToInput() * vertex;
  const texture::PaintedModel painted(std::move(soup), box.localToInput().translation());
  texture::writeTexturedModel(box.path(), painted.soup, painted.model, painted.textures,
                              box.localToInput().linear().col(2));
}

TEST(TexturedPicture, ShowsEveryPlaceInItsColour) {
  const BoxReconstruction box;
  writeTextured(box);
  const Drawing drawing =
      makeDrawing(Reconstruction(box.path()), Stage::Textured, View::Isometric, {});
  ASSERT_EQ(drawing.textured.size(), 6u);
  std::size_t num_triangles = 0;
  for (const TexturedSet& set : drawing.textured) {
    for (const std::array<int, 3>& triangle : set.triangles) {
      ++num_triangles;
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      Eigen::Vector2d place = Eigen::Vector2d::Zero();
      for (const int corner : triangle) {
        middle += set.vertices.at(static_cast<std::size_t>(corner)) / 3.0;
        place += set.coordinates.at(static_cast<std::size_t>(corner)) / 3.0;
      }
      const Eigen::Array3d color =
          texture::bilinear(set.image, {place.x(), 1.0 - place.y()});  // rows go down
      const Eigen::Vector3d painted = box.localToInput().linear() * middle;
      // Paint changes by 9 from a texel to the next at the most, and is rounded.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], texture::paint(painted, c), 1.5);
    }
  }
  EXPECT_EQ(num_triangles, 12u);
}

/// Whether a triangle is seen from the side that a point is on.
bool isSeenFrom(const Eigen::Vector3d& point, const TexturedSet& set, std::size_t triangle) {
  const auto at = [&](std::size_t i) {
    return set.vertices.at(static_cast<std::size_t>(set.triangles[triangle][i]));
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(point - at(0)) > 0.0;
}

TEST(TexturedPicture, IsSeenFromWhereThePhotosWereTaken) {
  const Eigen::Vector3d middle(2.0, 1.5, 3.0);  // of the box
  const BoxReconstruction box;
  writeTextured(box);
  const Reconstruction reconstruction(box.path());
  for (const TexturedSet& set :
       makeDrawing(reconstruction, Stage::Textured, View::Top, {}).textured) {
    for (std::size_t t = 0; t < set.triangles.size(); ++t) EXPECT_FALSE(isSeenFrom(middle, set, t));
  }
}

TEST(TexturedPicture, FilesThatSayOtherwiseAreRefused) {
  const BoxReconstruction box;
  writeTextured(box);
  const Reconstruction reconstruction(box.path());
  const std::string plan = test::readAll(box.file("facades.json"));
  for (const auto& [right, wrong] :
       {std::pair<std::string, std::string>{"textures/facade_000.png", "../facade_000.png"},
        {"textures/facade_000.png", "/tmp/facade_000.png"},
        {"textures/facade_000.png", "textures/none.png"},
        {"\"texel\": 0.1", "\"texel\": 0"},
        {"\"polygons\"", "\"polygon\""}}) {
    std::string changed = plan;
    ASSERT_NE(changed.find(right), std::string::npos) << right;
    changed.replace(changed.find(right), right.size(), wrong);
    box.directory().write("facades.json", changed);
    EXPECT_THROW(makeDrawing(reconstruction, Stage::Textured, View::Top, {}), io::Failure) << wrong;
  }
}

TEST(WindowsPicture, TellsWindowsAndRevealsFromWalls) {
  const BoxReconstruction box;
  io::PolygonSoup soup = test::boxSoup();
  soup.polygons[0].label = io::kWindowLabel;
  soup.polygons[4].label = io::kRevealLabel;  // a level one
  io::writePolygonsPly(box.file("windows.ply"), soup, box.localToInput());
  const Drawing drawing = makeDrawing(Reconstruction(box.path()), Stage::Windows, View::Top, {});
  std::vector<std::string> texts;
  for (const LegendEntry& entry : drawing.legend) texts.push_back(entry.text);
  EXPECT_EQ(texts,
            (std::vector<std::string>{"wall: 2", "roof: 0", "ground: 1", "ceiling: 0", "window: 1",
                                      "reveal: 1", "wall partly seen: 0", "wall not seen: 1"}));
  EXPECT_EQ(drawing.facets.front().triangles.size(), 12u);
}

}  // namespace
}  // namespace storey::view
