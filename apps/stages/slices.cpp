// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slices.h"

#include <storey/filters/detail/threads.h>
#include <storey/filters/gravity_slicing.h>

#include <algorithm>
#include <functional>
#include <map>

#include "stages/attitude.h"

namespace storey::stages {
namespace {

using Stages = SliceStages<Point>;

/// What a step works on: each slice with its points, flat at mid-height, and their groups.
std::vector<Stages> takeApart(const StageCloud& cloud) {
  requireGroups(cloud, Slice, "storey_slices");
  std::vector<Stages> slices(cloud.state.slices.size());
  for (std::size_t s = 0; s < slices.size(); ++s) {
    slices[s].z_min = cloud.state.slices[s].first;
    slices[s].z_max = cloud.state.slices[s].second;
  }
  for (std::size_t i = 0; i < cloud.points->size(); ++i) {
    if (cloud.groups(Slice)[i] < 0) continue;
    Stages& slice = slices[static_cast<std::size_t>(cloud.groups(Slice)[i])];
    slice.indices.push_back(static_cast<pcl::index_t>(i));
    slice.smoothed.push_back((*cloud.points)[i]);
    slice.smoothed.back().z = static_cast<float>(0.5 * (slice.z_min + slice.z_max));
    if (!cloud.groups(Direction).empty()) slice.labels.push_back(cloud.groups(Direction)[i]);
  }
  return slices;
}

/// The regions of each slice, in the order of their numbers.
void takeRegions(const StageCloud& cloud, std::vector<Stages>& slices) {
  requireGroups(cloud, Direction, "storey_labels");
  requireGroups(cloud, Region, "storey_regions");
  for (Stages& slice : slices) {
    std::map<int, pcl::PointIndices> regions;
    for (std::size_t i = 0; i < slice.indices.size(); ++i) {
      const int region = cloud.groups(Region)[static_cast<std::size_t>(slice.indices[i])];
      if (region >= 0) regions[region].indices.push_back(static_cast<pcl::index_t>(i));
    }
    for (auto& [number, region] : regions) {
      slice.region_labels.push_back(slice.labels[static_cast<std::size_t>(region.indices.front())]);
      slice.regions.push_back(std::move(region));
    }
  }
}

/// Runs a step on all slices that have points. A slice that fails is left without points, as one
/// that had none, and the others go on.
std::size_t forEachSlice(std::vector<Stages>& slices, unsigned int threads,
                         const std::function<void(Stages&)>& step) {
  const auto count = static_cast<std::ptrdiff_t>(slices.size());
#pragma omp parallel for num_threads(storey::detail::threadsFor(threads)) schedule(dynamic, 1)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Stages& slice = slices[static_cast<std::size_t>(i)];
    if (slice.indices.empty()) {
      slice.failure = "no points";
      continue;
    }
    try {  // nothing may leave the parallel region
      step(slice);
    } catch (const std::exception& error) {
      slice.failure = error.what();
      slice.indices.clear();
    }
  }
  return static_cast<std::size_t>(std::count_if(
      slices.begin(), slices.end(), [](const Stages& s) { return !s.indices.empty(); }));
}

/// Puts the points of a step's slices back into the cloud, one slice after the other, each at its
/// own height.
void putTogether(const std::vector<Stages>& slices, pcl::PointCloud<Point> Stages::*points,
                 StageCloud& cloud) {
  StageCloud result;
  result.name = cloud.name;
  result.has_normals = true;
  result.state = cloud.state;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    for (std::size_t i = 0; i < slices[s].indices.size(); ++i) {
      const auto origin = static_cast<std::size_t>(slices[s].indices[i]);
      result.points->push_back((slices[s].*points)[i]);
      result.points->back().z = (*cloud.points)[origin].z;
      if (!cloud.confidences.empty()) result.confidences.push_back(cloud.confidences[origin]);
      for (std::size_t group = 0; group < kGroupNames.size(); ++group) {
        if (cloud.groups_of[group].empty()) continue;
        result.groups_of[group].push_back(cloud.groups_of[group][origin]);
      }
    }
  }
  cloud = std::move(result);
}

SliceStageOptions optionsOf(const StageCloud& cloud) {
  if (cloud.state.directions.empty()) {
    refuse(cloud, "has no dominant directions", "let storey_dominant_directions find them first");
  }
  SliceStageOptions options;
  options.directions = cloud.state.directions;
  options.noise = cloud.state.noise;
  return options;
}

}  // namespace

