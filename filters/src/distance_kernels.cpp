// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/distance_kernels.h>

// Only here, where neither PCL nor Eigen is included: their types change with the instruction set.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__linux__)
#define STOREY_EACH_INSTRUCTION_SET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STOREY_EACH_INSTRUCTION_SET
#endif

namespace storey::detail {
namespace {

constexpr std::size_t kDoubles = 8;

// As many lanes on every machine, in one register or several: so sums have one order.
typedef float Floats __attribute__((vector_size(kLanes * sizeof(float)), aligned(4), may_alias));
typedef std::int32_t Ints __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
typedef double Doubles __attribute__((vector_size(kDoubles * sizeof(double))));
typedef float HalfFloats
    __attribute__((vector_size(kDoubles * sizeof(float)), aligned(4), may_alias));

typedef std::uint32_t Places __attribute__((vector_size(32), aligned(4), may_alias));

// For every byte the places of its bits that are set, and how many they are.
struct SetBits {
  alignas(32) std::array<std::array<std::uint32_t, 8>, 256> places{};
  std::array<std::uint32_t, 256> counts{};

  constexpr SetBits() {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      for (std::uint32_t bit = 0; bit < 8; ++bit) {
        if ((byte >> bit & 1U) != 0) {
          places[byte][counts[byte]++] = bit;
        }
      }
    }
  }
};
constexpr SetBits kSetBits;

// Lane i of a comparison as bit i.
inline __attribute__((always_inline)) std::uint32_t bitsOf(const Ints& truth) {
  Ints bits =
      truth & Ints{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
  bits |= __builtin_shuffle(bits, Ints{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7});
  bits |= __builtin_shuffle(bits, Ints{4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11});
  bits |= __builtin_shuffle(bits, Ints{2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13});
  return static_cast<std::uint32_t>(bits[0] | bits[1]);
}

}  // namespace

STOREY_EACH_INSTRUCTION_SET
void squaredDistances(const float* x, const float* y, const float* z, std::size_t n, const float* q,
                      float* squared) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Floats dx = *reinterpret_cast<const Floats*>(x + i) - q[0];
    const Floats dy = *reinterpret_cast<const Floats*>(y + i) - q[1];
    const Floats dz = *reinterpret_cast<const Floats*>(z + i) - q[2];
    *reinterpret_cast<Floats*>(squared + i) = dx * dx + dy * dy + dz * dz;
  }
}

STOREY_EACH_INSTRUCTION_SET
void squaredDistancesToBox(const float* x, const float* y, const float* z, std::size_t n,
                           const float* low, const float* high, float* squared) {
  const float* coordinates[3] = {x, y, z};
  for (std::size_t i = 0; i < n; i += kLanes) {
    Floats sum = {};
    for (int axis = 0; axis < 3; ++axis) {
      const Floats c = *reinterpret_cast<const Floats*>(coordinates[axis] + i);
      const Floats before = low[axis] - c;
      const Floats behind = c - high[axis];
      const Floats outside = before > 0.0f ? before : behind > 0.0f ? behind : Floats{};
      sum += outside * outside;
    }
    *reinterpret_cast<Floats*>(squared + i) = sum;
  }
}

STOREY_EACH_INSTRUCTION_SET
std::size_t countWithin(const float* values, std::size_t n, float limit) {
  Ints counts = {};
  for (std::size_t i = 0; i < n; i += kLanes) {
    counts -= *reinterpret_cast<const Floats*>(values + i) <= limit;  // true is -1
  }
  counts += __builtin_shuffle(counts, Ints{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7});
  counts += __builtin_shuffle(counts, Ints{4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11});
  counts += __builtin_shuffle(counts, Ints{2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13});
  return static_cast<std::size_t>(counts[0] + counts[1]);
}

STOREY_EACH_INSTRUCTION_SET
std::size_t placesWithin(const float* values, std::size_t n, float limit, std::uint32_t* places) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Ints within = *reinterpret_cast<const Floats*>(values + i) <= limit;
    const std::uint32_t bits = bitsOf(within);
    for (std::uint32_t half = 0; half < 2; ++half) {
      // All eight are stored and those in excess overwritten: there is no branch to guess.
      const std::uint32_t byte = bits >> (8 * half) & 0xff;
      *reinterpret_cast<Places*>(places + count) =
          *reinterpret_cast<const Places*>(kSetBits.places[byte].data()) +
          (static_cast<std::uint32_t>(i) + 8 * half);
      count += kSetBits.counts[byte];
    }
  }
  return count;
}

STOREY_EACH_INSTRUCTION_SET
Moments momentsAbout(const float* x, const float* y, const float* z, std::size_t n, const float* q,
                     std::size_t count) {
  Doubles sums[9] = {};
  for (std::size_t i = 0; i < n; i += kDoubles) {
    const Doubles dx =
        __builtin_convertvector(*reinterpret_cast<const HalfFloats*>(x + i), Doubles) -
        static_cast<double>(q[0]);
    const Doubles dy =
        __builtin_convertvector(*reinterpret_cast<const HalfFloats*>(y + i), Doubles) -
        static_cast<double>(q[1]);
    const Doubles dz =
        __builtin_convertvector(*reinterpret_cast<const HalfFloats*>(z + i), Doubles) -
        static_cast<double>(q[2]);
    sums[0] += dx;
    sums[1] += dy;
    sums[2] += dz;
    sums[3] += dx * dx;
    sums[4] += dx * dy;
    sums[5] += dx * dz;
    sums[6] += dy * dy;
    sums[7] += dy * dz;
    sums[8] += dz * dz;
  }
  double totals[9];
  for (std::size_t s = 0; s < 9; ++s) {
    const Doubles& v = sums[s];
    totals[s] = ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
  }
  Moments moments;
  moments.count = static_cast<double>(count);
  for (std::size_t i = 0; i < 3; ++i) {
    moments.sum[i] = totals[i];
  }
  for (std::size_t i = 0; i < 6; ++i) {
    moments.products[i] = totals[3 + i];
  }
  return moments;
}

}  // namespace storey::detail
