// SPDX-License-Identifier: BSD-3-Clause
#include "malformed_files.h"

#include <cstring>
#include <sstream>

namespace storey::test {
namespace {

/// A PCD of two points whose header lines can be replaced one by one.
std::string pcd(const std::string& fields, const std::string& size, const std::string& type,
                const std::string& count, const std::string& width, const std::string& height,
                const std::string& points, const std::string& rest) {
  return "VERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " + type + "\nCOUNT " +
         count + "\nWIDTH " + width + "\nHEIGHT " + height + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         points + "\n" + rest;
}

std::string pcdSized(const std::string& width, const std::string& height, const std::string& points,
                     const std::string& rest) {
  return pcd("x y z", "4 4 4", "F F F", "1 1 1", width, height, points, rest);
}

std::string pcdTyped(const std::string& size, const std::string& type, const std::string& count) {
  return pcd("x y z", size, type, count, "3", "1", "3", "DATA ascii\n" + asciiRows(3));
}

std::string pcdLines(const std::string& lines) {
  return pcdSized("3", "1", "3", "DATA ascii\n" + lines);
}

std::string manyFields(int n) {
  std::string names;
  for (int i = 0; i < n; ++i) names += "f" + std::to_string(i) + " ";
  return "VERSION 0.7\nFIELDS " + names + "\nSIZE 4\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

std::string ply(const std::string& format, const std::string& elements, const std::string& body) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

std::string asciiPly(const std::string& before, int n, const std::string& after,
                     const std::string& body) {
  return ply("ascii", before + "element vertex " + std::to_string(n) + "\n" + kXyz + after, body);
}

/// Rows "x y z <extra>".
std::string rowsWith(int n, const std::string& extra) {
  std::istringstream rows(asciiRows(n));
  std::string text;
  for (std::string row; std::getline(rows, row);) text += row + " " + extra + "\n";
  return text;
}

const char* const kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

}  // namespace

Eigen::Vector3d samplePoint(int i) { return {0.5 * i, (i * i) % 101 - 7.25, 3.0 - 0.125 * i}; }

std::string asciiRows(int n) {
  std::ostringstream text;
  for (int i = 0; i < n; ++i) text << samplePoint(i).transpose().format({17, 0}) << "\n";
  return text.str();
}

std::string binaryRows(int n) {
  std::string bytes;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3f point = samplePoint(i).cast<float>();
    bytes.append(reinterpret_cast<const char*>(point.data()), 12);
  }
  return bytes;
}

std::string pcdHeader(int n, const std::string& data) {
  const std::string count = std::to_string(n);
  return "# .PCD v0.7 - Point Cloud Data file format\n" +
         pcdSized(count, "1", count, "DATA " + data + "\n");
}

std::string packPlain(const std::string& bytes) {
  std::string stream;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    stream += static_cast<char>(run.size() - 1);
    stream += run;
  }
  return stream;
}

std::string compressedBody(std::uint32_t packed, std::uint32_t unpacked,
                           const std::string& stream) {
  std::string body(8, '\0');
  std::memcpy(&body[0], &packed, 4);
  std::memcpy(&body[4], &unpacked, 4);
  return body + stream;
}

