// SPDX-License-Identifier: BSD-3-Clause
// report.html as a browser shows it: no errors, the model drawn, and turned by the mouse.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/temporary_files.h"
#include "export/exported_models.h"
#include "export/report_page.h"
#include "io/failure.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

/// As storey_reconstruct tells it, with a file name that would end a script element.
Json makeReport() {
  return Json::parse(R"({
    "program": "storey", "peak_megabytes": 1.0,
    "input": {"file": "odd </script><b>name.ply", "points": 1000, "format": "ply"},
    "normals": {"estimated": true, "neighbors": 12},
    "vertical": {"deviation_deg": 0.01, "wall_share": 0.5},
    "space": {"side": "outside", "reason": "normals"},
    "scale": {"noise": 0.1, "spacing": 0.1, "extent": 10.0},
    "planar": {"points": 900}, "directions": [], "slices": {"count": 0},
    "building": {"wall_lines": [], "cells": 9, "layers": 2, "trade_off": [
      {"faces": 6, "types": 1, "energy": -10.0}, {"faces": 11, "types": 2, "energy": -14.0}]},
    "layers": {"types": 2, "trade_off": [], "blocks": [
      {"z_min": 0, "z_max": 2, "components": 1, "edges": 4, "area": 63},
      {"z_min": 2, "z_max": 8, "components": 1, "edges": 4, "area": 9}]},
    "levels": [{"z": 0, "wall_points": 9, "cap_points": 0, "deviation": null}],
    "walls": [{"wall": 1, "normal": [1, 0], "offset": 2, "points": 77, "residual": 0.1,
               "offset_deviation": null, "angle_deviation_deg": null}],
    "residuals": {"points": 6, "bin": 0.025, "counts": [3, 2, 1], "beyond": 0},
    "support": {"wall_share_seen": 0.9, "level_share_seen": null},
    "model": {"valid": true, "polygons": 11, "walls": 8, "roofs": 2, "grounds": 1, "ceilings": 0,
              "volume": 180.0},
    "seconds": {"read": 0.1, "total": 0.1}})");
}

std::string writePage(const TemporaryDirectory& directory) {
  exports::Exported exported{modelOf(stackedModels()[3].layers)};
  exported.local_to_input.translation() = Eigen::Vector3d(1e7, -3e7, 0.0);
  exported.report = makeReport().dump();
  exports::writeReportPage(directory.file("report.html"), exported);
  return directory.file("report.html");
}

// Put in before all other scripts: takes down what goes wrong.
constexpr const char* kWatch =
    "<script>window.problems = [];"
    "window.onerror = text => { problems.push(text); };"
    "console.error = (...text) => { problems.push(text.join(' ')); };"
    "const context = HTMLCanvasElement.prototype.getContext;"
    "HTMLCanvasElement.prototype.getContext = function (kind, options) {"
    "  return context.call(this, kind, {...options, preserveDrawingBuffer: true}); };"
    "</script>";

// And after them: drags over the canvas, and tells what came of it in place of the page.
constexpr const char* kDrag = R"(<script>
window.addEventListener('load', () => {
  const canvas = document.querySelector('#viewer canvas');
  const mouse = (target, kind, x, y) => target.dispatchEvent(new MouseEvent(kind,
      {bubbles: true, button: 0, clientX: x, clientY: y}));
  const box = canvas ? canvas.getBoundingClientRect() : {left: 0, top: 0, width: 0, height: 0};
  const middle = [box.left + box.width / 2, box.top + box.height / 2];
  const pixels = () => {
    if (!canvas) return {picture: '', colours: 0};
    const copy = document.createElement('canvas');
    copy.width = canvas.width;
    copy.height = canvas.height;
    copy.getContext('2d').drawImage(canvas, 0, 0);
    const data = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height).data;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) colours.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
    return {picture: copy.toDataURL(), colours: colours.size};
  };
  const before = pixels();
  const still = pixels();
  if (canvas) {
    mouse(canvas, 'mousedown', ...middle);
    mouse(canvas, 'mouseup', ...middle);
    mouse(document, 'mouseup', ...middle);
  }
  const picked = document.getElementById('picked').textContent;
  if (canvas) {
    mouse(canvas, 'mousedown', ...middle);
    mouse(document, 'mousemove', middle[0] + 120, middle[1] + 10);
    mouse(document, 'mouseup', middle[0] + 120, middle[1] + 10);
  }
  const after = pixels();
  const count = selector => document.querySelectorAll(selector).length;
  const result = {
    problems, colours: before.colours, still: before.picture === still.picture,
    turned: before.picture !== after.picture, picked,
    title: document.getElementById('title').textContent,
    stages: count('#stages tr'), storeys: count('#storeys tr'), walls: count('#walls tr'),
    bars: count('#residuals rect'), tradeOff: count('#trade_off circle'),
    plans: count('.plans g[id^=storey_]'), pictures: count('#pictures img'),
    loaded: [...document.images].every(image => image.naturalWidth > 0),
    outside: performance.getEntriesByType('resource').map(entry => entry.name)
        .filter(name => !name.startsWith('data:')),
  };
  document.body.textContent = '@@' + JSON.stringify(result) + '@@';
});
</script>)";

