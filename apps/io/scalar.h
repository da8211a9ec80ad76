// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace storey::io {

/// Type of one number in a binary file.
enum class Scalar { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

constexpr std::size_t sizeOf(Scalar type) {
  switch (type) {
    case Scalar::Int8:
    case Scalar::UInt8:
      return 1;
    case Scalar::Int16:
    case Scalar::UInt16:
      return 2;
    case Scalar::Int32:
    case Scalar::UInt32:
    case Scalar::Float32:
      return 4;
    default:
      return 8;
  }
}

constexpr const char* nameOf(Scalar type) {
  constexpr const char* kNames[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                    "uint32", "int64", "uint64", "float32", "float64"};
  return kNames[static_cast<int>(type)];
}

constexpr bool isReal(Scalar type) { return type == Scalar::Float32 || type == Scalar::Float64; }

namespace detail {

template <typename T>
double decode(const unsigned char* bytes, bool big_endian) {
  unsigned char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof(T));
  if (big_endian)
    std::reverse(raw, raw + sizeof(T));  // the host is little-endian, as PCD's binary body
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

}  // namespace detail

/// The number at `bytes` (no alignment needed); exact but for 64-bit integers above 2^53.
inline double decodeScalar(const unsigned char* bytes, Scalar type, bool big_endian) {
  switch (type) {
    case Scalar::Int8:
      return detail::decode<std::int8_t>(bytes, big_endian);
    case Scalar::UInt8:
      return detail::decode<std::uint8_t>(bytes, big_endian);
    case Scalar::Int16:
      return detail::decode<std::int16_t>(bytes, big_endian);
    case Scalar::UInt16:
      return detail::decode<std::uint16_t>(bytes, big_endian);
    case Scalar::Int32:
      return detail::decode<std::int32_t>(bytes, big_endian);
    case Scalar::UInt32:
      return detail::decode<std::uint32_t>(bytes, big_endian);
    case Scalar::Int64:
      return detail::decode<std::int64_t>(bytes, big_endian);
    case Scalar::UInt64:
      return detail::decode<std::uint64_t>(bytes, big_endian);
    case Scalar::Float32:
      return detail::decode<float>(bytes, big_endian);
    default:
      return detail::decode<double>(bytes, big_endian);
  }
}

/// Where the numbers of a field are: so many, so far from each other.
struct StridedBytes {
  const unsigned char* first;
  std::size_t stride;
  std::size_t count;
};

/// Decodes a field of many records. \param each how far the results are from each other
template <typename Out>
void decodeColumn(const StridedBytes& bytes, Scalar type, bool big_endian, Out* out,
                  std::size_t each) {
  const auto decodeAll = [&](auto decodeOne) {
    for (std::size_t i = 0; i < bytes.count; ++i) {
      out[i * each] = static_cast<Out>(decodeOne(bytes.first + i * bytes.stride));
    }
  };
  if (!big_endian && type == Scalar::Float32) {  // nearly all clouds
    decodeAll([](const unsigned char* at) { return detail::decode<float>(at, false); });
  } else if (!big_endian && type == Scalar::Float64) {
    decodeAll([](const unsigned char* at) { return detail::decode<double>(at, false); });
  } else {
    decodeAll([&](const unsigned char* at) { return decodeScalar(at, type, big_endian); });
  }
}

}  // namespace storey::io