std::vector<CorpusFile> malformedPcd() {
  const std::string ascii = "DATA ascii\n" + asciiRows(3);
  const std::string binary = "DATA binary\n" + binaryRows(3);
  const std::string squeezed = pcdHeader(100000, "binary_compressed");
  const std::string stream = packPlain(std::string(36, '\0'));
  const auto length = static_cast<std::uint32_t>(stream.size());
  const std::string tail = "3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\n";
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + tail;
  return {
      {"empty", "", 0, "empty"},
      {"nul_bytes", std::string(4096, '\0'), 0, "neither"},
      {"points_1e18", pcdSized("1000000000000000000", "1", "1000000000000000000", ascii), 0,
       "1000000000000000000"},
      {"points_negative", pcdSized("3", "1", "-1", ascii), 0, "POINTS"},
      {"points_2_32", pcdSized("4294967295", "1", "4294967295", ascii), 0, "4294967295"},
      {"points_2_30_ascii", pcdSized("1073741824", "1", "1073741824", ascii), 0, "left"},
      {"points_2_30_binary", pcdSized("1073741824", "1", "1073741824", binary), 0, "left"},
      {"count_1e9", pcdTyped("4 4 4", "F F F", "1 1 1000000000"), 0, "COUNT"},
      {"count_2_30", pcdTyped("4 4 4", "F F F", "1073741824 1 1"), 0, "COUNT"},
      {"count_negative", pcdTyped("4 4 4", "F F F", "-1 1 1"), 0, "COUNT"},
      {"count_zero", pcdTyped("4 4 4", "F F F", "0 1 1"), 0, "COUNT"},
      {"count_4096", pcdTyped("4 4 4", "F F F", "1 1 4096"), 0, "z"},
      {"size_negative", pcdTyped("-1 4 4", "F F F", "1 1 1"), 0, "SIZE"},
      {"size_wraps", pcdTyped("-65536 4 131072", "F F F", "1 1 1"), 0, "SIZE"},
      {"size_3", pcdTyped("3 4 4", "F F F", "1 1 1"), 0, "SIZE"},
      {"size_1_float", pcdTyped("1 1 1", "F F F", "1 1 1"), 0, "TYPE"},
      {"size_missing", pcdTyped("4 4", "F F F", "1 1 1"), 0, "SIZE"},
      {"type_unknown", pcdTyped("4 4 4", "Q F F", "1 1 1"), 0, "TYPE"},
      {"type_mixed", pcdTyped("4 8 4", "F F F", "1 1 1"), 0, "types"},
      {"second_fields", head + "FIELDS x y z a b c\n" + ascii, 0, "FIELDS"},
      {"second_size", head + "SIZE 8 8 8\n" + binary, 0, "SIZE"},
      {"second_count", head + "COUNT 9 9 9\n" + binary, 0, "COUNT"},
      {"product_wraps_to_0", pcdSized("65536", "65536", "0", ascii), 0, "WIDTH"},
      {"product_wraps_64", pcdSized("4294967296", "4294967296", "0", ascii), 0, "WIDTH"},
      {"product_differs", pcdSized("3", "2", "3", ascii), 0, "WIDTH"},
      {"no_points", pcdSized("0", "0", "0", "DATA ascii\n"), 0, "no points"},
      {"unpacked_2_32",
       pcdHeader(3, "binary_compressed") + compressedBody(length, 0xffffffffu, stream), 0,
       "4294967295"},
      {"unpacked_4", squeezed + compressedBody(length, 4, stream), 0, "1200000"},
      {"unpacked_0", squeezed + compressedBody(length, 0, stream), 0, "1200000"},
      {"unpacked_bomb", squeezed + compressedBody(length, 1200000, stream), 0, "1200000"},
      {"packed_too_long",
       pcdHeader(3, "binary_compressed") + compressedBody(length + 1, 36, stream), 0, "left"},
      {"packed_0", pcdHeader(3, "binary_compressed") + compressedBody(0, 36, ""), 0, "left"},
      {"packed_without_sizes", pcdHeader(3, "binary_compressed") + "abc", 0, "early"},
      {"packed_points_before_start",
       pcdHeader(3, "binary_compressed") +
           compressedBody(4, 36, std::string("\xe0\x1b\x00\x00", 4)),
       0, "damaged"},
      {"data_without_word", pcdSized("3", "1", "3", "DATA\n" + asciiRows(3)), 0, "DATA"},
      {"data_missing", pcdSized("3", "1", "3", ""), 0, "header"},
      {"data_lzma", pcdSized("3", "1", "3", "DATA lzma\n" + asciiRows(3)), 0, "lzma"},
      {"fields_300000", manyFields(300000), 0, "longer"},
      {"fields_5000", manyFields(5000), 0, "fields"},
      {"fields_absent", "VERSION 0.7\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n", 0, "FIELDS"},
      {"fields_empty", pcd("", "", "", "", "3", "1", "3", ascii), 0, "called x"},
      {"z_missing", pcd("x y w", "4 4 4", "F F F", "1 1 1", "3", "1", "3", ascii), 0, "called z"},
      {"field_twice", pcd("x x y z", "4 4 4 4", "F F F F", "1 1 1 1", "3", "1", "3", ascii), 0,
       "two fields"},
      {"row_too_short", pcdLines("1 2 3\n1.5 2.5\n4 5 6\n"), 0, "line 12"},
      {"row_too_long", pcdLines("1 2 3\n1 2 3 4\n4 5 6\n"), 0, "line 12"},
      {"row_missing", pcdLines("1 2 3\n                 \n4 5 6\n"), 0, "2 of 3"},
      {"row_too_many", pcdLines(asciiRows(4)), 0, "line 14"},
      {"word_abc", pcdLines("1 2 3\n1 abc 3\n4 5 6\n"), 0, "line 12: word 2"},
      {"word_hex", pcdLines("1 2 3\n1 0x10 3\n4 5 6\n"), 0, "line 12: word 2"},
      {"word_1e999", pcdLines("1 2 3\n1 2 1e999\n4 5 6\n"), 0, "line 12: word 3"},
      {"word_comma", pcdLines("1 2 3\n1 2,5 3\n4 5 6\n"), 0, "line 12: word 2"},
      {"viewpoint_nan",
       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nHEIGHT 1\nVIEWPOINT nan "
       "nan nan 0 0 0 0\nPOINTS 3\n" +
           ascii,
       0, "VIEWPOINT"},
      {"viewpoint_zero",
       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 "
       "0 0 0 0\nPOINTS 3\n" +
           ascii,
       0, "VIEWPOINT"},
      {"binary_too_short", pcdHeader(3, "binary") + binaryRows(2), 0, "left"},
      {"binary_too_long", pcdHeader(3, "binary") + binaryRows(4), 0, "12 bytes more"},
      {"all_nan", pcdLines("nan nan nan\nnan 0 0\n0 0 inf\n"), 0, "distinct"},
      {"two_places", pcdLines("1 2 3\n4 5 6\n1 2 3\n"), 0, "2 distinct"},
      {"newline_in_word", pcdHeader(3, "asc\x01ii\x7f"), 0, "asc?ii?"},
      {"legal", pcdHeader(3, "ascii") + asciiRows(3), 3, ""},
      {"legal_crlf",
       "FIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 3\r\nHEIGHT 1\r\nPOINTS "
       "3\r\nDATA ascii\r\n0 -7.25 3\r\n0.5 -6.25 2.875\r\n1 -3.25 2.75\r\n",
       3, ""},
      {"legal_no_last_newline", pcdLines("0 -7.25 3\n0.5 -6.25 2.875\n+1 -3.25 2.75"), 3, ""},
      {"legal_old_names", "COLUMNS x y z\n" + head.substr(13) + ascii, 3, ""},
      {"legal_double_ascii", pcdTyped("8 8 8", "F F F", "1 1 1"), 3, ""},
      {"legal_padding",
       pcd("_ x y _ z", "1 4 4 2 4", "U F F I F", "1 1 1 2 1", "3", "1", "3",
           "DATA ascii\n7 0 -7.25 8 9 3\n7 .5 -6.25 8 9 2.875\n7 1e0 -325e-2 8 9 2.75\n"),
       3, ""},
      {"legal_compressed_plain",
       pcdHeader(3, "binary_compressed") +
           [] {
             std::string columns;  // all x, all y, all z
             for (std::size_t axis = 0; axis < 3; ++axis) {
               for (std::size_t i = 0; i < 3; ++i)
                 columns += binaryRows(3).substr(12 * i + 4 * axis, 4);
             }
             const std::string packed = packPlain(columns);
             return compressedBody(static_cast<std::uint32_t>(packed.size()), 36, packed);
           }(),
       3, ""},
  };
}

