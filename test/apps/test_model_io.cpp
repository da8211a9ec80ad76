// SPDX-License-Identifier: BSD-3-Clause
// What is written of a model can be read back: the same vertices, polygons and attributes.
#include <gtest/gtest.h>
#include <storey/surface/extrusion.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "io/failure.h"
#include "io/model_io.h"
#include "temporary_files.h"

namespace storey {
namespace {

using io::PlyEncoding;
using io::PolygonSoup;
using io::readPolygons;
using test::readAll;
using test::TemporaryDirectory;

PolygonSoup::Polygon polygon(std::vector<int> corners, FaceLabel label, int wall, int shell,
                             bool hypothetical) {
  return {std::move(corners), static_cast<std::uint8_t>(label), wall, shell, hypothetical};
}

/// A box of 1/3 x 1/7 x 1/10: numbers without a short decimal form.
PolygonSoup boxSoup() {
  PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back((i & 1) / 3.0, ((i >> 1) & 1) / 7.0, ((i >> 2) & 1) / 10.0);
  }
  soup.polygons = {polygon({0, 2, 3, 1}, FaceLabel::Ground, -1, 0, false),
                   polygon({4, 5, 7, 6}, FaceLabel::Roof, -1, 0, false),
                   polygon({0, 1, 5, 4}, FaceLabel::Wall, 3, 0, false),
                   polygon({1, 3, 7, 5}, FaceLabel::Wall, 0, 0, true),
                   polygon({3, 2, 6, 7}, FaceLabel::Wall, 1, 1, false),
                   polygon({2, 0, 4, 6}, FaceLabel::Ceiling, 2, 1, false)};
  return soup;
}

Eigen::Isometry3d translation(double x, double y, double z) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translation() = Eigen::Vector3d(x, y, z);
  return transform;
}

/// The frame of a tower on the globe: earth-centred coordinates, up along (0.18, 0.84, 0.50).
Eigen::Isometry3d ecef() {
  Eigen::Isometry3d transform = translation(1141745.25, 5391160.5, 3201808.125);
  transform.linear() = Eigen::Quaterniond::FromTwoVectors(
                           Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.178839, 0.84445, 0.504898))
                           .toRotationMatrix();
  return transform;
}

using PolygonKey = std::tuple<std::vector<int>, int, int, int, bool>;

/// The polygons as a set: OBJ groups them in another order. Walls are not part of an OBJ.
std::multiset<PolygonKey> keysOf(const PolygonSoup& soup, bool with_walls) {
  std::multiset<PolygonKey> keys;
  for (const auto& p : soup.polygons) {
    keys.emplace(p.corners, p.label, with_walls ? p.wall : -1, p.shell, p.hypothetical);
  }
  return keys;
}

void expectSame(const PolygonSoup& read, const PolygonSoup& written,
                const Eigen::Isometry3d& transform, bool with_walls) {
  ASSERT_EQ(read.vertices.size(), written.vertices.size());
  for (std::size_t i = 0; i < read.vertices.size(); ++i) {
    EXPECT_EQ(read.vertices[i], Eigen::Vector3d(transform * written.vertices[i])) << i;
  }
  EXPECT_EQ(keysOf(read, with_walls), keysOf(written, with_walls));
}

TEST(ModelIo, PolygonsReadBackExactlyInEveryFormat) {
  const TemporaryDirectory directory;
  const PolygonSoup soup = boxSoup();
  for (const Eigen::Isometry3d& transform :
       {translation(0, 0, 0), translation(447123.456, 5411987.654, 312.5), ecef()}) {
    io::writePolygonsPly(directory.file("a"), soup, transform, PlyEncoding::Ascii);
    expectSame(readPolygons(directory.file("a")), soup, transform, true);
    io::writePolygonsPly(directory.file("b"), soup, transform, PlyEncoding::Binary);
    expectSame(readPolygons(directory.file("b")), soup, transform, true);
    io::writePolygonsObj(directory.file("c"), soup, transform);
    expectSame(readPolygons(directory.file("c")), soup, transform, false);
  }
}

TEST(ModelIo, PolygonsOfMoreThan255Corners) {
  const TemporaryDirectory directory;
  PolygonSoup soup;
  PolygonSoup::Polygon disc = polygon({}, FaceLabel::Roof, -1, 0, false);
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * M_PI * i / 1000.0;
    soup.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    disc.corners.push_back(i);
  }
  soup.polygons = {disc};
  for (const PlyEncoding encoding : {PlyEncoding::Ascii, PlyEncoding::Binary}) {
    io::writePolygonsPly(directory.file("a"), soup, translation(0, 0, 0), encoding);
    expectSame(readPolygons(directory.file("a")), soup, translation(0, 0, 0), true);
  }
}

