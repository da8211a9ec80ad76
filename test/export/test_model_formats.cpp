// SPDX-License-Identifier: BSD-3-Clause
// Models written as glTF, STL, VTK and OBJ, read back by VTK: closed on the coordinates of the
// file, of the model's volume, with its faces.
#include <gtest/gtest.h>
#include <storey/surface/model_check.h>
#include <storey/surface/triangulation.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/temporary_files.h"
#include "export/exported_models.h"
#include "export/glb.h"
#include "export/gltf.h"
#include "export/obj.h"
#include "export/stl.h"
#include "export/triangle_soup.h"
#include "export/vtk.h"
#include "io/label_names.h"
#include "io/model_io.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

/// Fans of the polygons: diagonals cancel out, and volumes of planar polygons add up.
void append(vtkPolyData* data, TriangleSoup& soup) {
  vtkNew<vtkIdList> ids;
  data->GetPolys()->InitTraversal();
  while (data->GetPolys()->GetNextCell(ids) != 0) {
    const auto at = [&](vtkIdType i) { return Eigen::Vector3d(data->GetPoint(ids->GetId(i))); };
    for (vtkIdType i = 1; i + 1 < ids->GetNumberOfIds(); ++i) {
      soup.push_back({at(0), at(i), at(i + 1)});
    }
  }
}

template <typename Reader>
TriangleSoup readPolyData(const std::string& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  TriangleSoup soup;
  append(reader->GetOutput(), soup);
  return soup;
}

std::size_t countTriangles(const PolyhedralModel& model) {
  std::size_t count = 0;
  for (const PolyhedralFace& face : model.faces) count += triangulateFace(model, face).size();
  return count;
}

double extentOf(const PolyhedralModel& model) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(v);
  return box.diagonal().norm();
}

constexpr double kFloat = std::numeric_limits<float>::epsilon();
constexpr double kDouble = std::numeric_limits<double>::epsilon();

/// Walls fit a strip of two grid units: how they are cut into triangles moves the surface by one.
/// \param rounding largest error of a coordinate
void expectModel(const TriangleSoup& soup, const PolyhedralModel& model, double rounding) {
  const ModelCheck check = checkModel(model);
  EXPECT_TRUE(isClosed(soup));
  EXPECT_NEAR(volumeOf(soup), check.volume, (model.grid + 2.0 * rounding) * check.area);
}

TEST(Gltf, VtkReadsAClosedSurfaceOfTheModelsVolume) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    if (!frame.isApprox(Eigen::Isometry3d::Identity())) return;  // VTK's points are floats
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeGltf(directory.file("a.glb"), {model, frame});
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(directory.file("a.glb").c_str());
    reader->Update();
    TriangleSoup soup;
    const auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(
        vtkCompositeDataSet::SafeDownCast(reader->GetOutput())->NewIterator());
    for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem()) {
      append(vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject()), soup);
    }
    EXPECT_EQ(soup.size(), countTriangles(model));
    // The reader adds the translation in floats: 20 units from the origin at scale 1.
    expectModel(soup, model, kFloat * 3.0 * extentOf(model));
  });
}

