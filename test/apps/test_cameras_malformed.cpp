// SPDX-License-Identifier: BSD-3-Clause
// Camera files and images that must not bring a reader down, nor slip through it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "confined.h"
#include "io/cameras/camera_set.h"
#include "io/failure.h"
#include "io/image_header.h"
#include "temporary_files.h"

namespace storey {
namespace {

using test::inChild;
using test::MemoryFile;
using test::TemporaryDirectory;
using Files = std::map<std::string, std::string>;  // name to content

std::string bytesOf(std::uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  return bytes;
}

std::string doubles(int n) {
  const double one = 1.0;
  std::string bytes;
  for (int i = 0; i < n; ++i) bytes.append(reinterpret_cast<const char*>(&one), 8);
  return bytes;
}

const std::string kCamera = "1 PINHOLE 640 480 500 500 320 240\n";
const std::string kImage = "1 1 0 0 0 0 0 0 1 a.jpg\n\n";
const std::string kBundle =
    "# Bundle file v0.3\n1 1\n500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n1 2 3\n9 9 9\n1 0 0 1 2\n";
const std::string kMatrix = "CONTOUR\n500 0 320 0\n0 500 240 0\n0 0 1 0\n";
const std::string kCameraBin =
    bytesOf(1, 8) + bytesOf(1, 4) + bytesOf(1, 4) + bytesOf(640, 8) + bytesOf(480, 8) + doubles(4);
const std::string kImageBin = bytesOf(1, 8) + bytesOf(1, 4) + doubles(7) + bytesOf(1, 4) +
                              std::string("a\0", 2) + bytesOf(0, 8);
const std::string kPointBin =
    bytesOf(1, 8) + bytesOf(1, 8) + doubles(3) + std::string(11, '\0') + bytesOf(0, 8);

Files colmap(const std::string& camera, const std::string& image, const std::string& points = "") {
  return {{"cameras.txt", camera}, {"images.txt", image}, {"points3D.txt", points}};
}

Files binary(const std::string& camera, const std::string& image,
             const std::string& points = kPointBin) {
  return {{"cameras.bin", camera}, {"images.bin", image}, {"points3D.bin", points}};
}

std::string readFolder(const std::string& path) {
  try {
    const io::CameraSet set = io::readCameras(path);
    return set.photos.size() == 1 && set.photos[0].camera.world_to_camera.matrix().allFinite()
               ? "ok"
               : "wrong";
  } catch (const io::Failure& failure) {
    return "refused " + std::to_string(failure.status()) + " " + failure.what();
  }
}

std::string answerTo(const Files& files) {
  const TemporaryDirectory directory;
  for (const auto& [name, content] : files) directory.write(name, content);
  return inChild([&] { return readFolder(directory.path()); });
}

void expectRefused(const Files& files, const std::string& mentions) {
  const std::string answer = answerTo(files);
  EXPECT_EQ(answer.rfind("refused 65 ", 0), 0u) << answer << "\nexpected " << mentions;
  EXPECT_NE(answer.find(mentions), std::string::npos) << answer << "\nexpected " << mentions;
  EXPECT_NE(answer.find("; "), std::string::npos) << answer;
}

TEST(MalformedCameras, TheGoodOnesAreRead) {
  EXPECT_EQ(answerTo(colmap(kCamera, kImage)), "ok");
  EXPECT_EQ(answerTo(binary(kCameraBin, kImageBin)), "ok");
  EXPECT_EQ(answerTo({{"bundle.out", kBundle}}), "ok");
  EXPECT_EQ(answerTo({{"00000000.txt", kMatrix}}), "ok");
}

TEST(MalformedCameras, ColmapText) {
  for (const char* camera :
       {"1 PINHOLE 640 480 500 500 320\n", "1 PINHOLE 640 480 500 500 320 240 1\n",
        "1 PINHOLE 640 480 500 nan 320 240\n", "1 PINHOLE 640 480 -500 500 320 240\n",
        "1 PINHOLE 640 480 0 500 320 240\n", "1 PINHOLE 0 480 500 500 320 240\n",
        "1 PINHOLE 99999999999 480 500 500 320 240\n", "1 PINHOLE -640 480 500 500 320 240\n",
        "1 FOV 640 480 500 500 320 240 4\n", "1 LENSLESS 640 480 1\n", "1 PINHOLE\n", "x\n",
        "1 PINHOLE 640 480 500 500 320 1e999\n"}) {
    expectRefused(colmap(camera, kImage), "line 1: ");
  }
  expectRefused(colmap(kCamera + kCamera, kImage), "line 2: ");
  for (const char* image :
       {"1 1 0 0 0 0 0 0 2 a.jpg\n\n", "1 0 0 0 0 0 0 0 1 a.jpg\n\n", "1 1 0 0 0 0 0 inf 1 a.jpg\n",
        "1 1 0 0 0 0 0 0 1\n\n", "1 1 0 0 0 0 0 0 -1 a.jpg\n", "a.jpg\n"}) {
    expectRefused(colmap(kCamera, image), "line 1: ");
  }
  const std::string one_line_an_image = "1 1 0 0 0 0 0 0 1 a.jpg\n2 1 0 0 0 0 0 0 1 b.jpg\n";
  expectRefused(colmap(kCamera, one_line_an_image), "line 2: ");
  expectRefused(colmap(kCamera, "# none\n"), "no images");
  expectRefused(colmap(kCamera, kImage, "1 2 3\n"), "line 1: ");
  expectRefused(colmap(kCamera, kImage, "1 2 3 nan 0 0 0 0\n"), "line 1: ");
  expectRefused(colmap(kCamera, "1 1 0 0 0 0 0 0 1 " + std::string(5000, 'a') + "\n"), "too long");
}

TEST(MalformedCameras, Bundler) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kBundle;
    return Files{{"bundle.out", text.replace(text.find(from), from.size(), to)}};
  };
  expectRefused(changed("1 1\n", "1 2000000000\n"), "line 2: ");
  expectRefused(changed("1 1\n", "-1 1\n"), "line 2: ");
  expectRefused(changed("1 1\n", "1 2\n"), "ends within the points");
  expectRefused(changed("1 1\n", "1 0\n"), "more than");
  expectRefused(changed("500 0 0", "-500 0 0"), "focal length");
  expectRefused(changed("500 0 0", "0 0 0"), "no camera");
  expectRefused(changed("500 0 0", "inf 0 0"), "line 3: ");
  expectRefused(changed("0 1 0\n", "0 2 0\n"), "rotation");
  expectRefused(changed("0 1 0\n", "0 -1 0\n"), "rotation");  // mirrors
  expectRefused(changed("1 0 0 1 2", "2 0 0 1 2"), "line 10: ");
  expectRefused(changed("1 0 0 1 2", "18446744073709551615 0 0 1 2"), "line 10: ");
  expectRefused(changed("# Bundle file", "# Bungle file"), "no Bundler file");
}

