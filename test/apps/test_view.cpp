// SPDX-License-Identifier: BSD-3-Clause
// What pictures show, before anything is rendered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/failure.h"
#include "view/layout.h"
#include "view/palette.h"
#include "view/stages.h"
#include "view_files.h"

namespace storey::view {
namespace {

using test::BoxReconstruction;

int statusOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const io::Failure& failure) {
    return failure.status();
  }
  return io::Ok;
}

TEST(Projection, IsometricViewComesFromTheSouthEastAboveAndShortensAllAxesAlike) {
  const Projection p = projectionOf(View::Isometric);
  EXPECT_GT(p.towards.x(), 0.0);
  EXPECT_LT(p.towards.y(), 0.0);
  EXPECT_GT(p.towards.z(), 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(p.apply(Eigen::Vector3d::Unit(axis)).head<2>().norm(), p.shortening, 1e-15);
  }
  EXPECT_NEAR(p.apply(Eigen::Vector3d::UnitZ()).x(), 0.0, 1e-15);
  EXPECT_GT(p.apply(Eigen::Vector3d::UnitZ()).y(), 0.0);
}

TEST(Projection, AxesAreOrthonormalAndRightHanded) {
  for (const View view : {View::Isometric, View::Top, View::Front}) {
    const Projection p = projectionOf(view);
    EXPECT_NEAR(p.right.norm(), 1.0, 1e-15);
    EXPECT_NEAR(p.up.norm(), 1.0, 1e-15);
    EXPECT_LT((p.right.cross(p.up) - p.towards).norm(), 1e-15);
  }
}

TEST(Projection, RoundLengthIsTheLargestOneTwoOrFiveThatFits) {
  for (double length = 1e-7; length < 1e9; length *= 1.07) {
    const double rounded = roundLength(length);
    const double digit = rounded / std::pow(10.0, std::floor(std::log10(rounded * 1.0000001)));
    const double next = std::abs(digit - 2.0) < 1e-6 ? 2.5 : 2.0;  // 1 -> 2 -> 5 -> 10
    EXPECT_LE(rounded, length);
    EXPECT_GT(next * rounded, length * (1.0 - 1e-12));
    EXPECT_TRUE(std::abs(digit - 1.0) < 1e-6 || std::abs(digit - 2.0) < 1e-6 ||
                std::abs(digit - 5.0) < 1e-6)
        << rounded;
  }
}

TEST(Layout, BoundsFitIntoTheSceneAndFillItOneWay) {
  const Layout layout = layoutOf(800, 600);
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(100, 1, 5), Eigen::Vector3d(1, 100, 5), Eigen::Vector3d(0, 1e-6, 0)}) {
    const double pixels = pixelsPerLength(layout, {Eigen::Vector3d::Zero(), size});
    const double x = pixels * size.x() / (layout.right - layout.left);
    const double y = pixels * size.y() / (layout.top - layout.bottom);
    EXPECT_LE(std::max(x, y), 1.0);
    EXPECT_GT(std::max(x, y), 0.9);
  }
  EXPECT_GT(pixelsPerLength(layout, {Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()}), 0.0);
}

TEST(Palette, DistinctColoursDiffer) {
  for (const std::size_t n : {1u, 4u, 7u, 12u, 40u}) {
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_FALSE(distinctColour(i, n) == kNoLabel);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(distinctColour(i, n) == distinctColour(j, n)) << i << " " << j << " " << n;
      }
    }
  }
}

TEST(Palette, NeighbouringSlicesDiffer) {
  for (std::size_t k = 0; k < 20; ++k) EXPECT_FALSE(sliceColour(k) == sliceColour(k + 1));
}

TEST(Palette, HsvHasThePrimariesWhereTheyBelong) {
  EXPECT_TRUE(fromHsv(0.0, 1.0, 1.0) == (Colour{255, 0, 0}));
  EXPECT_TRUE(fromHsv(1.0 / 3.0, 1.0, 1.0) == (Colour{0, 255, 0}));
  EXPECT_TRUE(fromHsv(-1.0 / 3.0, 1.0, 1.0) == (Colour{0, 0, 255}));
  EXPECT_TRUE(fromHsv(0.4, 0.0, 1.0) == (Colour{255, 255, 255}));
}

