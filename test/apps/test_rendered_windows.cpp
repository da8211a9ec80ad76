// SPDX-License-Identifier: BSD-3-Clause
// Windows found in photos of generated buildings against those that were painted.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <string>

#include "synth/photos/rendered_building.h"
#include "synth/photos/window_evaluation.h"

namespace storey::synth {
namespace {

PhotoOptions tenViews(double recess) {
  PhotoOptions options;
  options.views = 10;
  options.width = 800;
  options.recess = recess;
  options.occluders = 6;
  return options;
}

/// The windows of all walls, with a mark on each or without any. Those that stand off are cut.
void findAll(const Rendered& rendered, double recess, bool marked) {
  const std::vector<Camera> cameras = rendered.scene.placeCameras();
  const WindowDetection detection(rendered.scene.facades(), rendered.photos);
  PolyhedralModel model = rendered.model;
  WindowMeasures measures;
  for (std::size_t f = 0; f < rendered.scene.facades().size(); ++f) {
    const auto& painted = rendered.scene.paints()[f].windows();
    const auto mark = markWindow(rendered.scene, cameras, f);
    if (marked && !mark) continue;
    const WindowGrid grid = marked ? detection.detect(*mark) : detection.propose(f);
    ASSERT_EQ(grid.facade, f);
    ASSERT_EQ(grid.problem.empty(), !painted.empty()) << grid.problem;
    if (painted.empty()) continue;
    compareWindows(grid, painted, measures);
    EXPECT_TRUE(grid.depth_known);
    EXPECT_NEAR(grid.depth, recess, 0.1 * recess) << "facade " << f;
    std::vector<FacadeWindow> clear;
    for (const FacadeWindow& w : grid.windows) {
      if (!w.doubtful) clear.push_back(w);
    }
    const std::vector<bool> cut = cutWindows(model, f, grid.frame, clear, grid.depth);
    EXPECT_EQ(std::count(cut.begin(), cut.end(), recess > 0.0), std::ptrdiff_t(cut.size()));
  }
  EXPECT_GE(measures.painted, 60);
  EXPECT_GE(measures.precision(), 0.97);
  EXPECT_GE(measures.recall(), 0.97);
  EXPECT_LE(*std::max_element(measures.corners.begin(), measures.corners.end()), 2.0);
  EXPECT_TRUE(checkModel(model).ok());
}

TEST(RenderedWindows, AreFoundWhereTheyAreSetBack) {
  const Rendered rendered("box", tenViews(0.3));
  for (const bool marked : {true, false}) findAll(rendered, 0.3, marked);
}

TEST(RenderedWindows, AreFoundWhereTheyArePainted) {
  const Rendered rendered("l_shape", tenViews(0.0));
  for (const bool marked : {true, false}) findAll(rendered, 0.0, marked);
}

TEST(RenderedWindows, AreNotProposedWhereThereAreNone) {
  PhotoOptions blank = tenViews(0.0);
  blank.window_pitch = 50.0;  // more than the walls have room for
  const Rendered rendered("box", blank);
  const WindowDetection detection(rendered.scene.facades(), rendered.photos);
  for (std::size_t f = 0; f < rendered.scene.facades().size(); ++f) {
    EXPECT_TRUE(rendered.scene.paints()[f].windows().empty());
    EXPECT_NE(detection.propose(f).problem, "");
  }
}

class WindowMarks : public ::testing::Test {
 protected:
  WindowMarks()
      : model_(extrudeFloorplans(makeBuilding("box").layers)), scene_(model_, tenViews(0.0)) {
    for (const Camera& camera : scene_.placeCameras()) {
      photos_.push_back({camera, RgbImage(camera.width, camera.height)});
    }
  }

  /// A square of side 2 on a wall, about a place given in shares of its width and height, in the
  /// first photo that looks at it from the front.
  WindowMark squareAt(double x, double y) const {
    WindowMark mark;
    for (std::size_t f = 0; f < scene_.facades().size(); ++f) {
      const FacadeFrame& frame = scene_.frames()[f];
      const Eigen::Vector3d middle = frame.point(0.5 * frame.width, 0.5 * frame.height);
      if (model_.faces[f].label != FaceLabel::Wall) continue;
      if (!scene_.isClear(photos_[0].camera, f, middle)) continue;
      const Eigen::Vector2d at(x * frame.width, y * frame.height);
      const Eigen::Vector2d corners[] = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d corner = at + corners[i];
        mark.corners[i] = *photos_[0].camera.project(frame.point(corner.x(), corner.y()));
      }
      break;
    }
    return mark;
  }

  std::string problemOf(const WindowMark& mark) const {
    const WindowGrid grid = WindowDetection(scene_.facades(), photos_).detect(mark);
    EXPECT_TRUE(grid.windows.empty());
    return grid.problem;
  }

  PolyhedralModel model_;
  PhotoScene scene_;
  std::vector<FacadePhoto> photos_;
};

TEST_F(WindowMarks, ThatAreNoneAreNamed) {
  WindowMark crossed = squareAt(0.5, 0.5);
  std::swap(crossed.corners[1], crossed.corners[2]);
  EXPECT_NE(problemOf(crossed).find("crosses itself"), std::string::npos);

  WindowMark beyond = squareAt(0.5, 1.0);  // half of it above the wall
  EXPECT_NE(problemOf(beyond), "");

  WindowMark sky = squareAt(0.5, 0.5);
  sky.corners = {Eigen::Vector2d(1, 1), Eigen::Vector2d(9, 1), Eigen::Vector2d(9, 9),
                 Eigen::Vector2d(1, 9)};
  EXPECT_NE(problemOf(sky).find("no facade"), std::string::npos);

  WindowMark outside = squareAt(0.5, 0.5);
  for (Eigen::Vector2d& corner : outside.corners) corner.x() -= photos_[0].camera.width;
  EXPECT_NE(problemOf(outside).find("not inside the photo"), std::string::npos);

  WindowMark no_photo = squareAt(0.5, 0.5);
  no_photo.photo = photos_.size();
  EXPECT_NE(problemOf(no_photo).find("no such photo"), std::string::npos);

  WindowMark blank = squareAt(0.5, 0.5);  // of black photos
  EXPECT_NE(problemOf(blank).find("looks like"), std::string::npos);
}

}  // namespace
}  // namespace storey::synth
