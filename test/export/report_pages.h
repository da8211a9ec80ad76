// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/temporary_files.h"
#include "export/exported_models.h"
#include "export/report_page.h"

/// A page to look at: a tower on a podium, far from the origin.
namespace storey::test {

/// As storey_reconstruct tells it, with a file name that would end a script element.
inline std::string makeReport() {
  return R"({
    "program": "storey", "peak_megabytes": 1.0,
    "input": {"file": "odd </script><b>name.ply", "points": 1000, "format": "ply",
              "declared": 5000, "thinned_out": 4000, "fitted_to_all": true},
    "normals": {"estimated": true, "neighbors": 12},
    "vertical": {"deviation_deg": 0.01, "wall_share": 0.5},
    "space": {"side": "outside", "reason": "normals"},
    "scale": {"noise": 0.1, "spacing": 0.1, "extent": 10.0},
    "planar": {"points": 900}, "directions": [], "slices": {"count": 0},
    "building": {"wall_lines": [], "cells": 9, "layers": 2, "trade_off": [
      {"faces": 6, "types": 1, "energy": -10.0}, {"faces": 11, "types": 2, "energy": -14.0}]},
    "layers": {"types": 2, "trade_off": [], "blocks": [
      {"z_min": 0, "z_max": 2, "components": 1, "edges": 4, "area": 63},
      {"z_min": 2, "z_max": 8, "components": 1, "edges": 4, "area": 9}]},
    "levels": [{"z": 0, "wall_points": 9, "cap_points": 0, "deviation": null}],
    "walls": [{"wall": 1, "normal": [1, 0], "offset": 2, "points": 77, "residual": 0.1,
               "offset_deviation": null, "angle_deviation_deg": null}],
    "residuals": {"points": 6, "bin": 0.025, "counts": [3, 2, 1], "beyond": 0},
    "support": {"wall_share_seen": 0.9, "level_share_seen": null},
    "model": {"valid": true, "polygons": 11, "walls": 8, "roofs": 2, "grounds": 1, "ceilings": 0,
              "volume": 180.0},
    "seconds": {"read": 0.1, "model": 0.1, "total": 0.2}})";
}

inline std::string writePage(const TemporaryDirectory& directory) {
  exports::Exported exported{modelOf(stackedModels()[3].layers)};
  exported.local_to_input.translation() = Eigen::Vector3d(1e7, -3e7, 0.0);
  exported.report = makeReport();
  exports::writeReportPage(directory.file("report.html"), exported);
  return directory.file("report.html");
}

/// The smallest PNG: one grey pixel.
constexpr unsigned char kPng[] = {0x89, 'P', 'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0,    0, 0, 0x0D,
                                  'I',  'H', 'D',  'R',  0,    0,    0,    1,    0,    0, 0, 1,
                                  8,    0,   0,    0,    0,    0x3A, 0x7E, 0x9B, 0x55, 0, 0, 0,
                                  0x0A, 'I', 'D',  'A',  'T',  0x78, 0x9C, 0x63, 0x68, 0, 0, 0,
                                  0x82, 0,   0x81, 0x77, 0xCD, 0x72, 0xB6, 0,    0,    0, 0, 'I',
                                  'E',  'N', 'D',  0xAE, 'B',  0x60, 0x82};

inline std::string writePng(const TemporaryDirectory& directory, const std::string& name) {
  return directory.write(name, std::string(reinterpret_cast<const char*>(kPng), sizeof kPng));
}

}  // namespace storey::test