TEST(Thinning, TakesAscendingIndicesAtEvenDistances) {
  EXPECT_TRUE(evenlySpaced(0, 10).empty());
  EXPECT_EQ(evenlySpaced(3, 10), (std::vector<std::size_t>{0, 1, 2}));
  const auto chosen = evenlySpaced(1000003, 300);
  ASSERT_EQ(chosen.size(), 300u);
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    const std::size_t gap = chosen[i] - chosen[i - 1];
    EXPECT_TRUE(gap == 1000003 / 300 || gap == 1000003 / 300 + 1);
  }
  EXPECT_LT(chosen.back(), 1000003u);
}

TEST(StageFiles, CloudsOfOurWriterComeBack) {
  const BoxReconstruction box;
  pcl::PointCloud<pcl::PointXYZINormal> cloud;
  for (int i = 0; i < 5; ++i) {
    const auto f = static_cast<float>(i);
    pcl::PointXYZINormal p;
    p.getVector3fMap() << f, 10.0f + f, -f;
    p.getNormalVector3fMap() << 0.0f, 1.0f, 0.1f * f;
    p.intensity = 0.2f * f;
    cloud.push_back(p);
  }
  io::writeCloud(box.file("02_confidence.pcd"), cloud);
  const StageCloud read = readStageCloud(box.file("02_confidence.pcd"), "intensity");
  ASSERT_EQ(read.positions.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(read.positions[i], Eigen::Vector3f(cloud[i].getVector3fMap()));
    EXPECT_EQ(read.normals[i], Eigen::Vector3f(cloud[i].getNormalVector3fMap()));
    EXPECT_EQ(read.values[i], static_cast<double>(cloud[i].intensity));
  }
}

TEST(StageFiles, EveryPieceOfAFileIsRefused) {
  const BoxReconstruction box;
  box.writeStages();
  const test::MemoryFile file;
  const std::string cloud = test::readAll(box.file("04_slices.pcd"));
  for (std::size_t size = 1; size < cloud.size(); ++size) {
    const std::string path = file.write(cloud.substr(0, size));
    EXPECT_EQ(statusOf([&] { readStageCloud(path, "label"); }), io::BadInput) << size;
  }
  const std::string lines = test::readAll(box.file("09_floorplans.vtk"));
  for (std::size_t size = 1; size < lines.find("LINES 1") + 8; ++size) {
    const std::string path = file.write(lines.substr(0, size));
    EXPECT_EQ(statusOf([&] { readVtkLines(path); }), io::BadInput) << size;
  }
}

TEST(StageFiles, NumbersThatCannotBeDrawnAreRefused) {
  const BoxReconstruction box;
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back({0.0f, std::numeric_limits<float>::infinity(), 0.0f});
  io::writeCloud(box.file("a.pcd"), cloud);
  EXPECT_EQ(statusOf([&] { readStageCloud(box.file("a.pcd"), ""); }), io::BadInput);
  const std::string head = "# vtk\na\nASCII\nDATASET POLYDATA\n";
  for (const char* const body :
       {"POINTS 1 double\n0 0 nan\nLINES 0 0\n", "POINTS 1 double\n0 0 0\nLINES 1 3\n2 0 1\n",
        "POINTS 1 double\n0 0 0\nLINES 1 3\n2 0 -1\n", "POINTS 99999999999 double\n0 0 0\n"}) {
    const std::string path = box.directory().write("b.vtk", head + body);
    EXPECT_EQ(statusOf([&] { readVtkLines(path); }), io::BadInput) << body;
  }
}

