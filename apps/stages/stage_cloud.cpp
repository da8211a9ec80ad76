// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stage_cloud.h"

#include <cstdarg>
#include <cstdio>

#include "io/failure.h"

namespace storey::stages {

pcl::Indices planarPoints(const StageCloud& cloud) {
  pcl::Indices planar;
  planar.reserve(cloud.points->size());
  for (std::size_t i = 0; i < cloud.points->size(); ++i) {
    if (cloud.confidences.empty() || cloud.confidences[i] >= cloud.state.planar_threshold) {
      planar.push_back(static_cast<pcl::index_t>(i));
    }
  }
  return planar;
}

void refuse(const StageCloud& cloud, const std::string& reason, const std::string& hint) {
  throw io::Failure(io::BadInput, cloud.name, reason, hint);
}

void requireGroups(const StageCloud& cloud, Group group, const std::string& program) {
  if (!cloud.groups(group).empty()) return;
  refuse(cloud, std::string("its points have no field ") + kGroupNames[group],
         "let " + program + " find it first");
}

void requireNormals(const StageCloud& cloud) {
  if (cloud.has_normals) return;
  refuse(cloud, "its points have no normals", "let storey_vertical estimate them first");
}

std::string format(const char* text, ...) {
  char line[400];
  va_list arguments;
  va_start(arguments, text);
  std::vsnprintf(line, sizeof line, text, arguments);
  va_end(arguments);
  return line;
}

}  // namespace storey::stages