std::vector<CorpusFile> malformedPly() {
  const std::string binary = "binary_little_endian";
  const std::string grid = "element range_grid 2\nproperty list uchar int vertex_indices\n";
  const std::string camera = "element camera 1\nproperty int viewportx\nproperty int viewporty\n";
  const std::string rows = asciiRows(3);
  const auto declared = [&](const std::string& count, const std::string& format) {
    return ply(format, "element vertex " + count + "\n" + kXyz,
               format == "ascii" ? rows : binaryRows(3));
  };
  return {
      {"vertices_2_32", declared("4294967295", "ascii"), 0, "vertices_2_32"},
      {"vertices_2_32_binary", declared("4294967295", binary), 0, "more than"},
      {"vertices_negative", declared("-1", "ascii"), 0, "whole number"},
      {"vertices_1e12", declared("1000000000000", binary), 0, "more than"},
      {"vertices_2_64", declared("18446744073709551616", binary), 0, "whole number"},
      {"vertices_wrap", declared("1537228672809129302", binary), 0, "more than"},
      {"vertices_0", declared("0", "ascii"), 0, "no points"},
      {"faces_1e9",
       asciiPly("", 3,
                "element face 1000000000\nproperty list uchar int "
                "vertex_indices\n",
                rows),
       0, "more than"},
      {"faces_1e18",
       asciiPly("", 3,
                "element face 1000000000000000000\nproperty list uchar int "
                "vertex_indices\n",
                rows),
       0, "more than"},
      {"range_grid_1e9",
       asciiPly("", 3,
                "element range_grid 1000000000\nproperty list uchar int "
                "vertex_indices\n",
                rows),
       0, "more than"},
      {"no_properties",
       ply(binary, "element foo 18446744073709551615\nelement vertex 3\n" + kXyz, binaryRows(3)), 0,
       "no properties"},
      {"vertex_no_properties", ply(binary, "element vertex 18446744073709551615\n", ""), 0,
       "no properties"},
      {"num_cols",
       asciiPly("obj_info num_cols 1\nobj_info num_rows 1\n", 1000, "", asciiRows(1000)), 1000, ""},
      {"num_cols_intensity",
       asciiPly("obj_info num_cols 1\nobj_info num_rows 1\n", 1000, "property uchar intensity\n",
                rowsWith(1000, "9")),
       1000, ""},
      {"num_cols_rgba",
       asciiPly(
           "obj_info num_cols 1\nobj_info num_rows 1\n", 1000,
           "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
           rowsWith(1000, "1 2 3 4")),
       1000, ""},
      {"num_cols_negative", asciiPly("obj_info num_cols -1\n", 3, "", rows), 3, ""},
      {"num_cols_1e10",
       asciiPly("obj_info num_cols 100000\nobj_info num_rows 100000\n", 3, "", rows), 3, ""},
      {"viewport_60000", asciiPly("", 3, camera, rows + "60000 60000\n"), 3, ""},
      {"range_grid_index", asciiPly("", 3, grid, rows + "1 -1\n1 357913941\n"), 3, ""},
      {"vertex_list_grows",
       ply("ascii", "element vertex 3\nproperty list uchar int tags\n" + kXyz,
           "0 0 -7.25 3\n2 8 8 0.5 -6.25 2.875\n1 9 1 -3.25 2.75\n"),
       3, ""},
      {"green_without_red",
       asciiPly("", 3, "property uchar green\nproperty uchar blue\n", rowsWith(3, "7 8")), 3, ""},
      {"face_index_out", asciiPly("", 3, kFaces, rows + "3 0 1 999999\n"), 3, ""},
      {"face_index_negative", asciiPly("", 3, kFaces, rows + "3 0 1 -1\n"), 3, ""},
      {"face_ushort_list",
       ply("ascii",
           "element vertex 3\n" + kXyz +
               "element face 1\nproperty "
               "list ushort int vertex_indices\n",
           rows + "3 0 1 2\n"),
       3, ""},
      {"list_longer_than_file",
       ply(binary,
           "element vertex 3\n" + kXyz +
               "element face 1\nproperty "
               "list uint int vertex_indices\n",
           binaryRows(3) + std::string("\xff\xff\x0f\x00", 4)),
       0, "early"},
      {"list_2_32",
       ply(binary,
           "element vertex 3\n" + kXyz +
               "element face 1\nproperty list uint "
               "int vertex_indices\n",
           binaryRows(3) + "\xff\xff\xff\xff"),
       0, "list"},
      {"list_negative", asciiPly("", 3, kFaces, rows + "-3 0 1 2\n"), 0, "line 13"},
      {"list_half", asciiPly("", 3, kFaces, rows + "2.5 0 1 2\n"), 0, "line 13"},
      {"list_nan", asciiPly("", 3, kFaces, rows + "nan 0 1 2\n"), 0, "line 13"},
      {"list_too_short", asciiPly("", 3, kFaces, rows + "3 0 1\n"), 0, "line 13"},
      {"list_too_long", asciiPly("", 3, kFaces, rows + "3 0 1 2 3\n"), 0, "line 13"},
      {"list_real_length",
       asciiPly("", 3,
                "element face 1\nproperty list float int "
                "vertex_indices\n",
                rows + "3 0 1 2\n"),
       0, "integer"},
      {"x_is_a_list",
       ply("ascii",
           "element vertex 1\nproperty list uchar float x\nproperty float "
           "y\nproperty float z\n",
           "1 2 3 4\n"),
       0, "called x"},
      {"no_format", "ply\nelement vertex 3\n" + kXyz + "end_header\n" + rows, 0, "format"},
      {"format_2", "ply\nformat ascii 2.0\nelement vertex 3\n" + kXyz + "end_header\n" + rows, 0,
       "format"},
      {"no_end_header", "ply\nformat ascii 1.0\nelement vertex 3\n" + kXyz, 0, "header"},
      {"no_vertex", ply("ascii", "element point 3\n" + kXyz, rows), 0, "vertex"},
      {"vertex_twice", asciiPly("", 3, "element vertex 3\n" + kXyz, rows + rows), 0,
       "two elements"},
      {"property_twice", asciiPly("", 3, "property float x\n", rowsWith(3, "1")), 0,
       "two properties"},
      {"property_first", ply("ascii", "property float x\nelement vertex 3\n" + kXyz, rows), 0,
       "before any element"},
      {"type_unknown", ply("ascii", "element vertex 3\nproperty quad x\n", rows), 0, "type"},
      {"only_magic", "ply\n", 0, "header"},
      {"header_of_1e6_lines",
       "ply\nformat ascii 1.0\n" +
           [] {
             std::string lines;
             for (int i = 0; i < 100000; ++i) lines += "comment\n";
             return lines;
           }(),
       0, "lines"},
      {"header_line_of_1_mib", "ply\ncomment " + std::string(1 << 20, 'a'), 0, "longer"},
      {"row_too_many", asciiPly("", 3, "", asciiRows(4)), 0, "more rows"},
      {"binary_too_long", ply(binary, "element vertex 3\n" + kXyz, binaryRows(4)), 0,
       "12 bytes more"},
      {"legal_last_newline", ply(binary, "element vertex 3\n" + kXyz, binaryRows(3) + "\n"), 3, ""},
      {"legal_element_before",
       ply(binary,
           "element tag 2\nproperty list uchar short a\nproperty "
           "double b\nelement vertex 3\n" +
               kXyz,
           std::string("\x02"
                       "abcd12345678"
                       "\x00"
                       "12345678",
                       22) +
               binaryRows(3)),
       3, ""},
  };
}

