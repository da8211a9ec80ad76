// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/surface/extrusion.h>
#include <storey/surface/facade_texturing.h>

#include <vector>

#include "synth/buildings.h"
#include "synth/photos/photo_scene.h"

namespace storey::synth {

/// A generated building with the photos that were taken of it.
struct Rendered {
  PolyhedralModel model;
  PhotoScene scene;
  std::vector<FacadePhoto> photos;

  Rendered(const char* name, const PhotoOptions& options)
      : model(extrudeFloorplans(makeBuilding(name).layers)), scene(model, options) {
    for (const Camera& camera : scene.placeCameras()) {
      photos.push_back({camera, scene.photograph(camera, static_cast<int>(photos.size()))});
    }
  }
};

}  // namespace storey::synth
