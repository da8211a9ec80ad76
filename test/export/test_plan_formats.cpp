// SPDX-License-Identifier: BSD-3-Clause
// Floorplans written as SVG and DXF, read back by a small parser: the rings, lengths and areas of
// the model's storeys.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "apps/temporary_files.h"
#include "export/dxf.h"
#include "export/exported_models.h"
#include "export/svg.h"
#include "io/model_io.h"

namespace storey::test {
namespace {

using Ring = std::vector<Eigen::Vector2d>;

double signedAreaOf(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i] - ring[0];
    const Eigen::Vector2d b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// The rings of a storey where they are to be found.
std::vector<Ring> ringsOf(const FloorplanLayer& storey, const Eigen::Isometry3d& frame) {
  std::vector<Ring> rings;
  const auto add = [&](const FloorplanRing& ring) {
    rings.emplace_back();
    for (const Eigen::Vector2d& v : ring.vertices) {
      rings.back().push_back((frame * Eigen::Vector3d(v.x(), v.y(), 0.0)).head<2>());
    }
  };
  for (const FloorplanComponent& component : storey.plan.components) {
    add(component.outer);
    for (const FloorplanRing& hole : component.holes) add(hole);
  }
  return rings;
}

struct Polyline {
  std::string layer;
  Ring ring;
  double elevation = 0.0;
  double thickness = 0.0;
  bool closed = false;
  bool ended = false;
};

struct Dxf {
  std::string version;
  std::vector<std::string> layers;
  std::vector<Polyline> polylines;
  std::string last;  // value of the last group
};

/// Group codes and values in turn, as the reference of the format has them.
Dxf parseDxf(const std::string& text) {
  Dxf dxf;
  std::istringstream lines(text);
  std::string code_line, value, entity, section, variable;
  while (std::getline(lines, code_line) && std::getline(lines, value)) {
    const int code = std::stoi(code_line);
    dxf.last = value;
    if (code == 0) {
      entity = value;
      if (value == "POLYLINE") dxf.polylines.emplace_back();
      if (value == "VERTEX") dxf.polylines.back().ring.emplace_back(0.0, 0.0);
      if (value == "SEQEND") dxf.polylines.back().ended = true;
    } else if (code == 9) {
      variable = value;
    } else if (code == 1 && variable == "$ACADVER") {
      dxf.version = value;
    } else if (code == 2 && entity == "LAYER") {
      dxf.layers.push_back(value);
    } else if (entity == "POLYLINE") {
      Polyline& polyline = dxf.polylines.back();
      if (code == 8) polyline.layer = value;
      if (code == 30) polyline.elevation = std::stod(value);
      if (code == 39) polyline.thickness = std::stod(value);
      if (code == 70) polyline.closed = (std::stoi(value) & 1) != 0;
    } else if (entity == "VERTEX") {
      Polyline& polyline = dxf.polylines.back();
      EXPECT_TRUE(code != 8 || value == polyline.layer);
      if (code == 10) polyline.ring.back().x() = std::stod(value);
      if (code == 20) polyline.ring.back().y() = std::stod(value);
      EXPECT_TRUE(code != 30 || std::stod(value) == polyline.elevation);
    }
  }
  return dxf;
}

TEST(Dxf, ReadsBackExactlyALayerForEachStorey) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& local_to_input, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeDxf(directory.file("a.dxf"), {model, local_to_input});
    const Dxf dxf = parseDxf(readAll(directory.file("a.dxf")));
    EXPECT_EQ(dxf.version, "AC1009");
    EXPECT_EQ(dxf.last, "EOF");
    const Eigen::Isometry3d frame = io::planFrame(local_to_input);
    std::vector<std::string> layers;
    std::vector<Polyline>::const_iterator next = dxf.polylines.begin();
    for (std::size_t k = 0; k < model.storeys.size(); ++k) {
      const FloorplanLayer& storey = model.storeys[k];
      layers.push_back("STOREY_" + std::to_string(k));
      for (const Ring& ring : ringsOf(storey, frame)) {
        ASSERT_NE(next, dxf.polylines.end());
        EXPECT_EQ(next->layer, layers.back());
        EXPECT_EQ(next->ring, ring);
        EXPECT_EQ(next->elevation, storey.z_min + frame.translation().z());
        EXPECT_EQ(next->thickness, storey.z_max - storey.z_min);
        EXPECT_TRUE(next->closed && next->ended);
        ++next;
      }
    }
    EXPECT_EQ(next, dxf.polylines.end());
    EXPECT_EQ(dxf.layers, layers);
  });
}

