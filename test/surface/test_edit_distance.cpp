// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <storey/surface/floorplan_grammar.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using storey::cyclicEditDistance;
using storey::editDistance;
using String = std::vector<int>;

constexpr int kNever = 99;

// By its definition, as a recursion over the first letters.
std::size_t recursion(const String& a, std::size_t i, const String& b, std::size_t j) {
  if (i == a.size()) return b.size() - j;
  if (j == b.size()) return a.size() - i;
  const bool same = a[i] == b[j] && a[i] != kNever;
  return std::min({recursion(a, i + 1, b, j + 1) + (same ? 0 : 1), recursion(a, i + 1, b, j) + 1,
                   recursion(a, i, b, j + 1) + 1});
}

// Over all pairs of rotations.
std::size_t leastOfRotations(String a, String b) {
  std::size_t least = editDistance(a, b, kNever);
  for (std::size_t i = 0; i < std::max<std::size_t>(a.size(), 1); ++i) {
    for (std::size_t j = 0; j < std::max<std::size_t>(b.size(), 1); ++j) {
      least = std::min(least, editDistance(a, b, kNever));
      if (!b.empty()) std::rotate(b.begin(), b.begin() + 1, b.end());
    }
    if (!a.empty()) std::rotate(a.begin(), a.begin() + 1, a.end());
  }
  return least;
}

class Strings {
 public:
  explicit Strings(unsigned seed) : random_(seed) {}
  // Few letters, so that there are matches; sometimes the one that never matches.
  String draw(std::size_t longest) {
    String s(random_() % (longest + 1));
    for (int& letter : s) letter = random_() % 8 == 0 ? kNever : static_cast<int>(random_() % 3);
    return s;
  }

 private:
  std::mt19937 random_;
};

TEST(EditDistance, IsThatOfItsRecursion) {
  Strings strings(1);
  for (int round = 0; round < 500; ++round) {
    const String a = strings.draw(6);
    const String b = strings.draw(6);
    EXPECT_EQ(editDistance(a, b, kNever), recursion(a, 0, b, 0));
  }
}

TEST(EditDistance, OfWords) {
  const auto word = [](const char* text) { return String(text, text + std::string(text).size()); };
  EXPECT_EQ(editDistance(word("kitten"), word("sitting")), 3U);
  EXPECT_EQ(editDistance(word("storey"), word("storey")), 0U);
  EXPECT_EQ(editDistance(word(""), word("storey")), 6U);
  EXPECT_EQ(cyclicEditDistance(word("storey"), word("reysto")), 0U);
  EXPECT_EQ(cyclicEditDistance(word("abcd"), word("dcba")), 2U);  // dabc: b and c swapped
  EXPECT_EQ(cyclicEditDistance(word(""), word("abc")), 3U);
}

TEST(EditDistance, ALetterThatNeverMatchesCostsOneEach) {
  EXPECT_EQ(editDistance({kNever, kNever}, {kNever, kNever}, kNever), 2U);
  EXPECT_EQ(editDistance({kNever, 1}, {kNever, 1}, kNever), 1U);
}

TEST(EditDistance, IsAMetric) {
  Strings strings(2);
  for (int round = 0; round < 1000; ++round) {
    const String a = strings.draw(7);
    const String b = strings.draw(7);
    const String c = strings.draw(7);
    for (const auto distance : {&editDistance, &cyclicEditDistance}) {
      const std::size_t ab = distance(a, b, kNever);
      EXPECT_EQ(ab, distance(b, a, kNever));
      EXPECT_LE(ab, std::max(a.size(), b.size()));
      EXPECT_GE(ab, std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
      EXPECT_LE(distance(a, c, kNever), ab + distance(b, c, kNever));
    }
  }
}

TEST(CyclicEditDistance, IsTheLeastOverAllPairsOfRotations) {
  Strings strings(3);
  for (int round = 0; round < 300; ++round) {
    const String a = strings.draw(7);
    const String b = strings.draw(7);
    EXPECT_EQ(cyclicEditDistance(a, b, kNever), leastOfRotations(a, b));
  }
}

}  // namespace
