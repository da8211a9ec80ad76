// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_types.h>
#include <pcl/surface/reconstruction.h>
#include <storey/filters/eigen_alignment.h>
#include <storey/surface/layerwise_model.h>

#include <functional>
#include <string>
#include <vector>

namespace storey {

/// Reconstructs a building as a closed polyhedron over a few dominant floorplans [Sui et al. 2016,
/// section 4]: an MRF over the layers, (11)-(15), chooses the dominant floorplans and propagates
/// them to their neighbours; walls and heights are fitted to all points; equal neighbours merge
/// into blocks, and coplanar facets into polygons.
///
/// Needs an upright cloud (+z is up) with outward normals. Where the floorplans come from:
/// - by default from the walls of the whole building (`BuildingFloorplanExtraction`): the MRF over
///   the layers is then one over cells of the plan, and its blocks are the dominant floorplans;
/// - `setBlocks` gives the result of that extraction, with options of your own;
/// - `setFloorplans` gives one floorplan a slice, as `LayerwiseFloorplanExtraction` extracts them:
///   dominant ones are chosen by (11)-(15), the paper's way.
///
/// The result is `getModel`, a polyhedron with double vertices; the `pcl::PolygonMesh` is its
/// triangulated export with the header of the input. Without an input, with a bad parameter, an
/// index outside the cloud or layers that do not ascend, or where no outline is found, the output
/// is empty after a PCL_ERROR. Deterministic.
/// \note Deviations, each with its reason: the energy is minimised exactly (`minimizeLayerEnergy`),
/// the distance of floorplans knows their position (`FloorplanGrammar`), shapes and heights are
/// fitted to the points again (`fitWalls`, `fitHeights`), the mesh is conforming
/// (`extrudeFloorplans`).
/// \par Complexity O(n) for the fits, and what the source of the floorplans takes; (11)-(15) by
/// branch and bound over the sets of types, with a work limit after which bound and gap are
/// reported.
///
/// \par In pcl_viewer
/// `11_model.vtk`: `w` and `s` change between edges and facets, `-opaque 0.4` shows the cloud
/// within.
///
/// \image html tutorial_model.png
template <typename PointT>
class LayerwiseMRFReconstruction : public pcl::SurfaceReconstruction<PointT> {
 public:
  using Ptr = pcl::shared_ptr<LayerwiseMRFReconstruction<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LayerwiseMRFReconstruction<PointT>>;

  LayerwiseMRFReconstruction() { this->check_tree_ = false; }

  /// Floorplans of the slices, bottom to top; empty ones are skipped.
  void setFloorplans(const std::vector<FloorplanLayer>& floorplans) { floorplans_ = floorplans; }
  const std::vector<FloorplanLayer>& getFloorplans() const { return floorplans_; }

  /// Blocks with wall ids, bottom to top; not used where floorplans of slices are set.
  void setBlocks(const std::vector<FloorplanLayer>& blocks) { blocks_ = blocks; }
  const std::vector<FloorplanLayer>& getBlocks() const { return blocks_; }

  using PartVisitor = std::function<void(const pcl::PointCloud<PointT>& part)>;
  /// Calls the visitor with each part of a cloud.
  using PartSource = std::function<void(const PartVisitor&)>;

  /// Where the input is a sample of more points than memory holds: they come in parts, in the frame
  /// of the input, and walls and heights are fitted to all of them (`ModelRefinement`). The source
  /// is asked once, at the end of `reconstruct`; what it throws comes out of there. Empty
  /// (default): the input is all there is.
  void setPartSource(const PartSource& source) { source_ = source; }

  /// Standard deviation of the points across their walls; 0 (default): estimated from the input.
  void setNoise(double noise) { noise_ = noise; }
  double getNoise() const { return noise_; }

  /// Points per unit of wall area; 0 (default): estimated from the input.
  void setDensity(double density) { density_ = density; }
  double getDensity() const { return density_; }

  /// eta1, (11), >= 0; see `DominantFloorplanOptions::smoothness`.
  void setSmoothness(double eta1) { options_.smoothness = eta1; }
  double getSmoothness() const { return options_.smoothness; }

  /// eta2, (11), >= 0; see `DominantFloorplanOptions::label_cost`.
  void setLabelCost(double eta2) { options_.label_cost = eta2; }
  double getLabelCost() const { return options_.label_cost; }

  /// Greatest number of floorplan types among the slices; 0 (default): no limit.
  void setMaxTypes(std::size_t max_types) { options_.max_types = max_types; }
  std::size_t getMaxTypes() const { return options_.max_types; }

  /// Greatest number of polygons of a model of slices, kept by fewer types as far as one type
  /// allows; 0 (default): no limit. For blocks see `BuildingFloorplanExtraction::setMaxFaces`.
  void setMaxFaces(std::size_t max_faces) { max_faces_ = max_faces; }
  std::size_t getMaxFaces() const { return max_faces_; }

  /// How floorplans are compared; default `FloorplanGrammar::Encoding::Walls`.
  void setEncoding(FloorplanGrammar::Encoding encoding) { options_.encoding = encoding; }
  FloorplanGrammar::Encoding getEncoding() const { return options_.encoding; }

  /// Whether (11) is minimised globally (default) or by alpha-expansion as in the paper.
  void setExactMinimization(bool exact) { options_.exact = exact; }
  bool getExactMinimization() const { return options_.exact; }

  /// Unit of the vertices' lattice; 0 (default): see `extrudeFloorplans`.
  void setGrid(double grid) { grid_ = grid; }
  double getGrid() const { return grid_; }

  /// 0 (default): all cores. The result is the same for any number.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }

  /// Steps of the fits to do without, for experiments; default: none.
  void setSteps(const detail::MethodSteps& steps) { steps_ = steps; }

  void reconstruct(pcl::PolygonMesh& output) override;
  void reconstruct(pcl::PointCloud<PointT>& points, std::vector<pcl::Vertices>& polygons) override;

  /// The polyhedron of the last `reconstruct`, in the upright frame that
  /// `LayerwiseModel::upright` takes the input to; the mesh is in the input's own.
  const PolyhedralModel& getModel() const { return result_.model; }
  /// Everything found on the way: types, blocks, energy, walls, the model's checks.
  const LayerwiseModel& getResult() const { return result_; }

 protected:
  void performReconstruction(pcl::PolygonMesh& output) override;
  void performReconstruction(pcl::PointCloud<PointT>& points,
                             std::vector<pcl::Vertices>& polygons) override;
  std::string getClassName() const override { return "LayerwiseMRFReconstruction"; }

 private:
  bool parametersValid() const;
  bool build();
  void refine(const LayerwiseModelOptions& options);

  std::vector<FloorplanLayer> floorplans_;
  std::vector<FloorplanLayer> blocks_;
  DominantFloorplanOptions options_;
  double noise_ = 0.0;
  double density_ = 0.0;
  double grid_ = 0.0;
  std::size_t max_faces_ = 0;
  unsigned int threads_ = 0;
  detail::MethodSteps steps_;
  PartSource source_;
  LayerwiseModel result_;
};

}  // namespace storey

#include <storey/surface/impl/layerwise_mrf_reconstruction.hpp>

#ifndef PCL_NO_PRECOMPILE
extern template class storey::LayerwiseMRFReconstruction<pcl::PointNormal>;
extern template class storey::LayerwiseMRFReconstruction<pcl::PointXYZINormal>;
#endif
