// SPDX-License-Identifier: BSD-3-Clause
// Prints the cameras of photos, and checks them against a cloud.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cameras/agreement.h"
#include "cameras/camera_json.h"
#include "cameras/overlay.h"
#include "cli/command_line.h"
#include "io/cameras/camera_set.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "io/images/image_files.h"
#include "io/output_file.h"

namespace {

namespace cameras = storey::cameras;
namespace cli = storey::cli;
namespace io = storey::io;

// Right cameras reach 0.9 and more; light above and dark below alone make 0.6.
constexpr double kClearGain = 0.2;         // of agreement: a mistake was undone
constexpr double kLeastAgreement = 0.75;   // below, the cameras are of something else
constexpr double kLeastOfOne = 0.5;        // of one photo, which may hold little but sky and trees
constexpr std::size_t kMaxPoints = 50000;  // of the cloud that are looked at, evenly spread

struct Request {
  std::string cameras;
  std::string images;
  std::string cloud;
  std::string output;
  bool json = false;
};

bool parse(int argc, char** argv, Request& r) {
  cli::CommandLine line("storey_cameras", {"CAMERAS [IMAGES] [--cloud CLOUD] [-o DIR] [--json]"},
                        "Prints the cameras of a COLMAP, Bundler or PMVS folder, in the world's "
                        "unit and pixels, and checks them: the points of a cloud must have the "
                        "same brightness in all photos.");
  line.argument("cameras", r.cameras, "file or folder of the cameras");
  line.argument("images", r.images, "folder of the photos");
  line.text("cloud", r.cloud, "cloud to check them against; needs IMAGES");
  line.text("output,o", r.output,
            "folder for a picture of each photo with the cloud's points on it; needs --cloud");
  line.flag("json", r.json, "print JSON");
  if (!line.parse(argc, argv)) return false;
  if (r.cameras.empty()) line.fail("a file or folder of cameras is needed");
  if (!r.cloud.empty() && r.images.empty()) line.fail("--cloud needs the folder of the images");
  if (!r.output.empty() && r.cloud.empty()) line.fail("-o needs --cloud");
  return true;
}

void printCameras(const io::CameraSet& set) {
  std::printf("%s: %zu photos, %zu points\n", set.format.c_str(), set.photos.size(),
              set.points.size());
  std::printf("%5s %12s %18s %18s %36s  %s\n", "photo", "pixels", "focal length", "principal point",
              "centre", "name");
  for (const io::Photo& photo : set.photos) {
    const storey::Camera& c = photo.camera;
    const Eigen::Vector3d center = c.center();
    std::printf("%5zu %5d x %4d %9.2f %8.2f %9.2f %8.2f %12.6g %11.6g %11.6g  %s\n", photo.index,
                c.width, c.height, c.focal.x(), c.focal.y(), c.principal.x(), c.principal.y(),
                center.x(), center.y(), center.z(), io::printable(photo.name, 60).c_str());
  }
}

cameras::CloudPoints readPoints(const std::string& path) {
  const io::LoadedCloud loaded = io::readCloud(path);
  const std::size_t step = (loaded.cloud->size() + kMaxPoints - 1) / kMaxPoints;
  cameras::CloudPoints points;
  for (std::size_t i = 0; i < loaded.cloud->size(); i += step) {
    const pcl::PointNormal& p = (*loaded.cloud)[i];
    points.positions.push_back(p.getVector3fMap().cast<double>() + loaded.offset);
    if (loaded.has_normals) points.normals.push_back(p.getNormalVector3fMap().cast<double>());
  }
  return points;
}

void printAgreement(const io::CameraSet& set, const cameras::CameraCheck& check) {
  const std::vector<cameras::PhotoAgreement>& agreement = check.agreement;
  std::printf("\n%5s %8s %10s\n", "photo", "points", "agreement");
  for (std::size_t k = 0; k < agreement.size(); ++k) {
    const bool weak = agreement[k].correlation < kLeastOfOne;
    std::printf("%5zu %8zu %10.3f%s\n", set.photos[k].index, agreement[k].points,
                agreement[k].correlation, weak ? "  disagrees with the others" : "");
  }
  std::printf("agreement of all: %.3f\n", check.correlation);
}

void writePictures(const std::string& folder, const cameras::CloudPoints& points,
                   const io::CameraSet& set, const std::vector<storey::RgbImage>& images) {
  const io::OutputDirectory directory(folder);
  for (std::size_t k = 0; k < images.size(); ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "photo_%04zu.png", set.photos[k].index);
    io::writePng(directory.file(name),
                 cameras::drawPoints(points, set.photos[k].camera, images[k]));
  }
}

cameras::CameraCheck check(const Request& request, const io::CameraSet& set) {
  const cameras::CloudPoints points = readPoints(request.cloud);
  std::vector<storey::Camera> views;
  std::vector<storey::RgbImage> images;
  for (const io::Photo& photo : set.photos) {
    views.push_back(photo.camera);
    images.push_back(io::readImage(photo));
  }
  if (!request.output.empty()) writePictures(request.output, points, set, images);
  cameras::CameraCheck checked;
  checked.agreement = cameras::measureAgreement(points, views, images);
  checked.correlation = cameras::meanCorrelation(checked.agreement);
  checked.best = cameras::suspectMistakes(points, views, images).front();
  return checked;
}

/// Ends in a Failure if the cameras do not fit the cloud.
void judge(const std::string& path, const cameras::CameraCheck& checked) {
  if (checked.best.correlation > checked.correlation + kClearGain) {
    throw io::Failure(io::BadInput, path, checked.best.mistake,
                      "that undone, the photos agree by " +
                          std::to_string(checked.best.correlation) + " instead of " +
                          std::to_string(checked.correlation));
  }
  if (checked.correlation < kLeastAgreement) {
    throw io::Failure(io::BadInput, path, "do not fit the cloud",
                      "give the cloud and the cameras of the same reconstruction");
  }
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) return io::Ok;
  io::CameraSet set = io::readCameras(request.cameras);
  if (!request.images.empty()) io::findImages(request.images, set);
  std::optional<cameras::CameraCheck> checked;
  if (!request.cloud.empty()) checked = check(request, set);
  if (request.json) {
    std::printf("%s\n", cameras::toJson(set, checked).c_str());
  } else {
    printCameras(set);
    if (checked) printAgreement(set, *checked);
  }
  if (checked) judge(request.cameras, *checked);
  return io::Ok;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_cameras", [&] { return run(argc, argv); });
}