struct SvgWall {
  int wall;
  double length;
  Eigen::Vector2d from, to;
  bool hypothetical;
};

struct SvgStorey {
  double z_min, z_max, area, perimeter, scale;
  std::vector<std::vector<Ring>> components;
  std::vector<SvgWall> walls;
  std::vector<double> written;  // lengths
};

double number(const std::string& text, const std::string& attribute) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex("[ <]" + attribute + "=\"([^\"]*)\"")))
      << attribute << " in " << text;
  return match.empty() ? NAN : std::stod(match[1]);
}

std::vector<Ring> parsePath(const std::string& line) {
  std::vector<Ring> rings;
  std::smatch match;
  EXPECT_TRUE(std::regex_search(line, match, std::regex(" d=\"([^\"]*)\"")));
  std::istringstream path(match[1]);
  for (char command = 0; path >> command;) {
    if (command == 'M') rings.emplace_back();
    if (command == 'Z') continue;
    Eigen::Vector2d p;
    path >> p.x() >> p.y();
    rings.back().push_back(p);
  }
  return rings;
}

/// Every tag that the writer makes is on a line of its own.
std::vector<SvgStorey> parseSvg(const std::string& text, Eigen::Vector2d& origin) {
  std::vector<SvgStorey> storeys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("<desc>", 0) == 0) {
      EXPECT_EQ(std::sscanf(line.c_str(), "<desc>relative to %lf %lf", &origin.x(), &origin.y()),
                2);
    } else if (line.rfind("<g id=\"storey_" + std::to_string(storeys.size()) + "\"", 0) == 0) {
      storeys.push_back({number(line, "data-z-min"),
                         number(line, "data-z-max"),
                         number(line, "data-area"),
                         number(line, "data-perimeter"),
                         0,
                         {},
                         {},
                         {}});
    } else if (line.rfind("<g transform=\"matrix(", 0) == 0) {
      storeys.back().scale = std::stod(line.substr(21));
    } else if (line.rfind("<path", 0) == 0) {
      EXPECT_NE(line.find("fill-rule=\"evenodd\""), std::string::npos);
      storeys.back().components.push_back(parsePath(line));
    } else if (line.rfind("<line class=\"wall", 0) == 0) {
      storeys.back().walls.push_back({static_cast<int>(number(line, "data-wall")),
                                      number(line, "data-length"),
                                      {number(line, "x1"), number(line, "y1")},
                                      {number(line, "x2"), number(line, "y2")},
                                      line.find("hypothetical") != std::string::npos});
    } else if (line.rfind("<text class=\"length\"", 0) == 0) {
      storeys.back().written.push_back(std::stod(line.substr(line.find('>') + 1)));
    }
  }
  return storeys;
}

