// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiment.h"

namespace storey::bench {

/// What the command line asks for.
struct Request {
  std::string suite;
  std::string folder;      ///< suite real: of the clouds
  std::uint64_t seed = 1;  ///< of the first building or draw; the others follow
  std::size_t count = 0;   ///< buildings or draws; 0: as many as the suite takes by default
  std::size_t points = 0;  ///< in each cloud; 0: as the suite has it
  std::optional<reconstruct::Method> method;  ///< if only one is wanted
  std::string defect;                         ///< suite defects: only this one
  std::string cloud_options;                  ///< suite real: file with options for each cloud
  std::string csv;                            ///< file for all numbers, a row an experiment
  unsigned int jobs = 1;

  std::size_t countOr(std::size_t by_default) const { return count > 0 ? count : by_default; }
  std::size_t pointsOr(std::size_t by_default) const { return points > 0 ? points : by_default; }
};

/// `perform` as requested, with the numbers left in `Request::csv`.
std::vector<Outcome> perform(const Request& request, const std::vector<Experiment>& experiments);

/// Clean clouds of random buildings, from the request's seed on.
std::vector<Experiment> randomBuildings(const Request& request, std::size_t count);

/// The same with all defects at once.
std::vector<Experiment> damagedBuildings(const Request& request, std::size_t count);

/// Each measures and prints a section in Markdown to stdout.
void measureNamed(const Request& request);     ///< the paper's buildings, beside its figures
void measureRandom(const Request& request);    ///< clean clouds of random buildings
void measureCombined(const Request& request);  ///< the same with all defects at once
void measureAblation(const Request& request);  ///< the same two, without one step at a time
void measureDefects(const Request& request);   ///< one defect at a time, at rising levels
void measureShapes(const Request& request);    ///< a round building; other scales and places
void measureReal(const Request& request);      ///< clouds without truth

}  // namespace storey::bench
