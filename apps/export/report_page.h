// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "export/exported.h"

namespace storey::exports {

/// Writes report.html: one file that needs nothing else to be looked at, no network either. The
/// model to be turned with the mouse (WebGL), the floorplans, and the numbers of `report` as tables
/// and charts. \throws io::Failure (CannotCreate, IoError)
void writeReportPage(const std::string& path, const Exported& exported);

/// Puts pictures into a page that `writeReportPage` wrote, in place of those it has.
/// \param pictures paths of PNG files, in the order in which they are shown
/// \throws io::Failure (BadInput if it is no such page, MissingInput, CannotCreate, IoError)
void addPictures(const std::string& path, const std::vector<std::string>& pictures);

}  // namespace storey::exports
