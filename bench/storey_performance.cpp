// SPDX-License-Identifier: BSD-3-Clause
// storey_performance FOLDER: CPU time and memory of every stage for clouds of rising size, beside
// PCL's algorithms and the floor of the machine in the same run. Prints doc/performance.md.
#include <pcl/console/print.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "bench/isolation.h"
#include "bench/markdown.h"
#include "bench/peers.h"
#include "io/cloud_reader.h"
#include "io/failure.h"
#include "reconstruct/pipeline.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/sampling.h"

namespace storey::bench {
namespace {

constexpr const char* kBuilding = "syn1";
constexpr double kMillion = 1e6;

struct Row {
  std::string work;
  double seconds = 0.0;    // of CPU
  double megabytes = 0.0;  // peak of the process; 0 where it says nothing
};

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string rowText(const Row& row) {
  char text[200];
  std::snprintf(text, sizeof text, "%s;%.6f;%.1f\n", row.work.c_str(), row.seconds, row.megabytes);
  return text;
}

std::vector<Row> rowsOf(const Report& report) {
  if (!report.failure.empty()) throw io::Failure(io::Internal, "", report.failure, "");
  std::vector<Row> rows;
  std::istringstream lines(report.result);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(';');
    const std::size_t second = line.find(';', first + 1);
    rows.push_back({line.substr(0, first), std::stod(line.substr(first + 1)),
                    std::stod(line.substr(second + 1))});
  }
  return rows;
}

std::string writeCloud(const std::string& path, std::size_t points) {
  synth::SamplingOptions sampling;
  sampling.points = points;
  synth::writeCloudPly(path, synth::sampleBuilding(synth::makeBuilding(kBuilding).layers, sampling),
                       false, true);
  return "";
}

// What no program can go below: the bytes read, and one pass over them.
std::string measureFloor(const std::string& path) {
  double start = cpuSeconds();
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<char> bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  std::string text = rowText({"floor: the bytes read", cpuSeconds() - start, peakMegabytes()});
  start = cpuSeconds();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], 8);
    sum += word;
  }
  volatile const std::uint64_t kept = sum;  // or there would be nothing to measure
  static_cast<void>(kept);
  return text + rowText({"floor: one pass over them", cpuSeconds() - start, 0.0});
}

std::string measureStages(const std::string& path, reconstruct::Method method) {
  reconstruct::Options options;
  options.input = path;
  options.method = method;
  options.threads = 1;
  const reconstruct::Result result = reconstruct::reconstruct(options);
  std::string text;
  double total = 0.0;
  for (const reconstruct::StageTime& stage : result.times) {
    text += rowText({stage.name, stage.cpu_seconds, 0.0});
    total += stage.cpu_seconds;
  }
  return text + rowText({"all", total, peakMegabytes()});
}

std::string measurePeer(const std::string& path, const Peer& peer) {
  const auto loaded = io::readCloud(path);
  const double start = cpuSeconds();
  peer.run(loaded.cloud);
  return rowText({peer.name, cpuSeconds() - start, peakMegabytes()});
}

// One table: a row a work, a column a size. Rows also go to a file for the plots.
class Results {
 public:
  explicit Results(std::vector<std::size_t> sizes) : sizes_(std::move(sizes)) {}

  void add(std::size_t size, const std::string& prefix, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      const std::string work = prefix + row.work;
      if (rows_.emplace(work, std::map<std::size_t, Row>()).second) order_.push_back(work);
      rows_[work][size] = row;
      std::fprintf(stderr, "%9zu %-45s %8.3f s %8.0f MB\n", size, work.c_str(), row.seconds,
                   row.megabytes);
    }
  }

  void print() const {
    std::vector<std::string> header = {"CPU seconds a million points"};
    for (const std::size_t size : sizes_) header.push_back(std::to_string(size));
    header.emplace_back("million points a second");
    header.emplace_back("bytes a point");
    Table table(header);
    for (const std::string& work : order_) table.add(cellsOf(work));
    table.print();
  }

  void writeCsv(const std::string& path) const {
    std::ofstream file(path);
    for (const std::string& work : order_) {
      for (const auto& [size, row] : rows_.at(work)) {
        file << '"' << work << "\"," << size << ',' << row.seconds << ',' << row.megabytes << '\n';
      }
    }
  }

 private:
  // Speed and memory are those of the largest cloud.
  std::vector<std::string> cellsOf(const std::string& work) const {
    std::vector<std::string> cells = {work};
    const std::map<std::size_t, Row>& by_size = rows_.at(work);
    for (const std::size_t size : sizes_) {
      const auto row = by_size.find(size);
      cells.push_back(row == by_size.end()
                          ? "-"
                          : fixed(row->second.seconds * kMillion / static_cast<double>(size), 3));
    }
    const auto& [size, last] = *by_size.rbegin();
    const auto points = static_cast<double>(size);
    cells.push_back(last.seconds > 0.0 ? fixed(points / last.seconds / kMillion, 1) : "-");
    cells.push_back(last.megabytes > 0.0 ? fixed(last.megabytes * 1048576.0 / points, 0) : "-");
    return cells;
  }

  std::vector<std::size_t> sizes_;
  std::vector<std::string> order_;
  std::map<std::string, std::map<std::size_t, Row>> rows_;
};

void measure(std::size_t size, const std::string& path, Results& results) {
  const auto alone = [](const Task& task) {
    return rowsOf(runIsolated({task}, 1, [](std::size_t, const Report&) {}).front());
  };
  alone([&] { return writeCloud(path, size); });
  results.add(size, "", alone([&] { return measureFloor(path); }));
  results.add(size, "building: ", alone([&] {
                return measureStages(path, reconstruct::Method::Building);
              }));
  results.add(size,
              "paper: ", alone([&] { return measureStages(path, reconstruct::Method::Paper); }));
  for (const Peer& peer : peers()) {
    if (size <= peer.most_points) {
      results.add(size, "", alone([&] { return measurePeer(path, peer); }));
    }
  }
  std::remove(path.c_str());
}

int run(int argc, char** argv) {
  const bool quick = argc == 3 && std::strcmp(argv[2], "--quick") == 0;
  if (argc != 2 && !quick) {
    throw io::Failure(io::Usage, "", "expected a folder for clouds and tables, and --quick at most",
                      "storey_performance FOLDER [--quick]");
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  std::vector<std::size_t> sizes = {100000, 1000000, 4000000, 20000000};
  if (quick) sizes.resize(2);
  Results results(sizes);
  for (const std::size_t size : sizes) {
    measure(size, std::string(argv[1]) + "/performance.ply", results);
  }
  results.print();
  results.writeCsv(std::string(argv[1]) + "/performance.csv");
  return io::Ok;
}

}  // namespace
}  // namespace storey::bench

int main(int argc, char** argv) {
  return storey::io::runMain("storey_performance", [&] { return storey::bench::run(argc, argv); });
}
