// SPDX-License-Identifier: BSD-3-Clause
// model.city.json read back: the rules of the specification that a schema tells, and valid solids
// on the integers of the file.
#include <gtest/gtest.h>
#include <storey/surface/model_check.h>

#include <nlohmann/json.hpp>

#include "apps/temporary_files.h"
#include "export/city_json.h"
#include "export/exported_models.h"
#include "export/iso_solid.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

Json writeAndRead(const exports::Exported& exported) {
  const TemporaryDirectory directory;
  exports::writeCityJson(directory.file("a"), exported);
  return Json::parse(readAll(directory.file("a")));
}

IntegerSolid solidOf(const Json& city, const Json& geometry) {
  IntegerSolid solid;
  solid.vertices = city["vertices"].get<std::vector<detail::LatticePoint>>();
  solid.shells = geometry["boundaries"].get<std::vector<IntegerSolid::Shell>>();
  return solid;
}

/// The geometries of one level of detail of all objects.
std::vector<Json> geometriesOf(const Json& city, const std::string& lod) {
  std::vector<Json> found;
  for (const auto& [id, object] : city["CityObjects"].items()) {
    for (const Json& geometry : object.value("geometry", Json::array())) {
      if (geometry["lod"] == lod) found.push_back(geometry);
    }
  }
  return found;
}

/// Of the rules of CityJSON 2.0, those that a schema cannot tell, and those of it that matter here.
void expectConforms(const Json& city) {
  EXPECT_EQ(city["type"], "CityJSON");
  EXPECT_EQ(city["version"], "2.0");
  for (const auto& [key, value] : city.items()) {
    EXPECT_TRUE((std::set<std::string>{"type", "version", "transform", "metadata", "CityObjects",
                                       "vertices"})
                    .count(key))
        << key;
  }
  EXPECT_EQ(city["transform"].size(), 2u);
  EXPECT_EQ(city["transform"]["scale"].size(), 3u);
  EXPECT_EQ(city["transform"]["translate"].size(), 3u);
  std::set<Json> vertices;
  for (const Json& vertex : city["vertices"]) {
    ASSERT_EQ(vertex.size(), 3u);
    for (const Json& number : vertex) EXPECT_TRUE(number.is_number_integer());
    EXPECT_TRUE(vertices.insert(vertex).second) << "twice: " << vertex;
  }
  std::set<std::size_t> used;
  const Json& objects = city["CityObjects"];
  for (const auto& [id, object] : objects.items()) {
    EXPECT_EQ(object["type"], object.contains("parents") ? "BuildingPart" : "Building") << id;
    for (const Json& parent : object.value("parents", Json::array())) {
      const Json& children = objects.at(parent.get<std::string>()).at("children");
      EXPECT_EQ(std::count(children.begin(), children.end(), Json(id)), 1) << id;
    }
    for (const Json& child : object.value("children", Json::array())) {
      EXPECT_EQ(objects.at(child.get<std::string>()).at("parents"), Json::array({id}));
    }
    for (const Json& geometry : object.value("geometry", Json::array())) {
      EXPECT_EQ(geometry["type"], "Solid");
      const Json& semantics = geometry["semantics"];
      ASSERT_EQ(semantics["values"].size(), geometry["boundaries"].size());
      for (std::size_t s = 0; s < geometry["boundaries"].size(); ++s) {
        ASSERT_EQ(semantics["values"][s].size(), geometry["boundaries"][s].size());
        for (const Json& value : semantics["values"][s]) {
          EXPECT_LT(value.get<std::size_t>(), semantics["surfaces"].size());
        }
        for (const Json& polygon : geometry["boundaries"][s]) {
          for (const Json& ring : polygon) used.insert(ring.begin(), ring.end());
        }
      }
    }
  }
  EXPECT_EQ(used.size(), city["vertices"].size());
  EXPECT_EQ(*used.rbegin(), city["vertices"].size() - 1);
}

