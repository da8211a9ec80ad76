// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "io/formats/import_formats.h"
#include "io/limits.h"
#include "io/scan.h"

namespace storey::io {
namespace {

constexpr double kUnitTolerance = 0.02;        // of the length of a normal with 2 digits
constexpr double kMinShareOfUnits = 0.99;      // else the columns are something else
constexpr std::size_t kCheckEvery = 1u << 20;  // points, of the memory

bool isUnit(double x, double y, double z) {
  return std::abs(std::sqrt(x * x + y * y + z * z) - 1.0) < kUnitTolerance;
}

/// First of the columns of the normal; 0 if there are none.
std::size_t findNormal(const std::vector<double>& row) {
  for (const std::size_t first : {std::size_t{3}, row.size() - 3}) {
    if (first < 3 || first + 3 > row.size()) continue;
    if (isUnit(row[first], row[first + 1], row[first + 2])) return first;
  }
  return 0;
}

class XyzReader {
 public:
  XyzReader(InputFile& file, const ReadLimits& limits) : file_(file), limits_(limits) {
    raw_.limitPoints(limits.max_points);
  }

  RawCloud run() {
    std::string_view line;
    bool at_start = true;
    while (file_.nextBodyLine(line)) {
      if (isComment(line)) continue;
      if (!parse(line)) {
        if (!at_start) file_.failAtLine("holds something that is not a number that can be used");
        at_start = false;  // the names of the columns
        continue;
      }
      if (at_start && row_.size() == 1) {
        announced_ = row_[0];  // .pts
      } else {
        add();
      }
      at_start = false;
    }
    finish();
    return std::move(raw_);
  }

 private:
  static bool isComment(std::string_view line) {
    const std::size_t start = line.find_first_not_of(" \t");
    return line[start] == '#' || line.substr(start, 2) == "//";
  }

  bool parse(std::string_view line) {
    text_ = line;
    std::replace_if(
        text_.begin(), text_.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    NumberScanner scanner(text_);
    row_.clear();
    double value = 0.0;
    auto result = scanner.next(value);
    for (; result == NumberScanner::Result::Number; result = scanner.next(value)) {
      if (row_.size() == kMaxFields) file_.failAtLine("has too many numbers");
      row_.push_back(value);
    }
    return result == NumberScanner::Result::End;
  }

  void add() {
    if (raw_.declared == 0) {
      if (row_.size() < 3) file_.failAtLine("has fewer than 3 numbers");
      num_columns_ = row_.size();
      normal_ = findNormal(row_);
    }
    if (row_.size() != num_columns_) {
      file_.failAtLine("has " + std::to_string(row_.size()) + " numbers, expected " +
                       std::to_string(num_columns_));
    }
    raw_.positions.insert(raw_.positions.end(), row_.begin(), row_.begin() + 3);
    if (normal_ > 0) {
      const double* const n = &row_[normal_];
      for (int axis = 0; axis < 3; ++axis) raw_.normals.push_back(static_cast<float>(n[axis]));
      num_units_ += isUnit(n[0], n[1], n[2]) ? 1 : 0;
    }
    raw_.settle(raw_.size() - 1);
    if (++raw_.declared % kCheckEvery == 0) {
      checkPoints(file_, raw_.declared + kCheckEvery, limits_);
    }
  }

  void finish() {
    if (raw_.declared == 0) file_.fail("has no points");
    if (announced_ >= 0.0 && announced_ != static_cast<double>(raw_.declared)) {
      file_.fail("its first line announces another number of points than the " +
                 std::to_string(raw_.declared) + " that follow");
    }
    const auto size = static_cast<double>(raw_.declared);
    raw_.has_normal_fields =
        normal_ > 0 && static_cast<double>(num_units_) >= kMinShareOfUnits * size;
    if (!raw_.has_normal_fields) raw_.normals.clear();
    raw_.format = "text, " + std::to_string(num_columns_) + " columns";
  }

  InputFile& file_;
  const ReadLimits& limits_;
  RawCloud raw_;
  std::string text_;
  std::vector<double> row_;
  std::size_t num_columns_ = 0;
  std::size_t normal_ = 0;
  std::size_t num_units_ = 0;
  double announced_ = -1.0;
};

}  // namespace

RawCloud readXyz(InputFile& file, const ReadLimits& limits) {
  return XyzReader(file, limits).run();
}

}  // namespace storey::io
