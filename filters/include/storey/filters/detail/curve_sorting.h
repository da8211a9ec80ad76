// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/chunks.h>
#include <storey/filters/detail/first_touch.h>
#include <storey/filters/detail/morton_curve.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace storey::detail {

/// How many different ones there are in a sorted list.
struct CurveCounts {
  std::size_t codes = 0;
  std::size_t positions = 0;
};

/// Sorts part of a list, which fits into the cache, along the curve. Has the memory for it.
/// \tparam Source see `sortAlongCurve`
template <typename Source>
class CurveSorter {
 public:
  using Record = typename Source::Record;

  explicit CurveSorter(const MortonCurve& curve) : curve_(curve) {}

  /// \param equal_bits leading ones of the codes that all have in common
  CurveCounts sort(Record* records, std::size_t size, int equal_bits) {
    entries_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      entries_[i] = {curve_.codeOf(Source::positionOf(records[i])), static_cast<std::uint32_t>(i)};
    }
    const auto before = [records](const Entry& a, const Entry& b) {
      if (a.code != b.code) return a.code < b.code;
      const Eigen::Vector3f p = Source::positionOf(records[a.index]);
      const Eigen::Vector3f q = Source::positionOf(records[b.index]);
      return std::make_tuple(p.x(), p.y(), p.z()) < std::make_tuple(q.x(), q.y(), q.z());
    };
    if (!std::is_sorted(entries_.begin(), entries_.end(), before)) {
      sortRest(sortDigits(equal_bits), before);
      moveToPlaces(records);
    }
    return count(records);
  }

 private:
  struct Entry {
    std::uint64_t code;
    std::uint32_t index;
  };

  static constexpr int kMostDigitBits = 11;  // as many places as the cache has lines for

  // By two digits after the equal bits. On surfaces, which fill 2^(2/3 bits) cells of so many bits,
  // they tell nearly all apart. \return the bits that are sorted by then
  int sortDigits(int equal_bits) {
    int bits = 1;
    while (bits < kMostDigitBits && (entries_.size() >> (4 * bits / 3)) > 0) ++bits;
    const int sorted_bits = equal_bits + 2 * bits;
    sortByDigit(MortonCurve::kCodeBits - sorted_bits, bits);
    sortByDigit(MortonCurve::kCodeBits - sorted_bits + bits, bits);
    return sorted_bits;
  }

  void sortByDigit(int shift, int bits) {
    const std::size_t mask = (std::size_t{1} << bits) - 1;
    places_.assign(mask + 1, 0);
    for (const Entry& e : entries_) ++places_[(e.code >> shift) & mask];
    std::uint32_t next = 0;
    for (std::uint32_t& place : places_) next += std::exchange(place, next);
    sorted_.resize(entries_.size());
    for (const Entry& e : entries_) sorted_[places_[(e.code >> shift) & mask]++] = e;
    entries_.swap(sorted_);
  }

  // What has the same leading bits.
  template <typename Before>
  void sortRest(int sorted_bits, const Before& before) {
    const int rest = MortonCurve::kCodeBits - sorted_bits;
    for (auto begin = entries_.begin(); begin != entries_.end();) {
      auto end = begin + 1;
      while (end != entries_.end() && end->code >> rest == begin->code >> rest) ++end;
      if (end - begin > 1) std::sort(begin, end, before);
      begin = end;
    }
  }

  // Cycle by cycle, so that no second list is needed.
  void moveToPlaces(Record* records) {
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
      if (entries_[i].index == i) continue;
      const Record first = records[i];
      std::uint32_t place = i;
      for (std::uint32_t from = entries_[i].index; from != i; from = entries_[place].index) {
        records[place] = records[from];
        entries_[place].index = place;
        place = from;
      }
      records[place] = first;
      entries_[place].index = place;
    }
  }

  CurveCounts count(const Record* records) const {
    CurveCounts counts;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const bool new_code = i == 0 || entries_[i].code != entries_[i - 1].code;
      counts.codes += new_code ? 1 : 0;
      counts.positions +=
          new_code || Source::positionOf(records[i]) != Source::positionOf(records[i - 1]) ? 1 : 0;
    }
    return counts;
  }

  const MortonCurve& curve_;
  std::vector<Entry> entries_;
  std::vector<Entry> sorted_;
  std::vector<std::uint32_t> places_;
};

constexpr int kPartAxisBits = 4;  // of the parts: of 20 million points most fit into a cache
constexpr std::size_t kCurveParts = std::size_t{1} << (3 * kPartAxisBits);

