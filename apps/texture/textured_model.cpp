// SPDX-License-Identifier: BSD-3-Clause
#include "texture/textured_model.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/images/image_files.h"
#include "io/output_file.h"

namespace storey::texture {
namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(std::size_t facade, const char* end) {
  char name[64];
  std::snprintf(name, sizeof name, "textures/facade_%03zu%s", facade, end);
  return name;
}

std::string materialOf(std::size_t facade) { return "facade_" + std::to_string(facade); }

/// The image with the colours at the facade's edge carried on beyond it by two texels: renderers
/// interpolate, and would draw a dark rim.
RgbImage withRim(const FacadeTexture& texture) {
  constexpr int kRim = 2;
  RgbImage image = texture.image;
  std::vector<char> known;
  for (const TexelState state : texture.states) known.push_back(state != TexelState::Outside);
  for (int pass = 0; pass < kRim; ++pass) {
    const std::vector<char> before = known;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const int here = y * image.width + x;
        if (before[static_cast<std::size_t>(here)] != 0) continue;
        for (const int step : {-1, 1, -image.width, image.width}) {
          const int from = here + step;
          const bool wraps = (step == -1 && x == 0) || (step == 1 && x + 1 == image.width);
          if (wraps || from < 0 || from >= image.width * image.height) continue;
          if (before[static_cast<std::size_t>(from)] == 0) continue;
          std::copy_n(image.channels.data() + 3 * from, 3, image.at(x, y));
          known[static_cast<std::size_t>(here)] = 1;
          break;
        }
      }
    }
  }
  return image;
}

RgbImage maskOf(const FacadeTexture& texture) {
  RgbImage mask(texture.image.width, texture.image.height);
  for (std::size_t i = 0; i < texture.states.size(); ++i) {
    const int level = texture.states[i] == TexelState::Seen     ? 255
                      : texture.states[i] == TexelState::Unseen ? 0
                                                                : 128;
    std::fill_n(mask.channels.data() + 3 * i, 3, static_cast<std::uint8_t>(level));
  }
  return mask;
}

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
  file.write("mtllib model.mtl\n");
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
    file.write("usemtl " + materialOf(facade) + "\n" + face + "\n");
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

void writePlan(const std::string& path, const std::vector<FacadeTexture>& textures) {
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
                       {"seen", t.seenShare()}});
  }
  io::OutputFile file(path);
  file.write(Json{{"facades", facades}}.dump(1) + "\n");
  file.commit();
}

}  // namespace

void writeTexturedModel(const std::string& folder, const io::PolygonSoup& soup,
                        const ModelFacades& model, const std::vector<FacadeTexture>& textures) {
  const io::OutputDirectory directory(folder);
  const io::OutputDirectory images(directory.file("textures"));
  for (std::size_t f = 0; f < textures.size(); ++f) {
    io::writePng(directory.file(nameOf(f, ".png")), withRim(textures[f]));
    io::writePng(directory.file(nameOf(f, "_mask.png")), maskOf(textures[f]));
  }
  writeMaterials(directory.file("model.mtl"), textures.size());
  writeObj(directory.file("model.obj"), soup, model, textures);
  writePlan(directory.file("facades.json"), textures);
}

}  // namespace storey::texture
