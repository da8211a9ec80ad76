// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/crs.h"
#include "io/input_file.h"
#include "io/polygon_soup.h"

namespace storey::io {

/// Puts a polygon soup together from untrusted numbers; every `add` either keeps the soup valid or
/// fails with the place in the file.
class PolygonBuilder {
 public:
  /// \param by_line whether a message names the line or the byte
  PolygonBuilder(const InputFile& file, bool by_line) : file_(file), by_line_(by_line) {}

  void addVertex(double x, double y, double z);

  /// Of the vertex added last; of all vertices or none.
  void addDeviation(double deviation) { soup_.deviations.push_back(deviation); }

  /// \param corners indices from 0, not yet checked; polygons may come before their vertices
  void addPolygon(const std::vector<std::int64_t>& corners, PolygonSoup::Polygon polygon);

  /// What comments of the file that are ours tell (`noteOf`).
  void addNote(const std::string& note) {
    if (std::string crs = crsOfNote(note); !crs.empty()) soup_.crs = std::move(crs);
  }

  std::size_t numVertices() const { return soup_.vertices.size(); }

  /// The finished soup. Fails if it is empty or a corner has no vertex.
  PolygonSoup finish();

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  const InputFile& file_;
  bool by_line_;
  PolygonSoup soup_;
};

PolygonSoup readPlyPolygons(InputFile& file, std::uint64_t max_memory);
PolygonSoup readObjPolygons(InputFile& file, std::uint64_t max_memory);

}  // namespace storey::io
