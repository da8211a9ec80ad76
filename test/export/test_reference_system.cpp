// SPDX-License-Identifier: BSD-3-Clause
// The coordinate reference system of the input, found again in the files of every format.
#include <gtest/gtest.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkStringArray.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/temporary_files.h"
#include "export/exported_models.h"
#include "export/formats.h"
#include "io/model_io.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

/// A code; a name that formats have to escape; a definition longer than a line of some formats.
const std::vector<std::string>& systems() {
  static const std::vector<std::string> names = {
      "EPSG:25832", "site grid \"A & B\" <east>, 100 % \xc3\xa9",
      "PROJCS[\"" + std::string(700, 'x') + "\",UNIT[\"metre\",1]]"};
  return names;
}

/// The file of a model in this system.
std::string write(const std::string& format, const std::string& crs, const std::string& path) {
  const PolyhedralModel model = modelOf(stackedModels()[0].layers);
  exports::Exported exported{model};
  exported.crs = crs;
  exports::findFormat(format)->write(path, exported);
  return readAll(path);
}

template <typename Check>
void forEachSystem(const std::string& format, Check check) {
  for (const std::string& crs : systems()) {
    SCOPED_TRACE(format + " " + crs);
    const TemporaryDirectory directory;
    const std::string path = directory.file("a");
    check(crs, write(format, crs, path), path);
  }
}

TEST(ReferenceSystem, MeshesAreReadBackWithIt) {
  for (const char* const format : {"ply", "obj"}) {
    forEachSystem(format, [](const std::string& crs, const std::string&, const std::string& path) {
      EXPECT_EQ(io::readPolygons(path).crs, crs);
    });
  }
}

TEST(ReferenceSystem, AMeshWithoutOneHasNone) {
  const TemporaryDirectory directory;
  for (const char* const format : {"ply", "obj"}) {
    write(format, "", directory.file("a"));
    EXPECT_EQ(io::readPolygons(directory.file("a")).crs, "");
  }
}

TEST(ReferenceSystem, CommentsThatNameNoneAreNoError) {
  const TemporaryDirectory directory;
  const std::string obj = write("obj", "EPSG:25832", directory.file("a"));
  for (const std::string& crs : {std::string("EPSG:x"), std::string("25832"), std::string("a\tb"),
                                 std::string("a\xff"), std::string(20000, 'x')}) {
    std::string other = obj;
    other.replace(other.find("EPSG:25832"), 10, crs);
    std::ofstream(directory.file("b")) << other;
    EXPECT_EQ(io::readPolygons(directory.file("b")).crs, "") << crs.substr(0, 10);
  }
}

TEST(ReferenceSystem, GltfHasItAmongItsExtras) {
  forEachSystem("gltf", [](const std::string& crs, const std::string& glb, const std::string&) {
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, sizeof size);
    EXPECT_EQ(Json::parse(glb.substr(20, size))["asset"]["extras"]["crs"], crs);
  });
}

TEST(ReferenceSystem, GeoJsonAndCityJsonNameIt) {
  forEachSystem("geojson", [](const std::string& crs, const std::string& text, const std::string&) {
    EXPECT_EQ(Json::parse(text)["crs"]["properties"]["name"], crs);
  });
  forEachSystem("cityjson",
                [](const std::string& crs, const std::string& text, const std::string&) {
                  // The format's own member wants an address of OGC's; a name that has none is an
                  // attribute.
                  const Json city = Json::parse(text);
                  const Json& attributes = city["CityObjects"]["building"]["attributes"];
                  if (crs.rfind("EPSG:", 0) == 0) {
                    EXPECT_EQ(city["metadata"]["referenceSystem"],
                              "https://www.opengis.net/def/crs/EPSG/0/" + crs.substr(5));
                  } else {
                    EXPECT_EQ(attributes["crs"], crs);
                    EXPECT_FALSE(city["metadata"].contains("referenceSystem"));
                  }
                });
}

TEST(ReferenceSystem, VtkReadsItAsAField) {
  forEachSystem("vtk", [](const std::string& crs, const std::string&, const std::string& path) {
    vtkNew<vtkPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    auto* const field =
        vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray("crs"));
    ASSERT_NE(field, nullptr);
    EXPECT_EQ(field->GetValue(0), crs);
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 8);
  });
}

TEST(ReferenceSystem, StlNamesItWhereThereIsRoom) {
  forEachSystem("stl", [](const std::string& crs, const std::string& stl, const std::string&) {
    const std::string header = stl.substr(0, 80);
    EXPECT_EQ(header.find(" " + crs) != std::string::npos, crs.size() < 20) << header;
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof count);
    EXPECT_EQ(stl.size(), 84u + 50u * count);
  });
}

TEST(ReferenceSystem, DxfStartsWithItAsComments) {
  forEachSystem("dxf", [](const std::string& crs, const std::string& dxf, const std::string&) {
    std::istringstream lines(dxf);
    std::string text;
    std::string code;
    std::string value;
    while (std::getline(lines, code) && std::getline(lines, value) && code == "999") {
      EXPECT_LE(value.size(), 255u);
      text += value;
    }
    EXPECT_EQ(text, crs);
    EXPECT_EQ(value, "SECTION");
  });
}

TEST(ReferenceSystem, SvgTellsItInItsDescription) {
  forEachSystem("svg", [](const std::string& crs, const std::string& svg, const std::string&) {
    const std::size_t start = svg.find("<desc>") + 6;
    std::string text = svg.substr(start, svg.find("</desc>") - start);
    EXPECT_EQ(text.find('<'), std::string::npos);
    for (const auto& [entity, character] :
         {std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"}, std::pair{"&amp;", "&"}}) {
      for (std::size_t at; (at = text.find(entity)) != std::string::npos;) {
        text.replace(at, std::strlen(entity), character);
      }
    }
    EXPECT_NE(text.find(" in " + crs), std::string::npos) << text;
  });
}

}  // namespace
}  // namespace storey::test