TEST(CityJson, SolidsAreValidOnTheIntegersOfTheFile) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t solids) {
    SCOPED_TRACE(name);
    const Json city = writeAndRead({model, frame});
    expectConforms(city);
    const double scale = city["transform"]["scale"][0].get<double>();
    const double planarity = 2.0 * model.grid / scale;  // a model's walls fit a strip of two units
    const ModelCheck check = checkModel(model);
    ASSERT_TRUE(check.ok());
    for (const char* lod : {"1.2", "2.2"}) {
      double volume = 0.0;
      const std::vector<Json> geometries = geometriesOf(city, lod);
      EXPECT_EQ(geometries.size(), solids) << lod;
      for (const Json& geometry : geometries) {
        const IntegerSolid solid = solidOf(city, geometry);
        EXPECT_EQ(checkSolid(solid, planarity), std::set<IsoError>{}) << lod;
        volume += scale * scale * scale * volumeOf(solid);
      }
      // Rounding moves the surface by less than a scale, and how a wall is cut into triangles by a
      // grid unit; a block holds what it stands for.
      const double most = (scale + model.grid) * check.area;
      if (lod[0] == '2') {
        EXPECT_NEAR(volume, check.volume, most);
      } else {
        EXPECT_GE(volume, check.volume - most);
      }
    }
  });
}

TEST(CityJson, FacesAreTheModelsOwn) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    SCOPED_TRACE(name);
    const Json city = writeAndRead({model, frame});
    std::map<std::string, std::size_t> types;
    std::size_t holes = 0;
    std::set<Json> used;
    for (const Json& geometry : geometriesOf(city, "2.2")) {
      for (const Json& surface : geometry["semantics"]["surfaces"]) ++types[surface["type"]];
      for (const Json& shell : geometry["boundaries"]) {
        for (const Json& polygon : shell) {
          holes += polygon.size() - 1;
          for (const Json& ring : polygon) {
            for (const Json& i : ring) used.insert(city["vertices"][i.get<std::size_t>()]);
          }
        }
      }
    }
    std::map<std::string, std::size_t> expected;
    std::size_t expected_holes = 0;
    for (const PolyhedralFace& face : model.faces) {
      ++expected[face.label == FaceLabel::Wall     ? "WallSurface"
                 : face.label == FaceLabel::Roof   ? "RoofSurface"
                 : face.label == FaceLabel::Ground ? "GroundSurface"
                                                   : "OuterCeilingSurface"];
      expected_holes += face.inner.size();
    }
    EXPECT_EQ(types, expected);
    EXPECT_EQ(holes, expected_holes);
    // Each vertex of the model is one of the file, to what doubles resolve so far out.
    const auto triple = [&](const char* key) {
      const Json& t = city["transform"][key];
      return Eigen::Vector3d(t[0].get<double>(), t[1].get<double>(), t[2].get<double>());
    };
    const Eigen::Vector3d scale = triple("scale");
    const Eigen::Vector3d translate = triple("translate");
    for (const Eigen::Vector3d& vertex : model.vertices) {
      const Eigen::Vector3d position = frame * vertex - translate;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Json& v : used) {
        const Eigen::Vector3d p(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
        nearest = std::min(nearest, (p.cwiseProduct(scale) - position).cwiseAbs().maxCoeff());
      }
      EXPECT_LE(nearest, 0.51 * scale.x() + 4e-16 * translate.norm());
    }
  });
}

