// SPDX-License-Identifier: BSD-3-Clause
// What all formats have in common.
#include <gtest/gtest.h>

#include <set>

#include "apps/temporary_files.h"
#include "export/exported_models.h"
#include "export/formats.h"
#include "io/failure.h"

namespace storey::test {
namespace {

/// What a writer fails with; Ok if it does not.
io::ExitStatus statusOf(const exports::Format& format, const std::string& path) {
  try {
    format.write(path, {modelOf(stackedModels()[0].layers)});
  } catch (const io::Failure& failure) {
    return failure.status();
  }
  return io::Ok;
}

TEST(Formats, HaveNamesAndFilesOfTheirOwn) {
  std::set<std::string> names;
  std::set<std::string> files;
  for (const exports::Format& format : exports::allFormats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_TRUE(files.insert(format.file).second) << format.file;
    EXPECT_EQ(exports::findFormat(format.name), &format);
  }
  EXPECT_EQ(exports::findFormat("model.ply"), nullptr);
}

TEST(Formats, FailWithoutTracesWhereNothingCanBeWritten) {
  for (const exports::Format& format : exports::allFormats()) {
    const TemporaryDirectory directory;
    EXPECT_EQ(statusOf(format, directory.file("none/a.x")), io::CannotCreate) << format.name;
    EXPECT_EQ(directory.countFiles(), 0u) << format.name;
    if (format.name == std::string("obj")) continue;  // it has a second file beside the device
    EXPECT_EQ(statusOf(format, "/dev/full"), io::IoError) << format.name;
  }
}

TEST(Formats, AreTheSameBytesEachTime) {
  const PolyhedralModel model = modelOf(synth::randomBuilding(3));
  for (const exports::Format& format : exports::allFormats()) {
    const TemporaryDirectory directory;
    for (const char* name : {"a.x", "b.x"}) format.write(directory.file(name), {model});
    // An OBJ names the library of its materials.
    std::string again = readAll(directory.file("b.x"));
    const std::size_t library = again.find("b.mtl");
    if (library != std::string::npos) again[library] = 'a';
    EXPECT_EQ(readAll(directory.file("a.x")), again) << format.name;
  }
}

}  // namespace
}  // namespace storey::test
