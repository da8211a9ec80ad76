// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/report.h"

#include <storey/segmentation/detail/point_classes.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reconstruct/agreement.h"
#include "reconstruct/residuals.h"

namespace storey::reconstruct {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / M_PI;

// JSON has no infinity: what is not known is null.
Json known(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double faceArea(const PolyhedralModel& model, const PolyhedralFace& face) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = model.vertices[static_cast<std::size_t>(face.outer[0])];
  const auto add = [&](const std::vector<int>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto a = static_cast<std::size_t>(ring[i]);
      const auto b = static_cast<std::size_t>(ring[(i + 1) % ring.size()]);
      twice += (model.vertices[a] - origin).cross(model.vertices[b] - origin);
    }
  };
  add(face.outer);
  for (const std::vector<int>& ring : face.inner) add(ring);  // they run the other way
  return 0.5 * twice.norm();
}

Json vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

double turn(const Eigen::Isometry3d& rotation) {
  return Eigen::AngleAxisd(rotation.linear()).angle();
}

Json describeInput(const Options& options, const Result& r) {
  return {{"file", options.input},
          {"format", r.loaded.format},
          {"points", r.all.points->size()},
          {"structure_points", r.cloud.points->size()},
          {"declared", r.loaded.declared},
          {"thinned_out", r.loaded.thinned_out},
          {"fitted_to_all", r.fitted_to_all},
          {"dropped_non_finite", r.loaded.dropped_non_finite},
          {"collapsed_duplicates", r.loaded.collapsed_duplicates},
          {"zero_normals", r.loaded.zero_normals},
          {"normals_turned_to_photos", r.loaded.turned_normals},
          {"offset", vector(r.loaded.offset)},
          {"crs", r.cloud.state.crs.empty() ? Json(nullptr) : Json(r.cloud.state.crs)}};
}

Json describeParameters(const Options& o) {
  using Linking = storey::detail::LinkingMethod;
  const stages::AttitudeOptions& a = o.attitude;
  return {{"up", a.up.isZero() ? Json("derived") : vector(a.up)},
          {"space", a.side == SpaceSide::Auto     ? "auto"
                    : a.side == SpaceSide::Inside ? "inside"
                                                  : "outside"},
          {"method", o.method == Method::Paper ? "paper" : "building"},
          {"block_cost", o.blocks.block_cost},
          {"min_wall_area", o.blocks.min_wall_area},
          {"noise", a.noise},
          {"structure_points", o.structure_points},
          {"kept_share", o.kept_share},
          {"slice_thickness", o.slices.thickness},
          {"smoothness", o.model.smoothness},
          {"label_cost", o.model.label_cost},
          {"max_types", o.simplicity.max_types},
          {"max_faces", o.simplicity.max_faces},
          {"encoding", o.model.encoding == FloorplanGrammar::Encoding::Walls ? "walls" : "turns"},
          {"linking", o.slices.linking == Linking::Optimal ? "optimal" : "greedy"},
          {"minimization", o.model.expansion ? "alpha-expansion" : "exact"}};
}

// How many points are of each class, and how planar they are on average.
Json describeClasses(const stages::StageCloud& cloud) {
  constexpr const char* kNames[detail::kNumPointClasses] = {
      "wall", "level", "ground", "sloped", "non_planar", "apart", "small"};
  std::size_t count[detail::kNumPointClasses] = {};
  double confidence[detail::kNumPointClasses] = {};
  const std::vector<int>& classes = cloud.groups(stages::Class);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto c = static_cast<std::size_t>(classes[i]);
    ++count[c];
    confidence[c] += static_cast<double>(cloud.confidences[i]);
  }
  Json described;
  for (std::size_t c = 0; c < detail::kNumPointClasses; ++c) {
    const double mean = confidence[c] / static_cast<double>(count[c]);
    described[kNames[c]] = {{"points", count[c]}, {"mean_confidence", known(mean)}};
  }
  return described;
}

Json describeAgreement(const Result& r) {
  const Agreement agreement = agreementWith(r);
  return {{"upright_points", agreement.upright},
          {"explained_share", agreement.explained},
          {"upright_points_of_building", agreement.building},
          {"explained_share_of_building", agreement.explained_of_building}};
}

