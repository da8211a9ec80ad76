// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: dxflib writes to the final name with an unchecked stream, and what is needed of
// the format is a header, a table of layers and one kind of entity.
#include "export/dxf.h"

#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

// A DXF is a list of pairs: a group code, and on the next line its value.
class DxfFile {
 public:
  explicit DxfFile(const std::string& path) : file_(path) {}

  void put(int code, const std::string& value) {
    file_.write(std::to_string(code) + "\n" + value + "\n");
  }
  void put(int code, const char* value) { put(code, std::string(value)); }
  void put(int code, int value) { put(code, std::to_string(value)); }
  void put(int code, double value) {
    file_.write(std::to_string(code) + "\n");
    file_.writeNumber(value);
    file_.write("\n");
  }
  void put(const Eigen::Vector3d& point) {
    for (int axis = 0; axis < 3; ++axis) put(10 * (axis + 1), point[axis]);
  }
  void commit() { file_.commit(); }

 private:
  io::OutputFile file_;
};

std::string layerName(std::size_t storey) { return "STOREY_" + std::to_string(storey); }

void writeHeader(DxfFile& dxf, const Eigen::AlignedBox3d& box) {
  dxf.put(0, "SECTION");
  dxf.put(2, "HEADER");
  dxf.put(9, "$ACADVER");
  dxf.put(1, "AC1009");  // R12
  dxf.put(9, "$EXTMIN");
  dxf.put(box.min());
  dxf.put(9, "$EXTMAX");
  dxf.put(box.max());
  dxf.put(0, "ENDSEC");
}

void writeLayerTable(DxfFile& dxf, std::size_t count) {
  constexpr int kNumColours = 6;  // 1 to 6 of the colour index: red to magenta
  dxf.put(0, "SECTION");
  dxf.put(2, "TABLES");
  dxf.put(0, "TABLE");
  dxf.put(2, "LAYER");
  dxf.put(70, static_cast<int>(count));
  for (std::size_t storey = 0; storey < count; ++storey) {
    dxf.put(0, "LAYER");
    dxf.put(2, layerName(storey));
    dxf.put(70, 0);
    dxf.put(62, 1 + static_cast<int>(storey) % kNumColours);
    dxf.put(6, "CONTINUOUS");
  }
  dxf.put(0, "ENDTAB");
  dxf.put(0, "ENDSEC");
}

void writePolyline(DxfFile& dxf, const std::string& layer, const FloorplanRing& ring,
                   const FloorplanLayer& storey, const Eigen::Isometry3d& frame) {
  const auto place = [&](const Eigen::Vector2d& corner) -> Eigen::Vector3d {
    return frame * Eigen::Vector3d(corner.x(), corner.y(), storey.z_min);
  };
  dxf.put(0, "POLYLINE");
  dxf.put(8, layer);
  dxf.put(66, 1);  // vertices follow
  dxf.put(Eigen::Vector3d(0.0, 0.0, place(ring.vertices[0]).z()));
  dxf.put(39, storey.z_max - storey.z_min);
  dxf.put(70, 1);  // closed
  for (const Eigen::Vector2d& corner : ring.vertices) {
    dxf.put(0, "VERTEX");
    dxf.put(8, layer);
    dxf.put(place(corner));
  }
  dxf.put(0, "SEQEND");
  dxf.put(8, layer);
}

Eigen::AlignedBox3d boxOf(const std::vector<FloorplanLayer>& storeys,
                          const Eigen::Isometry3d& frame) {
  Eigen::AlignedBox3d box;
  for (const FloorplanLayer& storey : storeys) {
    for (const FloorplanComponent& component : storey.plan.components) {
      for (const Eigen::Vector2d& v : component.outer.vertices) {
        box.extend(frame * Eigen::Vector3d(v.x(), v.y(), storey.z_min));
        box.extend(frame * Eigen::Vector3d(v.x(), v.y(), storey.z_max));
      }
    }
  }
  return box;
}

}  // namespace

void writeDxf(const std::string& path, const Exported& exported) {
  const std::vector<FloorplanLayer>& storeys = exported.model.storeys;
  const Eigen::Isometry3d frame = io::planFrame(exported.local_to_input);
  DxfFile dxf(path);
  constexpr std::size_t kMaxValue = 255;  // characters of R12
  for (std::size_t at = 0; at < exported.crs.size(); at += kMaxValue) {
    dxf.put(999, exported.crs.substr(at, kMaxValue));  // a comment
  }
  writeHeader(dxf, boxOf(storeys, frame));
  writeLayerTable(dxf, storeys.size());
  dxf.put(0, "SECTION");
  dxf.put(2, "ENTITIES");
  for (std::size_t k = 0; k < storeys.size(); ++k) {
    for (const FloorplanComponent& component : storeys[k].plan.components) {
      writePolyline(dxf, layerName(k), component.outer, storeys[k], frame);
      for (const FloorplanRing& hole : component.holes) {
        writePolyline(dxf, layerName(k), hole, storeys[k], frame);
      }
    }
  }
  dxf.put(0, "ENDSEC");
  dxf.put(0, "EOF");
  dxf.commit();
}

}  // namespace storey::exports
