// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <cstddef>
#include <vector>

namespace storey {

/// Floorplans as strings, and their distance [Sui et al. 2016, 4.1, (9)-(10)].
///
/// Edges that occur repeatedly over all floorplans get a letter each (the dictionary); the others
/// share one special letter. A floorplan is one string a ring. Two encodings:
///
/// - `Turns`, the paper's: an edge is e = {v, theta, d}, the sense and angle of the turn from the
///   preceding edge and the length; strings start at the corner nearest to a fixed far point and
///   are compared by Levenshtein's distance. Special letters equal each other.
/// - `Walls`, the default: an edge is the line it lies on (oriented normal and offset), so that a
///   letter is a wall of the building. Strings are cyclic: the distance is the minimum over all
///   rotations.
///   \note Deviation: under noise the start corner of the paper's strings jumps between corners at
///   nearly the same distance; relative turns do not know where a floorplan is, so a storey that is
///   shifted equals one that is not; and a decoded string of turns does not close. Strings of walls
///   have none of the three faults: their decoded corners are intersections of lines.
///
/// Rings of two floorplans are matched by an optimal assignment; an unmatched ring costs its length
/// (the paper gives no distance for floorplans of several components).
class FloorplanGrammar {
 public:
  enum class Encoding { Walls, Turns };

  /// The strings of one floorplan: letters are indices into the dictionary or `kSpecialLetter`.
  using Strings = std::vector<std::vector<int>>;
  static constexpr int kSpecialLetter = -1;

  void setEncoding(Encoding encoding) { encoding_ = encoding; }
  Encoding getEncoding() const { return encoding_; }

  /// Edges whose lines (Walls) or lengths (Turns) differ by less share a letter. In the cloud's
  /// unit, > 0; there is no default, for the right value is about 1.5 noise deviations.
  void setLengthTolerance(double length) { length_tolerance_ = length; }
  double getLengthTolerance() const { return length_tolerance_; }

  /// Directions (Walls) or turns (Turns) that differ by less share a letter; radians, default 3
  /// degrees.
  void setAngleTolerance(double radians) { angle_tolerance_ = radians; }
  double getAngleTolerance() const { return angle_tolerance_; }

  /// Builds the dictionary from all floorplans and encodes each. Empty floorplans get no string.
  /// \return false, after a PCL_ERROR and with every string empty, if a tolerance is not positive
  bool encode(const std::vector<Floorplan>& plans);

  std::size_t getDictionarySize() const { return letters_.size(); }
  const Strings& getStrings(std::size_t plan) const { return strings_[plan]; }

  /// NEdist of two encoded floorplans, (10), in [0, 1]. Symmetric, but no metric: divided by the
  /// longer length the edit distance does not keep the triangle inequality (ab, aba, ba).
  double distance(std::size_t a, std::size_t b) const;

  /// The floorplan that a string of walls stands for: each corner is the intersection of the two
  /// letters' lines, edges with the special letter keep their own line, and `FloorplanEdge::wall`
  /// is the letter. Encoding Turns: the floorplan as it was given. Where lines do not meet in a
  /// simple ring, the ring as given.
  Floorplan decode(std::size_t plan) const;

 private:
  /// A letter: the line normal . x = offset (Walls), or turn and length (Turns).
  struct Letter {
    double angle = 0.0;   // of the normal, or of the turn
    double extent = 0.0;  // offset, or length
  };
  struct Occurrence {
    double angle = 0.0;
    double extent = 0.0;
    double weight = 0.0;
    Eigen::Vector2d middle;
    int letter = kSpecialLetter;
  };

  std::vector<Occurrence> collectEdges() const;
  void buildDictionary(std::vector<Occurrence>& edges);
  Letter makeLetter(const std::vector<Occurrence>& edges,
                    const std::vector<std::size_t>& members) const;

  Encoding encoding_ = Encoding::Walls;
  double length_tolerance_ = 0.0;
  double angle_tolerance_ = 0.05235987755982989;
  std::vector<Floorplan> plans_;
  std::vector<Letter> letters_;
  std::vector<Strings> strings_;
};

/// Levenshtein's distance. Letters equal to `never_equal` differ from every letter, themselves
/// included.
std::size_t editDistance(const std::vector<int>& a, const std::vector<int>& b,
                         int never_equal = FloorplanGrammar::kSpecialLetter - 1);

/// The least `editDistance` over all rotations of one of the two.
std::size_t cyclicEditDistance(const std::vector<int>& a, const std::vector<int>& b,
                               int never_equal = FloorplanGrammar::kSpecialLetter - 1);

}  // namespace storey
