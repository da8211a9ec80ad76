// SPDX-License-Identifier: BSD-3-Clause
#include <storey/surface/dominant_floorplans.h>
#include <storey/surface/extrusion.h>

#include <algorithm>
#include <limits>
#include <map>

namespace storey {
namespace {

// Of thin slices nearly every one has a floorplan of its own, and to try them all as types takes
// time by the cube of their number.
constexpr std::size_t kMostRuns = 64;

// The candidates: floorplans at distance 0 are one type, represented by the first of them.
struct Candidates {
  std::vector<std::size_t> representative;  // floorplan of each candidate
  std::vector<double> share;                // W_T
};

Candidates findCandidates(const FloorplanGrammar& grammar, std::size_t num_plans) {
  Candidates candidates;
  for (std::size_t i = 0; i < num_plans; ++i) {
    std::size_t t = 0;
    while (t < candidates.representative.size() &&
           grammar.distance(candidates.representative[t], i) > 0.0) {
      ++t;
    }
    if (t == candidates.representative.size()) {
      candidates.representative.push_back(i);
      candidates.share.push_back(0.0);
    }
    candidates.share[t] += 1.0 / static_cast<double>(num_plans);
  }
  return candidates;
}

// Which of the candidates from `begin` to `end` has the least sum of distances to the floorplans
// there and as far again to either side.
std::size_t nearestToAll(const FloorplanGrammar& grammar, const Candidates& candidates,
                         std::size_t begin, std::size_t end, std::size_t num_plans) {
  const std::size_t first = candidates.representative[begin];
  const std::size_t last = candidates.representative[end - 1];
  const std::size_t margin = last - first + 1;
  const std::size_t to = std::min(num_plans, last + margin + 1);
  std::size_t nearest = begin;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = begin; t < end; ++t) {
    double sum = 0.0;
    for (std::size_t i = first > margin ? first - margin : 0; i < to; ++i) {
      sum += grammar.distance(candidates.representative[t], i);
    }
    if (sum >= least) continue;
    least = sum;
    nearest = t;
  }
  return nearest;
}

// Of too many candidates one of each run of neighbours, and those that many floorplans equal.
Candidates standingForAll(const FloorplanGrammar& grammar, const Candidates& all,
                          std::size_t num_plans) {
  const std::size_t count = all.representative.size();
  if (count <= kMostRuns) return all;
  Candidates chosen;
  for (std::size_t run = 0; run < kMostRuns; ++run) {
    const std::size_t begin = run * count / kMostRuns;
    const std::size_t end = (run + 1) * count / kMostRuns;
    const std::size_t nearest = nearestToAll(grammar, all, begin, end, num_plans);
    for (std::size_t t = begin; t < end; ++t) {
      if (t != nearest && all.share[t] * kMostRuns < 1.0) continue;
      chosen.representative.push_back(all.representative[t]);
      chosen.share.push_back(all.share[t]);
    }
  }
  return chosen;
}

LayerEnergy buildEnergy(const FloorplanGrammar& grammar, const Candidates& candidates,
                        std::size_t num_plans, const DominantFloorplanOptions& options) {
  LayerEnergy energy;
  energy.num_nodes = num_plans;
  energy.max_labels = options.max_types;
  energy.num_labels = candidates.representative.size();
  for (std::size_t i = 0; i < num_plans; ++i) {  // (12)
    for (const std::size_t t : candidates.representative) {
      energy.data.push_back(grammar.distance(t, i));
    }
  }
  for (const std::size_t a : candidates.representative) {  // (13)
    for (const std::size_t b : candidates.representative) {
      const double d = grammar.distance(a, b);
      const double change =
          d <= options.change_threshold ? options.small_change : options.large_change;
      energy.pair.push_back(a == b ? 0.0 : options.smoothness * change);
    }
  }
  for (const double share : candidates.share) {  // (14)
    energy.label_cost.push_back(options.label_cost * (1.0 - share) * (1.0 - share));
  }
  return energy;
}

// Edges that no letter stands for get a wall id of their own, the same in all blocks of the type.
void nameRemainingWalls(Floorplan& plan, int& next_id) {
  const auto name = [&](FloorplanRing& ring) {
    for (FloorplanEdge& edge : ring.edges) {
      if (edge.wall < 0) edge.wall = next_id++;
    }
  };
  for (FloorplanComponent& component : plan.components) {
    name(component.outer);
    for (FloorplanRing& hole : component.holes) name(hole);
  }
}

// The floorplans of the slices that have one, and their grammar.
struct ValidSlices {
  std::vector<std::size_t> slices;  // of each floorplan
  std::vector<Floorplan> plans;
  FloorplanGrammar grammar;
  Candidates candidates;
};

// Blocks, types and the type of each slice from labels of the floorplans.
void takeLabels(const std::vector<FloorplanLayer>& slices, const ValidSlices& valid,
                const std::vector<int>& labels, DominantFloorplans& result) {
  result.slice_types.assign(slices.size(), -1);
  std::map<int, int> type_of;  // label -> type, in order of height
  std::vector<Floorplan> type_plans;
  int next_wall = static_cast<int>(valid.grammar.getDictionarySize());
  for (std::size_t i = 0; i < valid.plans.size(); ++i) {
    const int label = labels[i];
    if (type_of.emplace(label, static_cast<int>(type_of.size())).second) {
      type_plans.push_back(
          valid.grammar.decode(valid.candidates.representative[static_cast<std::size_t>(label)]));
      nameRemainingWalls(type_plans.back(), next_wall);
    }
    const int type = type_of[label];
    result.slice_types[valid.slices[i]] = type;
    const FloorplanLayer& slice = slices[valid.slices[i]];
    if (!result.types.empty() && result.types.back() == type) {
      result.blocks.back().z_max = slice.z_max;
      continue;
    }
    double z_min = slice.z_min;
    if (!result.blocks.empty()) {
      z_min = 0.5 * (result.blocks.back().z_max + slice.z_min);
      result.blocks.back().z_max = z_min;
    }
    result.types.push_back(type);
    result.blocks.push_back({z_min, slice.z_max, type_plans[static_cast<std::size_t>(type)]});
  }
  result.num_types = static_cast<int>(type_of.size());
}

std::size_t countFaces(const std::vector<FloorplanLayer>& slices, const ValidSlices& valid,
                       const std::vector<int>& labels) {
  DominantFloorplans chosen;
  takeLabels(slices, valid, labels, chosen);
  return extrudeFloorplans(chosen.blocks).faces.size();
}

}  // namespace

