// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include <algorithm>

#include "io/failure.h"
#include "io/limits.h"
#include "io/point_records.h"
#include "io/scan.h"

namespace storey::io {
namespace {

using Words = std::vector<std::string_view>;

std::string quote(std::string_view word) { return "'" + printable(std::string(word), 40) + "'"; }

PlyFormat parseFormat(const InputFile& file, const Words& words) {
  if (words.size() == 3 && words[2] == "1.0") {
    for (const PlyFormat format :
         {PlyFormat::Ascii, PlyFormat::BinaryLittleEndian, PlyFormat::BinaryBigEndian}) {
      if (words[1] == nameOf(format)) return format;
    }
  }
  file.failAtLine("the format is none of ascii, binary_little_endian, binary_big_endian 1.0");
}

Scalar parseType(const InputFile& file, std::string_view word) {
  constexpr std::pair<std::string_view, Scalar> kTypes[] = {
      {"char", Scalar::Int8},      {"int8", Scalar::Int8},       {"uchar", Scalar::UInt8},
      {"uint8", Scalar::UInt8},    {"short", Scalar::Int16},     {"int16", Scalar::Int16},
      {"ushort", Scalar::UInt16},  {"uint16", Scalar::UInt16},   {"int", Scalar::Int32},
      {"int32", Scalar::Int32},    {"uint", Scalar::UInt32},     {"uint32", Scalar::UInt32},
      {"float", Scalar::Float32},  {"float32", Scalar::Float32}, {"double", Scalar::Float64},
      {"float64", Scalar::Float64}};
  for (const auto& [name, type] : kTypes) {
    if (word == name) return type;
  }
  file.failAtLine(quote(word) + " is not a type of PLY");
}

void parseElement(const InputFile& file, const Words& words, PlyHeader& header) {
  PlyElement element;
  if (words.size() != 3 || !parseUnsigned(words[2], element.count)) {
    file.failAtLine("an element needs a name and a whole number from 0");
  }
  element.name = std::string(words[1]);
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name) file.failAtLine("two elements " + quote(element.name));
  }
  if (header.elements.size() == kMaxElements) {
    file.failAtLine("more than " + std::to_string(kMaxElements) + " elements");
  }
  header.elements.push_back(element);
}

void parseProperty(const InputFile& file, const Words& words, PlyHeader& header) {
  if (header.elements.empty()) file.failAtLine("a property before any element");
  PlyElement& element = header.elements.back();
  PlyProperty property;
  property.is_list = words.size() == 5 && words[1] == "list";
  if (!property.is_list && words.size() != 3) file.failAtLine("a property needs a type and a name");
  if (property.is_list) {
    property.count_type = parseType(file, words[2]);
    if (isReal(property.count_type)) file.failAtLine("the length of a list must be an integer");
  }
  property.type = parseType(file, words[words.size() - 2]);
  property.name = std::string(words.back());
  for (const PlyProperty& other : element.properties) {
    if (other.name == property.name) file.failAtLine("two properties " + quote(property.name));
  }
  if (element.properties.size() == kMaxFields) {
    file.failAtLine("more than " + std::to_string(kMaxFields) + " properties");
  }
  element.properties.push_back(property);
}

/// The fewest bytes that a row of the element can have.
std::uint64_t minRowBytes(const PlyElement& element, PlyFormat format) {
  if (format == PlyFormat::Ascii) return 2 * element.properties.size();  // a digit and a blank each
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += sizeOf(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

void checkBody(const InputFile& file, const PlyHeader& header) {
  std::uint64_t needed = 0;
  bool overflow = false;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && element.count > 0) {
      file.fail("its element " + quote(element.name) + " has no properties");
    }
    std::uint64_t bytes = 0;
    overflow |=
        __builtin_mul_overflow(element.count, minRowBytes(element, header.format), &bytes) ||
        __builtin_add_overflow(needed, bytes, &needed);
  }
  // The last line of an ascii file may have no end.
  const std::uint64_t available = file.remaining() + (header.format == PlyFormat::Ascii ? 1 : 0);
  if (overflow || needed > available) {
    file.failAtByte("the header declares more than the " + std::to_string(file.remaining()) +
                    " bytes that are left can hold");
  }
}

}  // namespace

const char* nameOf(PlyFormat format) {
  constexpr const char* kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  return kNames[static_cast<int>(format)];
}

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.is_list; });
}

std::size_t PlyElement::find(const std::string& property, bool is_list) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property && properties[i].is_list == is_list) return i;
  }
  return PlyProperty::kNone;
}

PlyHeader readPlyHeader(InputFile& file) {
  PlyHeader header;
  bool has_format = false;
  if (file.nextHeaderLine() != "ply") file.failAtLine("is not 'ply'");
  while (true) {
    const std::string_view line = file.nextHeaderLine();
    const Words words = splitWords(line);
    if (words.empty() || words[0] == "obj_info") continue;
    if (words[0] == "comment") {
      const std::size_t text = line.find("comment") + 7;
      if (auto note = noteOf(line.substr(text))) header.notes.push_back(*note);
      continue;
    }
    if (words[0] == "end_header" && words.size() == 1) break;
    if (words[0] == "format") {
      if (has_format) file.failAtLine("a second format");
      header.format = parseFormat(file, words);
      has_format = true;
    } else if (words[0] == "element") {
      parseElement(file, words, header);
    } else if (words[0] == "property") {
      parseProperty(file, words, header);
    } else {
      file.failAtLine(quote(words[0]) + " is not a keyword of PLY");
    }
  }
  if (!has_format) file.fail("its header has no format");
  checkBody(file, header);
  return header;
}

}  // namespace storey::io