TEST(Reconstruction, ReportsThatAreNoneAreRefused) {
  const BoxReconstruction box;
  for (const char* const report : {"", "{", "[]", "{}", "null", R"({"input": {"file": 3}})"}) {
    box.directory().write("report.json", report);
    EXPECT_EQ(statusOf([&] { Reconstruction{box.path()}; }), io::BadInput) << report;
  }
}

TEST(ModelPicture, ShowsTheModelInTheUprightFrameOfTheClouds) {
  const BoxReconstruction box;
  const Drawing drawing =
      makeDrawing(Reconstruction(box.path()), Stage::Model, View::Isometric, {});
  ASSERT_EQ(drawing.facets.size(), 1u);
  const FacetSet& facets = drawing.facets.front();
  EXPECT_EQ(facets.triangles.size(), 12u);  // two for each of six rectangles
  const io::PolygonSoup soup = test::boxSoup();
  ASSERT_EQ(facets.vertices.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT((facets.vertices[i] - soup.vertices[i]).norm(), 1e-8);
  }
  EXPECT_EQ(drawing.lines.front().lines.size(), 12u);  // the edges of a box, no diagonals
}

TEST(ModelPicture, TellsKindsOfFacesApart) {
  const BoxReconstruction box;
  const Drawing drawing = makeDrawing(Reconstruction(box.path()), Stage::Model, View::Top, {});
  std::vector<std::string> texts;
  for (const LegendEntry& entry : drawing.legend) {
    texts.push_back(entry.text);
    for (const LegendEntry& other : drawing.legend) {
      EXPECT_EQ(other.colour == entry.colour, &other == &entry);
    }
  }
  EXPECT_EQ(texts, (std::vector<std::string>{"wall: 3", "roof: 1", "ground: 1", "ceiling: 0",
                                             "wall partly seen: 0", "wall not seen: 1"}));
}

TEST(ModelPicture, TellsWallsApartThatWereSeenInPart) {
  const BoxReconstruction box;
  io::PolygonSoup soup = test::boxSoup();
  soup.deviations.assign(soup.vertices.size(), 0.01);
  const double coverages[] = {1.0, 0.5, 0.7, 0.1, 0.0, 0.0};  // the fourth is hypothetical
  for (std::size_t i = 0; i < 6; ++i) soup.polygons[i].coverage = coverages[i];
  io::writePolygonsPly(box.file("model.ply"), soup, Eigen::Isometry3d::Identity());
  const Drawing drawing = makeDrawing(Reconstruction(box.path()), Stage::Model, View::Top, {});
  ASSERT_EQ(drawing.legend.size(), 6u);
  EXPECT_EQ(drawing.legend[0].text, "wall: 2");
  EXPECT_EQ(drawing.legend[1].text, "roof: 1");  // level faces are what they are
  EXPECT_EQ(drawing.legend[4].text, "wall partly seen: 1");
  EXPECT_EQ(drawing.legend[5].text, "wall not seen: 1");
}

TEST(ModelPicture, APolygonThatIsNoneIsRefused) {
  const BoxReconstruction box;
  io::PolygonSoup soup = test::boxSoup();
  std::swap(soup.polygons[4].corners[0], soup.polygons[4].corners[1]);  // now an hourglass
  io::writePolygonsPly(box.file("model.ply"), soup, Eigen::Isometry3d::Identity());
  const Reconstruction reconstruction(box.path());
  EXPECT_EQ(statusOf([&] { makeDrawing(reconstruction, Stage::Model, View::Top, {}); }),
            io::BadInput);
}

TEST(ModelPicture, PiecesOfAFaceCountAsOnePolygon) {
  const BoxReconstruction box;
  io::PolygonSoup soup = test::boxSoup();
  io::PolygonSoup::Polygon half = soup.polygons[4];  // the roof, cut along a diagonal
  half.corners = {4, 7, 6};
  soup.polygons[4].corners = {4, 5, 7};
  soup.polygons.push_back(half);
  io::writePolygonsPly(box.file("model.ply"), soup, Eigen::Isometry3d::Identity());
  const Drawing drawing = makeDrawing(Reconstruction(box.path()), Stage::Model, View::Top, {});
  EXPECT_EQ(drawing.legend[1].text, "roof: 1");
  EXPECT_NE(drawing.subtitle.find("6 polygons"), std::string::npos) << drawing.subtitle;
  EXPECT_EQ(drawing.lines.front().lines.size(), 12u);
}

