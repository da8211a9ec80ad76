// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/meter.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>

namespace storey::bench {
namespace {

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A value of /proc/self/status, "VmRSS" or "VmHWM", in bytes.
double memoryOf(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name + ":", 0) == 0) return 1024.0 * std::stod(line.substr(name.size() + 1));
  }
  return 0.0;
}

}  // namespace

void Meter::start() {
  malloc_trim(0);  // or the work would have memory for nothing that another one gave back
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak starts anew at what is in use now
  resident_ = memoryOf("VmRSS");
  wall_ = wallSeconds();
  cpu_ = cpuSeconds();
}

Measured Meter::lap(const std::string& work) {
  const Measured measured{work, wallSeconds() - wall_, cpuSeconds() - cpu_,
                          std::max(0.0, memoryOf("VmHWM") - resident_)};
  start();
  return measured;
}

std::string textOf(const std::vector<Measured>& measured) {
  std::string text;
  for (const Measured& m : measured) {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "%.6f %.6f %.0f ", m.wall, m.cpu, m.bytes);
    text += numbers + m.work + "\n";
  }
  return text;
}

std::vector<Measured> measuredFrom(const std::string& text) {
  std::vector<Measured> measured;
  std::istringstream lines(text);
  Measured m;
  while (lines >> m.wall >> m.cpu >> m.bytes && lines.get() == ' ' && std::getline(lines, m.work)) {
    measured.push_back(m);
  }
  return measured;
}

}  // namespace storey::bench
