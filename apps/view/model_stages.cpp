// SPDX-License-Identifier: BSD-3-Clause
// The model, and the cloud over it.
#include <storey/segmentation/detail/union_find.h>
#include <storey/surface/triangulation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "io/failure.h"
#include "view/palette.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

constexpr Colour kHypothetical{190, 70, 190};
constexpr Colour kPartly{208, 135, 172};  // half-way from there to a wall
constexpr Colour kPane{84, 120, 150};
constexpr Colour kReveal{186, 164, 126};
constexpr double kMostly = 2.0 / 3;  // of a wall's area
constexpr Colour kCloud{40, 55, 85};
constexpr std::size_t kOverlayPoints = 60000;  // few enough to see the model through them

// Level faces are no guess where walls end at them, seen or not.
bool isUnseen(const PolyhedralFace& face) {
  return face.label == FaceLabel::Wall && face.window == WindowPart::None && face.hypothetical;
}

bool isPartlySeen(const PolyhedralFace& face) {
  return face.label == FaceLabel::Wall && face.window == WindowPart::None && !face.hypothetical &&
         face.coverage < kMostly;
}

Colour baseColour(const PolyhedralFace& face) {
  if (face.window == WindowPart::Pane) return kPane;
  if (face.window == WindowPart::Reveal) return kReveal;
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

// Roofs of different heights must differ also where they are seen from above.
Colour raised(Colour colour, double share_of_height) {
  constexpr double kMost = 0.35;  // of the way to white, at the top
  const auto raise = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(c + kMost * share_of_height * (255 - c));
  };
  return {raise(colour.r), raise(colour.g), raise(colour.b)};
}

// The colours of a model's faces, by what they are, by what was seen of them or by how far off they
// may be; and what they mean.
class FaceColours {
 public:
  FaceColours(const PolyhedralModel& model, Stage stage) : model_(model), stage_(stage) {
    const auto lower = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return a.z() < b.z();
    };
    const auto [low, high] =
        std::minmax_element(model.vertices.begin(), model.vertices.end(), lower);
    lowest_ = low->z();
    height_ = high->z() - low->z();
    for (const PolyhedralFace& face : model.faces) {
      if (std::isfinite(face.deviation)) largest_ = std::max(largest_, face.deviation);
    }
  }

  Colour operator()(const PolyhedralFace& face) const {
    if (stage_ == Stage::Support) return sequentialColour(face.coverage);
    if (stage_ == Stage::Deviation) {
      if (!std::isfinite(face.deviation)) return kNoLabel;
      return sequentialColour(largest_ > 0.0 ? face.deviation / largest_ : 0.0);
    }
    const Colour colour = shaded(baseColour(face), normalOf(model_, face));
    if (face.label != FaceLabel::Roof || !(height_ > 0.0)) return colour;
    const double z = model_.vertices[static_cast<std::size_t>(face.outer.front())].z();
    return raised(colour, (z - lowest_) / height_);
  }

  void addScale(Drawing& drawing) const {
    if (stage_ == Stage::Support) addSequentialBar(drawing, "share with points", 1.0);
    if (stage_ != Stage::Deviation) return;
    if (largest_ > 0.0) addSequentialBar(drawing, "st. dev. (length)", largest_);
    drawing.legend.push_back({kNoLabel, "not known"});
  }

 private:
  const PolyhedralModel& model_;
  Stage stage_;
  double lowest_ = 0.0;
  double height_ = 0.0;
  double largest_ = 0.0;  // deviation
};

FacetSet facetsOf(const std::string& path, const PolyhedralModel& model,
                  const FaceColours& colours) {
  FacetSet facets;
  facets.vertices = model.vertices;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const auto triangles = triangulateFace(model, model.faces[f]);
    if (triangles.empty()) {
      throw io::Failure(io::BadInput, path,
                        "its polygon " + std::to_string(f) + " is not a simple one in a plane",
                        "run storey_reconstruct again");
    }
    facets.triangles.insert(facets.triangles.end(), triangles.begin(), triangles.end());
    facets.colours.insert(facets.colours.end(), triangles.size(), colours(model.faces[f]));
  }
  return facets;
}

// The pieces at each edge, by its ends.
using PiecesAt = std::map<std::pair<int, int>, std::vector<std::size_t>>;

PiecesAt piecesAtEdges(const PolyhedralModel& model) {
  PiecesAt pieces;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const std::vector<int>& ring = model.faces[f].outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      pieces[std::minmax(ring[i], ring[(i + 1) % ring.size()])].push_back(f);
    }
  }
  return pieces;
}

