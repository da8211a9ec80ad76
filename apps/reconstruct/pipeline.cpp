// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/pipeline.h"

#include <pcl/common/transforms.h>
#include <storey/features/normal_side.h>
#include <storey/features/outward_normal_orientation.h>
#include <storey/features/pca_normals.h>
#include <storey/filters/detail/wall_relief.h>
#include <storey/filters/planar_confidence_filter.h>
#include <storey/segmentation/dominant_direction_clustering.h>
#include <storey/surface/layerwise_mrf_reconstruction.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "io/failure.h"

namespace storey::reconstruct {
namespace {

// The vertical is taken as +z if it is not further off than its accuracy explains.
constexpr double kLevelDeviations = 4.0;
constexpr double kLevelFloor = 1e-4;  // rad, where the accuracy is not known
// A building must show its walls: normals of all directions alike have a share of 0.105 within 6
// degrees of level, and buildings seen from a drone 0.14 and more.
constexpr double kMinWallShare = 0.07;
constexpr double kMaxWallTilt = 0.61;  // sin(35 degrees) = 0.57; see GravitySlicing

std::string format(const char* text, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* text, ...) {
  char line[400];
  va_list arguments;
  va_start(arguments, text);
  std::vsnprintf(line, sizeof line, text, arguments);
  va_end(arguments);
  return line;
}

class Pipeline {
 public:
  Pipeline(const Options& options, const std::function<void(const std::string&)>& progress)
      : options_(options), progress_(progress) {}

  Result run(const std::function<io::LoadedCloud()>& load) {
    stage("read", [&] { return take(load()); });
    stage("normals", [&] { return estimateMissingNormals(); });
    stage("vertical", [&] { return adjustAttitude(); });
    stage("orientation", [&] { return orientNormals(); });
    stage("scale", [&] { return measureScale(); });
    stage("planar", [&] { return filterPlanar(); });
    stage("directions", [&] { return findDirections(); });
    stage("floorplans", [&] {
      return options_.method == Method::Building ? extractBlocks() : extractFloorplans();
    });
    stage("model", [&] { return buildModel(); });
    return std::move(result_);
  }

 private:
  template <typename Work>
  void stage(const char* name, Work work) {
    const auto start = std::chrono::steady_clock::now();
    const std::string found = work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    result_.times.push_back({name, seconds.count()});
    progress_(format("%-11s %6.2f s  %s", name, seconds.count(), found.c_str()));
  }

  [[noreturn]] void refuse(const std::string& reason, const std::string& hint) const {
    throw io::Failure(io::BadInput, options_.input, reason, hint);
  }

  std::string take(io::LoadedCloud loaded) {
    result_.loaded = std::move(loaded);
    result_.cloud = std::move(result_.loaded.cloud);
    result_.local_to_input.translation() = result_.loaded.offset;
    return format("%zu points (%s)", result_.cloud->size(), result_.loaded.format.c_str());
  }

  std::string estimateMissingNormals() {
    if (result_.loaded.has_normals && !options_.estimate_normals) return "given";
    result_.normals_k = estimateNormals(*result_.cloud, 0, options_.threads);
    return format("estimated from %d neighbours", result_.normals_k);
  }

  std::string adjustAttitude() {
    VerticalDirectionEstimation<Point> estimation;
    estimation.setInputCloud(result_.cloud);
    estimation.setInitialUp(options_.up);
    estimation.setNumberOfThreads(options_.threads);
    if (!estimation.compute(result_.up)) {
      refuse("the vertical cannot be found", "give --up");
    }
    result_.vertical = estimation.getQuality();
    const double tilt = std::acos(std::clamp(result_.up.z(), -1.0, 1.0));
    result_.level = tilt <= std::max(kLevelDeviations * result_.vertical.deviation, kLevelFloor);
    if (result_.level) {
      result_.up = Eigen::Vector3d::UnitZ();
    } else {
      const Eigen::Quaterniond upright = estimation.getRotation();
      pcl::transformPointCloudWithNormals(
          *result_.cloud, *result_.cloud,
          Eigen::Affine3f(Eigen::Quaternionf(upright.cast<float>())));
      result_.local_to_input.linear() = upright.conjugate().toRotationMatrix();
    }
    return format("up = %.4f %.4f %.4f, %.3f deg off z%s, %.0f %% of the normals are level",
                  result_.up.x(), result_.up.y(), result_.up.z(), tilt * 180.0 / M_PI,
                  result_.level ? " (taken as z)" : "", 100.0 * result_.vertical.wall_share);
  }

