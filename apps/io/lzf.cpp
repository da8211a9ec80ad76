// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.h"

#include <cstring>

namespace storey::io {
namespace {

constexpr unsigned kFirstBackReference = 32;  // control bytes below it announce plain bytes
constexpr std::size_t kExtendedLength = 7;
constexpr std::size_t kMinCopy = 2;

}  // namespace

bool unpackLzf(const unsigned char* packed, std::size_t packed_size, unsigned char* unpacked,
               std::size_t unpacked_size) {
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < packed_size) {
    const unsigned control = packed[in++];
    if (control < kFirstBackReference) {
      const std::size_t length = control + 1;
      if (length > packed_size - in || length > unpacked_size - out) return false;
      std::memcpy(unpacked + out, packed + in, length);
      in += length;
      out += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == kExtendedLength) {
      if (in == packed_size) return false;
      length += packed[in++];
    }
    length += kMinCopy;
    if (in == packed_size) return false;
    const std::size_t distance = ((control & 31u) << 8) + packed[in++] + 1;
    if (distance > out || length > unpacked_size - out) return false;
    // Byte by byte: the source may overlap the bytes that are being written.
    for (const std::size_t end = out + length; out < end; ++out) {
      unpacked[out] = unpacked[out - distance];
    }
  }
  return out == unpacked_size;
}

}  // namespace storey::io
