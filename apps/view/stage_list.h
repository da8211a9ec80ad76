// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace storey::view {

/// What a picture can show of a directory that storey_reconstruct left.
enum class Stage {
  Upright,
  Confidence,
  Classes,
  Directions,
  Slices,
  Normals,
  Labels,
  Regions,
  Refined,
  Slice,
  Segments,
  Walls,
  Cells,
  Floorplans,
  Types,
  Model,
  Support,
  Deviation,
  Windows,
  Textured,
  Overlay
};

struct StageInfo {
  Stage stage;
  const char* name;                ///< on the command line
  int number;                      ///< of the step of the method, as in the names of the files
  std::vector<std::string> files;  ///< that it is drawn from, besides report.json
};

/// All stages, in the order of the method.
const std::vector<StageInfo>& allStages();

const StageInfo& infoOf(Stage stage);

/// Whether it is drawn in plan, one slice or block at a time.
bool isPlan(Stage stage);

/// Whether it shows surfaces or lines that the cloud can be laid over.
bool canOverlay(Stage stage);

}  // namespace storey::view
