// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "io/failure.h"
#include "io/formats/import_formats.h"
#include "io/limits.h"
#include "io/scalar.h"
#include "io/text_numbers.h"

namespace storey::io {
namespace {

using Words = std::vector<std::string_view>;

class VtkReader {
 public:
  VtkReader(InputFile& file, const ReadLimits& limits) : file_(file), limits_(limits) {}

  RawCloud run() {
    readHeader();
    readPoints();
    if (old_) {
      skipCells();
      readNormals();
    }
    return std::move(raw_);
  }

 private:
  /// The words of the next line that is not blank, or none at the end. Sections begin with them.
  Words nextWords() {
    std::string_view line;
    return file_.remaining() > 0 && file_.nextBodyLine(line) ? splitWords(line) : Words();
  }

  void readHeader() {
    const std::string version(file_.nextHeaderLine());
    old_ = version.find("Version 5") == std::string::npos;  // from 5 on cells are stored otherwise
    file_.nextHeaderLine();                                 // the title
    const std::string kind(file_.nextHeaderLine());
    if (kind != "ASCII" && kind != "BINARY") file_.failAtLine("is neither ASCII nor BINARY");
    binary_ = kind == "BINARY";
    const Words words = nextWords();
    if (words.size() != 2 || words[0] != "DATASET" || words[1] != "POLYDATA") {
      file_.failAtLine("is not DATASET POLYDATA", "write the points as polygonal data");
    }
  }

  Scalar typeOf(std::string_view word) const {
    if (word == "float") return Scalar::Float32;
    if (word == "double") return Scalar::Float64;
    file_.failAtLine("'" + printable(std::string(word), 40) + "' is neither float nor double");
  }

  std::uint64_t countOf(std::string_view word) const {
    std::uint64_t count = 0;
    if (!parseUnsigned(word, count)) file_.failAtLine("has no number where one belongs");
    return count;
  }

  /// Calls `take` with each number of a section.
  template <typename Take>
  void readNumbers(std::uint64_t count, Scalar type, const Take& take) {
    const std::uint64_t least = binary_ ? sizeOf(type) : 2;  // a digit and a blank
    if (count > (file_.remaining() + 1) / least) {
      file_.failAtLine("announces more numbers than the file holds");
    }
    if (binary_) {
      for (std::uint64_t i = 0; i < count; ++i) {
        take(decodeScalar(file_.take(sizeOf(type)), type, true));
      }
      return;
    }
    TextNumbers numbers(file_);
    for (std::uint64_t i = 0; i < count; ++i) take(numbers.next());
    numbers.expectLineEnd();
  }

  void readPoints() {
    const Words words = nextWords();
    if (words.size() != 3 || words[0] != "POINTS") file_.failAtLine("is not 'POINTS n type'");
    raw_.declared = countOf(words[1]);
    const Scalar type = typeOf(words[2]);
    checkPoints(file_, raw_.declared, limits_.wholeFile());
    raw_.format = std::string("vtk ") + (binary_ ? "binary " : "ascii ") + nameOf(type);
    readNumbers(3 * raw_.declared, type, [&](double x) { raw_.positions.push_back(x); });
  }

  /// Passes over the cells; `section_` is then what follows them.
  void skipCells() {
    for (section_ = nextWords(); section_.size() == 3; section_ = nextWords()) {
      bool cells = false;
      for (const char* kind : {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"}) {
        cells |= section_[0] == kind;
      }
      if (!cells) return;
      readNumbers(countOf(section_[2]), Scalar::Int32, [](double) {});
    }
  }

  void readNormals() {
    if (section_.size() != 2 || section_[0] != "POINT_DATA" ||
        countOf(section_[1]) != raw_.declared) {
      return;
    }
    const Words words = nextWords();
    if (words.size() != 3 || words[0] != "NORMALS") return;
    raw_.has_normal_fields = true;
    readNumbers(3 * raw_.declared, typeOf(words[2]),
                [&](double x) { raw_.normals.push_back(static_cast<float>(x)); });
  }

  InputFile& file_;
  const ReadLimits& limits_;
  bool binary_ = false;
  bool old_ = true;
  Words section_;
  RawCloud raw_;
};

}  // namespace

RawCloud readVtkPoints(InputFile& file, const ReadLimits& limits) {
  return VtkReader(file, limits).run();
}

}  // namespace storey::io
