// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/camera_json.h"

#include <nlohmann/json.hpp>

namespace storey::cameras {
namespace {

using Json = nlohmann::ordered_json;

Json describe(const io::Photo& photo) {
  const Camera& camera = photo.camera;
  const Eigen::Vector3d center = camera.center();
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    const Eigen::RowVector4d numbers = camera.world_to_camera.matrix().row(row);
    rows.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  }
  return {{"photo", photo.index},
          {"name", photo.name},
          {"width", camera.width},
          {"height", camera.height},
          {"focal_length", {camera.focal.x(), camera.focal.y()}},
          {"principal_point", {camera.principal.x(), camera.principal.y()}},
          {"world_to_camera", std::move(rows)},
          {"centre", {center.x(), center.y(), center.z()}}};
}

}  // namespace

std::string toJson(const io::CameraSet& set, const std::optional<CameraCheck>& check) {
  Json json = {{"format", set.format}, {"points", set.points.size()}};
  if (check) {
    json["agreement"] = check->correlation;
    if (check->best.correlation > check->correlation) {
      json["suspected_mistake"] = {{"mistake", check->best.mistake},
                                   {"agreement_without", check->best.correlation}};
    }
  }
  json["photos"] = Json::array();
  for (std::size_t k = 0; k < set.photos.size(); ++k) {
    json["photos"].push_back(describe(set.photos[k]));
    if (!check) continue;
    json["photos"].back()["shared_points"] = check->agreement[k].points;
    json["photos"].back()["agreement"] = check->agreement[k].correlation;
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace storey::cameras