TEST(ModelPicture, SupportAndDeviationAreColouredByTheirBars) {
  const BoxReconstruction box;
  io::PolygonSoup soup = test::boxSoup();
  soup.deviations.assign(soup.vertices.size(), 0.01);
  for (std::size_t i = 0; i < 6; ++i) {
    soup.polygons[i].coverage = i == 0 ? 1.0 : 0.0;
    soup.polygons[i].deviation = i == 1 ? 0.5 : 0.0;
  }
  io::writePolygonsPly(box.file("model.ply"), soup, Eigen::Isometry3d::Identity());
  const Reconstruction reconstruction(box.path());
  const Drawing support = makeDrawing(reconstruction, Stage::Support, View::Top, {});
  const Drawing deviation = makeDrawing(reconstruction, Stage::Deviation, View::Top, {});
  for (std::size_t t = 0; t < 12; ++t) {  // two triangles a face
    EXPECT_TRUE(support.facets[0].colours[t] == sequentialColour(t / 2 == 0 ? 1.0 : 0.0));
    EXPECT_TRUE(deviation.facets[0].colours[t] == sequentialColour(t / 2 == 1 ? 1.0 : 0.0));
  }
  EXPECT_EQ(deviation.bar.ticks.back().text, "0.5");
}

TEST(ModelPicture, TheCloudIsLaidOverOnDemand) {
  const BoxReconstruction box;
  box.writeStages();
  const Reconstruction reconstruction(box.path());
  EXPECT_TRUE(makeDrawing(reconstruction, Stage::Support, View::Free, {}).points.empty());
  const Drawing both = makeDrawing(reconstruction, Stage::Support, View::Free, {}, true);
  EXPECT_EQ(both.points.size(), 1u);
  EXPECT_LT(both.facets.front().opacity, 1.0);
}

TEST(PlanPictures, ShowEachRunOfAWallAndTheCellsOfABlock) {
  const BoxReconstruction box;
  box.writePlans();
  const Reconstruction reconstruction(box.path());
  const Drawing walls = makeDrawing(reconstruction, Stage::Walls, View::Isometric, {});
  EXPECT_EQ(walls.lines.front().lines.size(), 2u);  // two runs
  EXPECT_EQ(walls.facets.front().triangles.size(), 4u);
  EXPECT_EQ(countSteps(reconstruction, Stage::Cells), 2u);
  const Drawing lower = makeDrawing(reconstruction, Stage::Cells, View::Top, 0);
  const Drawing upper = makeDrawing(reconstruction, Stage::Cells, View::Top, 1);
  const Colour inside = lower.legend.front().colour;
  const auto in = [&](const Drawing& drawing) {
    const auto& colours = drawing.facets.front().colours;
    return std::count(colours.begin(), colours.end(), inside) / 2;  // two triangles a cell
  };
  EXPECT_EQ(in(lower), 2);
  EXPECT_EQ(in(upper), 1);
  EXPECT_EQ(statusOf([&] { makeDrawing(reconstruction, Stage::Cells, View::Top, 2); }), io::Usage);
}

TEST(PlanPictures, FilesThatAreNoneAreRefused) {
  const BoxReconstruction box;
  for (const char* const text : {"", "{}", R"({"blocks": [[0]], "features": []})",
                                 R"({"blocks": [[0, 1]], "features": [{"properties":
        {"inside": [1]}, "geometry": {"coordinates": [[[0,0],[1,0],[1,1],[0,0]]]}}]})"}) {
    box.directory().write("09_cells.geojson", text);
    box.directory().write("09_walls.geojson", text[0] == '{' ? "{\"features\": [1]}" : text);
    const Reconstruction reconstruction(box.path());
    for (const Stage stage : {Stage::Cells, Stage::Walls}) {
      EXPECT_EQ(statusOf([&] { makeDrawing(reconstruction, stage, View::Top, {}); }), io::BadInput)
          << text;
    }
  }
}

