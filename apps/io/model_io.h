// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "io/limits.h"
#include "io/polygon_soup.h"

namespace storey::io {

enum class PlyEncoding { Ascii, Binary };

/// The faces of a model as hole-free planar polygons over the model's vertices: faces with holes
/// are cut (`splitHoles`), without new vertices and without new free edges.
PolygonSoup toPolygons(const PolyhedralModel& model);

/// Writes polygons as PLY: `double x y z` and, for each face, the list `vertex_indices` and the
/// properties label, wall, shell, hypothetical as in `PolygonSoup::Polygon`; of models that were
/// fitted to points also support, coverage, residual and deviation of the faces, and the deviation
/// of the vertices. Ascii numbers are the shortest that read back exactly; unknown is `inf`.
/// \param local_to_input takes the vertices to the coordinates of the input cloud
/// \throws Failure (CannotCreate, IoError)
void writePolygonsPly(const std::string& path, const PolygonSoup& soup,
                      const Eigen::Isometry3d& local_to_input,
                      PlyEncoding encoding = PlyEncoding::Ascii);

/// Writes polygons as OBJ: an object `shell_k` for each shell, in it a group for each label (wall,
/// roof, ground, ceiling, window, reveal, with the second group name `hypothetical` for walls not
/// seen). \param materials name of a library that has a material named like each label, and one
/// with
///        `_hypothetical` after it; empty: none
/// \throws Failure (CannotCreate, IoError)
void writePolygonsObj(const std::string& path, const PolygonSoup& soup,
                      const Eigen::Isometry3d& local_to_input, const std::string& materials = {});

void writeModelPly(const std::string& path, const PolyhedralModel& model,
                   const Eigen::Isometry3d& local_to_input,
                   PlyEncoding encoding = PlyEncoding::Ascii);

/// The frame that floorplans are written in: the input's if `local_to_input` keeps the vertical,
/// else the upright one (the identity).
Eigen::Isometry3d planFrame(const Eigen::Isometry3d& local_to_input);

/// The wall face of the model that lies on an edge of a floorplan, at the middle of both; null if
/// there is none.
const PolyhedralFace* wallFaceAt(const PolyhedralModel& model, const FloorplanLayer& layer,
                                 const FloorplanRing& ring, std::size_t edge);

/// Writes the floorplans of a model as GeoJSON: a Feature for each storey, its geometry a
/// MultiPolygon with outer rings counter-clockwise and holes clockwise; properties z_min, z_max,
/// area, perimeter, and `walls`, `hypothetical`, `coverage`, `deviation`: the wall's id and what
/// `PolyhedralFace` says of the model's face there, nested polygon / ring / edge, edge i from
/// corner i to corner i + 1 (null: no face or not known). If `local_to_input` keeps the vertical,
/// coordinates are the input's own. If not (the cloud was turned upright), they are the upright
/// frame's. The member `frame_to_input` of the collection, a 4 x 4 matrix by rows, takes the
/// written coordinates to the input's in either case. \param crs of the input's coordinates, any
/// text; empty: not known. \throws Failure (CannotCreate, IoError)
void writeFloorplansGeoJson(const std::string& path, const PolyhedralModel& model,
                            const Eigen::Isometry3d& local_to_input, const std::string& crs = {});

struct PolygonReaderOptions {
  std::uint64_t max_bytes = kDefaultMaxFileBytes;
  std::uint64_t max_memory = defaultMaxMemory();
};

/// Reads a polygon mesh from a PLY (ascii, binary of both byte orders, float or double) or OBJ
/// file, told apart by content. Label, wall, shell and hypothetical are read where the file has
/// them; of an OBJ, shells are its objects and labels its groups. Material files are never opened.
/// Every vertex must be finite, every index in range, every polygon have 3 distinct corners.
/// \throws Failure (BadInput, MissingInput, IoError)
PolygonSoup readPolygons(const std::string& path, const PolygonReaderOptions& options = {});

}  // namespace storey::io