/// The records, each in its part of the curve. \return where each part begins, and the end
template <typename Source, typename List>
std::vector<std::size_t> partAlongCurve(const Source& source, const MortonCurve& curve,
                                        unsigned int threads, List& records) {
  const std::size_t size = source.size();
  std::vector<std::vector<std::uint16_t>> parts(Chunks(size).count());
  std::vector<std::vector<std::size_t>> places(parts.size());
  forEachChunk(size, threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    parts[c].resize(end - begin);
    places[c].assign(kCurveParts + 1, 0);  // the last one: left out
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f p = source.position(i);
      const std::size_t part = isSearchable(p) ? curve.leadingBits(p, kPartAxisBits) : kCurveParts;
      parts[c][i - begin] = static_cast<std::uint16_t>(part);
      ++places[c][part];
    }
  });
  std::vector<std::size_t> begins;
  std::size_t next = 0;
  for (std::size_t part = 0; part <= kCurveParts; ++part) {
    begins.push_back(next);
    for (std::vector<std::size_t>& of_chunk : places) next += std::exchange(of_chunk[part], next);
  }
  records.reserve(begins.back());
  touchReserve(threads, records);
  records.resize(begins.back());
  forEachChunk(size, threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t part = parts[c][i - begin];
      if (part < kCurveParts) records[places[c][part]++] = source.record(i);
    }
  });
  return begins;
}

/// \param begins of the parts \return what it has sorted
template <typename Source, typename List>
CurveCounts sortParts(const MortonCurve& curve, const std::vector<std::size_t>& begins,
                      unsigned int threads, List& records) {
  std::size_t codes = 0;
  std::size_t positions = 0;
#pragma omp parallel num_threads(threadsFor(threads)) reduction(+ : codes, positions)
  {
    CurveSorter<Source> sorter(curve);
#pragma omp for schedule(dynamic, 8)
    for (std::size_t part = 0; part < kCurveParts; ++part) {
      const CurveCounts counts = sorter.sort(records.data() + begins[part],
                                             begins[part + 1] - begins[part], 3 * kPartAxisBits);
      codes += counts.codes;
      positions += counts.positions;
    }
  }
  return {codes, positions};
}

/// Whether more than half of many records are in one part, which no cache holds.
inline bool areInOnePart(const std::vector<std::size_t>& begins) {
  constexpr std::size_t kMany = std::size_t{1} << 16;
  std::size_t largest = 0;
  for (std::size_t part = 0; part < kCurveParts; ++part) {
    largest = std::max(largest, begins[part + 1] - begins[part]);
  }
  return largest > std::max(kMany, begins.back() / 2);
}

/// The different positions of records in any order. Copies must not count: a million of one point
/// would make outliers of all others.
template <typename Source, typename List>
std::vector<Eigen::Vector3f> distinctPositions(const List& records) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(records.size());
  for (const auto& record : records) positions.push_back(Source::positionOf(record));
  std::sort(positions.begin(), positions.end(),
            [](const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
              return std::make_tuple(p.x(), p.y(), p.z()) < std::make_tuple(q.x(), q.y(), q.z());
            });
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

/// The different positions of sorted records.
template <typename Source, typename List>
std::vector<Eigen::Vector3f> distinctAlong(const List& records) {
  std::vector<Eigen::Vector3f> positions;
  for (const auto& record : records) {
    const Eigen::Vector3f p = Source::positionOf(record);
    if (positions.empty() || positions.back() != p) positions.push_back(p);
  }
  return positions;
}

template <typename Source>
Eigen::AlignedBox3d boxOf(const Source& source, unsigned int threads) {
  std::vector<Eigen::AlignedBox3f> boxes(Chunks(source.size()).count());
  forEachChunk(source.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Eigen::AlignedBox3f box;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f p = source.position(i);
      if (isSearchable(p)) box.extend(p);
    }
    boxes[c] = box;
  });
  Eigen::AlignedBox3f box;
  for (const Eigen::AlignedBox3f& part : boxes) box.extend(part);
  return box.cast<double>();
}

/// Puts records along a Morton curve, those of equal positions one after the other. What is not
/// `isSearchable` is left out. O(n). Nothing is moved but from the source to its part of the result
/// and within this part, which is in the cache: so it takes no memory beyond the result.
/// \tparam Source has `size()`, `position(i)`, `record(i)` and, static, `positionOf(record)`
/// \param threads 0: all cores. The order does not depend on them, nor on the source's, but where
/// positions are equal
/// \return the number of different positions
template <typename Source, typename List>
std::size_t sortAlongCurve(const Source& source, unsigned int threads, List& records) {
  Eigen::AlignedBox3d box = boxOf(source, threads);
  std::vector<std::size_t> begins = partAlongCurve(source, MortonCurve(box), threads, records);
  if (areInOnePart(begins)) {
    box = withoutOutliers(distinctPositions<Source>(records), box);
    begins = partAlongCurve(source, MortonCurve(box), threads, records);
  }
  const CurveCounts counts = sortParts<Source>(MortonCurve(box), begins, threads, records);
  if (counts.codes >= counts.positions / 2) return counts.positions;
  const MortonCurve finer(withoutOutliers(distinctAlong<Source>(records), box));
  begins = partAlongCurve(source, finer, threads, records);
  return sortParts<Source>(finer, begins, threads, records).positions;
}

}  // namespace storey::detail
