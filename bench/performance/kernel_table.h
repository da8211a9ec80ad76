// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include "bench/markdown.h"

namespace storey::bench {

/// Gathers what Google Benchmark measures into one table in Markdown. A benchmark tells by
/// `SetItemsProcessed` how many items it did, and by its label what they are.
class KernelTable : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override { table_.print(); }

 private:
  Table table_{{"kernel", "items", "ns an item", "million items a second", "ms a call"}};
};

}  // namespace storey::bench
