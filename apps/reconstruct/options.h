// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/layerwise_floorplan_extraction.h>
#include <storey/surface/floorplan_grammar.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "export/formats.h"

namespace storey::reconstruct {

/// What encloses the points: a building seen from outside, or a space (room, yard) from inside.
enum class SpaceSide { Auto, Outside, Inside };

/// Where the floorplans come from: the walls of the whole building, or slice by slice as the paper.
enum class Method { Building, Paper };

/// Everything a user can set. Lengths are in the cloud's unit; 0 derives them from the cloud.
struct Options {
  std::string input;
  std::string output_directory;
  std::vector<exports::Format> formats;
  int epsg = 0;  ///< coordinate reference system of the cloud; 0: not known
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< zero: found from the walls
  SpaceSide side = SpaceSide::Auto;
  Method method = Method::Building;
  double block_cost = 0.0;        ///< wall area, squared unit of the cloud
  bool estimate_normals = false;  ///< even if the file has some
  double noise = 0.0;
  double kept_share = 0.85;
  double slice_thickness = 0.0;
  double smoothness = 0.1;
  double label_cost = 0.5;
  int max_types = 0;       ///< of floorplans; 0: no limit
  int max_faces = 0;       ///< method building: of the model; 0: no limit
  bool trade_off = false;  ///< method building: report the whole trade-off
  double grid = 0.0;
  FloorplanGrammar::Encoding encoding = FloorplanGrammar::Encoding::Walls;
  detail::LinkingMethod linking = detail::LinkingMethod::Optimal;
  bool expansion = false;  ///< minimise by alpha-expansion instead of exactly
  unsigned int threads = 0;
  bool intermediate = false;
  bool quiet = false;
};

/// Reads the command line. \return false if help or the version was asked for and printed
/// \throws io::Failure (Usage)
bool parseOptions(int argc, char** argv, Options& options);

}  // namespace storey::reconstruct
