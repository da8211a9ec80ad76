// SPDX-License-Identifier: BSD-3-Clause
#include "io/cameras/camera_writer.h"

#include "io/output_file.h"

namespace storey::io {
namespace {

template <typename Vector>
void writeNumbers(OutputFile& file, const Vector& numbers, const char* end) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    if (i > 0) file.write(" ");
    file.writeNumber(static_cast<double>(numbers[i]));
  }
  file.write(end);
}

void writeIntrinsics(const std::string& path, const CameraSet& cameras) {
  OutputFile file(path);
  file.write("# CAMERA_ID MODEL WIDTH HEIGHT fx fy cx cy\n");
  for (std::size_t i = 0; i < cameras.photos.size(); ++i) {
    const Camera& c = cameras.photos[i].camera;
    file.write(std::to_string(i + 1) + " PINHOLE " + std::to_string(c.width) + " " +
               std::to_string(c.height) + " ");
    writeNumbers(file, c.focal, " ");
    writeNumbers(file, c.principal, "\n");
  }
  file.commit();
}

void writePoses(const std::string& path, const CameraSet& cameras) {
  OutputFile file(path);
  file.write("# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of image points\n");
  for (std::size_t i = 0; i < cameras.photos.size(); ++i) {
    const Photo& photo = cameras.photos[i];
    const Eigen::Quaterniond q(photo.camera.world_to_camera.linear());
    file.write(std::to_string(i + 1) + " ");
    writeNumbers(file, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), " ");
    writeNumbers(file, Eigen::Vector3d(photo.camera.world_to_camera.translation()), " ");
    file.write(std::to_string(i + 1) + " " + photo.name + "\n\n");
  }
  file.commit();
}

}  // namespace

void writeColmapText(const std::string& folder, const CameraSet& cameras) {
  writeIntrinsics(folder + "/cameras.txt", cameras);
  writePoses(folder + "/images.txt", cameras);
  OutputFile file(folder + "/points3D.txt");
  file.write("# POINT3D_ID X Y Z R G B ERROR TRACK\n");
  for (std::size_t i = 0; i < cameras.points.size(); ++i) {
    file.write(std::to_string(i + 1) + " ");
    writeNumbers(file, cameras.points[i], " 128 128 128 0\n");
  }
  file.commit();
}

void writeBundler(const std::string& folder, const CameraSet& cameras) {
  OutputFile names(folder + "/list.txt");
  OutputFile file(folder + "/bundle.out");
  file.write("# Bundle file v0.3\n" + std::to_string(cameras.photos.size()) + " " +
             std::to_string(cameras.points.size()) + "\n");
  const Eigen::Vector3d ahead(1.0, -1.0, -1.0);  // our camera's frame to theirs
  for (const Photo& photo : cameras.photos) {
    names.write(photo.name + "\n");
    writeNumbers(file, Eigen::Vector3d(photo.camera.focal.x(), 0.0, 0.0), "\n");
    const Eigen::Matrix3d rotation = ahead.asDiagonal() * photo.camera.world_to_camera.linear();
    for (int row = 0; row < 3; ++row) writeNumbers(file, rotation.row(row), "\n");
    writeNumbers(file, ahead.cwiseProduct(photo.camera.world_to_camera.translation()).eval(), "\n");
  }
  for (const Eigen::Vector3d& point : cameras.points) {
    writeNumbers(file, point, "\n128 128 128\n0\n");
  }
  names.commit();
  file.commit();
}

}  // namespace storey::io
