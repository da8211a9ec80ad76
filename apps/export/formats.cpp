// SPDX-License-Identifier: BSD-3-Clause
#include "export/formats.h"

#include <filesystem>

#include "export/city_json.h"
#include "export/dxf.h"
#include "export/gltf.h"
#include "export/obj.h"
#include "export/report_page.h"
#include "export/stl.h"
#include "export/svg.h"
#include "export/vtk.h"
#include "io/model_io.h"

namespace storey::exports {
namespace {

void writePly(const std::string& path, const Exported& exported) {
  io::writePolygonsPly(path, io::toPolygons(exported.model, exported.crs), exported.local_to_input);
}

void writeGeoJson(const std::string& path, const Exported& exported) {
  io::writeFloorplansGeoJson(path, exported.model, exported.local_to_input, exported.crs);
}

}  // namespace

const std::vector<Format>& allFormats() {
  static const std::vector<Format> formats = {{"ply", "model.ply", writePly},
                                              {"obj", "model.obj", writeObj},
                                              {"cityjson", "model.city.json", writeCityJson},
                                              {"gltf", "model.glb", writeGltf},
                                              {"stl", "model.stl", writeStl},
                                              {"vtk", "model.vtk", writeVtk},
                                              {"geojson", "floorplans.geojson", writeGeoJson},
                                              {"svg", "floorplans.svg", writeSvg},
                                              {"dxf", "floorplans.dxf", writeDxf},
                                              {"html", "report.html", writeReportPage}};
  return formats;
}

const Format* findFormat(const std::string& name) {
  for (const Format& format : allFormats()) {
    if (name == format.name) return &format;
  }
  return nullptr;
}

const Format* formatOfFile(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const Format& format : allFormats()) {
    if (std::filesystem::path(format.file).extension() == extension) return &format;
  }
  return nullptr;
}

}  // namespace storey::exports
