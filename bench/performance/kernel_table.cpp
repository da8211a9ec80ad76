// SPDX-License-Identifier: BSD-3-Clause
#include "bench/performance/kernel_table.h"

#include <cstdio>

namespace storey::bench {

bool KernelTable::ReportContext(const Context&) { return true; }

void KernelTable::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const auto items = run.counters.find("items_per_second");
    if (run.error_occurred || items == run.counters.end()) continue;
    const double a_second = items->second.value;
    const double a_call = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    std::fprintf(stderr, "%s: %.1f ns\n", run.benchmark_name().c_str(), 1e9 / a_second);
    table_.add({run.benchmark_name(), run.report_label, fixed(1e9 / a_second, 1),
                fixed(a_second * 1e-6, 2), fixed(1e3 * a_call, 3)});
  }
}

}  // namespace storey::bench
