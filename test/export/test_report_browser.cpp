// SPDX-License-Identifier: BSD-3-Clause
// report.html in a browser: no errors, the model drawn, and turned by the mouse.
#include <gtest/gtest.h>

#include "export/browser.h"
#include "export/report_pages.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

// Drags over the canvas, and tells what came of it in place of the page.
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
    summary: document.getElementById('summary').textContent,
    found: [...document.querySelectorAll('#stages td:nth-child(2)')].map(cell => cell.textContent),
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

TEST(ReportBrowser, DrawsTheModelWhichTheMouseTurns) {
  if (!haveChromium()) GTEST_SKIP() << "there is no chromium";
  const TemporaryDirectory directory;
  const Json seen = look(directory, writePage(directory), kDrag);
  EXPECT_EQ(seen["problems"], Json::array());
  EXPECT_EQ(seen["outside"], Json::array());
  EXPECT_EQ(seen["title"], "script><b>name.ply");  // what follows the last slash
  // Background, edges, roofs, and two sides of walls in two lights at the least.
  EXPECT_GE(seen["colours"].get<int>(), 5);
  EXPECT_TRUE(seen["still"].get<bool>());
  EXPECT_TRUE(seen["turned"].get<bool>());
  EXPECT_EQ(seen["picked"].get<std::string>().rfind("Face ", 0), 0u) << seen["picked"];
  EXPECT_EQ(seen["summary"].get<std::string>().rfind("1000 of 5000 points to 11 polygons", 0), 0u);
  EXPECT_EQ(seen["found"][0], "1000 of 5000 points, ply");
  EXPECT_EQ(seen["found"][1], "8 walls, 2 roofs, 1 ground, 0 ceilings, fitted to all points");
  EXPECT_EQ(seen["stages"], 1 + 3);
  EXPECT_EQ(seen["storeys"], 1 + 2);
  EXPECT_EQ(seen["walls"], 1 + 1);
  EXPECT_EQ(seen["bars"], 3);
  EXPECT_EQ(seen["tradeOff"], 2);
  EXPECT_EQ(seen["plans"], 2);
  EXPECT_EQ(seen["pictures"], 0);
}

TEST(ReportBrowser, ShowsThePictures) {
  if (!haveChromium()) GTEST_SKIP() << "there is no chromium";
  const TemporaryDirectory directory;
  const std::string path = writePage(directory);
  exports::addPictures(path, {writePng(directory, "a.png"), writePng(directory, "b.png")});
  const Json seen = look(directory, path, kDrag);
  EXPECT_EQ(seen["problems"], Json::array());
  EXPECT_EQ(seen["pictures"], 2);
  EXPECT_TRUE(seen["loaded"].get<bool>());
}

}  // namespace
}  // namespace storey::test
