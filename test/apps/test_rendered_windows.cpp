// SPDX-License-Identifier: BSD-3-Clause
// Windows found in photos of generated buildings against those that were painted.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>
#include <storey/surface/model_check.h>
#include <storey/surface/window_cutting.h>
#include <storey/surface/window_detection.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "synth/photos/rendered_building.h"

namespace storey::synth {
namespace {

struct Score {
  int found = 0;
  int right = 0;
  int painted = 0;
  double worst_corner = 0.0;
};

double overlap(const FacadeWindow& a, const PaintedWindow& b) {
  const Eigen::Vector2d common = (a.max.cwiseMin(b.max) - a.min.cwiseMax(b.min)).cwiseMax(0.0);
  const double both = common.prod();
  return both / ((a.max - a.min).prod() + (b.max - b.min).prod() - both);
}

Score scoreOf(const WindowGrid& grid, const std::vector<PaintedWindow>& truth) {
  Score score;
  score.painted = static_cast<int>(truth.size());
  for (const FacadeWindow& window : grid.windows) {
    if (window.doubtful) continue;
    ++score.found;
    for (const PaintedWindow& painted : truth) {
      if (overlap(window, painted) < 0.5) continue;
      ++score.right;
      const double off = std::max((window.min - painted.min).cwiseAbs().maxCoeff(),
                                  (window.max - painted.max).cwiseAbs().maxCoeff());
      score.worst_corner = std::max(score.worst_corner, off / grid.texel);
    }
  }
  return score;
}

/// A mark about the window of a facade that a photo shows largest, drawn loosely.
bool markOn(const Rendered& rendered, std::size_t facade, WindowMark& mark) {
  double largest = 0.0;
  const FacadeFrame& frame = rendered.scene.frames()[facade];
  for (std::size_t k = 0; k < rendered.photos.size(); ++k) {
    for (const PaintedWindow& w : rendered.scene.paints()[facade].windows()) {
      const Eigen::Vector2d slack = 0.05 * (w.max - w.min);
      const Eigen::Vector2d a = w.min - slack;
      const Eigen::Vector2d b = w.max + slack;
      const std::array<Eigen::Vector2d, 4> ring = {a, Eigen::Vector2d(b.x(), a.y()), b,
                                                   Eigen::Vector2d(a.x(), b.y())};
      WindowMark here;
      here.photo = k;
      here.corners.fill(Eigen::Vector2d::Zero());
      bool clear = true;
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector3d point = frame.point(ring[i].x(), ring[i].y());
        clear = clear && rendered.scene.isClear(rendered.photos[k].camera, facade, point);
        if (clear) here.corners[i] = *rendered.photos[k].camera.project(point);
      }
      if (!clear) continue;
      const Eigen::Vector2d u = here.corners[2] - here.corners[0];
      const Eigen::Vector2d v = here.corners[3] - here.corners[1];
      const double area = std::abs(u.x() * v.y() - u.y() * v.x());
      if (area <= largest) continue;
      largest = area;
      mark = here;
    }
  }
  return largest > 0.0;
}

PhotoOptions tenViews(double recess) {
  PhotoOptions options;
  options.views = 10;
  options.width = 800;
  options.recess = recess;
  options.occluders = 6;
  return options;
}

/// All walls with windows, one mark each. Windows that stand off are cut.
void findAll(const char* name, double recess) {
  const Rendered rendered(name, tenViews(recess));
  PolyhedralModel model = rendered.model;
  Score all;
  for (std::size_t f = 0; f < rendered.scene.facades().size(); ++f) {
    const auto& truth = rendered.scene.paints()[f].windows();
    WindowMark mark;
    if (truth.empty() || !markOn(rendered, f, mark)) continue;
    const WindowGrid grid = detectWindows(rendered.scene.facades(), rendered.photos, mark);
    ASSERT_EQ(grid.problem, "");
    ASSERT_EQ(grid.facade, f);
    const Score score = scoreOf(grid, truth);
    all.found += score.found;
    all.right += score.right;
    all.painted += score.painted;
    EXPECT_LE(score.worst_corner, 2.0) << name << ", facade " << f;
    EXPECT_TRUE(grid.depth_known);
    EXPECT_NEAR(grid.depth, recess, 0.1 * recess) << name << ", facade " << f;
    std::vector<FacadeWindow> clear;
    for (const FacadeWindow& w : grid.windows) {
      if (!w.doubtful) clear.push_back(w);
    }
    const std::vector<bool> cut = cutWindows(model, f, grid.frame, clear, grid.depth);
    EXPECT_EQ(std::count(cut.begin(), cut.end(), recess > 0.0), std::ptrdiff_t(cut.size()));
  }
  EXPECT_GE(all.painted, 60);
  EXPECT_GE(all.right, 0.97 * all.found);
  EXPECT_GE(all.right, 0.97 * all.painted);
  EXPECT_TRUE(checkModel(model).ok());
}

TEST(RenderedWindows, AreFoundWhereTheyAreSetBack) { findAll("box", 0.3); }

TEST(RenderedWindows, AreFoundWhereTheyArePainted) { findAll("l_shape", 0.0); }

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
    const WindowGrid grid = detectWindows(scene_.facades(), photos_, mark);
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
