// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "view/stage_files.h"

namespace storey::view {

/// What report.json tells of a run, as far as pictures need it.
struct Report {
  std::string input;              ///< name of the cloud without its folders
  bool inside = false;            ///< the model is a space seen from inside
  double planar_threshold = 0.0;  ///< T_k, within [0, 1]
  std::vector<double> azimuths;   ///< of the dominant directions, degrees from +x to +y
  double slice_thickness = 0.0;   ///< length
  std::size_t num_slices = 0;
  std::vector<int> layer_types;  ///< floorplan type of each slice, or of each block; -1: none
  double grid = 0.0;             ///< unit of the model's coordinates, length
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of the local frame, in the input's
};

/// The files in a directory that storey_reconstruct wrote. All are read as untrusted.
class Reconstruction {
 public:
  /// Reads the report, without which a run did not come to its end.
  /// \throws io::Failure (BadInput, MissingInput, IoError), as all the others do
  explicit Reconstruction(const std::string& directory);

  const Report& report() const { return report_; }
  std::string file(const std::string& name) const { return directory_ + "/" + name; }
  bool has(const std::string& name) const;

  /// A cloud with labels from 0 to `num_labels`; others are refused.
  /// \param num_labels 0: any number
  StageCloud readLabels(const std::string& name, std::size_t num_labels,
                        const std::string& field = "label") const;
  /// The polygons of a model's file in the upright local frame.
  PolyhedralModel readModel(const std::string& name) const;
  /// Takes the input's coordinates to the upright local frame.
  Eigen::Isometry3d inputToLocal() const;

 private:
  std::string directory_;
  Report report_;
};

}  // namespace storey::view
