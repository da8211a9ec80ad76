// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/polyhedral_model.h>

#include <array>
#include <vector>

namespace storey {

/// Cuts a face into triangles without new vertices. Every vertex of the rings is used, those in
/// the middle of a straight run too, so that the triangles of neighbouring faces share whole
/// edges. Exact (integers on the model's grid).
/// \return indices into `model.vertices`, in the sense of the face; empty if the face is not a
/// polygon with holes inside (see `checkModel`)
std::vector<std::array<int, 3>> triangulateFace(const PolyhedralModel& model,
                                                const PolyhedralFace& face);

/// Cuts a face into few simple polygons without holes that together are the face, for formats
/// that know no holes. New edges are shared by two pieces in opposite senses.
/// \return rings of indices in the sense of the face: the outer ring itself if the face has no
/// holes; empty if the face is not a polygon with holes inside
std::vector<std::vector<int>> splitHoles(const PolyhedralModel& model, const PolyhedralFace& face);

}  // namespace storey