TEST(Svg, PathsAndLinesAreTheStoreys) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& local_to_input, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeSvg(directory.file("a.svg"), {model, local_to_input});
    Eigen::Vector2d origin;
    const std::vector<SvgStorey> storeys = parseSvg(readAll(directory.file("a.svg")), origin);
    const Eigen::Isometry3d frame = io::planFrame(local_to_input);
    ASSERT_EQ(storeys.size(), model.storeys.size());
    for (std::size_t k = 0; k < storeys.size(); ++k) {
      const FloorplanLayer& expected = model.storeys[k];
      EXPECT_EQ(storeys[k].z_min, expected.z_min + frame.translation().z());
      EXPECT_EQ(storeys[k].z_max, expected.z_max + frame.translation().z());
      EXPECT_EQ(storeys[k].components.size(), expected.plan.components.size());
      // Coordinates were rounded once, when they got so far out.
      const double rounding = 1e-15 * (origin.norm() + 100.0);
      std::vector<Ring> rings;
      double area_of_all = 0.0;
      for (const std::vector<Ring>& component : storeys[k].components) {
        for (const Ring& ring : component) {
          rings.push_back(ring);
          area_of_all += signedAreaOf(ring);  // holes run the other way
        }
      }
      const double length = perimeter(expected.plan);
      EXPECT_NEAR(area_of_all, area(expected.plan), length * rounding);
      EXPECT_DOUBLE_EQ(storeys[k].area, area(expected.plan));
      EXPECT_DOUBLE_EQ(storeys[k].perimeter, length);
      const std::vector<Ring> expected_rings = ringsOf(expected, frame);
      ASSERT_EQ(rings.size(), expected_rings.size());
      std::size_t wall = 0;
      for (std::size_t r = 0; r < rings.size(); ++r) {
        ASSERT_EQ(rings[r].size(), expected_rings[r].size());
        for (std::size_t i = 0; i < rings[r].size(); ++i, ++wall) {
          EXPECT_LE((rings[r][i] + origin - expected_rings[r][i]).norm(), rounding);
          ASSERT_LT(wall, storeys[k].walls.size());
          const SvgWall& line = storeys[k].walls[wall];
          const Eigen::Vector2d to = rings[r][(i + 1) % rings[r].size()];
          EXPECT_EQ(line.from, rings[r][i]);
          EXPECT_EQ(line.to, to);
          EXPECT_DOUBLE_EQ(line.length, (to - rings[r][i]).norm());
        }
      }
      EXPECT_EQ(wall, storeys[k].walls.size());
    }
  });
}

TEST(Svg, LengthsAreWrittenToFourDigitsOfTheExtent) {
  // 9 x 7 in all, turned by 0.3: the extent is 9 cos 0.3 + 7 sin 0.3 = 10.7, so two decimals.
  const TemporaryDirectory directory;
  exports::writeSvg(directory.file("a.svg"), {modelOf(stackedModels()[3].layers)});
  Eigen::Vector2d origin;
  const std::vector<SvgStorey> storeys = parseSvg(readAll(directory.file("a.svg")), origin);
  EXPECT_EQ(storeys[0].written, (std::vector<double>{9.0, 7.0, 9.0, 7.0}));
  EXPECT_EQ(storeys[1].written, (std::vector<double>{3.0, 3.0, 3.0, 3.0}));
}

TEST(Svg, TheScaleBarIsAsLongAsItSays) {
  for (const double scale : {1e-3, 1.0, 1e5}) {
    const TemporaryDirectory directory;
    exports::writeSvg(directory.file("a.svg"), {modelOf(stackedModels()[3].layers, scale)});
    const std::string text = readAll(directory.file("a.svg"));
    Eigen::Vector2d origin;
    const double pixels = parseSvg(text, origin)[0].scale;
    const std::string bar = text.substr(text.find("<g id=\"scale_bar\""));
    const double length = number(bar, "data-length");
    EXPECT_NEAR(number(bar, "x2") - number(bar, "x1"), pixels * length, 1e-3);
    EXPECT_NEAR(length, 5.0 * scale, 1e-9 * scale);  // at most half of 10.7
  }
}

TEST(Svg, GuessedWallsAreDashed) {
  PolyhedralModel model = modelOf(stackedModels()[0].layers);
  model.storeys[0].plan.components[0].outer.edges[2].hypothetical = true;
  for (PolyhedralFace& face : model.faces) face.hypothetical = face.wall == 0;
  const TemporaryDirectory directory;
  exports::writeSvg(directory.file("a.svg"), {model});
  Eigen::Vector2d origin;
  const SvgStorey storey = parseSvg(readAll(directory.file("a.svg")), origin)[0];
  ASSERT_EQ(storey.walls.size(), 4u);
  for (const SvgWall& wall : storey.walls) {
    EXPECT_EQ(wall.hypothetical, wall.wall == 0 || wall.wall == 2) << wall.wall;
  }
}

}  // namespace
}  // namespace storey::test