TEST(ModelIo, ObjHasAnObjectForEachShellAndAGroupForEachLabel) {
  const TemporaryDirectory directory;
  io::writePolygonsObj(directory.file("a.obj"), boxSoup(), translation(0, 0, 0));
  std::istringstream text(readAll(directory.file("a.obj")));
  std::vector<std::string> outline;
  for (std::string line; std::getline(text, line);) {
    if (line[0] == 'o' || line[0] == 'g') outline.push_back(line);
  }
  EXPECT_EQ(outline,
            (std::vector<std::string>{"o shell_0", "g wall", "g wall hypothetical", "g roof",
                                      "g ground", "o shell_1", "g wall", "g ceiling"}));
}

TEST(ModelIo, ReadsForeignMeshes) {
  const TemporaryDirectory directory;
  // A float mesh with the other name of the index list, normals, and edges that are passed over.
  const PolygonSoup ply = readPolygons(directory.write(
      "a",
      "ply\nformat ascii 1.0\nelement face 1\nproperty uchar flags\nproperty list uchar uint "
      "vertex_index\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float nx\nelement edge 1\nproperty int vertex1\nproperty int "
      "vertex2\nend_header\n9 3 2 0 1\n0 0 .5 1\n1 0 .5 1\n0 1 .5 1\n0 1\n"));
  ASSERT_EQ(ply.polygons.size(), 1u);
  EXPECT_EQ(ply.polygons[0].corners, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(ply.polygons[0].wall, -1);
  EXPECT_EQ(ply.vertices[2], Eigen::Vector3d(0, 1, 0.5));
  const PolygonSoup obj = readPolygons(directory.write(
      "b",
      "# made elsewhere\r\nmtllib x.mtl\r\no House\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nv "
      "0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\nusemtl red\r\ns 1\r\nf 1/1/1 2/1 3//1\r\nf -1 -2 -3\r\n"));
  ASSERT_EQ(obj.polygons.size(), 2u);
  EXPECT_EQ(obj.polygons[0].corners, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(obj.polygons[1].corners, (std::vector<int>{2, 1, 0}));
}

/// A block of 6 x 5 x 2 with a shaft of 2 x 1 through it: its caps have a hole.
PolyhedralModel blockWithShaft() {
  PolyhedralModel model;
  model.grid = 1.0;
  model.num_shells = 1;
  for (const double z : {0.0, 2.0}) {
    for (const auto& [x, y] : std::vector<std::pair<double, double>>{
             {0, 0}, {6, 0}, {6, 5}, {0, 5}, {2, 2}, {4, 2}, {4, 3}, {2, 3}}) {
      model.vertices.emplace_back(x, y, z);
    }
  }
  PolyhedralFace roof;
  roof.label = FaceLabel::Roof;
  roof.outer = {8, 9, 10, 11};
  roof.inner = {{12, 15, 14, 13}};
  PolyhedralFace ground;
  ground.label = FaceLabel::Ground;
  ground.outer = {3, 2, 1, 0};
  ground.inner = {{5, 6, 7, 4}};
  model.faces = {roof, ground};
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    PolyhedralFace wall;
    wall.wall = i;
    wall.outer = {i, next, next + 8, i + 8};
    model.faces.push_back(wall);
    wall.wall = i + 4;
    wall.hypothetical = true;
    wall.outer = {next + 4, i + 4, i + 12, next + 12};
    model.faces.push_back(wall);
  }
  return model;
}

/// Six times the volume that polygons enclose: the tetrahedra of their fans with the origin.
double sixfoldVolume(const PolygonSoup& soup) {
  double sum = 0.0;
  for (const auto& p : soup.polygons) {
    const auto vertex = [&](std::size_t k) {
      return soup.vertices[static_cast<std::size_t>(p.corners[k])];
    };
    for (std::size_t k = 2; k < p.corners.size(); ++k) {
      sum += vertex(0).dot(vertex(k - 1).cross(vertex(k)));
    }
  }
  return sum;
}

TEST(ModelIo, ModelsWithHolesBecomeClosedFilesWithoutHoles) {
  const TemporaryDirectory directory;
  const PolyhedralModel model = blockWithShaft();
  for (const std::string name : {"m.ply", "m.obj"}) {
    const std::string path = directory.file(name);
    if (name == "m.ply") {
      io::writePolygonsPly(path, io::toPolygons(model), translation(1000, 2000, 0));
    } else {
      io::writePolygonsObj(path, io::toPolygons(model), translation(1000, 2000, 0));
    }
    const PolygonSoup soup = readPolygons(path);
    EXPECT_EQ(soup.vertices.size(), 16u);
    std::map<std::pair<int, int>, int> uses;
    int num_hypothetical = 0;
    for (const auto& p : soup.polygons) {
      num_hypothetical += p.hypothetical;
      for (std::size_t k = 0; k < p.corners.size(); ++k) {
        ++uses[{p.corners[k], p.corners[(k + 1) % p.corners.size()]}];
      }
    }
    for (const auto& [edge, count] : uses) {
      EXPECT_EQ(count, 1) << edge.first << " " << edge.second;
      EXPECT_EQ(uses.count({edge.second, edge.first}), 1u) << edge.first << " " << edge.second;
    }
    EXPECT_DOUBLE_EQ(sixfoldVolume(soup), 6.0 * (6 * 5 - 2 * 1) * 2);
    EXPECT_EQ(num_hypothetical, 4);
  }
}

TEST(ModelPly, HoldsWhatThePointsSay) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("m.ply");
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  io::PolygonSoup soup;
  soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  soup.deviations = {0.5, 0.25, kUnknown, 0.125};
  soup.polygons = {{{0, 2, 1}, 2, -1, 0, true, 0, 0.0, 0.0, kUnknown},
                   {{0, 1, 3}, 0, 5, 0, false, 1234, 0.75, 0.5, 0.0625}};
  for (const auto encoding : {io::PlyEncoding::Ascii, io::PlyEncoding::Binary}) {
    io::writePolygonsPly(path, soup, translation(0, 0, 0), encoding);
    const io::PolygonSoup read = io::readPolygons(path);
    EXPECT_EQ(read.deviations, soup.deviations);
    ASSERT_EQ(read.polygons.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(read.polygons[i].hypothetical, soup.polygons[i].hypothetical);
      EXPECT_EQ(read.polygons[i].support, soup.polygons[i].support);
      EXPECT_EQ(read.polygons[i].coverage, soup.polygons[i].coverage);
      EXPECT_EQ(read.polygons[i].residual, soup.polygons[i].residual);
      EXPECT_EQ(read.polygons[i].deviation, soup.polygons[i].deviation);
    }
  }
}

