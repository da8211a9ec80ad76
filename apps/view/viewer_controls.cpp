// SPDX-License-Identifier: BSD-3-Clause
#include "view/viewer_controls.h"

#include <algorithm>

#include "view/palette.h"
#include "view/sheet.h"

namespace storey::view {
namespace {

// Sizes in a window of 1600 x 1200.
constexpr double kHelpWidth = 1180.0;
constexpr double kKeyColumn = 110.0;
constexpr double kStageColumn = 640.0;
constexpr double kNameColumn = 60.0;

std::string stageText(const ViewerState::Entry& entry) {
  std::string text = infoOf(entry.stage).name;
  if (!entry.missing.empty()) text += "  (no " + entry.missing + ")";
  return text;
}

void addHelp(Sheet& sheet, const Layout& layout, const ViewerState& state) {
  const double u = layout.unit;
  const std::size_t rows = std::max(keyHelp().size(), state.entries().size());
  const double left = layout.left + kMargin * u;
  const double top = layout.top - kMargin * u;
  const double bottom = top - (static_cast<double>(rows) + 1.0) * kLine * u;
  const double right = left + kHelpWidth * u;
  sheet.rectangle({left, bottom}, {right, top}, {252, 252, 245});
  sheet.line({{left, bottom}, {right, bottom}, {right, top}, {left, top}, {left, bottom}}, kDark,
             1.5);
  const auto row = [&](std::size_t i) { return top - (static_cast<double>(i) + 1.0) * kLine * u; };
  const double x = left + kMargin * u;
  for (std::size_t i = 0; i < keyHelp().size(); ++i) {
    const auto& [key, text] = keyHelp()[i];
    sheet.text(key, {x, row(i)}, kFont, kKeyColumn * u, kDark);
    sheet.text(text, {x + kKeyColumn * u, row(i)}, kFont, (kStageColumn - kKeyColumn) * u, kDark);
  }
  for (std::size_t i = 0; i < state.entries().size(); ++i) {
    const ViewerState::Entry& entry = state.entries()[i];
    const Colour colour = entry.missing.empty() ? kDark : Colour{165, 165, 170};
    const int number = infoOf(entry.stage).number;
    const double at = left + kStageColumn * u;
    sheet.text(std::to_string(number > 9 ? 0 : number), {at, row(i)}, kFont, kNameColumn * u,
               colour);
    sheet.text((entry.stage == state.stage() ? "> " : "") + stageText(entry),
               {at + kNameColumn * u, row(i)}, kFont, right - at - (kNameColumn + kMargin) * u,
               colour);
  }
}

}  // namespace

void addControls(vtkRenderer& renderer, const Layout& layout, const ViewerState& state,
                 const std::string& status) {
  constexpr double kKeysLeft = 800.0;
  constexpr const char* kKeys =
      "n p: stage    + -: slice    c: colours    o: cloud    w: save    h: help";
  Sheet sheet(renderer, layout);
  const double u = layout.unit;
  sheet.text(status.empty() ? kKeys : status, {kKeysLeft * u, 30.0 * u}, kFont,
             layout.width - (kKeysLeft + kMargin) * u, kGrey);
  if (state.help()) addHelp(sheet, layout, state);
}

}  // namespace storey::view