// The spread is that of the normals in plan: noise, and walls that share the direction roughly.
Json describeDirections(const Result& r) {
  const std::vector<Eigen::Vector3d>& found = r.cloud.state.directions;
  const std::vector<int>& direction_of = r.cloud.groups(stages::Direction);
  std::vector<std::size_t> num_points(found.size(), 0);
  std::vector<double> squares(found.size(), 0.0);  // radians^2
  for (std::size_t i = 0; i < direction_of.size(); ++i) {
    if (direction_of[i] < 0) continue;
    const auto direction = static_cast<std::size_t>(direction_of[i]);
    const Eigen::Vector3d normal = (*r.cloud.points)[i].getNormalVector3fMap().cast<double>();
    const Eigen::Vector2d wall = found[direction].head<2>();
    const double across = wall.x() * normal.y() - wall.y() * normal.x();
    const double angle = std::atan2(across, wall.dot(normal.head<2>()));
    squares[direction] += angle * angle;
    ++num_points[direction];
  }
  Json directions = Json::array();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double spread =
        std::sqrt(squares[i] / static_cast<double>(std::max<std::size_t>(num_points[i], 1)));
    directions.push_back({{"normal", vector(found[i])},
                          {"azimuth_deg", std::atan2(found[i].y(), found[i].x()) * kDegrees},
                          {"spread_deg", spread * kDegrees},
                          {"points", num_points[i]}});
  }
  return directions;
}

Json describeSlices(const Result& r) {
  Json failures = Json::array();
  for (const stages::SliceFailure& failure : r.slices.failures) {
    failures.push_back({{"slice", failure.slice}, {"reason", failure.reason}});
  }
  const std::vector<FloorplanLayer>& layers = r.slices.layers;
  return {{"thickness", layers.empty() ? 0.0 : layers.front().z_max - layers.front().z_min},
          {"count", layers.size()},
          {"with_floorplan", layers.size() - r.slices.failures.size()},
          {"skipped", failures}};
}

Json describeBuilding(const Result& r) {
  const detail::BuildingFloorplans& b = r.building;
  Json walls = Json::array();
  for (const detail::WallLine& wall : b.walls) {
    walls.push_back({{"azimuth_deg", std::atan2(wall.normal.y(), wall.normal.x()) * kDegrees},
                     {"offset", wall.offset},
                     {"points", wall.support},
                     {"area", wall.support_area},
                     {"residual", wall.residual}});
  }
  Json trade_off = Json::array();
  for (const detail::OutlineTradeOff& point : b.trade_off) {
    trade_off.push_back({{"faces", point.faces},
                         {"types", point.types},
                         {"energy", point.energy},
                         {"face_cost", point.face_cost}});
  }
  return {{"hypothetical_lines", b.hypotheses.size()},
          {"cells", b.plan.cells.size()},
          {"layers", b.levels.empty() ? 0 : b.levels.size() - 1},
          {"gap_cost", b.gap},
          {"trade_off", trade_off},
          {"wall_lines", walls}};
}

Json describeLayers(const Result& r) {
  const DominantFloorplans& d = r.model.dominant;
  Json blocks = Json::array();
  for (const FloorplanLayer& storey : r.model.model.storeys) {
    blocks.push_back({{"z_min", storey.z_min},
                      {"z_max", storey.z_max},
                      {"components", storey.plan.components.size()},
                      {"edges", countEdges(storey.plan)},
                      {"area", area(storey.plan)}});
  }
  Json trade_off = Json::array();  // the least energy without label costs for each number of types
  for (std::size_t i = 0; i < d.trade_off.size(); ++i) {
    const LayerTradeOff& point = d.trade_off[i];
    trade_off.push_back({{"types", point.num_labels},
                         {"faces", d.trade_off_faces[i]},
                         {"energy", point.labeling.energy},
                         {"lower_bound", point.labeling.lower_bound},
                         {"optimal", point.labeling.optimal},
                         {"candidates", point.labeling.labels}});
  }
  return {{"types", d.num_types},
          {"candidates", d.num_candidates},
          {"dictionary_size", d.dictionary_size},
          {"energy", d.labeling.energy},
          {"lower_bound", d.labeling.lower_bound},
          {"optimal", d.labeling.optimal},
          {"slice_types", d.slice_types},
          {"block_types", d.types},
          {"trade_off", trade_off},
          {"blocks", blocks}};
}

Json describeWalls(const Result& r) {
  Json walls = Json::array();
  for (const auto& [id, wall] : r.model.walls) {
    walls.push_back({{"wall", id},
                     {"normal", {wall.normal.x(), wall.normal.y()}},
                     {"offset", wall.offset},
                     {"points", wall.support},
                     {"residual", wall.residual},
                     {"offset_deviation", known(wall.offset_deviation)},
                     {"angle_deviation_deg",
                      wall.support > 0 ? Json(wall.angle_deviation * kDegrees) : Json(nullptr)}});
  }
  return walls;
}

Json describeLevels(const Result& r) {
  Json levels = Json::array();
  for (const HeightFit& level : r.model.levels) {
    levels.push_back({{"z", level.z},
                      {"wall_points", level.wall_support},
                      {"cap_points", level.cap_support},
                      {"deviation", known(level.deviation)}});
  }
  return levels;
}