FloorplanRing ring(const std::vector<Eigen::Vector2d>& vertices, int first_wall) {
  FloorplanRing result;
  result.vertices = vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    FloorplanEdge edge;
    edge.wall = first_wall + static_cast<int>(i);
    edge.hypothetical = i == 1;
    result.edges.push_back(edge);
  }
  return result;
}

PolyhedralModel courtyardStoreys() {
  FloorplanLayer layer;
  layer.z_min = 0.5;
  layer.z_max = 3.0;
  FloorplanComponent court;
  court.outer = ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0);
  court.holes = {ring({{1, 1}, {1, 2}, {2, 2}, {2, 1}}, 4)};
  FloorplanComponent shed;
  shed.outer = ring({{6, 0}, {7, 0}, {6, 2}}, 10);
  layer.plan.components = {court, shed};
  FloorplanLayer upper = layer;
  upper.z_min = 3.0;
  upper.z_max = 5.0;
  upper.plan.components.pop_back();
  PolyhedralModel model;
  model.storeys = {layer, upper};
  return model;
}

TEST(FloorplanGeoJson, HoldsRingsHeightsAndWalls) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("f.geojson");
  io::writeFloorplansGeoJson(path, courtyardStoreys(), translation(447000.25, 5411000.5, 100.0));
  const auto json = nlohmann::json::parse(readAll(path));
  EXPECT_EQ(json["type"], "FeatureCollection");
  ASSERT_EQ(json["features"].size(), 2u);
  const auto& feature = json["features"][0];
  EXPECT_EQ(feature["type"], "Feature");
  EXPECT_EQ(feature["geometry"]["type"], "MultiPolygon");
  const auto& polygons = feature["geometry"]["coordinates"];
  ASSERT_EQ(polygons.size(), 2u);
  ASSERT_EQ(polygons[0].size(), 2u);
  ASSERT_EQ(polygons[0][0].size(), 5u);  // the first corner is repeated
  EXPECT_EQ(polygons[0][0][0], polygons[0][0][4]);
  EXPECT_EQ(polygons[0][0][2], nlohmann::json({447004.25, 5411004.5}));
  EXPECT_EQ(polygons[0][1][1], nlohmann::json({447001.25, 5411002.5}));
  const auto& properties = feature["properties"];
  EXPECT_EQ(properties["z_min"], 100.5);
  EXPECT_EQ(properties["z_max"], 103.0);
  EXPECT_EQ(properties["area"], 16.0 - 1.0 + 1.0);
  EXPECT_DOUBLE_EQ(properties["perimeter"], 16.0 + 4.0 + 3.0 + std::sqrt(5.0));
  EXPECT_EQ(properties["walls"].dump(), "[[[0,1,2,3],[4,5,6,7]],[[10,11,12]]]");
  EXPECT_EQ(properties["hypothetical"][1].dump(), "[[false,true,false]]");
  EXPECT_EQ(properties["coverage"][1].dump(), "[[null,null,null]]");  // the model has no faces
  EXPECT_EQ(json["features"][1]["properties"]["area"], 15.0);
}

