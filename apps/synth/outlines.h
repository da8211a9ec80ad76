// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <Eigen/Core>
#include <vector>

namespace storey::synth {

/// A simple polygon without wall ids, counter-clockwise; edge i runs from corner i to i + 1.
using Outline = std::vector<Eigen::Vector2d>;

/// One component: an outer outline and its courtyards, all of them counter-clockwise here.
struct Part {
  Outline outer;
  std::vector<Outline> holes;
};

/// One storey type: its components and the height of its upper end.
struct Stage {
  double top = 0.0;
  std::vector<Part> parts;
};

/// Intersection of the lines n(a_i).(x - center) = d_i of neighbours; the angles (rad) of the
/// outward normals must rise by less than pi from one to the next.
Outline convexOutline(const std::vector<double>& normal_angles,
                      const std::vector<double>& distances,
                      const Eigen::Vector2d& center = Eigen::Vector2d::Zero());

/// Regular polygon with the given distance of its sides from the centre.
Outline regularOutline(int sides, double apothem, double first_normal_angle);

Outline rectangle(double x_min, double y_min, double x_max, double y_max);

/// The line of one edge moved inwards by `distance` (outwards if negative), neighbours extended.
Outline moveEdge(const Outline& outline, std::size_t edge, double distance);

/// All edges moved inwards by `distance`.
Outline inset(const Outline& outline, double distance);

/// Cuts a parallelogram off a corner: `before` along the edge that ends there, `after` along the
/// one that starts there. The two new walls are parallel to the two old ones.
Outline cutCorner(const Outline& outline, std::size_t corner, double before, double after);

/// Pushes the stretch [start, start + width] of an edge inwards by `depth`, at right angles.
Outline cutBay(const Outline& outline, std::size_t edge, double start, double width, double depth);

/// The part of a convex outline where normal.(x) <= distance; empty if nothing is left.
Outline clipConvex(const Outline& outline, const Eigen::Vector2d& normal, double distance);

Outline turned(const Outline& outline, double yaw);
Outline shifted(const Outline& outline, const Eigen::Vector2d& by);

/// Turns every outline of the stages about the origin.
std::vector<Stage> turned(std::vector<Stage> stages, double yaw);

double edgeLength(const Outline& outline, std::size_t edge);

/// Shoelace formula, positive if counter-clockwise.
double signedArea(const Outline& outline);

/// The stages stacked from z = 0 upwards. Edges whose lines agree to a millionth of the width get
/// the same wall id, numbered from 0 in order of appearance.
std::vector<FloorplanLayer> stackStages(const std::vector<Stage>& stages);

}  // namespace storey::synth
