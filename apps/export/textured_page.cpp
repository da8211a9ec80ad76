// SPDX-License-Identifier: BSD-3-Clause
#include "export/textured_page.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "export/page_parts.h"
#include "export/page_text.h"

namespace storey::exports {
namespace {

std::string describe(const std::vector<FacadeImage>& facades) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FacadeImage& image : facades) {
    list.push_back({{"facade", image.facade},
                    {"sheet", image.sheet},
                    {"left", image.left},
                    {"top", image.top},
                    {"columns", image.columns},
                    {"rows", image.rows},
                    {"texel", image.texel},
                    {"width", image.width},
                    {"height", image.height},
                    {"seen", image.seen}});
  }
  return list.dump();
}

Page pageAt(const std::string& path) {
  if (std::filesystem::exists(path)) return Page::read(path);
  return Page(fillPage(kTexturedTemplate, {{"style", kPageStyle},
                                           {"licence", kThreeLicence},
                                           {"three", kThree},
                                           {"orbit", kOrbitControls},
                                           {"turntable", kPageTurntable}}));
}

}  // namespace

void showTexturedModel(const std::string& path, const std::string& glb,
                       const std::vector<FacadeImage>& facades) {
  Page page = pageAt(path);
  page.replacePart(path, "textured",
                   fillPage(kTexturedSection, {{"facades", withoutTags(describe(facades))},
                                               {"glb", encodeBase64(glb)}}));
  page.replacePart(path, "textured_scripts",
                   "<script>\n" + std::string(kGltfLoader) + "\n</script>\n<script>\n" +
                       kTexturedViewer + "</script>");
  page.write(path);
}

}  // namespace storey::exports