// How much of the model's walls and of its level faces the points show.
Json describeSupport(const PolyhedralModel& model) {
  double area[2] = {0.0, 0.0};
  double seen[2] = {0.0, 0.0};
  std::size_t guessed[2] = {0, 0};
  for (const PolyhedralFace& face : model.faces) {
    const bool level = face.label != FaceLabel::Wall;
    const double size = faceArea(model, face);
    area[level] += size;
    seen[level] += face.coverage * size;
    guessed[level] += face.hypothetical;
  }
  std::vector<double> deviations;
  for (std::size_t v = 0; v < model.covariances.size(); ++v) {
    deviations.push_back(model.vertexDeviation(v));
  }
  std::sort(deviations.begin(), deviations.end());
  const auto share = [&](int level) {
    return area[level] > 0.0 ? Json(seen[level] / area[level]) : Json(nullptr);
  };
  return {{"wall_area", area[0]},
          {"wall_share_seen", share(0)},
          {"level_area", area[1]},
          {"level_share_seen", share(1)},
          {"guessed_walls", guessed[0]},
          {"guessed_level_faces", guessed[1]},
          {"median_vertex_deviation",
           deviations.empty() ? Json(nullptr) : known(deviations[deviations.size() / 2])}};
}

Json describeModel(const Result& r) {
  const PolyhedralModel& model = r.model.model;
  const ModelCheck& check = r.model.check;
  std::size_t count[4] = {0, 0, 0, 0};
  std::size_t hypothetical = 0;
  for (const PolyhedralFace& face : model.faces) {
    ++count[static_cast<int>(face.label)];
    if (face.hypothetical && face.label == FaceLabel::Wall) ++hypothetical;
  }
  return {{"polygons", model.faces.size()},
          {"walls", count[0]},
          {"roofs", count[1]},
          {"grounds", count[2]},
          {"ceilings", count[3]},
          {"hypothetical_walls", hypothetical},
          {"vertices", model.vertices.size()},
          {"shells", model.num_shells},
          {"grid", model.grid},
          {"volume", check.volume},
          {"area", check.area},
          {"valid", check.ok()},
          {"problems", check.problems}};
}

Json describeResiduals(const Result& r) {
  const ResidualHistogram histogram = measureResiduals(r);
  return {{"points", histogram.points},
          {"bin", histogram.bin},
          {"counts", histogram.counts},
          {"beyond", histogram.beyond}};
}

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

std::string describe(const Options& options, const Result& r) {
  Json report;
  report["program"] = std::string("storey ") + STOREY_VERSION;
  report["input"] = describeInput(options, r);
  report["parameters"] = describeParameters(options);
  report["normals"] = {{"estimated", r.attitude.normals_k > 0},
                       {"neighbors", r.attitude.normals_k}};
  report["vertical"] = {{"up", vector(r.attitude.up)},
                        {"taken_as_z", r.attitude.level},
                        {"wall_share", r.attitude.vertical.wall_share},
                        {"second_score", r.attitude.vertical.second_score},
                        {"deviation_deg", r.attitude.vertical.deviation * kDegrees},
                        {"walls_turned_by_deg", turn(r.model.upright) * kDegrees}};
  report["space"] = {{"side", r.cloud.state.inside ? "inside" : "outside"},
                     {"reason", r.attitude.side_reason}};
  report["scale"] = {{"noise", r.cloud.state.noise},
                     {"measured_noise", r.attitude.scale.noise},
                     {"measured_noise_deviation", r.attitude.scale.noise_deviation},
                     {"measured_noise_share", r.attitude.scale.noise_share},
                     {"spacing", r.attitude.scale.spacing},
                     {"density", r.attitude.scale.density},
                     {"extent", r.attitude.scale.extent}};
  report["planar"] = {{"T_k", r.cloud.state.planar_threshold},
                      {"points", planarPoints(r.cloud).size()}};
  report["classes"] = describeClasses(r.cloud);
  report["agreement"] = describeAgreement(r);
  report["directions"] = describeDirections(r);
  report["slices"] = describeSlices(r);  // none where the floorplans are of the whole building
  report["building"] = describeBuilding(r);
  report["layers"] = describeLayers(r);
  report["walls"] = describeWalls(r);
  report["levels"] = describeLevels(r);
  report["residuals"] = describeResiduals(r);
  report["support"] = describeSupport(r.model.model);
  report["model"] = describeModel(r);
  Json& seconds = report["seconds"];
  Json& cpu_seconds = report["cpu_seconds"];  // of all threads together
  double total = 0.0;
  double cpu_total = 0.0;
  for (const StageTime& stage : r.times) {
    seconds[stage.name] = stage.seconds;
    cpu_seconds[stage.name] = stage.cpu_seconds;
    total += stage.seconds;
    cpu_total += stage.cpu_seconds;
  }
  seconds["total"] = total;
  cpu_seconds["total"] = cpu_total;
  report["peak_megabytes"] = peakMegabytes();

  // File names need not be UTF-8, JSON must be: replace what is not.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace storey::reconstruct
