// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/temporary_files.h"

namespace storey::test {

// Put in before all other scripts: takes down what goes wrong.
constexpr const char* kWatch =
    "<script>window.problems = [];"
    "window.onerror = text => { problems.push(text); };"
    "console.error = (...text) => { problems.push(text.join(' ')); };"
    "const context = HTMLCanvasElement.prototype.getContext;"
    "HTMLCanvasElement.prototype.getContext = function (kind, options) {"
    "  return context.call(this, kind, {...options, preserveDrawingBuffer: true}); };"
    "</script>";

/// Opens the page in a browser of its own, with a script put after all others, and gives what the
/// script leaves between two @@ as the text of the page.
inline nlohmann::json look(const TemporaryDirectory& directory, const std::string& path,
                           const std::string& script) {
  std::string page = readAll(path);
  page.insert(page.find("<style>"), kWatch);
  page.insert(page.rfind("</body>"), script);
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
  return nlohmann::json::parse(text);
}

inline bool haveChromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

}  // namespace storey::test
