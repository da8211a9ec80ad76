// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace storey::io {

// What a header may ask for. No honest file comes near; a hostile one is refused before any
// memory is taken.
constexpr std::size_t kMaxHeaderBytes = 1u << 20;
constexpr std::size_t kMaxHeaderLines = 1000;
constexpr std::size_t kMaxHeaderLineBytes = 64u << 10;
constexpr std::size_t kMaxBodyLineBytes = 4u << 20;  // a record of kMaxRecordValues numbers fits
constexpr std::size_t kMaxFields = 256;              // PCD fields, PLY properties of an element
constexpr std::size_t kMaxElements = 64;             // PLY
constexpr std::uint64_t kMaxFieldCount = 4096;       // PCD COUNT of one field
constexpr std::uint64_t kMaxRecordValues = 65536;    // numbers of one point
constexpr std::uint64_t kMaxListLength = 1u << 20;   // entries of one PLY list
constexpr std::uint64_t kMaxPoints = 2147483647;     // pcl::index_t is a signed 32-bit integer
constexpr std::uint64_t kMaxLzfRatio = 264;  // an LZF back reference: 3 bytes give at most 264

// A binary body may be followed by a line end (some writers add one), and by nothing else.
constexpr std::size_t kMaxTrailingBytes = 2;

constexpr std::uint64_t kDefaultMaxFileBytes = std::uint64_t{64} << 30;

/// Default of the memory limits: three quarters of the machine's memory, in bytes.
std::uint64_t defaultMaxMemory();

/// Bytes that a new program can have now, by the kernel's estimate; the default where it gives
/// none.
std::uint64_t availableMemory();

}  // namespace storey::io
