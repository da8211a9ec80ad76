// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/distance_kernels.h>
#include <storey/filters/detail/instruction_sets.h>

namespace storey::detail {
namespace {

constexpr std::size_t kHalf = kLanes / 2;
constexpr int kCountings = 16;
constexpr float kWider = 1.2f;
constexpr float kInfinity = __builtin_inff();

// As many lanes on every machine, in one register or several: so sums have one order.
typedef float Floats __attribute__((vector_size(kLanes * sizeof(float)), aligned(4), may_alias));
typedef std::int32_t Ints __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
typedef float Halves __attribute__((vector_size(kHalf * sizeof(float)), aligned(4), may_alias));
typedef std::int32_t Order __attribute__((vector_size(kHalf * sizeof(std::int32_t))));
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

#define STOREY_INLINE inline __attribute__((always_inline))

// Vectors are passed by reference: by value, the instruction set would change how.
STOREY_INLINE const Floats& load(const float* values) {
  return *reinterpret_cast<const Floats*>(values);
}

STOREY_INLINE void store(const Floats& values, float* to) {
  *reinterpret_cast<Floats*>(to) = values;
}

// Lane i of a comparison as bit i.
STOREY_INLINE std::uint32_t bitsOf(const Ints& truth) {
  Ints bits =
      truth & Ints{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
  bits |= __builtin_shuffle(bits, Ints{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7});
  bits |= __builtin_shuffle(bits, Ints{4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11});
  bits |= __builtin_shuffle(bits, Ints{2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13});
  return static_cast<std::uint32_t>(bits[0] | bits[1]);
}

// Appends first + i for every lane i that is true.
STOREY_INLINE std::size_t appendPlaces(const Ints& truth, std::size_t first, std::uint32_t* places,
                                       std::size_t count) {
  const std::uint32_t bits = bitsOf(truth);
  for (std::uint32_t half = 0; half < 2; ++half) {
    // All eight are stored and those in excess overwritten: there is no branch to guess.
    const std::uint32_t byte = bits >> (8 * half) & 0xff;
    *reinterpret_cast<Places*>(places + count) =
        *reinterpret_cast<const Places*>(kSetBits.places[byte].data()) +
        (static_cast<std::uint32_t>(first) + 8 * half);
    count += kSetBits.counts[byte];
  }
  return count;
}

STOREY_INLINE std::size_t countWithin(const float* values, std::size_t n, float limit) {
  Ints counts = {};
  for (std::size_t i = 0; i < n; i += kLanes) {
    counts -= load(values + i) <= limit;  // true is -1
  }
  counts += __builtin_shuffle(counts, Ints{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7});
  counts += __builtin_shuffle(counts, Ints{4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11});
  counts += __builtin_shuffle(counts, Ints{2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13});
  return static_cast<std::size_t>(counts[0] + counts[1]);
}

// Squared distances to a box, 0 inside.
STOREY_INLINE void distancesToBox(const Floats& x, const Floats& y, const Floats& z,
                                  const Corners& box, Floats& squared) {
  const Floats* const coordinates[3] = {&x, &y, &z};
  squared = Floats{};
  for (int axis = 0; axis < 3; ++axis) {
    const Floats before = box.low[axis] - *coordinates[axis];
    const Floats behind = *coordinates[axis] - box.high[axis];
    const Floats nearest = before > behind ? before : behind;
    const Floats outside = nearest > 0.0f ? nearest : Floats{};
    squared += outside * outside;
  }
}

}  // namespace

STOREY_EACH_INSTRUCTION_SET
std::size_t boxesWithin(const std::array<const float*, 6>& sides, std::size_t n, const Corners& box,
                        float squared_reach, std::uint32_t* places) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += kLanes) {
    Floats sum = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats before = load(sides[axis] + i) - box.high[axis];
      const Floats behind = box.low[axis] - load(sides[axis + 3] + i);
      const Floats nearest = before > behind ? before : behind;
      const Floats outside = nearest > 0.0f ? nearest : Floats{};
      sum += outside * outside;
    }
    count = appendPlaces(sum <= squared_reach, i, places, count);
  }
  return count;
}

STOREY_EACH_INSTRUCTION_SET
std::size_t positionsWithin(const Coordinates& positions, const std::uint32_t* blocks,
                            std::size_t num_blocks, const Corners& box, float squared_reach,
                            const std::array<float*, 3>& chosen) {
  const float* const coordinates[3] = {positions.x, positions.y, positions.z};
  std::size_t count = 0;
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const std::size_t first = blocks[b] * kLanes;
    Floats squared;
    distancesToBox(load(positions.x + first), load(positions.y + first), load(positions.z + first),
                   box, squared);
    const std::uint32_t bits = bitsOf(squared <= squared_reach);
    for (std::size_t half = 0; half < 2; ++half) {
      const std::uint32_t byte = bits >> (8 * half) & 0xff;
      const Order order = *reinterpret_cast<const Order*>(kSetBits.places[byte].data());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Halves all =
            *reinterpret_cast<const Halves*>(coordinates[axis] + first + half * kHalf);
        *reinterpret_cast<Halves*>(chosen[axis] + count) = __builtin_shuffle(all, order);
      }
      count += kSetBits.counts[byte];
    }
  }
  return count;
}

STOREY_EACH_INSTRUCTION_SET
void squaredDistances(const Coordinates& positions, const std::uint32_t* blocks,
                      std::size_t num_blocks, const float* q, float* squared) {
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const std::size_t first = blocks[b] * kLanes;
    const Floats dx = load(positions.x + first) - q[0];
    const Floats dy = load(positions.y + first) - q[1];
    const Floats dz = load(positions.z + first) - q[2];
    store(dx * dx + dy * dy + dz * dz, squared + b * kLanes);
  }
}

STOREY_EACH_INSTRUCTION_SET
float limitOf(const float* values, std::size_t n, std::size_t k, float guess) {
  float low = 0.0f;
  float high = kInfinity;
  float below = 0.0f;  // how many are within `low`, and within `high`
  float above = 0.0f;
  const auto wanted = static_cast<float>(k);
  float limit = guess;
  for (int round = 0; round < kCountings; ++round) {
    const std::size_t count = countWithin(values, n, limit);
    if (count == k) {
      return limit;
    }
    if (count < k) {
      low = limit;
      below = static_cast<float>(count);
    } else {
      high = limit;
      above = static_cast<float>(count);
    }
    // On a surface the number within a distance grows like its square, evenly between two limits.
    limit = high < kInfinity ? low + (high - low) * (wanted + 0.5f - below) / (above + 1.0f - below)
                             : kWider * low * wanted / (below > 0.5f ? below : 0.5f);
    if (!(limit > low && limit < high)) {
      limit = 0.5f * (low + high);
    }
  }
  return __builtin_nanf("");
}

STOREY_EACH_INSTRUCTION_SET
std::size_t placesWithin(const float* values, std::size_t n, float limit, std::uint32_t* places) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += kLanes) {
    count = appendPlaces(load(values + i) <= limit, i, places, count);
  }
  return count;
}

}  // namespace storey::detail
