// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <string>
#include <vector>

/// Faces of the solid, counted on the floorplans with GEOS: connected stretches of each oriented
/// wall plane, and connected parts of each layer's plan less the next one's, up and down.
std::size_t countPolygons(const std::vector<storey::FloorplanLayer>& layers);

/// What is wrong with a building: rings that GEOS finds invalid, wrong senses, components of a
/// layer closer than 1, a component above nothing. Empty if nothing is.
std::string whyInvalid(const std::vector<storey::FloorplanLayer>& layers);

/// Smallest distance between two different parallel wall planes.
double smallestPlaneDistance(const std::vector<storey::FloorplanLayer>& layers);