std::vector<CorpusFile> malformedObj() {
  const std::string triangle = "v 0 -7.25 3\nv 0.5 -6.25 2.875\nv 1 -3.25 2.75\n";
  return {
      {"blank_line", triangle + "      \nf 1 2 3\n", 3, ""},
      {"vertex_of_two", "v 1 2\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", 0, "line 1"},
      {"vertex_of_none", triangle + "v\nf 1 2 3\n", 0, "line 4"},
      {"vertex_nan", triangle + "v nan 0 0\nf 1 2 3\n", 0, "line 4"},
      {"vertex_abc", triangle + "v a b c\nf 1 2 3\n", 0, "line 4"},
      {"more_normals", triangle + "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//4 2//4 3//4\n", 3,
       ""},
      {"mtllib_without_name", "mtllib\n" + triangle + "f 1 2 3\n", 3, ""},
      {"mtllib_elsewhere", "mtllib ../../../../etc/passwd\n" + triangle + "f 1 2 3\n", 3, ""},
      {"face_index_out", triangle + "f 1 2 999999\n", 0, "999998"},
      {"face_index_0", triangle + "f 0 1 2\n", 0, "line 4"},
      {"face_index_back_9", triangle + "f -9 1 2\n", 0, "line 4"},
      {"face_abc", triangle + "f a b c\n", 0, "line 4"},
      {"face_of_two", triangle + "f 1 2\n", 0, "line 4"},
      {"face_of_one_point", triangle + "f 1 1 1 1\n", 0, "line 4"},
      {"face_index_2_64", triangle + "f 1 2 18446744073709551616\n", 0, "line 4"},
      {"no_faces", triangle, 0, "no faces"},
      {"not_a_mesh", "hello world\n", 0, "line 1"},
      {"no_usemtl", triangle + "f 1 2 3\n", 3, ""},
      {"legal_odd", "o a\n" + triangle + "vt 0 0\nusemtl x\ns off\nf -3/1/1 2/1 3\n", 3, ""},
  };
}

}  // namespace storey::test