TEST(Gltf, FloatsAboutTheTranslationAreTheModelsVerticesAndNormals) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeGltf(directory.file("a.glb"), {model, frame});
    const Glb glb(readAll(directory.file("a.glb")));
    TriangleSoup soup;
    std::set<std::size_t> faces;
    EXPECT_EQ(glb.json["nodes"].size(), 1u + static_cast<std::size_t>(model.num_shells));
    for (const Json& mesh : glb.json["meshes"]) {
      for (const Json& primitive : mesh["primitives"]) {
        const std::vector<float> p = glb.values(primitive["attributes"]["POSITION"]);
        const std::vector<float> n = glb.values(primitive["attributes"]["NORMAL"]);
        const std::vector<float> f = glb.values(primitive["attributes"]["_FACE"]);
        ASSERT_EQ(p.size(), 3 * f.size());
        ASSERT_EQ(n.size(), p.size());
        for (std::size_t i = 0; i < f.size(); ++i) {
          const auto index = static_cast<std::size_t>(f[i]);
          faces.insert(index);
          const PolyhedralFace& face = model.faces.at(index);
          if (i % 3 == 0) soup.emplace_back();
          // y is up: (x, y, z) was written as (x, z, -y).
          soup.back()[i % 3] = Eigen::Vector3d(p[3 * i], -p[3 * i + 2], p[3 * i + 1]);
          const Eigen::Vector3d normal =
              frame.linear().transpose() * Eigen::Vector3d(n[3 * i], -n[3 * i + 2], n[3 * i + 1]);
          EXPECT_NEAR(normal.norm(), 1.0, 4 * kFloat);
          if (face.label == FaceLabel::Wall) {
            EXPECT_NEAR(normal.z(), 0.0, 4 * kFloat);
          } else {
            EXPECT_NEAR(normal.z(), face.label == FaceLabel::Roof ? 1.0 : -1.0, 4 * kFloat);
          }
          const std::string material =
              glb.json["materials"][primitive["material"].get<std::size_t>()]["name"];
          EXPECT_EQ(material, io::labelName(static_cast<std::uint8_t>(face.label)));
        }
      }
    }
    EXPECT_EQ(faces.size(), model.faces.size());
    EXPECT_EQ(soup.size(), countTriangles(model));
    expectModel(soup, model, kFloat * extentOf(model));
    // Back in the model's frame the corners are its vertices, to a fraction of its grid.
    const Eigen::Vector3d t = glb.translation();
    const Eigen::Vector3d origin(t.x(), -t.z(), t.y());
    const double rounding = kFloat * extentOf(model) + 4.0 * kDouble * origin.norm();
    for (const auto& triangle : soup) {
      for (const Eigen::Vector3d& corner : triangle) {
        const Eigen::Vector3d local =
            frame.linear().transpose() * (corner + (origin - frame.translation()));
        double nearest = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& v : model.vertices) {
          nearest = std::min(nearest, (v - local).norm());
        }
        EXPECT_LE(nearest, rounding);
      }
    }
  });
}

TEST(Gltf, GuessedFacesHaveAMaterialOfTheirOwn) {
  PolyhedralModel model = modelOf(stackedModels()[0].layers);
  for (PolyhedralFace& face : model.faces) face.hypothetical = face.label == FaceLabel::Roof;
  const TemporaryDirectory directory;
  exports::writeGltf(directory.file("a.glb"), {model});
  const Glb glb(readAll(directory.file("a.glb")));
  std::set<std::string> used;
  for (const Json& primitive : glb.json["meshes"][0]["primitives"]) {
    used.insert(glb.json["materials"][primitive["material"].get<std::size_t>()]["name"]);
  }
  EXPECT_EQ(used, (std::set<std::string>{"wall", "roof_hypothetical", "ground"}));
}

TEST(Stl, VtkReadsAClosedSurfaceAboutTheOriginInTheHeader) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeStl(directory.file("a.stl"), {model, frame});
    const TriangleSoup soup = readPolyData<vtkSTLReader>(directory.file("a.stl"));
    EXPECT_EQ(soup.size(), countTriangles(model));
    expectModel(soup, model, kFloat * extentOf(model));
    const std::string header = readAll(directory.file("a.stl")).substr(0, 80);
    Eigen::Vector3d origin;
    ASSERT_EQ(std::sscanf(header.c_str(), "storey %lf %lf %lf", &origin[0], &origin[1], &origin[2]),
              3);
    Eigen::AlignedBox3d expected;
    for (const Eigen::Vector3d& v : model.vertices) {
      expected.extend(frame.linear() * v + (frame.translation() - origin));
    }
    Eigen::AlignedBox3d found;
    for (const auto& triangle : soup) {
      for (const Eigen::Vector3d& corner : triangle) found.extend(corner);
    }
    const double rounding = kFloat * extentOf(model) + 4.0 * kDouble * origin.norm();
    EXPECT_LE((found.min() - expected.min()).norm(), rounding);
    EXPECT_LE((found.max() - expected.max()).norm(), rounding);
  });
}

