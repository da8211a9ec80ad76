// SPDX-License-Identifier: BSD-3-Clause
// The textured model in a browser: drawn by three.js and its reader of glTF in the colours of its
// images, and its facades, in which lengths are measured.
#include <gtest/gtest.h>

#include "apps/painted_model.h"
#include "export/browser.h"
#include "export/report_pages.h"
#include "io/model_io.h"

namespace storey::texture {
namespace {

// Waits for the images, then drags over the first facade from a quarter of its width to three.
constexpr const char* kMeasure = R"(<script>
const wait = setInterval(() => {
  const facades = [...document.querySelectorAll('.facade canvas')];
  const view = document.querySelector('#textured_viewer canvas');
  if (facades.length === 0 || !view) return;
  clearInterval(wait);
  const colours = canvas => {
    const copy = document.createElement('canvas');
    copy.width = canvas.width;
    copy.height = canvas.height;
    copy.getContext('2d').drawImage(canvas, 0, 0);
    return copy.getContext('2d').getImageData(0, 0, copy.width, copy.height).data;
  };
  const counts = new Map();
  const data = colours(view);
  for (let i = 0; i < data.length; i += 4) {
    const colour = [data[i], data[i + 1], data[i + 2]].join();
    counts.set(colour, (counts.get(colour) || 0) + 1);
  }
  const shown = [...counts].filter(([, count]) => count > data.length / 4 / 100)
      .map(([colour]) => colour.split(',').map(Number));  // edges are mixed from faces
  const middles = facades.map(canvas => {
    const at = 4 * (Math.floor(canvas.height / 2) * canvas.width + Math.floor(canvas.width / 2));
    return [...colours(canvas).slice(at, at + 3)];
  });
  const first = facades[0];
  const mouse = (kind, share) => {
    const box = first.getBoundingClientRect();
    first.dispatchEvent(new MouseEvent(kind, {bubbles: true, button: 0,
        clientX: box.left + share * box.width, clientY: box.top + box.height / 2}));
  };
  mouse('mousedown', 0.25);
  mouse('mousemove', 0.75);
  const result = {problems, middles, shown,
    caption: document.querySelector('figcaption').textContent,
    bar: document.querySelector('.scale').clientWidth / first.clientWidth,
    models: document.querySelectorAll('#viewer canvas').length,
    outside: performance.getEntriesByType('resource').map(entry => entry.name)
        .filter(name => !name.startsWith('data:') && !name.startsWith('blob:'))};
  document.body.textContent = '@@' + JSON.stringify(result) + '@@';
}, 50);
</script>)";

/// A box of 4 x 3 x 6, each face of one colour.
PaintedModel plainBox() {
  io::PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back(1e6 + (i & 1) * 4.0, (i & 2) * 1.5, (i & 4) * 1.5);
  }
  const std::vector<std::vector<int>> faces = {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7},
                                               {2, 0, 4, 6}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  for (std::size_t f = 0; f < 6; ++f) {
    const std::uint8_t label = f < 4 ? 0 : static_cast<std::uint8_t>(f - 3);
    soup.polygons.push_back({faces[f], label, -1, 0, false});
  }
  PaintedModel box(soup, Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::size_t i = 0; i < box.textures[f].states.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        box.textures[f].image.channels[3 * i + c] = static_cast<std::uint8_t>(40 * f + 15 * c);
      }
    }
  }
  return box;
}

bool isColourOf(const nlohmann::json& colour, std::size_t face) {
  constexpr int kJpeg = 3;  // grey levels
  for (std::size_t c = 0; c < 3; ++c) {
    const int off = colour[c].get<int>() - static_cast<int>(40 * face + 15 * c);
    if (std::abs(off) > kJpeg) return false;
  }
  return true;
}

void expectTexturedModel(const nlohmann::json& seen) {
  EXPECT_EQ(seen["problems"], nlohmann::json::array());
  EXPECT_EQ(seen["outside"], nlohmann::json::array());
  // From the front, the right and above, as three.js draws it: faces 0, 1 and 4 and no others.
  for (std::size_t face = 0; face < 6; ++face) {
    bool shown = false;
    for (const auto& colour : seen["shown"]) shown |= isColourOf(colour, face);
    EXPECT_EQ(shown, face == 0 || face == 1 || face == 4) << face;
  }
  // Walls come first, the largest of them first; of two alike, the one with the lower number.
  const std::vector<std::size_t> order = {0, 2, 1, 3, 4, 5};
  ASSERT_EQ(seen["middles"].size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_TRUE(isColourOf(seen["middles"][i], order[i])) << seen["middles"][i];
  }
  const std::string caption = seen["caption"];
  EXPECT_NE(caption.find("4 wide, 6 high, 100 % seen; bar 1,"), std::string::npos) << caption;
  // Half of the width of 4, to a pixel of the screen.
  const double measured = std::stod(caption.substr(caption.find("measured ") + 9));
  EXPECT_NEAR(measured, 2.0, 0.15);
  EXPECT_NEAR(seen["bar"].get<double>(), 1.0 / 4.0, 0.03);
}

TEST(TexturedBrowser, DrawsTheModelAndMeasuresInFacades) {
  if (!test::haveChromium()) GTEST_SKIP() << "there is no chromium";
  const test::TemporaryDirectory directory;
  const PaintedModel box = plainBox();
  writeTexturedModel(directory.path(), box.soup, box.model, box.textures, Eigen::Vector3d::UnitZ());
  const auto seen = test::look(directory, directory.file("report.html"), kMeasure);
  expectTexturedModel(seen);
  EXPECT_EQ(seen["models"], 0);
}

TEST(TexturedBrowser, IsPartOfTheReportThatIsThere) {
  if (!test::haveChromium()) GTEST_SKIP() << "there is no chromium";
  const test::TemporaryDirectory directory;
  const std::string page = test::writePage(directory);
  const PaintedModel box = plainBox();
  for (int time = 0; time < 2; ++time) {  // the second takes the place of the first
    writeTexturedModel(directory.path(), box.soup, box.model, box.textures,
                       Eigen::Vector3d::UnitZ());
  }
  const auto seen = test::look(directory, page, kMeasure);
  expectTexturedModel(seen);
  EXPECT_EQ(seen["models"], 1);
}

}  // namespace
}  // namespace storey::texture