TEST(MalformedCameras, Pmvs) {
  const auto matrix = [](const std::string& text) { return Files{{"00000000.txt", text}}; };
  expectRefused(matrix("CONTOUR\n1 0 0 0\n0 1 0 0\n"), "ends within");
  expectRefused(matrix("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), "CONTOUR");
  expectRefused(matrix("CONTOUR\n1 0 0 0\n0 1 0 0\n0 0 0 1\n"), "projects nothing");
  expectRefused(matrix("CONTOUR\n1 0 0 0\n1 0 0 0\n0 0 1 1\n"), "projects nothing");
  expectRefused(matrix("CONTOUR\n1 0 0 0\n0 1 0 0\n0 0 nan 1\n"), "line 4: ");
  expectRefused(matrix(kMatrix + "0 0 0 1\n"), "line 5: ");
}

// A binary file cut anywhere is refused, and so is one whose counts are larger than it.
TEST(MalformedCameras, ColmapBinary) {
  const TemporaryDirectory directory;
  const Files good = binary(kCameraBin, kImageBin);
  for (const auto& [cut, content] : good) {
    for (const auto& [name, whole] : good) directory.write(name, whole);
    for (std::size_t length = 1; length < content.size(); ++length) {
      directory.write(cut, content.substr(0, length));
      EXPECT_EQ(readFolder(directory.path()).rfind("refused 65", 0), 0u) << cut << " " << length;
    }
  }
  const std::string many = bytesOf(~std::uint64_t{0} / 64, 8);
  expectRefused(binary(many + kCameraBin.substr(8), kImageBin), "too short");
  expectRefused(binary(kCameraBin, many + kImageBin.substr(8)), "too short");
  expectRefused(binary(kCameraBin, kImageBin.substr(0, kImageBin.size() - 8) + many), "too short");
  expectRefused(binary(kCameraBin, kImageBin, many + kPointBin.substr(8)), "too short");
  expectRefused(
      binary(bytesOf(1, 8) + bytesOf(1, 4) + bytesOf(99, 4) + kCameraBin.substr(16), kImageBin),
      "99 is no camera model");
  expectRefused(binary(kCameraBin + "x", kImageBin), "more than");
}

TEST(MalformedCameras, NothingThere) {
  const TemporaryDirectory directory;
  expectRefused({{"readme.txt", "no cameras"}}, "holds no cameras");
  EXPECT_EQ(readFolder(directory.file("missing")).rfind("refused 66", 0), 0u);
  ASSERT_EQ(mkfifo(directory.file("bundle.out").c_str(), 0600), 0);
  EXPECT_EQ(inChild([&] { return readFolder(directory.path()); }).rfind("refused 65", 0), 0u);
}

std::string jpeg(const std::string& segments) { return "\xff\xd8" + segments; }

const std::string kFrame("\xff\xc0\x00\x0b\x08\x01\xe0\x02\x80\x01\x01\x11\x00", 13);

std::string exif(const std::string& tiff) {
  const std::string body = std::string("Exif\0\0", 6) + tiff;
  const std::size_t length = body.size() + 2;
  return std::string("\xff\xe1") + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + body;
}

/// A TIFF's first directory with one tag.
std::string tiffWith(std::uint64_t tag, std::uint64_t value, std::uint64_t directory = 8) {
  return std::string("II*\0", 4) + bytesOf(directory, 4) + bytesOf(1, 2) + bytesOf(tag, 2) +
         bytesOf(3, 2) + bytesOf(1, 4) + bytesOf(value, 4);
}

TEST(ImageHeaders, SizesAndOrientations) {
  const MemoryFile file;
  const auto plain = io::readImageHeader(file.write(jpeg(kFrame)));
  EXPECT_EQ(plain.width(), 640);
  EXPECT_EQ(plain.height(), 480);
  const auto turned = io::readImageHeader(file.write(jpeg(exif(tiffWith(274, 6)) + kFrame)));
  EXPECT_EQ(turned.width(), 480);
  EXPECT_EQ(turned.height(), 640);
  // What EXIF says wrongly, or far outside of itself, is passed over.
  for (const std::string& odd : {tiffWith(274, 9), tiffWith(274, 6, 0xfffffff0),
                                 tiffWith(274, 6, 7), std::string("II*"), std::string()}) {
    EXPECT_EQ(io::readImageHeader(file.write(jpeg(exif(odd) + kFrame))).width(), 640);
  }
}

TEST(ImageHeaders, MalformedOnesAreRefused) {
  const MemoryFile file;
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\0\0\0\1\0", 24);
  const std::string huge("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff", 24);
  const std::string no_length = jpeg(std::string("\xff\xe0\0\1", 4) + kFrame);
  for (const std::string& content :
       {png, huge, no_length, jpeg("x" + kFrame), std::string("GIF89a"), tiffWith(256, 5),
        std::string("\xff\xd8\xff", 3)}) {
    const std::string path = file.write(content);
    EXPECT_THROW(io::readImageHeader(path), io::Failure);
  }
  const std::string whole = jpeg(exif(tiffWith(274, 6)) + kFrame);
  for (std::size_t length = 1; length + 1 < whole.size(); ++length) {
    const std::string path = file.write(whole.substr(0, length));
    EXPECT_THROW(io::readImageHeader(path), io::Failure) << length;
  }
}

}  // namespace
}  // namespace storey
