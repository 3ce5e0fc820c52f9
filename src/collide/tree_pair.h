#pragma once

#include "collide/box_pair.h"

namespace prohull {

/// A node of each of two trees.
struct NodePair {
  std::uint32_t a, b;
};

/// The two pairs that take the place of one; the larger box is the one that is split. Not both may be leaves.
inline std::pair<NodePair, NodePair> split(const ObbTree& a, const ObbTree& b, const BoxPair& pair, NodePair at) {
  const ObbNode &in_a = a.boxes()[at.a], &in_b = b.boxes()[at.b];
  if (in_b.is_leaf() || (!in_a.is_leaf() && pair.is_larger(in_a, in_b))) return {{at.a + 1, at.b}, {in_a.link, at.b}};
  return {{at.a, at.b + 1}, {at.a, in_b.link}};
}

/// visit(leaf of a, leaf of b) for all pairs of leaves of which the boxes may meet, near ones first, until it returns
/// true. Returns whether it did.
template <class Visit>
bool visit_meeting_leaves(const ObbTree& a, const ObbTree& b, const BoxPair& pair, Visit visit) {
  const auto boxes_a = a.boxes(), boxes_b = b.boxes();
  NodePair stack[2 * ObbTree::kMaxDepth + 2];
  std::uint32_t size = 0;
  if (pair.may_meet(boxes_a[0], boxes_b[0])) stack[size++] = {0, 0};
  while (size > 0) {
    const NodePair at = stack[--size];
    const ObbNode &in_a = boxes_a[at.a], &in_b = boxes_b[at.b];
    if (in_a.is_leaf() && in_b.is_leaf()) {
      if (visit(in_a, in_b)) return true;
      continue;
    }
    const auto [first, second] = split(a, b, pair, at);
    const bool first_meets = pair.may_meet(boxes_a[first.a], boxes_b[first.b]);
    const bool second_meets = pair.may_meet(boxes_a[second.a], boxes_b[second.b]);
    if (first_meets && second_meets) {
      const bool first_is_nearer =
          pair.nearness(boxes_a[first.a], boxes_b[first.b]) <= pair.nearness(boxes_a[second.a], boxes_b[second.b]);
      stack[size++] = first_is_nearer ? second : first;
      stack[size++] = first_is_nearer ? first : second;
    } else if (first_meets || second_meets) {
      stack[size++] = first_meets ? first : second;
    }
  }
  return false;
}

/// measure(leaf of a, leaf of b) for pairs of leaves until it returns true. Returns whether it did. `known(nodes)` has
/// what is known of a pair of nodes, and the `nodes`. Of the two parts of a pair, one comes first if is_first(one,
/// other). A pair for which `is_open(known)` is false once its turn comes is left out, with all that is in it.
template <class Known, class IsFirst, class IsOpen, class Measure>
bool visit_open_leaves(const ObbTree& a, const ObbTree& b, const BoxPair& pair, Known known, IsFirst is_first,
                       IsOpen is_open, Measure measure) {
  const auto boxes_a = a.boxes(), boxes_b = b.boxes();
  decltype(known(NodePair{})) stack[2 * ObbTree::kMaxDepth + 2];
  std::uint32_t size = 0;
  stack[size++] = known(NodePair{0, 0});
  while (size > 0) {
    const auto top = stack[--size];
    if (!is_open(top)) continue;
    const NodePair at = top.nodes;
    const ObbNode &in_a = boxes_a[at.a], &in_b = boxes_b[at.b];
    if (in_a.is_leaf() && in_b.is_leaf()) {
      if (measure(in_a, in_b)) return true;
      continue;
    }
    const auto [first, second] = split(a, b, pair, at);
    const auto one = known(first), other = known(second);
    const bool one_is_first = is_first(one, other);
    stack[size++] = one_is_first ? other : one;
    stack[size++] = one_is_first ? one : other;
  }
  return false;
}

/// measure(leaf of a, leaf of b) for the pairs of leaves whose distance may be less than `best`, which it may lessen;
/// near ones first, until it returns true. Returns whether it did.
template <class Measure>
bool visit_near_leaves(const ObbTree& a, const ObbTree& b, const BoxPair& pair, const double& best,
                       const Float4& direction, Measure measure) {
  struct Near {
    NodePair nodes;
    double bound;
    Float4 direction;
  };
  const auto near = [&](NodePair nodes) {
    return Near{nodes, pair.distance_bound(a.boxes()[nodes.a], b.boxes()[nodes.b], direction), direction};
  };
  const auto may_be_near = [&](const Near& at) {
    if (at.bound >= best) return false;
    const bool has_changed = mask(at.direction != direction) != 0;  // it may be better now
    return !has_changed || near(at.nodes).bound < best;
  };
  const auto nearness = [&](NodePair nodes) { return pair.nearness(a.boxes()[nodes.a], b.boxes()[nodes.b]); };
  const auto is_nearer = [&](const Near& one, const Near& other) {
    return one.bound != other.bound ? one.bound < other.bound : nearness(one.nodes) <= nearness(other.nodes);
  };
  return visit_open_leaves(a, b, pair, near, is_nearer, may_be_near, measure);
}

}  // namespace prohull
