// SPDX-License-Identifier: BSD-3-Clause
// Puts photos on a model.
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "io/model_io.h"
#include "synth/polygon_mesh.h"
#include "texture/textured_model.h"

namespace {

namespace io = storey::io;
namespace options = boost::program_options;
namespace texture = storey::texture;

struct Request {
  std::string model;
  std::string cameras;
  std::string images;
  std::string output;
  storey::FacadeTexturingOptions texturing;
};

[[noreturn]] void failUsage(const std::string& reason) {
  throw io::Failure(io::Usage, "", reason, "see storey_texture --help");
}

bool parse(int argc, char** argv, Request& r) {
  options::options_description visible(
      "storey_texture MODEL CAMERAS IMAGES -o DIR [options]\n"
      "An image of each facade of a closed model (.ply, .obj) from the photos that see it: "
      "model.obj,\nmodel.mtl, facades.json (scales), textures/. Cameras in the model's "
      "coordinates, of COLMAP,\nBundler or PMVS. Lengths are in the model's unit");
  visible.add_options()("output,o", options::value(&r.output), "folder to write into")(
      "texel", options::value(&r.texturing.texel)->default_value(0.0),
      "side of a texel; 0: what the photos resolve")(
      "max-texels", options::value(&r.texturing.max_texels)->default_value(64e6, "64e6"),
      "most texels of all facades together")(
      "fill", options::bool_switch(&r.texturing.fill),
      "fill what no photo saw from the facade's own repetition")("help,h", "this text");
  options::options_description all;
  all.add(visible).add_options()("model", options::value(&r.model))(
      "cameras", options::value(&r.cameras))("images", options::value(&r.images));
  options::positional_options_description positional;
  positional.add("model", 1).add("cameras", 1).add("images", 1);
  options::variables_map given;
  try {
    options::store(
        options::command_line_parser(argc, argv).options(all).positional(positional).run(), given);
    options::notify(given);
  } catch (const options::error& error) {
    failUsage(error.what());
  }
  if (given.count("help") > 0) {
    std::cout << visible;
    return false;
  }
  if (r.images.empty() || r.output.empty()) {
    failUsage("a model, its cameras, the folder of the images, and an output (-o) are needed");
  }
  const storey::FacadeTexturingOptions& t = r.texturing;
  if (!(t.texel >= 0.0 && std::isfinite(t.texel)) || !(t.max_texels >= 1.0)) {
    failUsage("--texel must not be negative, nor --max-texels below 1");
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
  const std::vector<storey::FacadePhoto> photos = readPhotos(request);
  texture::turnToCameras(photos, model.facades);
  request.texturing.vertical = storey::synth::upOfModel(soup);
  const std::vector<storey::FacadeTexture> textures =
      storey::textureFacades(model.facades, photos, request.texturing);
  texture::writeTexturedModel(request.output, soup, model, textures);
  print(textures);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return io::runMain("storey_texture", [&] { return run(argc, argv); });
}