  std::string orientNormals() {
    if (result_.normals_k > 0) {
      OutwardNormalOrientation<Point> orientation;
      orientation.setInputCloud(result_.cloud);
      orientation.setNumberOfThreads(options_.threads);
      const auto oriented = pcl::make_shared<Cloud>();
      orientation.orient(*oriented);
      result_.cloud = oriented;
      result_.inside = options_.side == SpaceSide::Inside;
      result_.side_reason = "normals estimated";
    } else {
      const NormalSideEvidence side = detectNormalSide(*result_.cloud, Eigen::Vector3d::UnitZ());
      result_.inside = options_.side == SpaceSide::Inside ||
                       (options_.side == SpaceSide::Auto && side.side == NormalSide::Space);
      result_.side_reason = format("outwardness %.2f", side.outwardness);
    }
    // Inside a space the normals of its walls point to its middle: turned, they point out of it.
    if (result_.inside) {
      for (Point& p : *result_.cloud) p.getNormalVector3fMap() *= -1.0f;
    }
    return format("%s (%s)",
                  result_.inside ? "a space seen from inside" : "a building seen from outside",
                  result_.side_reason.c_str());
  }

  std::string measureScale() {
    pcl::Indices walls;
    for (std::size_t i = 0; i < result_.cloud->size(); ++i) {
      if (std::abs((*result_.cloud)[i].normal_z) < std::sin(kMaxWallTilt)) {
        walls.push_back(static_cast<pcl::index_t>(i));
      }
    }
    if (result_.vertical.wall_share < kMinWallShare || walls.empty()) {
      refuse(format("only %.1f %% of the normals are level, too few walls for a model",
                    100.0 * result_.vertical.wall_share),
             "storey needs a cloud that shows the walls, from the ground or a drone");
    }
    result_.scale = estimateCloudScale(Cloud(*result_.cloud, walls));
    result_.noise = options_.noise > 0.0 ? options_.noise : noiseOfWalls(walls);
    return format(
        "noise %.3g (walls %.3g), spacing %.3g, %.3g points per unit of wall, extent %.3g",
        result_.scale.noise, result_.noise, result_.scale.spacing, result_.scale.density,
        result_.scale.extent);
  }

  double noiseOfWalls(const pcl::Indices& walls) const {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    for (const pcl::index_t i : walls) {
      const Point& p = (*result_.cloud)[static_cast<std::size_t>(i)];
      positions.push_back(p.getVector3fMap());
      normals.push_back(p.getNormalVector3fMap());
    }
    return detail::estimateWallNoise(positions, normals, result_.scale.noise, result_.scale.extent);
  }

  std::string filterPlanar() {
    PlanarConfidenceFilter<Point> filter;
    filter.setInputCloud(result_.cloud);
    filter.setKeptShare(options_.kept_share);
    filter.setNumberOfThreads(options_.threads);
    filter.filter(result_.planar);
    result_.planar_threshold = filter.getThreshold();
    result_.confidences.assign(filter.getConfidences().begin(), filter.getConfidences().end());
    return format("T_k = %.3f, %zu points kept", result_.planar_threshold, result_.planar.size());
  }

  std::string findDirections() {
    DominantDirectionClustering<Point> clustering;
    clustering.setInputCloud(result_.cloud);
    clustering.setIndices(pcl::make_shared<pcl::Indices>(result_.planar));
    clustering.setNumberOfThreads(options_.threads);
    std::vector<pcl::PointIndices> clusters;
    clustering.extract(clusters);
    result_.directions = clustering.getDirections();
    result_.point_directions.assign(result_.cloud->size(), -1);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      result_.direction_points.push_back(clusters[c].indices.size());
      for (const pcl::index_t i : clusters[c].indices) {
        result_.point_directions[static_cast<std::size_t>(i)] = static_cast<int>(c);
      }
    }
    if (result_.directions.empty()) {
      refuse("no dominant wall direction found", "is the cloud a building with planar walls?");
    }
    return format("%zu dominant directions", result_.directions.size());
  }

