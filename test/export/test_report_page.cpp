// SPDX-License-Identifier: BSD-3-Clause
// report.html as a file.
#include <gtest/gtest.h>

#include "export/report_pages.h"
#include "io/failure.h"

namespace storey::test {
namespace {

TEST(ReportPage, PicturesAreReplaced) {
  const TemporaryDirectory directory;
  const std::string path = writePage(directory);
  const std::string plain = readAll(path);
  const std::vector<std::string> pictures = {writePng(directory, "a.png"),
                                             writePng(directory, "b.png")};
  exports::addPictures(path, pictures);
  const std::string with_two = readAll(path);
  EXPECT_GT(with_two.size(), plain.size() + 2 * sizeof kPng);
  exports::addPictures(path, pictures);
  EXPECT_EQ(readAll(path), with_two);
  exports::addPictures(path, {});
  EXPECT_EQ(readAll(path), plain);
}

TEST(ReportPage, OtherFilesAreNoReports) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("report.html", "<html>mine</html>");
  try {
    exports::addPictures(path, {});
    FAIL();
  } catch (const io::Failure& failure) {
    EXPECT_EQ(failure.status(), io::BadInput);
  }
  EXPECT_EQ(readAll(path), "<html>mine</html>");
}

TEST(ReportPage, CarriesTheLicenceOfWhatItCarries) {
  const TemporaryDirectory directory;
  const std::string page = readAll(writePage(directory));
  EXPECT_NE(page.find("three.js authors"), std::string::npos);
  EXPECT_NE(page.find("Permission is hereby granted"), std::string::npos);
}

}  // namespace
}  // namespace storey::test