std::string cutSlices(StageCloud& cloud, double thickness) {
  requireNormals(cloud);
  GravitySlicing<Point> slicing;
  slicing.setInputCloud(cloud.points);
  slicing.setIndices(pcl::make_shared<pcl::Indices>(planarPoints(cloud)));
  slicing.setSliceThickness(thickness);
  std::vector<pcl::PointIndices> slices;
  slicing.extract(slices);
  if (slices.empty()) refuse(cloud, "cannot be cut into slices", "is --slice-thickness too small?");
  cloud.state.slices = slicing.getSliceRanges();
  for (std::vector<int>& groups : cloud.groups_of) groups.clear();  // of points, not of slices
  cloud.groups(Slice).assign(cloud.points->size(), -1);
  for (std::size_t s = 0; s < slices.size(); ++s) {
    for (const pcl::index_t i : slices[s].indices) {
      cloud.groups(Slice)[static_cast<std::size_t>(i)] = static_cast<int>(s);
    }
  }
  return format("%zu slices of %.3g", slices.size(), slicing.getSliceThickness());
}

std::string smoothNormals(StageCloud& cloud, unsigned int threads) {
  requireNormals(cloud);
  std::vector<Stages> slices = takeApart(cloud);
  const std::size_t good = forEachSlice(slices, threads, [&](Stages& slice) {
    smoothSlice(*cloud.points, SliceStageOptions(), slice);
  });
  putTogether(slices, &Stages::smoothed, cloud);
  return format("%zu points in %zu slices", cloud.points->size(), good);
}

std::string labelPoints(StageCloud& cloud, unsigned int threads) {
  const SliceStageOptions options = optionsOf(cloud);
  std::vector<Stages> slices = takeApart(cloud);
  forEachSlice(slices, threads, [&](Stages& slice) { labelSlice(options, slice); });
  putTogether(slices, &Stages::smoothed, cloud);
  std::vector<int>& direction_of = cloud.groups(Direction);
  direction_of.clear();
  for (const Stages& slice : slices) {
    if (slice.indices.empty()) continue;
    direction_of.insert(direction_of.end(), slice.labels.begin(), slice.labels.end());
  }
  const auto none = std::count(direction_of.begin(), direction_of.end(), -1);
  return format("%zu directions, %td points without", options.directions.size(), none);
}

std::string growRegions(StageCloud& cloud, unsigned int threads) {
  requireGroups(cloud, Direction, "storey_labels");
  std::vector<Stages> slices = takeApart(cloud);
  forEachSlice(slices, threads, [](Stages& slice) { growSliceRegions(slice); });
  putTogether(slices, &Stages::smoothed, cloud);
  std::vector<int>& region_of = cloud.groups(Region);
  region_of.assign(cloud.points->size(), -1);
  std::size_t first = 0;
  int num_regions = 0;
  for (const Stages& slice : slices) {
    for (const pcl::PointIndices& region : slice.regions) {
      for (const pcl::index_t i : region.indices) {
        region_of[first + static_cast<std::size_t>(i)] = num_regions;
      }
      ++num_regions;
    }
    first += slice.indices.size();
  }
  return format("%d edge regions", num_regions);
}

std::string refinePositions(StageCloud& cloud, unsigned int threads) {
  const SliceStageOptions options = optionsOf(cloud);
  std::vector<Stages> slices = takeApart(cloud);
  takeRegions(cloud, slices);
  const std::size_t good =
      forEachSlice(slices, threads, [&](Stages& slice) { refineSlice(options, slice); });
  putTogether(slices, &Stages::refined, cloud);
  return format("%zu points in %zu slices", cloud.points->size(), good);
}

std::string outlineSlices(StageCloud& cloud, storey::detail::LinkingMethod linking,
                          unsigned int threads, SliceFloorplans& floorplans) {
  ensureScale(cloud);
  SliceStageOptions options = optionsOf(cloud);
  options.linking = linking;
  std::vector<Stages> slices = takeApart(cloud);
  takeRegions(cloud, slices);
  forEachSlice(slices, threads, [&](Stages& slice) {
    slice.refined = slice.smoothed;
    outlineSlice(options, slice);
  });
  std::size_t good = 0;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    floorplans.layers.push_back({slices[s].z_min, slices[s].z_max, slices[s].floorplan});
    good += slices[s].floorplan.empty() ? 0 : 1;
    if (!slices[s].failure.empty()) floorplans.failures.push_back({s, slices[s].failure});
  }
  if (good == 0) {
    refuse(cloud, "no slice has a closed floorplan",
           "is half of the building missing, or the vertical wrong (--up)?");
  }
  return format("%zu slices of %.3g, %zu with a floorplan", slices.size(),
                slices.front().z_max - slices.front().z_min, good);
}

}  // namespace storey::stages
