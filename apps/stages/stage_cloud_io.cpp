// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stage_cloud_io.h"

#include <storey/segmentation/detail/point_classes.h>

#include <cmath>
#include <cstring>

#include "io/cloud_writer.h"
#include "io/failure.h"
#include "io/line_of_sight.h"
#include "io/raw_cloud.h"
#include "stages/stage_notes.h"

namespace storey::stages {
namespace {

using Field = pcl::PCLPointField;

constexpr std::size_t kMaxFields = 7 + 1 + kGroupNames.size() + 1;  // of 4 bytes each

/// Points as rows of 4-byte numbers.
class Rows {
 public:
  explicit Rows(const StageCloud& cloud) : cloud_(cloud) {
    for (const char* name : {"x", "y", "z"}) add(name, Field::FLOAT32);
    if (cloud.has_normals) {
      for (const char* name : {"normal_x", "normal_y", "normal_z", "curvature"}) {
        add(name, Field::FLOAT32);
      }
    }
    if (!cloud.confidences.empty()) add("intensity", Field::FLOAT32);
    for (std::size_t group = 0; group < kGroupNames.size(); ++group) {
      if (cloud.groups_of[group].empty()) continue;
      columns_.push_back(&cloud.groups_of[group]);
      add(kGroupNames[group], Field::UINT32);
    }
    if (columns_.empty()) return;
    columns_.push_back(columns_.back());
    add("label", Field::UINT32);
  }

  const std::vector<Field>& fields() const { return fields_; }

  const unsigned char* row(std::size_t i) {
    next_ = row_.data();
    const Point& p = (*cloud_.points)[i];
    for (const float value : {p.x, p.y, p.z}) put(value);
    if (cloud_.has_normals) {
      for (const float value : {p.normal_x, p.normal_y, p.normal_z, p.curvature}) put(value);
    }
    if (!cloud_.confidences.empty()) put(cloud_.confidences[i]);
    for (const std::vector<int>* column : columns_) {
      put(static_cast<std::uint32_t>((*column)[i] + 1));
    }
    return row_.data();
  }

 private:
  void add(const char* name, std::uint8_t type) {
    Field field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(4 * fields_.size());
    field.datatype = type;
    field.count = 1;
    fields_.push_back(field);
  }

  template <typename T>
  void put(T value) {
    static_assert(sizeof value == 4);
    std::memcpy(next_, &value, sizeof value);
    next_ += sizeof value;
  }

  const StageCloud& cloud_;
  std::vector<Field> fields_;
  std::vector<const std::vector<int>*> columns_;
  std::array<unsigned char, 4 * kMaxFields> row_{};
  unsigned char* next_ = nullptr;
};

// The positions and normals of a file of a stage are floats: the casts change nothing.
void takePoints(const io::RawCloud& raw, const io::InputFile& file, Cloud& points) {
  points.resize(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Eigen::Vector3f position =
        Eigen::Map<const Eigen::Vector3d>(&raw.positions[3 * i]).cast<float>();
    if (!position.allFinite()) {
      file.fail("point " + std::to_string(i) + " is not finite", "run the stage before again");
    }
    points[i].getVector3fMap() = position;
    if (raw.has_normal_fields) {
      points[i].getNormalVector3fMap() = Eigen::Map<const Eigen::Vector3f>(&raw.normals[3 * i]);
    }
  }
}

/// How many groups there are, as far as the state tells.
std::size_t limitOf(std::size_t group, const StageCloud& cloud) {
  if (group == Class) return storey::detail::kNumPointClasses;
  if (group == Slice) return cloud.state.slices.size();
  if (group == Direction) return cloud.state.directions.size();
  return cloud.points->size();
}

void takeExtra(const io::ExtraColumn& column, const io::InputFile& file, StageCloud& cloud) {
  if (column.name == "curvature") {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      (*cloud.points)[i].curvature = static_cast<float>(column.values[i]);
    }
    return;
  }
  if (column.name == "intensity") {
    cloud.confidences.assign(column.values.begin(), column.values.end());
    return;
  }
  for (std::size_t group = 0; group < kGroupNames.size(); ++group) {
    if (column.name != kGroupNames[group]) continue;
    const auto limit = static_cast<double>(limitOf(group, cloud));
    for (const double value : column.values) {
      if (!(value >= 0.0 && value <= limit && value == std::floor(value))) {
        file.fail(
            "a point has no " + column.name + " from 0 to " + std::to_string(limitOf(group, cloud)),
            "run the stage before again");
      }
      cloud.groups_of[group].push_back(static_cast<int>(value) - 1);
    }
  }
}

}  // namespace

void writeStageCloud(const std::string& path, const StageCloud& cloud) {
  Rows rows(cloud);
  io::CloudView view;
  view.fields = rows.fields();
  view.row = [&rows](std::size_t i) { return rows.row(i); };
  view.width = cloud.points->size();
  view.notes = toNotes(cloud.state);
  io::writeCloud(path, view);
}

StageCloud readStageCloud(const std::string& path) {
  const io::CloudReaderOptions options;
  io::InputFile file(path, options.max_bytes);
  std::vector<std::string> extras = {"curvature", "intensity"};
  extras.insert(extras.end(), kGroupNames.begin(), kGroupNames.end());
  io::RawCloud raw = io::readRawCloud(file, options.limits, extras);
  const std::optional<StageState> state = fromNotes(raw.notes, file);
  if (!state) {
    io::turnToViewers(path, options.limits.max_memory, raw);
    io::LoadedCloud loaded = io::conditionCloud(std::move(raw), file);
    return fromLoaded(loaded, path);
  }
  StageCloud cloud;
  cloud.name = path;
  cloud.state = *state;
  cloud.has_normals = raw.has_normal_fields;
  takePoints(raw, file, *cloud.points);
  for (const io::ExtraColumn& column : raw.extras) takeExtra(column, file, cloud);
  return cloud;
}

StageCloud fromLoaded(io::LoadedCloud& loaded, const std::string& name) {
  StageCloud cloud;
  cloud.name = name;
  cloud.points = std::move(loaded.cloud);
  cloud.has_normals = loaded.has_normals;
  cloud.state.frame_to_input.translation() = loaded.offset;
  return cloud;
}

}  // namespace storey::stages