  std::string extractBlocks() {
    BuildingFloorplanExtraction<Point> extraction;
    extraction.setInputCloud(result_.cloud);
    extraction.setIndices(pcl::make_shared<pcl::Indices>(result_.planar));
    extraction.setNoise(result_.noise);
    extraction.setDensity(result_.scale.density);
    extraction.setBlockCost(options_.block_cost);
    extraction.setMaxFaces(static_cast<std::size_t>(options_.max_faces));
    extraction.setMaxTypes(static_cast<std::size_t>(options_.max_types));
    extraction.setWholeTradeOff(options_.trade_off);
    if (!extraction.extract(result_.blocks)) {
      refuse("the walls enclose no building",
             "is half of it missing, or the vertical wrong (--up)?");
    }
    result_.building = extraction.getResult();
    return format("%zu walls, %zu cells, %zu layers in %zu blocks", result_.building.walls.size(),
                  result_.building.plan.cells.size(), result_.building.levels.size() - 1,
                  result_.blocks.size());
  }

  std::string extractFloorplans() {
    LayerwiseFloorplanExtraction<Point> extraction;
    extraction.setInputCloud(result_.cloud);
    extraction.setIndices(pcl::make_shared<pcl::Indices>(result_.planar));
    extraction.setDirections(result_.directions);
    extraction.setNoise(result_.noise);
    extraction.setSliceThickness(options_.slice_thickness);
    extraction.setLinkingMethod(options_.linking);
    extraction.setKeepStages(options_.intermediate);
    extraction.setNumberOfThreads(options_.threads);
    extraction.extract(result_.slices);
    result_.slice_thickness = extraction.getSliceThickness();
    result_.stages = extraction.getStages();
    const auto good = std::count_if(result_.slices.begin(), result_.slices.end(),
                                    [](const FloorplanLayer& s) { return !s.plan.empty(); });
    if (good == 0) {
      refuse("no slice has a closed floorplan",
             "is half of the building missing, or the vertical wrong (--up)?");
    }
    return format("%zu slices of %.3g, %td with a floorplan", result_.slices.size(),
                  result_.slice_thickness, good);
  }

  std::string buildModel() {
    LayerwiseMRFReconstruction<Point> reconstruction;
    reconstruction.setInputCloud(result_.cloud);
    reconstruction.setFloorplans(result_.slices);
    reconstruction.setBlocks(result_.blocks);
    reconstruction.setNoise(result_.noise);
    reconstruction.setSmoothness(options_.smoothness);
    reconstruction.setLabelCost(options_.label_cost);
    reconstruction.setMaxTypes(static_cast<std::size_t>(options_.max_types));
    reconstruction.setEncoding(options_.encoding);
    reconstruction.setExactMinimization(!options_.expansion);
    reconstruction.setGrid(options_.grid);
    pcl::PolygonMesh mesh;
    reconstruction.reconstruct(mesh);
    result_.model = reconstruction.getResult();
    result_.local_to_input = result_.local_to_input * result_.model.upright.inverse();
    if (result_.model.model.empty()) {
      refuse("the floorplans enclose no solid", "look at the slices with --intermediate");
    }
    return format("%d floorplan types in %zu blocks, %zu polygons, %s",
                  result_.model.dominant.num_types, result_.model.model.storeys.size(),
                  result_.model.model.faces.size(),
                  result_.model.check.ok() ? "closed and valid" : "NOT VALID");
  }

  const Options& options_;
  const std::function<void(const std::string&)>& progress_;
  Result result_;
};

}  // namespace

Result reconstruct(const Options& options,
                   const std::function<void(const std::string&)>& progress) {
  return Pipeline(options, progress).run([&] { return io::readCloud(options.input); });
}

Result reconstruct(io::LoadedCloud cloud, const Options& options,
                   const std::function<void(const std::string&)>& progress) {
  return Pipeline(options, progress).run([&] { return std::move(cloud); });
}

}  // namespace storey::reconstruct
