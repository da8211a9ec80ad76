// SPDX-License-Identifier: BSD-3-Clause
// Puts photos on a model.
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "io/model_io.h"
#include "synth/polygon_mesh.h"
#include "texture/textured_model.h"

namespace {

namespace cli = storey::cli;
namespace io = storey::io;
namespace texture = storey::texture;

struct Request {
  std::string model;
  std::string cameras;
  std::string images;
  std::string output;
  double texel = 0.0;
  double max_texels = storey::FacadeTexturing().getMaxTexels();
  bool fill = false;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line(
      "storey_texture", {"MODEL CAMERAS IMAGES -o DIR [options]"},
      "An image of each facade of a closed model (.ply, .obj) from the photos "
      "that see it: textured.glb, textured.obj, report.html to look at, facades.json "
      "(scales), textures/. "
      "Lengths are in the model's unit.");
  line.argument("model", r.model, "closed model, .ply or .obj");
  line.argument("cameras", r.cameras,
                "cameras in the model's coordinates: COLMAP, Bundler or PMVS");
  line.argument("images", r.images, "folder of the photos");
  line.text("output,o", r.output, "folder to write into");
  line.number("texel", r.texel, cli::kNonNegative,
              "side of a texel, length; 0: what the photos resolve");
  line.number("max-texels", r.max_texels, cli::Range{1.0}, "most texels of all facades together");
  line.flag("fill", r.fill, "fill what no photo saw from the facade's own repetition");
  if (!line.parse(argc, argv)) return false;
  if (r.images.empty() || r.output.empty()) {
    line.fail("a model, its cameras, the folder of the images, and an output (-o) are needed");
  }
  return true;
}

std::vector<storey::FacadePhoto> readPhotos(const Request& request) {
  io::CameraSet set = io::readCameras(request.cameras);
  io::findImages(request.images, set);
  std::vector<storey::FacadePhoto> photos;
  for (const io::Photo& photo : set.photos) photos.push_back({photo.camera, io::readImage(photo)});
  return photos;
}

void print(const std::vector<storey::FacadeTexture>& textures) {
  std::printf("%6s %14s %10s %6s\n", "facade", "texels", "texel", "seen");
  for (std::size_t f = 0; f < textures.size(); ++f) {
    const storey::FacadeTexture& t = textures[f];
    std::printf("%6zu %6d x %5d %10.4g %5.1f%%\n", f, t.image.width, t.image.height, t.texel,
                100.0 * t.seenShare());
  }
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) return io::Ok;
  const io::PolygonSoup soup = io::readPolygons(request.model);
  texture::ModelFacades model = texture::groupFacades(request.model, soup);
  std::vector<storey::FacadePhoto> photos = readPhotos(request);
  const Eigen::Vector3d vertical = storey::synth::upOfModel(soup);
  const bool enclosed = texture::turnToCameras(photos, model.facades);
  storey::FacadeTexturing texturing;
  texturing.setFacades(model.facades);
  texturing.setPhotos(std::move(photos));
  texturing.setVertical(vertical);
  texturing.setTexelSize(request.texel);
  texturing.setMaxTexels(request.max_texels);
  texturing.setFillUnseen(request.fill);
  std::vector<storey::FacadeTexture> textures;
  if (!texturing.texture(textures)) return io::BadInput;
  if (enclosed) texture::forgetOpenLids(model, vertical, textures);
  texture::writeTexturedModel(request.output, soup, model, textures, vertical);
  print(textures);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_texture", [&] { return run(argc, argv); });
}
