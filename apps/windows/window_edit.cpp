// SPDX-License-Identifier: BSD-3-Clause
#include "windows/window_edit.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "io/input_file.h"
#include "io/output_file.h"

namespace storey::windows {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "storey_windows edit 1";

Json toJson(const WindowChange& change) {
  Json json = {{"row", change.row}, {"column", change.column}};
  if (change.keep) json["keep"] = *change.keep;
  if (change.rectangle) {
    const Eigen::Vector2d& a = change.rectangle->min();
    const Eigen::Vector2d& b = change.rectangle->max();
    json["rectangle"] = {a.x(), a.y(), b.x(), b.y()};
  }
  return json;
}

Json toJson(const FacadeEdit& facade) {
  Json json;
  if (facade.isMarked()) {
    json["view"] = facade.view;
    for (const Eigen::Vector2d& corner : facade.quad) {
      json["quad"].push_back(corner.x());
      json["quad"].push_back(corner.y());
    }
  } else {
    json["facade"] = facade.facade;
  }
  if (facade.depth) json["depth"] = *facade.depth;
  json["windows"] = Json::array();
  for (const WindowChange& change : facade.changes) json["windows"].push_back(toJson(change));
  return json;
}

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

/// A number that is one: JSON has none that are infinite, but 1e999 is read as such.
double numberOf(const Json& json, const std::string& name) {
  require(json.is_number() && std::isfinite(json.get<double>()), name + " is no number");
  return json.get<double>();
}

int indexOf(const Json& json, const char* name) {
  constexpr int kMost = 1000000;
  require(json.contains(name) && json[name].is_number_integer(),
          std::string("a window has no whole number '") + name + "'");
  const auto index = json[name].get<std::int64_t>();
  require(index >= 0 && index <= kMost, std::string("a window's '") + name + "' is out of range");
  return static_cast<int>(index);
}

WindowChange changeOf(const Json& json) {
  require(json.is_object(), "a window is no object");
  WindowChange change;
  change.row = indexOf(json, "row");
  change.column = indexOf(json, "column");
  if (json.contains("keep")) {
    require(json["keep"].is_boolean(), "'keep' is neither true nor false");
    change.keep = json["keep"].get<bool>();
  }
  if (!json.contains("rectangle")) return change;
  const Json& r = json["rectangle"];
  require(r.is_array() && r.size() == 4, "'rectangle' is to be four numbers");
  std::array<double, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = numberOf(r[i], "one of a 'rectangle'");
  require(v[0] < v[2] && v[1] < v[3], "a 'rectangle' has no area");
  change.rectangle = {Eigen::Vector2d(v[0], v[1]), Eigen::Vector2d(v[2], v[3])};
  return change;
}

FacadeEdit facadeOf(const Json& json) {
  require(json.is_object(), "a facade is no object");
  require(json.contains("view") != json.contains("facade"),
          "a facade is to have either a 'view' or a 'facade'");
  FacadeEdit facade;
  if (json.contains("view")) {
    require(json["view"].is_string() && !json["view"].get<std::string>().empty(),
            "a 'view' is no name");
    facade.view = json["view"].get<std::string>();
    require(json.contains("quad") && json["quad"].is_array() && json["quad"].size() == 8,
            "'quad' is to be eight numbers");
    for (std::size_t i = 0; i < 8; ++i) {
      facade.quad[i / 2][static_cast<Eigen::Index>(i % 2)] =
          numberOf(json["quad"][i], "one of a 'quad'");
    }
  } else {
    require(json["facade"].is_number_unsigned(), "a 'facade' is no number of a face");
    facade.facade = json["facade"].get<std::size_t>();
  }
  if (json.contains("depth")) facade.depth = numberOf(json["depth"], "'depth'");
  if (!json.contains("windows")) return facade;
  require(json["windows"].is_array(), "'windows' is no list");
  std::set<std::pair<int, int>> seen;
  for (const Json& window : json["windows"]) {
    facade.changes.push_back(changeOf(window));
    const WindowChange& change = facade.changes.back();
    require(seen.insert({change.row, change.column}).second, "a window is there twice");
  }
  return facade;
}

}  // namespace

void writeEdit(const std::string& path, const WindowEdit& edit) {
  Json json = {{"format", kFormat}, {"facades", Json::array()}};
  for (const FacadeEdit& facade : edit.facades) json["facades"].push_back(toJson(facade));
  io::OutputFile file(path);
  file.write(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  file.commit();
}

WindowEdit readEdit(const std::string& path) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 26;  // these files have kilobytes
  io::InputFile file(path, kMaxBytes);
  const auto size = static_cast<std::size_t>(file.size());
  const auto fail = [&](const std::string& reason) {
    file.fail("is no record of an edit: " + reason, "save it again with storey_windows --edit");
  };
  WindowEdit edit;
  try {
    const unsigned char* const text = file.take(size);
    const Json json = Json::parse(text, text + size);
    require(json.is_object() && json.contains("format") && json["format"] == kFormat,
            std::string("its 'format' is not '") + kFormat + "'");
    require(json.contains("facades") && json["facades"].is_array(), "it has no list of 'facades'");
    for (const Json& facade : json["facades"]) edit.facades.push_back(facadeOf(facade));
  } catch (const nlohmann::json::exception& error) {
    fail(error.what());
  } catch (const std::invalid_argument& error) {
    fail(error.what());
  }
  return edit;
}

}  // namespace storey::windows
