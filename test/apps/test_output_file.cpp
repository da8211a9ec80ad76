// SPDX-License-Identifier: BSD-3-Clause
// A file is there completely or not at all, whatever happens on the way.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <functional>
#include <limits>

#include "io/cloud_writer.h"
#include "io/failure.h"
#include "io/output_file.h"
#include "temporary_files.h"

namespace storey {
namespace {

using io::Failure;
using io::OutputDirectory;
using io::OutputFile;
using test::readAll;
using test::TemporaryDirectory;

constexpr std::size_t kLarge = 3u << 20;  // more than any buffer on the way

int statusOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Failure& failure) {
    EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos);
    return failure.status();
  }
  return io::Ok;
}

void writeFile(const std::string& path, const std::string& content) {
  OutputFile file(path);
  file.write(content);
  file.commit();
}

TEST(OutputFile, AppearsWithItsWholeContentAtCommit) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.txt");
  std::string expected;
  {
    OutputFile file(path);
    for (int i = 0; i < 100000; ++i) {
      file.writeNumber(static_cast<long long>(i));
      file.write("\n");
      expected += std::to_string(i) + "\n";
    }
    const std::string large(kLarge, 'x');
    file.write(large);
    expected += large;
    EXPECT_NE(access(path.c_str(), F_OK), 0) << "there before the commit";
    file.commit();
  }
  EXPECT_EQ(readAll(path), expected);
  EXPECT_EQ(directory.countFiles(), 1u);
}

TEST(OutputFile, WithoutCommitNothingChanges) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "old");
  { OutputFile(path).write(std::string(kLarge, 'x')); }
  try {
    OutputFile file(path);
    file.write("new");
    throw std::runtime_error("on the way");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(readAll(path), "old");
  EXPECT_EQ(directory.countFiles(), 1u);
}

TEST(OutputFile, ReplacesAnOlderFileAndFollowsLinks) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "old");
  const std::string link = directory.file("link");
  ASSERT_EQ(symlink(path.c_str(), link.c_str()), 0);
  writeFile(link, "new");
  EXPECT_EQ(readAll(path), "new");
  struct stat status {};
  ASSERT_EQ(lstat(link.c_str(), &status), 0);
  EXPECT_TRUE(S_ISLNK(status.st_mode));
}

TEST(OutputFile, NumbersReadBackExactly) {
  const TemporaryDirectory directory;
  const double values[] = {0.0, -0.0, 0.1, 1.0 / 3.0, 5411987.654321, 1e-308, 4.9e-324, 1.7e308};
  for (const double value : values) {
    OutputFile file(directory.file("n"));
    file.writeNumber(value);
    file.commit();
    const std::string text = readAll(directory.file("n"));
    double back = -1.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value) << text;
    EXPECT_EQ(std::signbit(back), std::signbit(value)) << text;
  }
}

TEST(OutputFile, WhatCannotBeCreatedIsSaid) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("file", "x");
  EXPECT_EQ(statusOf([&] { writeFile(directory.path(), "x"); }), io::CannotCreate);
  EXPECT_EQ(statusOf([&] { writeFile(directory.file("no/such/a.txt"), "x"); }), io::CannotCreate);
  EXPECT_EQ(statusOf([&] { writeFile(file + "/a.txt", "x"); }), io::CannotCreate);
  EXPECT_EQ(statusOf([&] { writeFile("", "x"); }), io::CannotCreate);
  EXPECT_EQ(directory.countFiles(), 1u);
}

TEST(OutputFile, FullDeviceIsNoticed) {
  if (access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(statusOf([] { writeFile("/dev/full", "one byte is enough"); }), io::IoError);
  EXPECT_EQ(statusOf([] { writeFile("/dev/full", std::string(kLarge, 'x')); }), io::IoError);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({1, 2, 3});
  EXPECT_EQ(statusOf([&] { io::writeCloud("/dev/full", cloud); }), io::IoError);
  struct stat status {};
  ASSERT_EQ(stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode)) << "the device was replaced by a file";
}

TEST(OutputFile, DevicesAreWrittenDirectly) {
  EXPECT_EQ(statusOf([] { writeFile("/dev/null", "x"); }), io::Ok);
}

// A limit on the size of files stands for a disk that fills up at any point of the writing.
TEST(OutputFile, RunningOutOfRoomAnywhereLeavesTheOldFile) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "old");
  for (const rlim_t room : {rlim_t{0}, rlim_t{1}, rlim_t{4096}, rlim_t{kLarge - 1}}) {
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGXFSZ, SIG_IGN);
      const rlimit rule{room, room};
      setrlimit(RLIMIT_FSIZE, &rule);
      _exit(statusOf([&] { writeFile(path, std::string(kLarge, 'x')); }));
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), io::IoError) << "room for " << room;
    EXPECT_EQ(readAll(path), "old");
    EXPECT_EQ(directory.countFiles(), 1u);
  }
}

TEST(OutputDirectory, IsMadeWithItsParents) {
  const TemporaryDirectory directory;
  const OutputDirectory made(directory.file("a/b/c"));
  writeFile(made.file("x.txt"), "x");
  EXPECT_EQ(readAll(directory.file("a/b/c/x.txt")), "x");
  EXPECT_EQ(statusOf([&] { OutputDirectory again(made.path()); }), io::Ok);
  EXPECT_EQ(statusOf([&] { OutputDirectory on_file(made.file("x.txt")); }), io::CannotCreate);
  EXPECT_EQ(statusOf([&] { OutputDirectory below(made.file("x.txt/d")); }), io::CannotCreate);
  EXPECT_EQ(statusOf([&] { OutputDirectory none(""); }), io::CannotCreate);
}

}  // namespace
}  // namespace storey
