#pragma once

#include <cstddef>
#include <vector>

#include "cover/part.h"
#include "prohull/detail/progress_meter.h"

namespace prohull::cover {

/// A binary space partition of a solid. Each node is a part of it; the part of an inner node is cut in two by a plane.
struct CutTree {
  struct Node {
    double volume = 0;  ///< of the convex hull of its part
    Plane plane = {};
    std::size_t below = 0, above = 0;  ///< its children; numbered after their parent; 0: it is a leaf
  };
  std::vector<Node> nodes;  ///< the first is the root
};

/// Pieces with less void than this, as a share of the solid's volume, fill it, but for rounding.
inline constexpr double kNoVoid = 1e-6;

/// For more pieces the wide search takes too long for what it saves.
inline constexpr std::size_t kMostPiecesOfWide = 24;

/// Looks for trees whose leaves have little volume. Deterministic; uses the threads of the arena that it runs in.
///
/// How it works: of each part the best cuts in many directions are tried, and of those the one is taken after which
/// further cuts save most (as the tree search of CoACD does, Wei et al. 2022). What a cut saves is the difference of
/// volumes of convex hulls; they share only the cut, so their sum is the volume of their union. Cuts are made where
/// they save most. More are made than are needed, and the best ones are kept.
/// Such a search often ends in a poor tree. So there are two: a narrow one tries few cuts, of `solid`, and looks one
/// cut ahead; a wide one tries many, of `coarser`, and looks two cuts ahead. Then each plane of a tree moves as long as
/// that makes the volume of all leaves less. The tree of less volume wins. For many pieces, and where it leaves little
/// void, only the narrow search runs.
class CutSearch {
 public:
  /// For trees of up to so many leaves. `coarser` is a solid of fewer faces around `solid`, or the same. Coordinates
  /// are of the order of 1. The void, of the solid, counts as little if it is less than `little_void`.
  CutSearch(Solid solid, const Solid& coarser, std::size_t pieces, double little_void, ProgressMeter& meter);

  /// A tree of so many leaves, or of fewer if no cut saves anything worth it.
  CutTree tree(std::size_t pieces, ProgressMeter& meter) const;

 private:
  Solid solid_;
  std::vector<CutTree> trees_;
};

/// How many leaves it has.
inline std::size_t leaves(const CutTree& tree) { return (tree.nodes.size() + 1) / 2; }

/// least[k]: the least volume of k parts that the tree divides its solid into, for k from 1 to its number of leaves.
/// By dynamic programming, so that a cut counts by all that its further cuts save.
std::vector<double> least_volumes(const CutTree& tree);

/// The k parts of `solid`, which the tree divides in the way of least_volumes. Empty ones are left out.
std::vector<Part> divided(const CutTree& tree, std::size_t k, const Solid& solid);

}  // namespace prohull::cover