/// Opens the page in a browser of its own and gives what the script saw.
Json look(const TemporaryDirectory& directory, const std::string& path) {
  std::string page = readAll(path);
  page.insert(page.find("<style>"), kWatch);
  page.insert(page.rfind("</body>"), kDrag);
  const std::string opened = directory.write("opened.html", page);
  const std::string command =
      "HOME=" + directory.path() +
      " timeout 300 chromium --headless --no-sandbox --disable-dev-shm-usage --use-gl=angle "
      "--use-angle=swiftshader --enable-unsafe-swiftshader --window-size=1200,900 "
      "--virtual-time-budget=10000 --dump-dom 'file://" +
      opened + "' >" + directory.file("dom") + " 2>" + directory.file("log");
  EXPECT_EQ(std::system(command.c_str()), 0) << readAll(directory.file("log"));
  const std::string dom = readAll(directory.file("dom"));
  const std::size_t start = dom.find("@@");
  const std::size_t end = dom.rfind("@@");
  if (start == std::string::npos || end <= start) {
    ADD_FAILURE() << "the page did not come to its end: " << readAll(directory.file("log"));
    return {};
  }
  // HTML writes < > & as names.
  std::string text = dom.substr(start + 2, end - start - 2);
  for (const auto& [name, sign] :
       {std::pair<std::string, std::string>{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
      text.replace(at, name.size(), sign);
    }
  }
  return Json::parse(text);
}

bool haveChromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

TEST(ReportPage, ABrowserDrawsTheModelAndTheMouseTurnsIt) {
  if (!haveChromium()) GTEST_SKIP() << "there is no chromium";
  const TemporaryDirectory directory;
  const Json seen = look(directory, writePage(directory));
  EXPECT_EQ(seen["problems"], Json::array());
  EXPECT_EQ(seen["outside"], Json::array());
  EXPECT_EQ(seen["title"], "script><b>name.ply");  // what follows the last slash
  // Background, edges, roofs, and two sides of walls in two lights at the least.
  EXPECT_GE(seen["colours"].get<int>(), 5);
  EXPECT_TRUE(seen["still"].get<bool>());
  EXPECT_TRUE(seen["turned"].get<bool>());
  EXPECT_EQ(seen["picked"].get<std::string>().rfind("Face ", 0), 0u) << seen["picked"];
  EXPECT_EQ(seen["stages"], 1 + 2);
  EXPECT_EQ(seen["storeys"], 1 + 2);
  EXPECT_EQ(seen["walls"], 1 + 1);
  EXPECT_EQ(seen["bars"], 3);
  EXPECT_EQ(seen["tradeOff"], 2);
  EXPECT_EQ(seen["plans"], 2);
  EXPECT_EQ(seen["pictures"], 0);
}

/// The smallest PNG: one grey pixel.
constexpr unsigned char kPng[] = {0x89, 'P', 'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0,    0, 0, 0x0D,
                                  'I',  'H', 'D',  'R',  0,    0,    0,    1,    0,    0, 0, 1,
                                  8,    0,   0,    0,    0,    0x3A, 0x7E, 0x9B, 0x55, 0, 0, 0,
                                  0x0A, 'I', 'D',  'A',  'T',  0x78, 0x9C, 0x63, 0x68, 0, 0, 0,
                                  0x82, 0,   0x81, 0x77, 0xCD, 0x72, 0xB6, 0,    0,    0, 0, 'I',
                                  'E',  'N', 'D',  0xAE, 'B',  0x60, 0x82};

TEST(ReportPage, PicturesAreShownAndReplaced) {
  const TemporaryDirectory directory;
  const std::string path = writePage(directory);
  const std::string plain = readAll(path);
  const std::string png(reinterpret_cast<const char*>(kPng), sizeof kPng);
  const std::vector<std::string> pictures = {directory.write("a.png", png),
                                             directory.write("b.png", png)};
  exports::addPictures(path, pictures);
  const std::string with_two = readAll(path);
  exports::addPictures(path, pictures);
  EXPECT_EQ(readAll(path), with_two);
  if (haveChromium()) {
    const Json seen = look(directory, path);
    EXPECT_EQ(seen["problems"], Json::array());
    EXPECT_EQ(seen["pictures"], 2);
    EXPECT_TRUE(seen["loaded"].get<bool>());
  }
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
