// SPDX-License-Identifier: BSD-3-Clause
#include "texture/textured_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "export/textured_page.h"
#include "io/images/image_files.h"
#include "io/label_names.h"
#include "io/output_file.h"
#include "texture/drawn_image.h"
#include "texture/textured_gltf.h"

namespace storey::texture {
namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(std::size_t facade, const char* end) {
  char name[64];
  std::snprintf(name, sizeof name, "textures/facade_%03zu%s", facade, end);
  return name;
}

std::string materialOf(std::size_t facade) { return "facade_" + std::to_string(facade); }

void writeVector(io::OutputFile& file, const char* keyword, const Eigen::VectorXd& v) {
  file.write(keyword);
  for (const double number : v) {
    file.write(" ");
    file.writeNumber(number);
  }
  file.write("\n");
}

void writeObj(const std::string& path, const io::PolygonSoup& soup, const ModelFacades& model,
              const std::vector<FacadeTexture>& textures) {
  io::OutputFile file(path);
  if (!soup.crs.empty()) file.write("# storey crs " + soup.crs + "\n");
  file.write("mtllib textured.mtl\n");
  for (const Eigen::Vector3d& vertex : soup.vertices) writeVector(file, "v", vertex);
  long long num_coordinates = 0;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::size_t facade = model.facade_of[i];
    std::string face = "f";
    for (const int corner : soup.polygons[i].corners) {
      const Eigen::Vector3d& vertex = soup.vertices[static_cast<std::size_t>(corner)];
      writeVector(file, "vt", textures[facade].coordinates(vertex));
      face += " " + std::to_string(corner + 1) + "/" + std::to_string(++num_coordinates);
    }
    file.write("g " + std::string(io::labelName(soup.polygons[i].label)) + "\nusemtl " +
               materialOf(facade) + "\n" + face + "\n");
  }
  file.commit();
}

void writeMaterials(const std::string& path, std::size_t num_facades) {
  io::OutputFile file(path);
  for (std::size_t f = 0; f < num_facades; ++f) {
    file.write("newmtl " + materialOf(f) + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " +
               nameOf(f, ".png") + "\n");
  }
  file.commit();
}

Json toJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void writePlan(const std::string& path, const ModelFacades& model,
               const std::vector<FacadeTexture>& textures) {
  std::vector<Json> polygons(textures.size(), Json::array());
  for (std::size_t i = 0; i < model.facade_of.size(); ++i) {
    polygons[model.facade_of[i]].push_back(i);
  }
  Json facades = Json::array();
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const FacadeTexture& t = textures[f];
    facades.push_back({{"image", nameOf(f, ".png")},
                       {"mask", nameOf(f, "_mask.png")},
                       {"origin", toJson(t.frame.origin)},
                       {"right", toJson(t.frame.right)},
                       {"up", toJson(t.frame.up)},
                       {"width", t.frame.width},
                       {"height", t.frame.height},
                       {"texel", t.texel},
                       {"seen", t.seenShare()},
                       {"polygons", std::move(polygons[f])}});
  }
  io::OutputFile file(path);
  file.write(Json{{"facades", facades}}.dump(1) + "\n");
  file.commit();
}

/// The images of the largest facades that were seen: walls, then level ones, the largest first.
std::vector<exports::FacadeImage> largestImages(const std::vector<FacadeTexture>& textures,
                                                const TextureSheets& sheets,
                                                const Eigen::Vector3d& vertical) {
  constexpr double kLeast = 0.05;  // of the area of the largest; less are reveals and corners
  const auto areaOf = [&](std::size_t f) {
    return textures[f].frame.width * textures[f].frame.height;
  };
  const auto isLevel = [&](std::size_t f) {
    return std::abs(textures[f].frame.normal().dot(vertical)) > 0.5;
  };
  double largest = 0.0;
  std::vector<std::size_t> order;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    if (sheets.places[f].sheet < 0) continue;
    order.push_back(f);
    largest = std::max(largest, areaOf(f));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return isLevel(a) != isLevel(b) ? isLevel(b) : areaOf(a) > areaOf(b);
  });
  std::vector<exports::FacadeImage> images;
  for (const std::size_t f : order) {
    if (areaOf(f) < kLeast * largest) continue;
    const FacadeTexture& t = textures[f];
    const SheetPlace& place = sheets.places[f];
    const auto shrunk = [&](int texels) { return (texels + place.shrink - 1) / place.shrink; };
    images.push_back({f, place.sheet, place.left, place.top, shrunk(t.image.width),
                      shrunk(t.image.height), t.texel * place.shrink, t.frame.width, t.frame.height,
                      t.seenShare()});
  }
  return images;
}

}  // namespace

void writeTexturedModel(const std::string& folder, const io::PolygonSoup& soup,
                        const ModelFacades& model, const std::vector<FacadeTexture>& textures,
                        const Eigen::Vector3d& vertical) {
  const io::OutputDirectory directory(folder);
  const io::OutputDirectory images(directory.file("textures"));
  std::vector<RgbImage> drawn = drawnImages(textures);
  for (std::size_t f = 0; f < textures.size(); ++f) {
    io::writePng(directory.file(nameOf(f, ".png")), drawn[f]);
    io::writePng(directory.file(nameOf(f, "_mask.png")), maskOf(textures[f]));
    if (textures[f].seenShare() == 0.0) drawn[f] = RgbImage();  // plain in the GLB
  }
  writeMaterials(directory.file("textured.mtl"), textures.size());
  writeObj(directory.file("textured.obj"), soup, model, textures);
  writePlan(directory.file("facades.json"), model, textures);
  const TextureSheets sheets = laySheets(std::move(drawn));
  const exports::GlbFile glb = toTexturedGlb(soup, model, textures, sheets, vertical);
  glb.write(directory.file("textured.glb"));
  exports::showTexturedModel(directory.file("report.html"), glb.bytes(),
                             largestImages(textures, sheets, vertical));
}

}  // namespace storey::texture