TEST(CityJson, WhereNothingIsTurnedTheIntegersAreTheModelsLattice) {
  const PolyhedralModel model = modelOf(stackedModels()[3].layers);
  exports::Exported exported{model};
  exported.local_to_input.translation() = Eigen::Vector3d(1e7, -3e7, 0.0);
  const Json city = writeAndRead(exported);
  EXPECT_EQ(city["transform"]["scale"][0].get<double>(), model.grid);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(v);
  std::set<detail::LatticePoint> expected;
  for (const Eigen::Vector3d& v : model.vertices) {
    const Eigen::Vector3d units = (v - box.min()) / model.grid;
    expected.insert({std::llround(units.x()), std::llround(units.y()), std::llround(units.z())});
  }
  std::set<detail::LatticePoint> found;
  const IntegerSolid solid = solidOf(city, geometriesOf(city, "2.2")[0]);
  for (const IntegerSolid::Polygon& polygon : solid.shells[0]) {
    for (const std::vector<int>& ring : polygon) {
      for (const int i : ring) found.insert(solid.vertices[static_cast<std::size_t>(i)]);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(CityJson, SupportGoesWithTheSurfacesOfFittedModels) {
  PolyhedralModel model = modelOf(stackedModels()[0].layers);
  EXPECT_FALSE(geometriesOf(writeAndRead({model}), "2.2")[0]["semantics"]["surfaces"][0].contains(
      "support"));
  model.covariances.assign(model.vertices.size(), Eigen::Matrix3d::Identity());
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    model.faces[f].support = 100 + f;
    model.faces[f].residual = 0.25;
    model.faces[f].coverage = 0.5;
    model.faces[f].hypothetical = f == 1;
    if (f == 2) model.faces[f].deviation = 0.125;
  }
  const Json geometry = geometriesOf(writeAndRead({model}), "2.2")[0];
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const Json& surface =
        geometry["semantics"]["surfaces"][geometry["semantics"]["values"][0][f].get<std::size_t>()];
    EXPECT_EQ(surface["support"], 100 + f);
    EXPECT_EQ(surface["residual"], 0.25);
    EXPECT_EQ(surface["coverage"], 0.5);
    EXPECT_EQ(surface["hypothetical"], f == 1);
    EXPECT_EQ(surface["deviation"], f == 2 ? Json(0.125) : Json(nullptr));
    EXPECT_EQ(surface.value("wall", -1), model.faces[f].wall);
  }
}

TEST(CityJson, StoreysAndTheReferenceSystemAreTold) {
  const PolyhedralModel model = modelOf(stackedModels()[3].layers);
  exports::Exported exported{model};
  EXPECT_FALSE(writeAndRead(exported)["metadata"].contains("referenceSystem"));
  exported.crs = "EPSG:7415";
  exported.local_to_input.translation().z() = 100.0;
  const Json city = writeAndRead(exported);
  EXPECT_EQ(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/7415");
  const Json& storeys = city["CityObjects"]["building"]["attributes"]["storeys"];
  ASSERT_EQ(storeys.size(), 2u);  // 9 x 7 up to 2, 3 x 3 up to 8
  EXPECT_NEAR(storeys[0]["area"].get<double>(), 63.0, 1e-9);
  EXPECT_NEAR(storeys[1]["area"].get<double>(), 9.0, 1e-9);
  EXPECT_EQ(storeys[1]["z_min"], 102.0);
  EXPECT_EQ(storeys[1]["z_max"], 108.0);
}

TEST(CityJson, ABlockIsThePlanOfItsPartUpToItsTop) {
  // A tower on a podium: 9 x 7 up to 8. Two boxes apart: 4 x 2 from 0 to 3, 1 x 1 from 5 to 6.
  const auto volumes = [](const PolyhedralModel& model) {
    const Json city = writeAndRead({model});
    std::multiset<double> found;
    for (const Json& geometry : geometriesOf(city, "1.2")) {
      found.insert(std::round(std::pow(model.grid, 3) * volumeOf(solidOf(city, geometry))));
    }
    return found;
  };
  EXPECT_EQ(volumes(modelOf(stackedModels()[3].layers)), (std::multiset<double>{504.0}));
  EXPECT_EQ(volumes(modelOf(stackedModels()[6].layers)), (std::multiset<double>{1.0, 24.0}));
}

}  // namespace
}  // namespace storey::test
