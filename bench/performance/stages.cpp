// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/stages.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "io/failure.h"
#include "reconstruct/pipeline.h"

namespace storey::bench {

std::vector<Measured> measureAlone(const std::function<std::vector<Measured>()>& work) {
  const Report report =
      runIsolated({[&] { return textOf(work()); }}, 1, [](std::size_t, const Report&) {}).front();
  if (!report.failure.empty()) throw io::Failure(io::Internal, "", report.failure, "");
  return measuredFrom(report.result);
}

std::vector<Measured> measureFloor(const std::string& cloud) {
  Meter meter;
  std::ifstream file(cloud, std::ios::binary | std::ios::ate);
  std::vector<char> bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  std::vector<Measured> measured = {meter.lap("floor: the bytes read")};
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], 8);
    sum += word;
  }
  volatile const std::uint64_t kept = sum;  // or there would be nothing to measure
  static_cast<void>(kept);
  measured.push_back(meter.lap("floor: one pass over them"));
  return measured;
}

std::vector<Measured> measureStages(const reconstruct::Options& options) {
  std::vector<Measured> measured;
  Measured all{"all stages"};
  Meter meter;
  const double at_first = meter.resident();
  reconstruct::Observers observers;
  observers.progress = [&](const std::string&) {
    const double before = meter.resident();
    measured.push_back(meter.lap(""));
    all.bytes = std::max(all.bytes, before - at_first + measured.back().bytes);
  };
  const reconstruct::Result result = reconstruct::reconstruct(options, observers);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    measured[i].work = result.times[i].name;
    measured[i].cpu = result.times[i].cpu_seconds;
    measured[i].wall = result.times[i].seconds;
    all.cpu += measured[i].cpu;
    all.wall += measured[i].wall;
  }
  measured.push_back(all);
  return measured;
}

}  // namespace storey::bench
