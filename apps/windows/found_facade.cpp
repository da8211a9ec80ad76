// SPDX-License-Identifier: BSD-3-Clause
#include "windows/found_facade.h"

#include <algorithm>

namespace storey::windows {

const WindowChange* FoundFacade::change(const FacadeWindow& window) const {
  const auto made =
      std::find_if(edit.changes.begin(), edit.changes.end(),
                   [&window](const WindowChange& candidate) { return candidate.isOf(window); });
  return made == edit.changes.end() ? nullptr : &*made;
}

Eigen::AlignedBox2d FoundFacade::rectangle(const FacadeWindow& window) const {
  const WindowChange* const made = change(window);
  return made != nullptr && made->rectangle ? *made->rectangle
                                            : Eigen::AlignedBox2d(window.min, window.max);
}

bool FoundFacade::isKept(const FacadeWindow& window) const {
  const WindowChange* const made = change(window);
  return made != nullptr && made->keep ? *made->keep : !window.doubtful;
}

bool FoundFacade::isDropped(const FacadeWindow& window) const {
  const WindowChange* const made = change(window);
  return made != nullptr && made->keep == false;
}

WindowGrid FoundFacade::changed() const {
  WindowGrid grid = found;
  grid.windows.clear();
  for (FacadeWindow window : found.windows) {
    if (isDropped(window)) continue;
    const Eigen::AlignedBox2d box = rectangle(window);
    window.doubtful = !isKept(window);
    window.min = box.min();
    window.max = box.max();
    grid.windows.push_back(window);
  }
  return grid;
}

}  // namespace storey::windows
