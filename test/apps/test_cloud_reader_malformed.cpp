// SPDX-License-Identifier: BSD-3-Clause
// Files that must not bring a reader down, nor slip through it.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "confined.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "io/model_io.h"
#include "loaded_points.h"
#include "malformed_files.h"
#include "temporary_files.h"

namespace storey {
namespace {

using io::Failure;
using io::LoadedCloud;
using test::CorpusFile;
using test::inChild;
using test::MemoryFile;
using test::samplePoint;
using test::TemporaryDirectory;

/// "ok", or what differs from the sample points.
std::string compare(const LoadedCloud& loaded, int num_points) {
  if (loaded.declared != static_cast<std::size_t>(num_points)) return "wrong number declared";
  if (loaded.cloud->size() != static_cast<std::size_t>(num_points)) return "wrong number of points";
  for (int i = 0; i < num_points; ++i) {
    const Eigen::Vector3f point = test::pointAt(loaded, samplePoint(i)).getVector3fMap();
    if (point.cast<double>() + loaded.offset != samplePoint(i)) return "wrong point";
  }
  return "ok";
}

std::string refusal(const Failure& failure) {
  return "refused " + std::to_string(failure.status()) + " " + failure.what();
}

std::string readCloudFile(const std::string& path, int num_points) {
  try {
    return compare(io::readCloud(path), num_points);
  } catch (const Failure& failure) {
    return refusal(failure);
  }
}

std::string readPolygonFile(const std::string& path, int num_vertices) {
  try {
    const io::PolygonSoup soup = io::readPolygons(path);
    if (soup.vertices.size() != static_cast<std::size_t>(num_vertices)) return "wrong number";
    for (int i = 0; i < num_vertices; ++i) {
      if (soup.vertices[static_cast<std::size_t>(i)] != samplePoint(i)) return "wrong vertex";
    }
    return soup.polygons.size() == 1 && soup.polygons[0].corners == std::vector<int>{0, 1, 2}
               ? "ok"
               : "wrong faces";
  } catch (const Failure& failure) {
    return refusal(failure);
  }
}

void expectAnswer(const CorpusFile& file, const std::string& path, const std::string& answer) {
  if (file.num_points > 0) {
    EXPECT_EQ(answer, "ok") << file.name;
    return;
  }
  EXPECT_EQ(answer.rfind("refused 65 " + path + ": ", 0), 0u) << file.name << " gave " << answer;
  EXPECT_NE(answer.find(file.mentions), std::string::npos) << file.name << " gave " << answer;
  EXPECT_NE(answer.find("; "), std::string::npos) << file.name << " has no hint: " << answer;
  for (const char c : answer) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << file.name;
}

void checkCorpus(const std::vector<CorpusFile>& corpus, const char* extension,
                 std::string (*read)(const std::string&, int)) {
  const TemporaryDirectory directory;
  for (const CorpusFile& file : corpus) {
    const std::string path = directory.write(file.name + extension, file.content);
    expectAnswer(file, path, inChild([&] { return read(path, file.num_points); }));
  }
}

TEST(MalformedClouds, PcdCorpus) { checkCorpus(test::malformedPcd(), ".pcd", readCloudFile); }
TEST(MalformedClouds, PlyCorpus) { checkCorpus(test::malformedPly(), ".ply", readCloudFile); }

TEST(MalformedClouds, LasCorpus) { checkCorpus(test::malformedLas(), ".las", readCloudFile); }
TEST(MalformedClouds, VtkCorpus) { checkCorpus(test::malformedVtk(), ".vtk", readCloudFile); }
TEST(MalformedClouds, PatchCorpus) {
  checkCorpus(test::malformedPatches(), ".patch", readCloudFile);
}
TEST(MalformedClouds, XyzCorpus) { checkCorpus(test::malformedXyz(), ".xyz", readCloudFile); }

TEST(MalformedClouds, TheExtensionDoesNotMatter) {
  checkCorpus(test::malformedPcd(), ".ply", readCloudFile);
  checkCorpus(test::malformedPly(), ".pcd", readCloudFile);
}

TEST(MalformedPolygons, ObjCorpus) { checkCorpus(test::malformedObj(), ".obj", readPolygonFile); }

TEST(MalformedPolygons, PlyFaces) {
  const auto mesh = [](const std::string& list, const std::string& row) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
           "float z\nelement face 1\nproperty list " +
           list + " vertex_indices\nend_header\n" + test::asciiRows(3) + row + "\n";
  };
  checkCorpus({{"index_out", mesh("uchar int", "3 0 1 999999"), 0, "999999"},
               {"index_3", mesh("uchar int", "3 0 1 3"), 0, "corner 3"},
               {"index_negative", mesh("uchar int", "3 0 1 -1"), 0, "line 13"},
               {"index_half", mesh("uchar float", "3 0 1 1.5"), 0, "line 13"},
               {"index_nan", mesh("uchar float", "3 0 1 nan"), 0, "line 13"},
               {"no_corners", mesh("uchar int", "0"), 0, "line 13"},
               {"one_corner", mesh("uchar int", "1 0"), 0, "line 13"},
               {"two_distinct", mesh("uchar int", "4 0 1 0 1"), 0, "line 13"},
               {"legal_ushort", mesh("ushort int", "3 0 1 2"), 3, ""},
               {"legal_char", mesh("char uint", "3 0 1 2"), 3, ""}},
              ".ply", readPolygonFile);
}

TEST(MalformedClouds, OnlyRegularFilesAreOpened) {
  const TemporaryDirectory directory;
  const std::string fifo = directory.file("fifo.pcd");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  const std::string folder = directory.file("folder.pcd");
  ASSERT_EQ(mkdir(folder.c_str(), 0700), 0);
  for (const std::string& path :
       {fifo, folder, std::string("/dev/null"), std::string("/dev/zero")}) {
    for (const auto read : {readCloudFile, readPolygonFile}) {
      const std::string answer = inChild([&] { return read(path, 3); });
      EXPECT_EQ(answer.rfind("refused 65 " + path + ": is a", 0), 0u) << answer;
    }
  }
  const std::string missing = directory.file("missing.ply");
  EXPECT_EQ(readCloudFile(missing, 3).rfind("refused 66 " + missing, 0), 0u);
}

TEST(MalformedClouds, LimitsAreHeldAndNamed) {
  const TemporaryDirectory directory;
  const std::string path =
      directory.write("a.pcd", test::pcdHeader(1000, "binary") + test::binaryRows(1000));
  io::CloudReaderOptions small_file;
  small_file.max_bytes = 12000;
  EXPECT_THROW(io::readCloud(path, small_file), Failure);
  io::CloudReaderOptions small_memory;
  small_memory.limits.max_memory = 12000;
  try {
    io::readCloud(path, small_memory);
    FAIL() << "the limit was passed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), io::BadInput);
    EXPECT_NE(std::string(failure.what()).find("limit is 12000"), std::string::npos);
  }
  EXPECT_EQ(readCloudFile(path, 1000), "ok");
}

// A file of 16 GiB that holds nothing but a hole: its declared points fit, the memory does not.
TEST(MalformedClouds, HugeSparseFileIsRefusedBeforeMemoryIsTaken) {
  const TemporaryDirectory directory;
  const std::string header = test::pcdHeader(1400000000, "binary");
  const std::string path = directory.write("sparse.pcd", header);
  ASSERT_EQ(truncate(path.c_str(), static_cast<off_t>(header.size() + 12ull * 1400000000)), 0);
  const std::string answer = inChild([&] {
    io::CloudReaderOptions options;
    options.limits.max_memory = std::uint64_t{8} << 30;
    try {
      io::readCloud(path, options);
    } catch (const Failure& failure) {
      return refusal(failure);
    }
    return std::string("read");
  });
  EXPECT_EQ(answer.rfind("refused 65", 0), 0u) << answer;
  EXPECT_NE(answer.find("memory"), std::string::npos) << answer;
}

/// Small good files of every flavour with the sample points.
std::vector<CorpusFile> seeds() {
  std::vector<CorpusFile> good;
  for (std::vector<CorpusFile> corpus : {test::malformedPcd(), test::malformedPly()}) {
    for (CorpusFile& file : corpus) {
      if (file.num_points == 3) good.push_back(std::move(file));
    }
  }
  good.push_back({"binary.pcd", test::pcdHeader(7, "binary") + test::binaryRows(7), 7, ""});
  return good;
}

bool isAscii(const CorpusFile& seed) { return seed.content.find("binary") == std::string::npos; }

std::size_t bodyStart(const CorpusFile& seed) {
  const bool is_ply = seed.content.rfind("ply", 0) == 0;
  const std::size_t last_line = seed.content.find(is_ply ? "end_header" : "DATA ");
  return seed.content.find('\n', last_line) + 1;
}

// Cut anywhere, a file is refused. The one cut that no reader can see is within the last number of
// an ascii file (whose last line end is optional); even then the number of points is right.
TEST(MutatedClouds, TruncatedAtEveryByte) {
  const MemoryFile file;
  for (const CorpusFile& seed : seeds()) {
    const std::string text = seed.content.substr(0, seed.content.find_last_not_of("\r\n") + 1);
    const std::size_t last_number = text.find_last_of(" \n") + 1;
    for (std::size_t length = 1; length < text.size(); ++length) {
      const std::string path = file.write(text.substr(0, length));
      const std::string answer = readCloudFile(path, seed.num_points);
      const bool invisible = isAscii(seed) && length > last_number;
      EXPECT_TRUE(answer.rfind("refused 65", 0) == 0 || (invisible && answer == "wrong point") ||
                  (invisible && answer == "ok"))
          << seed.name << " cut at " << length << " of " << text.size() << ": " << answer;
    }
  }
}

// A header with one byte changed is refused, or means the same points.
TEST(MutatedClouds, EveryHeaderByteChanged) {
  const MemoryFile file;
  int num_refused = 0;
  int num_read = 0;
  for (const CorpusFile& seed : seeds()) {
    for (std::size_t at = 0; at < bodyStart(seed); ++at) {
      const char old = seed.content[at];
      for (const char changed : {static_cast<char>(old ^ 1), static_cast<char>(old ^ 0x20), '0',
                                 '1', '9', '-', ' ', '\n', '#', '\0', '\xff'}) {
        if (changed == old) continue;
        std::string content = seed.content;
        content[at] = changed;
        const std::string answer = readCloudFile(file.write(content), seed.num_points);
        const bool refused = answer.rfind("refused 65", 0) == 0;
        ++(refused ? num_refused : num_read);
        EXPECT_TRUE(refused || answer == "ok")
            << seed.name << " byte " << at << " to " << int{changed} << ": " << answer;
      }
    }
  }
  EXPECT_GT(num_refused, 10000);  // the sweep did take place
  EXPECT_GT(num_read, 100);       // in comments, field names that do not matter, ...
}

// Whatever an LZF stream holds, unpacking neither leaves its buffers nor gives another number of
// points; the sanitizers watch the former.
TEST(MutatedClouds, EveryByteOfACompressedBody) {
  const MemoryFile file;
  CorpusFile seed;
  for (const CorpusFile& good : seeds()) {
    if (good.name == "legal_compressed_plain") seed = good;
  }
  for (std::size_t at = bodyStart(seed); at < seed.content.size(); ++at) {
    for (int value = 0; value < 256; ++value) {
      std::string content = seed.content;
      content[at] = static_cast<char>(value);
      const std::string answer = readCloudFile(file.write(content), 3);
      EXPECT_TRUE(answer == "ok" || answer == "wrong point" || answer == "wrong number of points" ||
                  answer.rfind("refused 65", 0) == 0)
          << answer;
    }
  }
}

// Cut anywhere, or with any byte changed, a file of another format is refused or read: there is no
// third way.
TEST(MutatedClouds, ImportsCutAndChanged) {
  const MemoryFile file;
  int num_refused = 0;
  const auto check = [&](const std::string& name, const std::string& content) {
    const std::string answer = readCloudFile(file.write(content), 3);
    const bool refused = answer.rfind("refused 65", 0) == 0;
    num_refused += refused ? 1 : 0;
    EXPECT_TRUE(refused || answer == "ok" || answer.rfind("wrong ", 0) == 0) << name << answer;
  };
  for (const std::vector<CorpusFile>& corpus :
       {test::malformedLas(), test::malformedVtk(), test::malformedPatches()}) {
    for (const CorpusFile& seed : corpus) {
      if (seed.num_points != 3) continue;
      for (std::size_t at = 1; at < seed.content.size(); ++at) {
        check(seed.name, seed.content.substr(0, at));
        for (const char changed : {'\0', '\xff', '9', '-', '\n'}) {
          std::string content = seed.content;
          content[at] = changed;
          check(seed.name, content);
        }
      }
    }
  }
  EXPECT_GT(num_refused, 1000);  // the sweep did take place
}

}  // namespace
}  // namespace storey
