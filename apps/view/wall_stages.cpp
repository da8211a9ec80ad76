// SPDX-License-Identifier: BSD-3-Clause
// From walls to floorplans: the walls found, the cells that they cut the plan into, and the
// floorplans coloured by their type.
#include <storey/surface/triangulation.h>

#include <algorithm>
#include <cmath>

#include "io/failure.h"
#include "stages/floorplan_file.h"
#include "view/palette.h"
#include "view/plan_files.h"
#include "view/stages.h"

namespace storey::view::detail {
namespace {

constexpr std::size_t kMaxLegendEntries = 24;  // more do not fit beside the picture
constexpr Colour kInside{235, 170, 95};
constexpr Colour kBelow{250, 222, 185};  // inside in the block below only: what a roof covers
constexpr Colour kOutside{240, 241, 244};
constexpr Colour kCellEdge{120, 125, 140};

Eigen::Vector3d at(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

[[noreturn]] void failFile(const Reconstruction& r, const char* name, const char* reason) {
  throw io::Failure(io::BadInput, r.file(name), reason, "run storey_reconstruct again");
}

// A vertical rectangle, two triangles of one colour.
void addPanel(FacetSet& facets, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double z_min, double z_max, Colour colour) {
  const int first = static_cast<int>(facets.vertices.size());
  for (const Eigen::Vector3d& corner :
       {at(from, z_min), at(to, z_min), at(to, z_max), at(from, z_max)}) {
    facets.vertices.push_back(corner);
  }
  facets.triangles.push_back({first, first + 1, first + 2});
  facets.triangles.push_back({first, first + 2, first + 3});
  facets.colours.insert(facets.colours.end(), 2, colour);
}

void addLoop(LineSet& lines, const std::vector<Eigen::Vector2d>& corners, double z) {
  std::vector<Eigen::Vector3d> line;
  for (const Eigen::Vector2d& corner : corners) line.push_back(at(corner, z));
  line.push_back(line.front());
  lines.lines.push_back(std::move(line));
  lines.colours.push_back(kDark);
}

// The layers of a floorplan file as solids, each in its colour.
class LayerSolids {
 public:
  LayerSolids(const Reconstruction& r, FacetSet& facets, LineSet& edges)
      : r_(r), facets_(facets), edges_(edges) {}

  void add(const FloorplanLayer& layer, Colour colour) {
    for (const FloorplanComponent& component : layer.plan.components) {
      PolyhedralModel cap;
      cap.grid = r_.report().grid;
      PolyhedralFace face;
      face.label = FaceLabel::Roof;
      face.outer = addRing(component.outer, layer, colour, cap);
      for (const FloorplanRing& hole : component.holes) {
        face.inner.push_back(addRing(hole, layer, colour, cap));
      }
      addCap(cap, face, colour);
    }
  }

 private:
  std::vector<int> addRing(const FloorplanRing& ring, const FloorplanLayer& layer, Colour colour,
                           PolyhedralModel& cap) {
    std::vector<int> indices;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& from = ring.vertices[i];
      const Eigen::Vector2d& to = ring.vertices[(i + 1) % ring.size()];
      const Eigen::Vector3d outwards(to.y() - from.y(), from.x() - to.x(), 0.0);
      addPanel(facets_, from, to, layer.z_min, layer.z_max, shaded(colour, outwards.normalized()));
      indices.push_back(static_cast<int>(cap.vertices.size()));
      cap.vertices.push_back(at(from, layer.z_max));
    }
    addLoop(edges_, ring.vertices, layer.z_max);
    return indices;
  }

  void addCap(const PolyhedralModel& cap, const PolyhedralFace& face, Colour colour) {
    const auto triangles = triangulateFace(cap, face);
    if (triangles.empty()) failFile(r_, "09_floorplans.geojson", "has a ring that crosses itself");
    const int first = static_cast<int>(facets_.vertices.size());
    facets_.vertices.insert(facets_.vertices.end(), cap.vertices.begin(), cap.vertices.end());
    for (const std::array<int, 3>& t : triangles) {
      facets_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      facets_.colours.push_back(shaded(colour, Eigen::Vector3d::UnitZ()));
    }
  }

  const Reconstruction& r_;
  FacetSet& facets_;
  LineSet& edges_;
};

}  // namespace

Drawing drawWalls(const Reconstruction& r) {
  Drawing drawing;
  drawing.title = "Walls found";
  FacetSet panels;
  LineSet outlines;
  const std::vector<SeenWall> walls = readWalls(r.file("09_walls.geojson"));
  for (const SeenWall& wall : walls) {
    const Colour colour = azimuthColour(std::atan2(wall.normal.y(), wall.normal.x()));
    for (const auto& [from, to] : wall.runs) {
      addPanel(panels, from, to, wall.z_min, wall.z_max, colour);
      outlines.lines.push_back({at(from, wall.z_min), at(to, wall.z_min), at(to, wall.z_max),
                                at(from, wall.z_max), at(from, wall.z_min)});
      outlines.colours.push_back(kDark);
    }
  }
  drawing.subtitle = counted(walls.size(), "wall") + ", where they were seen in plan and height";
  addAzimuthBar(drawing);
  drawing.facets.push_back(std::move(panels));
  drawing.lines.push_back(std::move(outlines));
  return drawing;
}

Drawing drawCells(const Reconstruction& r, std::optional<int> wanted) {
  const PlanCells plan = readCells(r.file("09_cells.geojson"));
  if (plan.blocks.empty()) failFile(r, "09_cells.geojson", "has no blocks");
  const std::size_t middle = plan.blocks.size() / 2;
  const std::size_t block = wanted ? static_cast<std::size_t>(*wanted) : middle;
  requireStep(block, plan.blocks.size());
  Drawing drawing;
  drawing.title = "Cells of the plan, block " + std::to_string(block) + " (0 to " +
                  std::to_string(plan.blocks.size() - 1) + ")";
  FacetSet cells;
  LineSet edges;
  edges.width = 1.5;
  std::size_t num_inside = 0;
  for (const PlanCells::Cell& cell : plan.cells) {
    const bool below = block > 0 && cell.inside[block - 1];
    const Colour colour = cell.inside[block] ? kInside : below ? kBelow : kOutside;
    num_inside += cell.inside[block] ? 1 : 0;
    const int first = static_cast<int>(cells.vertices.size());
    for (const Eigen::Vector2d& corner : cell.corners) cells.vertices.push_back(at(corner, 0.0));
    for (int i = 2; i < static_cast<int>(cell.corners.size()); ++i) {
      cells.triangles.push_back({first, first + i - 1, first + i});
      cells.colours.push_back(colour);
    }
    addLoop(edges, cell.corners, 0.0);
    edges.colours.back() = kCellEdge;
  }
  const auto& [z_min, z_max] = plan.blocks[block];
  drawing.subtitle = std::to_string(num_inside) + " of " + counted(plan.cells.size(), "cell") +
                     " inside, from z = " + shortNumber(z_min) + " to " + shortNumber(z_max);
  drawing.legend = {{kInside, "inside"}, {kOutside, "outside"}};
  if (block > 0) drawing.legend.push_back({kBelow, "inside below only"});
  drawing.facets.push_back(std::move(cells));
  drawing.lines.push_back(std::move(edges));
  return drawing;
}

Drawing drawTypes(const Reconstruction& r) {
  const stages::StageFloorplans floorplans =
      stages::readFloorplans(r.file("09_floorplans.geojson"));
  const std::vector<int>& types = r.report().layer_types;
  const auto bad = [&](int type) { return type >= static_cast<int>(types.size()); };
  if (types.empty() || types.size() != floorplans.layers.size() ||
      std::any_of(types.begin(), types.end(), bad)) {
    failFile(r, "09_floorplans.geojson", "is not of the same run as report.json");
  }
  const auto n = static_cast<std::size_t>(1 + *std::max_element(types.begin(), types.end()));
  std::vector<std::size_t> count(n, 0);
  FacetSet facets;
  LineSet edges;
  edges.width = 1.2;
  LayerSolids solids(r, facets, edges);
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i] < 0) continue;
    const auto type = static_cast<std::size_t>(types[i]);
    ++count[type];
    solids.add(floorplans.layers[i], distinctColour(type, n));
  }
  const bool slices = floorplans.method == stages::Method::Paper;
  Drawing drawing;
  drawing.title = "Floorplans by their type";
  drawing.subtitle =
      counted(n, "type") + " for " + counted(floorplans.layers.size(), slices ? "slice" : "block");
  drawing.legend_title = slices ? "type: slices" : "type: blocks";
  for (std::size_t k = 0; k < std::min(n, kMaxLegendEntries); ++k) {
    drawing.legend.push_back(
        {distinctColour(k, n), std::to_string(k) + ": " + std::to_string(count[k])});
  }
  drawing.facets.push_back(std::move(facets));
  drawing.lines.push_back(std::move(edges));
  return drawing;
}

}  // namespace storey::view::detail