DominantFloorplans selectDominantFloorplans(const std::vector<FloorplanLayer>& slices,
                                            const DominantFloorplanOptions& options) {
  DominantFloorplans result;
  result.slice_types.assign(slices.size(), -1);
  ValidSlices valid;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (slices[i].plan.empty()) continue;
    valid.slices.push_back(i);
    valid.plans.push_back(slices[i].plan);
  }
  const std::size_t count = valid.plans.size();
  if (count == 0) return result;
  valid.grammar.setEncoding(options.encoding);
  valid.grammar.setLengthTolerance(options.length_tolerance);
  if (!valid.grammar.encode(valid.plans)) return result;
  result.dictionary_size = valid.grammar.getDictionarySize();
  valid.candidates = standingForAll(valid.grammar, findCandidates(valid.grammar, count), count);
  result.num_candidates = static_cast<int>(valid.candidates.representative.size());
  const LayerEnergy energy = buildEnergy(valid.grammar, valid.candidates, count, options);
  result.labeling = options.exact ? minimizeLayerEnergy(energy) : expandLayerLabels(energy);
  if (options.exact) result.trade_off = tradeOffLabels(energy);
  for (const LayerTradeOff& point : result.trade_off) {
    result.trade_off_faces.push_back(countFaces(slices, valid, point.labeling.labels));
  }
  takeLabels(slices, valid, result.labeling.labels, result);
  return result;
}

}  // namespace storey
