// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace storey::test {

/// A file that a reader must survive.
struct CorpusFile {
  std::string name;
  std::string content;
  int num_points = 0;    ///< > 0: legal, read as `samplePoint(0 .. num_points - 1)`; 0: refused
  std::string mentions;  ///< a refusal must contain this, so that it is refused for its own fault
};

/// Point i of all sample files: distinct and exact as a float.
Eigen::Vector3d samplePoint(int i);

/// What `samplePoint(0 .. n - 1)` is as lines "x y z".
std::string asciiRows(int n);

/// The same as float32 records in host byte order.
std::string binaryRows(int n);

/// A PCD header with fields x y z up to and including the DATA line.
std::string pcdHeader(int n, const std::string& data);

/// LZF stream of plain bytes only, and the body of a PCD with the two sizes as given.
std::string packPlain(const std::string& bytes);
std::string compressedBody(std::uint32_t packed, std::uint32_t unpacked, const std::string& stream);

/// A LAS file with the sample points, of version 1.`minor`.
std::string lasFile(int num_points, int minor, int format);

/// Malformed and odd files, by format.
std::vector<CorpusFile> malformedPcd();
std::vector<CorpusFile> malformedPly();
std::vector<CorpusFile> malformedLas();
std::vector<CorpusFile> malformedVtk();
std::vector<CorpusFile> malformedPatches();
std::vector<CorpusFile> malformedXyz();
std::vector<CorpusFile> malformedObj();  ///< `num_points` is the number of vertices

}  // namespace storey::test
