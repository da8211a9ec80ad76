// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/distance_kernels.h>

// The kernel for each instruction set has registers of its own width, so the one to run is chosen
// by hand here.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__linux__)
#define STOREY_TARGET(set) __attribute__((target(set)))
#define STOREY_HAS(set) __builtin_cpu_supports(set)
#else
#define STOREY_TARGET(set)
#define STOREY_HAS(set) false
#endif

namespace storey::detail {
namespace {

constexpr int kCountings = 16;
constexpr float kWider = 1.2f;
constexpr float kInfinity = __builtin_inff();

// As many lanes as a register has. What is found does not depend on it: no lane knows another.
template <std::size_t kWidth>
struct Register {
  typedef float Floats __attribute__((vector_size(kWidth * sizeof(float)), may_alias));
  typedef std::int32_t Ints __attribute__((vector_size(kWidth * sizeof(std::int32_t)), may_alias));
  typedef double Doubles __attribute__((vector_size(kWidth * sizeof(double)), may_alias));
};

struct Input {
  const Coordinates& candidates;
  std::size_t n;
  const std::array<Lanes, 3>& queries;
  std::size_t k;
  float guess;
};

#define STOREY_INLINE inline __attribute__((always_inline))

template <typename Vector>
STOREY_INLINE Vector& at(Lanes& lanes, std::size_t first) {
  return *reinterpret_cast<Vector*>(lanes.of.data() + first);
}

template <typename Vector>
STOREY_INLINE const Vector& at(const Lanes& lanes, std::size_t first) {
  return *reinterpret_cast<const Vector*>(lanes.of.data() + first);
}

template <std::size_t kWidth>
STOREY_INLINE void measure(const Input& in, std::size_t first, Lanes* squared) {
  using Floats = typename Register<kWidth>::Floats;
  const Floats qx = at<Floats>(in.queries[0], first);
  const Floats qy = at<Floats>(in.queries[1], first);
  const Floats qz = at<Floats>(in.queries[2], first);
  for (std::size_t i = 0; i < in.n; ++i) {
    const Floats dx = in.candidates.x[i] - qx;
    const Floats dy = in.candidates.y[i] - qy;
    const Floats dz = in.candidates.z[i] - qz;
    at<Floats>(squared[i], first) = dx * dx + dy * dy + dz * dz;
  }
}

// As `limitOf`, for the values of each lane.
template <std::size_t kWidth>
STOREY_INLINE void findLimits(const Input& in, std::size_t first, const Lanes* squared,
                              Lanes& limits) {
  using Floats = typename Register<kWidth>::Floats;
  using Ints = typename Register<kWidth>::Ints;
  const auto wanted = static_cast<float>(in.k);
  const Floats nothing = {};
  Floats limit = nothing + in.guess;
  Floats low = nothing;
  Floats high = nothing + kInfinity;
  Floats below = nothing;
  Floats above = nothing;
  Ints found = {};
  for (int round = 0; round < kCountings; ++round) {
    Ints counts = {};
#pragma GCC unroll 4
    for (std::size_t i = 0; i < in.n; ++i) {
      counts = at<Floats>(squared[i], first) <= limit ? counts + 1 : counts;
    }
    found = counts == static_cast<std::int32_t>(in.k);
    std::int32_t all = -1;
    for (std::size_t lane = 0; lane < kWidth; ++lane) all &= found[lane];
    if (all != 0) {
      break;
    }
    const Floats count = __builtin_convertvector(counts, Floats);
    const Ints fewer = count < wanted;
    low = fewer ? limit : low;
    below = fewer ? count : below;
    high = fewer ? high : limit;
    above = fewer ? above : count;
    const Floats few = below > 0.5f ? below : nothing + 0.5f;
    const Floats between = low + (high - low) * (wanted + 0.5f - below) / (above + 1.0f - below);
    Floats next = high < kInfinity ? between : kWider * low * wanted / few;
    next = (next > low) & (next < high) ? next : 0.5f * (low + high);
    limit = found ? limit : next;
  }
  at<Floats>(limits, first) = found ? limit : nothing + __builtin_nanf("");
}

// A register holds half as many doubles.
template <std::size_t kWidth>
STOREY_INLINE void addUp(const Input& in, std::size_t first, const Lanes* squared,
                         const Lanes& limits, MomentLanes& moments) {
  using Floats = typename Register<kWidth>::Floats;
  using Ints = typename Register<kWidth>::Ints;
  using Doubles = typename Register<kWidth>::Doubles;
  const Doubles qx = __builtin_convertvector(at<Floats>(in.queries[0], first), Doubles);
  const Doubles qy = __builtin_convertvector(at<Floats>(in.queries[1], first), Doubles);
  const Doubles qz = __builtin_convertvector(at<Floats>(in.queries[2], first), Doubles);
  const Floats limit = at<Floats>(limits, first);
  Doubles sums[9] = {};
  for (std::size_t i = 0; i < in.n; ++i) {
    const Ints within = at<Floats>(squared[i], first) <= limit;  // true is -1
    const Doubles weight = -__builtin_convertvector(within, Doubles);
    const Doubles dx = (static_cast<double>(in.candidates.x[i]) - qx) * weight;
    const Doubles dy = (static_cast<double>(in.candidates.y[i]) - qy) * weight;
    const Doubles dz = (static_cast<double>(in.candidates.z[i]) - qz) * weight;
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
  for (std::size_t s = 0; s < 9; ++s) {
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      moments[s][first + lane] = sums[s][lane];
    }
  }
}

template <std::size_t kWidth>
STOREY_INLINE void momentsIn(const Input& in, Lanes* squared, Lanes& limits, MomentLanes& moments) {
  for (std::size_t first = 0; first < kLanes; first += kWidth) {
    measure<kWidth>(in, first, squared);
    findLimits<kWidth>(in, first, squared, limits);
    addUp<kWidth / 2>(in, first, squared, limits, moments);
    addUp<kWidth / 2>(in, first + kWidth / 2, squared, limits, moments);
  }
}

STOREY_TARGET("avx512f")
void momentsInSixteen(const Input& in, Lanes* squared, Lanes& limits, MomentLanes& moments) {
  momentsIn<16>(in, squared, limits, moments);
}

STOREY_TARGET("avx2")
void momentsInEight(const Input& in, Lanes* squared, Lanes& limits, MomentLanes& moments) {
  momentsIn<8>(in, squared, limits, moments);
}

void momentsInFour(const Input& in, Lanes* squared, Lanes& limits, MomentLanes& moments) {
  momentsIn<4>(in, squared, limits, moments);
}

}  // namespace

void momentsOfNearest(const Coordinates& candidates, std::size_t n,
                      const std::array<Lanes, 3>& queries, std::size_t k, float guess,
                      Lanes* squared, Lanes& limits, MomentLanes& moments) {
  static const auto kChosen = STOREY_HAS("avx512f") ? momentsInSixteen
                              : STOREY_HAS("avx2")  ? momentsInEight
                                                    : momentsInFour;
  kChosen({candidates, n, queries, k, guess}, squared, limits, moments);
}

}  // namespace storey::detail