TEST(FloorplanGeoJson, HoldsWhatIsKnownOfTheFaceAtEachEdge) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("f.geojson");
  PolyhedralModel model = extrudeFloorplans(courtyardStoreys().storeys);
  for (PolyhedralFace& face : model.faces) {
    if (face.label != FaceLabel::Wall) continue;
    face.coverage = face.wall / 16.0;
    face.hypothetical = face.wall == 6;
    if (face.wall != 7) face.deviation = 0.25 * face.wall;
  }
  io::writeFloorplansGeoJson(path, model, translation(0, 0, 0));
  const auto json = nlohmann::json::parse(readAll(path));
  for (const auto& feature : json["features"]) {
    const auto& properties = feature["properties"];
    for (std::size_t p = 0; p < properties["walls"].size(); ++p) {
      for (std::size_t r = 0; r < properties["walls"][p].size(); ++r) {
        for (std::size_t e = 0; e < properties["walls"][p][r].size(); ++e) {
          const int wall = properties["walls"][p][r][e];
          EXPECT_EQ(properties["coverage"][p][r][e], wall / 16.0);
          EXPECT_EQ(properties["hypothetical"][p][r][e], e == 1 || wall == 6);
          if (wall == 7) {
            EXPECT_TRUE(properties["deviation"][p][r][e].is_null());
          } else {
            EXPECT_EQ(properties["deviation"][p][r][e], 0.25 * wall);
          }
        }
      }
    }
  }
}

// The written coordinates with the written matrix give the input's coordinates, tilted or not.
TEST(FloorplanGeoJson, MatrixTakesCoordinatesToTheInput) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("f.geojson");
  for (const Eigen::Isometry3d& transform : {translation(447000.25, 5411000.5, 100.0), ecef()}) {
    io::writeFloorplansGeoJson(path, courtyardStoreys(), transform);
    const auto json = nlohmann::json::parse(readAll(path));
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        matrix(row, column) =
            json["frame_to_input"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      }
    }
    const auto& feature = json["features"][0];
    const auto& corner = feature["geometry"]["coordinates"][0][0][2];
    const Eigen::Vector4d written(corner[0], corner[1], feature["properties"]["z_min"], 1.0);
    const Eigen::Vector3d expected = transform * Eigen::Vector3d(4.0, 4.0, 0.5);
    EXPECT_LT(((matrix * written).head<3>() - expected).norm(), 1e-8);
  }
}

TEST(FloorplanGeoJson, NoLayersAreAnEmptyCollection) {
  const TemporaryDirectory directory;
  io::writeFloorplansGeoJson(directory.file("f"), {}, translation(0, 0, 0));
  EXPECT_EQ(nlohmann::json::parse(readAll(directory.file("f")))["features"].size(), 0u);
}

TEST(ModelIo, AFullDiskIsNoticedByEveryWriter) {
  if (access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  const Eigen::Isometry3d none = translation(0, 0, 0);
  const auto expectIoError = [](const std::function<void()>& write) {
    try {
      write();
      ADD_FAILURE() << "not noticed";
    } catch (const io::Failure& failure) {
      EXPECT_EQ(failure.status(), io::IoError);
    }
  };
  expectIoError([&] { io::writePolygonsPly("/dev/full", boxSoup(), none); });
  expectIoError([&] { io::writePolygonsObj("/dev/full", boxSoup(), none); });
  expectIoError([&] { io::writeFloorplansGeoJson("/dev/full", courtyardStoreys(), none); });
}

}  // namespace
}  // namespace storey
