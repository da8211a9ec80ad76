// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/results.h"

#include <cstdio>
#include <fstream>

#include "bench/markdown.h"

namespace storey::bench {
namespace {

constexpr double kMillion = 1e6;
constexpr const char* kStages = "building: ";
constexpr const char* kTotal = "building: all stages";

std::string shortNumber(std::size_t size) {
  return size >= 1000000 ? std::to_string(size / 1000000) + "M" : std::to_string(size / 1000) + "k";
}

}  // namespace

void Results::add(std::size_t size, const std::string& prefix,
                  const std::vector<Measured>& measured) {
  for (const Measured& m : measured) {
    const std::string work = prefix + m.work;
    if (rows_.emplace(work, std::map<std::size_t, Measured>()).second) order_.push_back(work);
    rows_[work][size] = m;
    std::fprintf(stderr, "%9zu %-52s %8.3f s CPU %8.3f s %7.0f MB\n", size, work.c_str(), m.cpu,
                 m.wall, m.bytes / 1048576.0);
  }
}

const Measured* Results::find(const std::string& work, std::size_t size) const {
  const auto row = rows_.find(work);
  if (row == rows_.end()) return nullptr;
  const auto cell = row->second.find(size);
  return cell == row->second.end() ? nullptr : &cell->second;
}

void Results::print() const {
  std::vector<std::string> header = {"CPU seconds a million points"};
  for (const std::size_t size : sizes_) header.push_back(shortNumber(size));
  const std::string growth = shortNumber(sizes_.back()) + " : 1M";
  if (sizes_.back() > 1000000) header.push_back(growth);
  header.emplace_back("million points a second");
  header.emplace_back("bytes a point");
  Table table(header);
  for (const std::string& work : order_) table.add(cellsOf(work));
  table.print();
}

// Speed and memory are those of the largest cloud.
std::vector<std::string> Results::cellsOf(const std::string& work) const {
  std::vector<std::string> cells = {work};
  const auto perMillion = [](const Measured& m, std::size_t size) {
    return m.cpu * kMillion / static_cast<double>(size);
  };
  for (const std::size_t size : sizes_) {
    const Measured* m = find(work, size);
    cells.push_back(m == nullptr ? "-" : fixed(perMillion(*m, size), 3));
  }
  if (sizes_.back() > 1000000) {
    const Measured* small = find(work, 1000000);
    const Measured* large = find(work, sizes_.back());
    const bool both = small != nullptr && large != nullptr && small->cpu > 0.01;
    cells.push_back(both ? fixed(perMillion(*large, sizes_.back()) / perMillion(*small, 1000000), 2)
                         : "-");
  }
  const auto& [size, last] = *rows_.at(work).rbegin();
  const auto points = static_cast<double>(size);
  cells.push_back(last.cpu > 0.0 ? fixed(points / last.cpu / kMillion, 2) : "-");
  cells.push_back(last.bytes > 0.0 ? fixed(last.bytes / points, 0) : "-");
  return cells;
}

void Results::writeCsv(const std::string& path) const {
  std::ofstream file(path);
  for (const std::string& work : order_) {
    for (const auto& [size, m] : rows_.at(work)) {
      file << '"' << work << "\"," << size << ',' << m.cpu << ',' << m.wall << ',' << m.bytes
           << '\n';
    }
  }
}

void Results::writeShares(const std::string& path) const {
  std::ofstream file(path);
  std::vector<std::string> stages;
  for (const std::string& work : order_) {
    if (work.rfind(kStages, 0) != 0 || work == kTotal) continue;
    if (rows_.at(work).rbegin()->second.cpu > 0.0) stages.push_back(work);
  }
  file << "points";
  for (const std::string& stage : stages) file << ',' << stage.substr(std::string(kStages).size());
  for (const std::size_t size : sizes_) {
    const Measured* all = find(kTotal, size);
    if (all == nullptr) continue;
    file << '\n' << shortNumber(size);
    for (const std::string& stage : stages) {
      const Measured* m = find(stage, size);
      file << ',' << (m == nullptr ? 0.0 : 100.0 * m->cpu / all->cpu);
    }
  }
  file << '\n';
}

}  // namespace storey::bench