// The face of the model that each piece is of. Files know no holes: faces with holes are cut into
// pieces, which lie in one plane, as neighbouring faces of the model never do.
std::vector<std::size_t> wholeFaces(const PolyhedralModel& model, const PiecesAt& pieces_at) {
  constexpr double kSamePlane = 1.0 - 1e-9;  // cosine
  std::vector<Eigen::Vector3d> normals;
  for (const PolyhedralFace& face : model.faces) normals.push_back(normalOf(model, face));
  storey::detail::UnionFind<> whole(model.faces.size());
  for (const auto& [ends, pieces] : pieces_at) {
    if (pieces.size() == 2 && normals[pieces[0]].dot(normals[pieces[1]]) > kSamePlane) {
      whole.unite(pieces[0], pieces[1]);
    }
  }
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < model.faces.size(); ++f) faces.push_back(whole.find(f));
  return faces;
}

// What parts the pieces of one face is no edge of the model.
LineSet edgesOf(const PolyhedralModel& model, const PiecesAt& pieces_at,
                const std::vector<std::size_t>& whole) {
  LineSet edges;
  edges.width = 2.0;
  for (const auto& [ends, pieces] : pieces_at) {
    if (pieces.size() == 2 && whole[pieces[0]] == whole[pieces[1]]) continue;
    edges.lines.push_back({model.vertices[static_cast<std::size_t>(ends.first)],
                           model.vertices[static_cast<std::size_t>(ends.second)]});
    edges.colours.push_back(kDark);
  }
  return edges;
}

void addKinds(Drawing& drawing, const std::vector<PolyhedralFace>& faces) {
  constexpr const char* kNames[] = {"wall", "roof", "ground", "ceiling"};
  const auto add = [&](const Colour& colour, const char* name, const auto& matches) {
    const auto count = std::count_if(faces.begin(), faces.end(), matches);
    drawing.legend.push_back({colour, std::string(name) + ": " + std::to_string(count)});
  };
  for (int label = 0; label < 4; ++label) {
    PolyhedralFace example;
    example.label = static_cast<FaceLabel>(label);
    example.coverage = 1.0;
    add(baseColour(example), kNames[label], [&](const PolyhedralFace& f) {
      return f.label == example.label && f.window == WindowPart::None && !isUnseen(f) &&
             !isPartlySeen(f);
    });
  }
  const auto isPart = [](WindowPart part) {
    return [part](const PolyhedralFace& f) { return f.window == part; };
  };
  if (std::any_of(faces.begin(), faces.end(), isPart(WindowPart::Pane))) {
    add(kPane, "window", isPart(WindowPart::Pane));
    add(kReveal, "reveal", isPart(WindowPart::Reveal));
  }
  add(kPartly, "wall partly seen", isPartlySeen);
  add(kHypothetical, "wall not seen", isUnseen);
  drawing.legend_title = "polygons (higher roofs paler)";
}

const char* titleOf(Stage stage) {
  switch (stage) {
    case Stage::Support:
      return "Model by its support";
    case Stage::Deviation:
      return "Model by its standard deviation";
    case Stage::Overlay:
      return "Model over the cloud";
    case Stage::Windows:
      return "Model with windows";
    default:
      return "Model";
  }
}

}  // namespace

Drawing drawModel(const Reconstruction& r, Stage stage) {
  const std::string name = stage == Stage::Windows ? "windows.ply" : "model.ply";
  const PolyhedralModel model = r.readModel(name);
  const PiecesAt pieces_at = piecesAtEdges(model);
  const std::vector<std::size_t> whole = wholeFaces(model, pieces_at);
  std::vector<PolyhedralFace> faces;  // a piece of each
  for (std::size_t f = 0; f < whole.size(); ++f) {
    if (whole[f] == f) faces.push_back(model.faces[f]);
  }
  Drawing drawing;
  drawing.title = titleOf(stage);
  if (model.faces.empty()) return drawing;
  const FaceColours colours(model, stage);
  drawing.facets.push_back(facetsOf(r.file(name), model, colours));
  drawing.lines.push_back(edgesOf(model, pieces_at, whole));
  colours.addScale(drawing);
  if (stage != Stage::Support && stage != Stage::Deviation) addKinds(drawing, faces);
  drawing.subtitle = counted(faces.size(), "polygon") + ", " +
                     counted(static_cast<std::size_t>(model.num_shells), "shell") +
                     (r.report().inside ? ", a space seen from inside" : "");
  return drawing;
}

void layCloudOver(Drawing& drawing, const Reconstruction& r) {
  constexpr double kOpacity = 0.4;
  const StageCloud cloud = readStageCloud(r.file("01_upright.pcd"), "");
  for (FacetSet& facets : drawing.facets) facets.opacity = kOpacity;
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
}

}  // namespace storey::view::detail
