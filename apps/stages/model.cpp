// SPDX-License-Identifier: BSD-3-Clause
#include "stages/model.h"

#include "stages/attitude.h"

namespace storey::stages {

std::string buildModel(StageCloud& cloud, const std::vector<FloorplanLayer>& layers, Method method,
                       const SimplicityOptions& simplicity, const ModelOptions& options,
                       unsigned int threads, LayerwiseModel& model, const PartSource& parts,
                       const storey::detail::MethodSteps& steps) {
  ensureScale(cloud);
  LayerwiseMRFReconstruction<Point> reconstruction;
  reconstruction.setInputCloud(cloud.points);
  if (method == Method::Paper) {
    reconstruction.setFloorplans(layers);
  } else {
    reconstruction.setBlocks(layers);
  }
  reconstruction.setNoise(cloud.state.noise);
  reconstruction.setDensity(cloud.state.density);
  reconstruction.setSmoothness(options.smoothness);
  reconstruction.setLabelCost(options.label_cost);
  reconstruction.setMaxTypes(static_cast<std::size_t>(simplicity.max_types));
  reconstruction.setMaxFaces(static_cast<std::size_t>(simplicity.max_faces));
  reconstruction.setEncoding(options.encoding);
  reconstruction.setExactMinimization(!options.expansion);
  reconstruction.setGrid(options.grid);
  reconstruction.setPartSource(parts);
  reconstruction.setSteps(steps);
  reconstruction.setNumberOfThreads(threads);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  model = reconstruction.getResult();
  if (model.model.empty()) {
    refuse(cloud, "the floorplans enclose no solid",
           options.grid > 0.0 ? "does --grid fit the size of the cloud?"
                              : "look at the floorplans with --intermediate");
  }
  std::string line =
      format("%d floorplan types in %zu blocks, %zu polygons, %s", model.dominant.num_types,
             model.model.storeys.size(), model.model.faces.size(),
             model.check.ok() ? "closed and valid" : "NOT VALID");
  if (parts) line += ", fitted to all points of the file";
  if (method == Method::Paper && simplicity.max_faces > 0 &&
      model.model.faces.size() > static_cast<std::size_t>(simplicity.max_faces)) {
    line += format("; --max-faces %d cannot be kept with one floorplan", simplicity.max_faces);
  }
  return line;
}

Eigen::Isometry3d modelToInput(const StageCloud& cloud, const LayerwiseModel& model) {
  return cloud.state.frame_to_input * model.upright.inverse();
}

}  // namespace storey::stages
