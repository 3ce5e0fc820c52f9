#pragma once

#include <cstddef>
#include <vector>

#include "cover/part.h"
#include "parallel/progress_meter.h"

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

/// Cuts where that saves most volume, until there are so many leaves or no cut saves anything worth it. Coordinates are
/// of the order of 1. Deterministic; uses the threads of the arena that it runs in.
///
/// How it works: of each part the best cuts in many directions are tried, and of those the one is taken after which a
/// further cut saves most (as the tree search of CoACD does, Wei et al. 2022, with two steps). What a cut saves is the
/// difference of volumes of convex hulls; they share only the cut, so their sum is the volume of their union.
CutTree cut_tree(const Solid& solid, std::size_t leaves, ProgressMeter& meter);

/// least[k]: the least volume of k parts that the tree divides its solid into, for k from 1 to its number of leaves.
/// By dynamic programming, so that a cut counts by all that its further cuts save.
std::vector<double> least_volumes(const CutTree& tree);

/// The k parts of `solid`, which the tree divides in the way of least_volumes. Empty ones are left out.
std::vector<Part> divided(const CutTree& tree, std::size_t k, const Solid& solid);

}  // namespace prohull::cover
