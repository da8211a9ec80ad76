// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/facade_texturing.h>
#include <storey/surface/triangulation.h>

#include <filesystem>

#include "io/failure.h"
#include "io/images/image_files.h"
#include "view/json_file.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

using Json = nlohmann::json;

/// A facade of facades.json, in the upright local frame.
struct TexturedFacade {
  FacadeTexture texture;
  std::string image;  ///< path
  double seen = 0.0;
  std::vector<std::size_t> polygons;
};

Eigen::Vector3d toVector(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// A file within the directory; no name leads out of it.
std::string imagePath(const Reconstruction& r, const std::string& name) {
  const std::filesystem::path path(name);
  for (const std::filesystem::path& part : path) {
    if (path.is_absolute() || part == "..") throw std::invalid_argument("it names " + name);
  }
  return r.file(name);
}

std::vector<TexturedFacade> readFacades(const Reconstruction& r, std::size_t num_polygons) {
  const Eigen::Isometry3d to_local = r.inputToLocal();
  std::vector<TexturedFacade> facades;
  readJson(r.file("facades.json"), [&](const Json& json) {
    for (const Json& read : json.at("facades")) {
      TexturedFacade facade;
      FacadeFrame& frame = facade.texture.frame;
      frame.origin = to_local * toVector(read.at("origin"));
      frame.right = to_local.linear() * toVector(read.at("right"));
      frame.up = to_local.linear() * toVector(read.at("up"));
      frame.width = read.at("width").get<double>();
      frame.height = read.at("height").get<double>();
      facade.texture.texel = read.at("texel").get<double>();
      if (!(facade.texture.texel > 0.0)) throw std::invalid_argument("a texel has no size");
      facade.image = imagePath(r, read.at("image").get<std::string>());
      facade.seen = read.at("seen").get<double>();
      for (const Json& polygon : read.at("polygons")) {
        facade.polygons.push_back(polygon.get<std::size_t>());
        if (facade.polygons.back() >= num_polygons) {
          throw std::invalid_argument("a facade has a polygon that is not there");
        }
      }
      facades.push_back(std::move(facade));
    }
  });
  return facades;
}

TexturedSet toSet(const PolyhedralModel& model, TexturedFacade& facade) {
  TexturedSet set;
  FacadeTexture& texture = facade.texture;
  texture.image = io::readImage(facade.image);
  for (const std::size_t polygon : facade.polygons) {
    for (std::array<int, 3> triangle : triangulateFace(model, model.faces[polygon])) {
      const auto at = [&](std::size_t i) {
        return model.vertices[static_cast<std::size_t>(triangle[i])];
      };
      const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
      if (normal.dot(texture.frame.normal()) < 0.0) std::swap(triangle[1], triangle[2]);
      const int first = static_cast<int>(set.vertices.size());
      for (std::size_t i = 0; i < 3; ++i) {
        set.vertices.push_back(at(i));
        set.coordinates.push_back(texture.coordinates(at(i)));
      }
      set.triangles.push_back({first, first + 1, first + 2});
    }
  }
  set.image = std::move(texture.image);
  return set;
}

}  // namespace

Drawing drawTextured(const Reconstruction& r) {
  const PolyhedralModel model = r.readModel("textured.obj");
  std::vector<TexturedFacade> facades = readFacades(r, model.faces.size());
  Drawing drawing;
  drawing.title = "Textured model";
  std::size_t seen = 0;
  for (TexturedFacade& facade : facades) {
    seen += facade.seen > 0.0 ? 1 : 0;
    drawing.textured.push_back(toSet(model, facade));
  }
  drawing.subtitle =
      counted(facades.size(), "facade") + ", photos show " + std::to_string(seen) + " of them";
  return drawing;
}

}  // namespace storey::view::detail
