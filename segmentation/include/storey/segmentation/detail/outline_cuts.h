// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/filters/detail/task_crew.h>
#include <storey/segmentation/detail/cell_labels.h>
#include <storey/segmentation/detail/outline_faces.h>

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace storey::detail {

/// Edges of the plan one after the other along a line.
struct EdgeRange {
  std::size_t first;
  std::size_t last;

  bool operator<(const EdgeRange& other) const {
    return first != other.first ? first < other.first : last < other.last;
  }
};

/// The cells inside in a block, and what bounds them.
struct BlockLabels {
  std::vector<char> inside;
  double energy = 0.0;
  std::vector<OutlineRun> runs;
};

/// The outlines of a stack of blocks, and what they are without some edges or with the block above:
/// each of these is cut once, and again only after the outline has changed.
class OutlineCuts {
 public:
  /// \param blocks a stack; changed by `takeMerge` and `writeBack` alone
  OutlineCuts(const LineArrangement& plan, double gap, unsigned int threads,
              std::vector<CellBlock>& blocks);

  std::size_t size() const { return outlines_.size(); }
  const BlockLabels& operator[](std::size_t block) const { return outlines_[block].labels; }

  /// The best outline of the block that does without the edges, and without those it did without so
  /// far. It is there until one of the block is taken.
  const BlockLabels& without(const EdgeRange& edges, std::size_t block);

  /// Whether to name what may be asked for: with one thread nothing is cut ahead.
  bool cutsAhead() const { return crew_.size() > 1; }
  void cutAhead(const std::set<std::pair<std::size_t, EdgeRange>>& asked);  ///< blocks and edges

  /// From now on the block does without the edges; `without` of them was asked for.
  void take(const EdgeRange& edges, std::size_t block);

  /// The block and the one above it as one; what both do without it does without.
  const BlockLabels& merged(std::size_t block) const { return outlines_[block].merged->labels; }
  void cutAllMerged();  ///< before `merged`
  void takeMerge(std::size_t block);

  /// The labels and energies into the blocks.
  void writeBack();

 private:
  struct Outline {
    LabelCut cut;
    BlockLabels labels;
    std::map<EdgeRange, BlockLabels> without;  // as far as asked for
    std::unique_ptr<Outline> merged;           // with the block above
  };

  BlockLabels cutAgain(const CellTerms& terms, LabelCut& cut) const;
  BlockLabels cutWithout(const EdgeRange& edges, std::size_t block) const;
  Outline cutMerged(std::size_t block) const;
  CellTerms termsOfMerge(std::size_t block) const;
  void forgetMerges(std::size_t block);

  const LineArrangement& plan_;
  double gap_;
  std::vector<CellBlock>& blocks_;
  std::vector<Outline> outlines_;
  TaskCrew crew_;
};

}  // namespace storey::detail