TEST(Vtk, ReadsBackInDoublesWithTheFaceOfEachTriangle) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeVtk(directory.file("a.vtk"), {model, frame});
    const TriangleSoup soup = readPolyData<vtkPolyDataReader>(directory.file("a.vtk"));
    EXPECT_EQ(soup.size(), countTriangles(model));
    const double far = frame.translation().norm() + extentOf(model);
    expectModel(soup, model, 4.0 * kDouble * far);
    vtkNew<vtkPolyDataReader> reader;
    reader->SetFileName(directory.file("a.vtk").c_str());
    reader->ReadAllScalarsOn();
    reader->Update();
    vtkPolyData* data = reader->GetOutput();
    ASSERT_EQ(static_cast<std::size_t>(data->GetNumberOfPoints()), model.vertices.size());
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
      EXPECT_EQ(Eigen::Vector3d(data->GetPoint(static_cast<vtkIdType>(i))),
                Eigen::Vector3d(frame * model.vertices[i]));
    }
    const auto value = [&](const char* array, std::size_t cell) {
      return data->GetCellData()->GetArray(array)->GetTuple1(static_cast<vtkIdType>(cell));
    };
    std::set<std::size_t> faces;
    for (std::size_t cell = 0; cell < soup.size(); ++cell) {
      const auto index = static_cast<std::size_t>(value("face", cell));
      faces.insert(index);
      EXPECT_EQ(value("label", cell), static_cast<int>(model.faces.at(index).label));
      EXPECT_EQ(value("wall", cell), model.faces[index].wall);
      EXPECT_EQ(value("shell", cell), model.faces[index].shell);
      EXPECT_EQ(value("deviation", cell), -1.0);  // not fitted to points
    }
    EXPECT_EQ(faces.size(), model.faces.size());
  });
}

TEST(Obj, VtkReadsAClosedSurfaceAndEveryMaterialIsInTheLibrary) {
  forEachExported([](const std::string& name, const PolyhedralModel& model,
                     const Eigen::Isometry3d& frame, std::size_t) {
    SCOPED_TRACE(name);
    const TemporaryDirectory directory;
    exports::writeObj(directory.file("a.obj"), {model, frame});
    const io::PolygonSoup polygons = io::readPolygons(directory.file("a.obj"));
    TriangleSoup soup;
    for (const io::PolygonSoup::Polygon& polygon : polygons.polygons) {
      const auto at = [&](std::size_t i) {
        return polygons.vertices[static_cast<std::size_t>(polygon.corners[i])];
      };
      for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i) {
        soup.push_back({at(0), at(i), at(i + 1)});
      }
    }
    expectModel(soup, model, 4.0 * kDouble * (frame.translation().norm() + extentOf(model)));
    if (frame.isApprox(Eigen::Isometry3d::Identity())) {  // VTK's points are floats
      expectModel(readPolyData<vtkOBJReader>(directory.file("a.obj")), model,
                  kFloat * 3.0 * extentOf(model));
    }
    std::set<std::string> materials;
    std::set<std::string> used;
    std::istringstream library(readAll(directory.file("a.mtl")));
    for (std::string word, value; library >> word;) {
      if (word == "newmtl" && library >> value) materials.insert(value);
    }
    std::vector<std::string> libraries;
    std::istringstream text(readAll(directory.file("a.obj")));
    for (std::string word, value; text >> word;) {
      if (word == "mtllib" && text >> value) libraries.push_back(value);
      if (word == "usemtl" && text >> value) used.insert(value);
    }
    EXPECT_EQ(libraries, std::vector<std::string>{"a.mtl"});
    EXPECT_GE(used.size(), 3u);
    for (const std::string& material : used) EXPECT_EQ(materials.count(material), 1u) << material;
  });
}

}  // namespace
}  // namespace storey::test
