// SPDX-License-Identifier: BSD-3-Clause
// report.html in a browser: no errors, the model drawn, and turned by the mouse.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "export/report_pages.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

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

TEST(ReportBrowser, DrawsTheModelWhichTheMouseTurns) {
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

TEST(ReportBrowser, ShowsThePictures) {
  if (!haveChromium()) GTEST_SKIP() << "there is no chromium";
  const TemporaryDirectory directory;
  const std::string path = writePage(directory);
  exports::addPictures(path, {writePng(directory, "a.png"), writePng(directory, "b.png")});
  const Json seen = look(directory, path);
  EXPECT_EQ(seen["problems"], Json::array());
  EXPECT_EQ(seen["pictures"], 2);
  EXPECT_TRUE(seen["loaded"].get<bool>());
}

}  // namespace
}  // namespace storey::test
