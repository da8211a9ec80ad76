// SPDX-License-Identifier: BSD-3-Clause
// The model alone, and over the cloud.
#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "io/failure.h"
#include "view/palette.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

constexpr Colour kHypothetical{190, 70, 190};
constexpr Colour kPartly{208, 135, 172};  // half-way from there to a wall
constexpr double kMostly = 2.0 / 3;       // of a wall's area
constexpr Colour kCloud{40, 55, 85};
constexpr std::size_t kOverlayPoints = 60000;  // few enough to see the model through them

// Level faces are no guess where walls end at them, seen or not.
bool isUnseen(const PolyhedralFace& face) {
  return face.label == FaceLabel::Wall && face.hypothetical;
}

bool isPartlySeen(const PolyhedralFace& face) {
  return face.label == FaceLabel::Wall && !face.hypothetical && face.coverage < kMostly;
}

Colour baseColour(const PolyhedralFace& face) {
  if (isPartlySeen(face)) return kPartly;
  if (isUnseen(face)) return kHypothetical;
  switch (face.label) {
    case FaceLabel::Roof:
      return {196, 84, 66};
    case FaceLabel::Ground:
      return {130, 130, 130};
    case FaceLabel::Ceiling:
      return {80, 140, 190};
    default:
      return {225, 200, 155};
  }
}

// Newell's formula: twice the vector area of the ring.
Eigen::Vector3d normalOf(const PolyhedralModel& model, const PolyhedralFace& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto at = [&](std::size_t i) -> const Eigen::Vector3d& {
    return model.vertices[static_cast<std::size_t>(face.outer[i % face.outer.size()])];
  };
  for (std::size_t i = 0; i < face.outer.size(); ++i) {
    sum += (at(i) - at(0)).cross(at(i + 1) - at(0));
  }
  return sum.normalized();
}

// A fixed light, so that a wall looks the same from every side: from the south-south-east, high.
Colour shaded(Colour colour, const Eigen::Vector3d& normal) {
  constexpr double kAmbient = 0.62;
  const Eigen::Vector3d to_light = Eigen::Vector3d(0.35, -0.75, 1.1).normalized();
  const double light =
      std::min(1.0, kAmbient + (1.0 - kAmbient) * 1.2 * std::max(0.0, normal.dot(to_light)));
  const auto dim = [&](std::uint8_t c) { return static_cast<std::uint8_t>(light * c); };
  return {dim(colour.r), dim(colour.g), dim(colour.b)};
}

// Roofs of different heights must differ also where they are seen from above.
Colour raised(Colour colour, double share_of_height) {
  constexpr double kMost = 0.35;  // of the way to white, at the top
  const auto raise = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(c + kMost * share_of_height * (255 - c));
  };
  return {raise(colour.r), raise(colour.g), raise(colour.b)};
}

FacetSet facetsOf(const Reconstruction& r, const PolyhedralModel& model) {
  FacetSet facets;
  facets.vertices = model.vertices;
  const auto lower = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.z() < b.z();
  };
  const auto [lowest, highest] =
      std::minmax_element(model.vertices.begin(), model.vertices.end(), lower);
  const double height = highest->z() - lowest->z();
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const PolyhedralFace& face = model.faces[f];
    Colour colour = shaded(baseColour(face), normalOf(model, face));
    if (face.label == FaceLabel::Roof && height > 0.0) {
      const double z = model.vertices[static_cast<std::size_t>(face.outer.front())].z();
      colour = raised(colour, (z - lowest->z()) / height);
    }
    const auto triangles = triangulateFace(model, face);
    if (triangles.empty()) {
      throw io::Failure(io::BadInput, r.file("model.ply"),
                        "its polygon " + std::to_string(f) + " is not a simple one in a plane",
                        "run storey_reconstruct again");
    }
    facets.triangles.insert(facets.triangles.end(), triangles.begin(), triangles.end());
    facets.colours.insert(facets.colours.end(), triangles.size(), colour);
  }
  return facets;
}

// The edges of the model's faces. Polygons that a face with holes was cut into lie in one plane:
// what parts them is no edge of the model.
LineSet edgesOf(const PolyhedralModel& model) {
  constexpr double kSamePlane = 1.0 - 1e-9;  // cosine; neighbours of the model itself never meet it
  std::vector<Eigen::Vector3d> normals;
  for (const PolyhedralFace& face : model.faces) normals.push_back(normalOf(model, face));
  std::map<std::pair<int, int>, std::vector<std::size_t>> faces_at;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const std::vector<int>& ring = model.faces[f].outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      faces_at[std::minmax(ring[i], ring[(i + 1) % ring.size()])].push_back(f);
    }
  }
  LineSet edges;
  edges.width = 2.0;
  for (const auto& [ends, faces] : faces_at) {
    if (faces.size() == 2 && normals[faces[0]].dot(normals[faces[1]]) > kSamePlane) continue;
    edges.lines.push_back({model.vertices[static_cast<std::size_t>(ends.first)],
                           model.vertices[static_cast<std::size_t>(ends.second)]});
    edges.colours.push_back(kDark);
  }
  return edges;
}

void addModel(Drawing& drawing, const Reconstruction& r, double opacity) {
  const PolyhedralModel model = r.readModel();
  drawing.facets.push_back(facetsOf(r, model));
  drawing.facets.back().opacity = opacity;
  drawing.lines.push_back(edgesOf(model));
  constexpr const char* kNames[] = {"wall", "roof", "ground", "ceiling"};
  const auto add = [&](const Colour& colour, const char* name, const auto& matches) {
    const auto count = std::count_if(model.faces.begin(), model.faces.end(), matches);
    drawing.legend.push_back({colour, std::string(name) + ": " + std::to_string(count)});
  };
  for (int label = 0; label < 4; ++label) {
    PolyhedralFace example;
    example.label = static_cast<FaceLabel>(label);
    example.coverage = 1.0;
    add(baseColour(example), kNames[label], [&](const PolyhedralFace& f) {
      return f.label == example.label && !isUnseen(f) && !isPartlySeen(f);
    });
  }
  add(kPartly, "wall partly seen", isPartlySeen);
  add(kHypothetical, "wall not seen", isUnseen);
  drawing.legend_title = "polygons (higher roofs paler)";
  const auto shells = static_cast<std::size_t>(model.num_shells);
  drawing.subtitle = counted(model.faces.size(), "polygon") + ", " + counted(shells, "shell") +
                     (r.report().inside ? ", a space seen from inside" : "");
}

}  // namespace

Drawing drawModel(const Reconstruction& r) {
  Drawing drawing;
  drawing.title = "Model";
  addModel(drawing, r, 1.0);
  return drawing;
}

Drawing drawOverlay(const Reconstruction& r) {
  const StageCloud cloud = readStageCloud(r.file("01_upright.pcd"), "");
  Drawing drawing;
  drawing.title = "Model over the cloud";
  addModel(drawing, r, 0.4);
  PointSet set;
  set.size = 1.5;
  for (const std::size_t i : evenlySpaced(cloud.positions.size(), kOverlayPoints)) {
    set.positions.push_back(cloud.positions[i]);
    set.colours.push_back(kCloud);
  }
  drawing.subtitle += ", " + std::to_string(set.positions.size()) + " of " +
                      counted(cloud.positions.size(), "point");
  drawing.points.push_back(std::move(set));
  drawing.legend.push_back({kCloud, "points"});
  return drawing;
}

}  // namespace storey::view::detail
