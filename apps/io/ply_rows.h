// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "io/ply_header.h"

namespace storey::io {

/// Steps through the rows of one PLY element of any make. Each row is checked: an ascii row is one
/// line with exactly the declared numbers, and no list is longer than the file or
/// `kMaxListLength`.
class PlyRows {
 public:
  PlyRows(InputFile& file, const PlyElement& element, PlyFormat format);

  /// Reads the next row.
  void next();

  /// Values of the row last read; the property must be of that kind.
  double scalar(std::size_t property) const { return scalars_[property]; }
  const std::vector<double>& list(std::size_t property) const { return lists_[property]; }

 private:
  void nextAscii();
  void nextBinary();
  std::uint64_t checkedLength(double length) const;

  InputFile& file_;
  const PlyElement& element_;
  PlyFormat format_;
  std::vector<double> scalars_;             // parallel to the properties
  std::vector<std::vector<double>> lists_;  // parallel to the properties
};

/// Consumes all rows of an element.
void skipElement(InputFile& file, const PlyElement& element, PlyFormat format);

/// Fails if anything follows the last element.
void expectPlyEnd(InputFile& file, PlyFormat format);

}  // namespace storey::io