TEST(SlicePicture, EveryRegionOfASliceHasASegment) {
  const BoxReconstruction box;
  box.writeStages();
  const Drawing drawing = makeDrawing(Reconstruction(box.path()), Stage::Segments, View::Top, 1);
  ASSERT_EQ(drawing.lines.front().lines.size(), 2u);  // halves of the wall on y = 0
  for (const auto& line : drawing.lines.front().lines) {
    EXPECT_NEAR(line.front().y(), 0.0, 1e-6);
    EXPECT_NEAR((line.back() - line.front()).norm(), 1.6, 1e-3);  // five points 0.4 apart
  }
}

TEST(SlicePicture, ShowsThePointsAndTheFloorplanOfTheSliceAskedFor) {
  const BoxReconstruction box;
  box.writeStages();
  const Reconstruction reconstruction(box.path());
  const Drawing drawing = makeDrawing(reconstruction, Stage::Slice, View::Top, 1);
  ASSERT_EQ(drawing.points.size(), 2u);
  for (const PointSet& set : drawing.points) ASSERT_EQ(set.positions.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const float x = 0.4f * static_cast<float>(i);
    EXPECT_EQ(drawing.points[0].positions[i].head<2>(), Eigen::Vector2f(x, -0.25f));
    EXPECT_EQ(drawing.points[1].positions[i].head<2>(), Eigen::Vector2f(x, 0.0f));
  }
  ASSERT_EQ(drawing.lines.size(), 2u);
  EXPECT_EQ(drawing.lines[0].lines.size(), 10u);  // normals
  ASSERT_EQ(drawing.lines[1].lines.size(), 1u);
  EXPECT_EQ(drawing.lines[1].lines[0].size(), 5u);

  const Drawing other = makeDrawing(reconstruction, Stage::Slice, View::Top, 2);
  EXPECT_TRUE(other.lines[1].lines.empty());
  EXPECT_EQ(statusOf([&] { makeDrawing(reconstruction, Stage::Slice, View::Top, 3); }), io::Usage);
}

TEST(SlicePicture, WithoutANumberItIsOneWithAFloorplan) {
  const BoxReconstruction box;
  box.writeStages();
  const Drawing drawing =
      makeDrawing(Reconstruction(box.path()), Stage::Slice, View::Top, std::nullopt);
  EXPECT_EQ(drawing.title, "Slice 1 in plan (0 to 2)");
}

TEST(CloudPictures, ColourEachSliceAsItsBarAndSayHowFarPointsMoved) {
  const BoxReconstruction box;
  box.writeStages();
  const Reconstruction reconstruction(box.path());
  const Drawing slices = makeDrawing(reconstruction, Stage::Slices, View::Isometric, {});
  ASSERT_EQ(slices.bar.colours.size(), 3u);
  ASSERT_EQ(slices.points.front().colours.size(), 31u);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_TRUE(slices.points.front().colours[i] == slices.bar.colours[2 - i / 10]);
  }
  EXPECT_TRUE(slices.points.front().colours[30] == kNoLabel);
  const Drawing refined = makeDrawing(reconstruction, Stage::Refined, View::Isometric, {});
  EXPECT_EQ(refined.legend_title, "99 % moved less than 0.25");
}

TEST(CloudPictures, LabelsBeyondTheReportAreRefused) {
  const BoxReconstruction box;
  box.writeStages();  // labels up to 3, the report has two directions
  std::filesystem::copy_file(box.file("04_slices.pcd"), box.file("03_directions.pcd"));
  const Reconstruction reconstruction(box.path());
  EXPECT_EQ(statusOf([&] { makeDrawing(reconstruction, Stage::Directions, View::Top, {}); }),
            io::BadInput);
}

}  // namespace
}  // namespace storey::view
