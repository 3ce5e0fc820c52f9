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
  const auto boxes_a = a.boxes(), boxes_b = b.boxes();
  const auto near = [&](NodePair nodes) {
    return Near{nodes, pair.distance_bound(boxes_a[nodes.a], boxes_b[nodes.b], direction), direction};
  };
  const auto may_be_near = [&](const Near& at) {
    if (at.bound >= best) return false;
    const bool has_changed = mask(at.direction != direction) != 0;  // it may be better now
    return !has_changed || near(at.nodes).bound < best;
  };
  Near stack[2 * ObbTree::kMaxDepth + 2];
  std::uint32_t size = 0;
  stack[size++] = near({0, 0});
  while (size > 0) {
    const Near top = stack[--size];
    if (!may_be_near(top)) continue;
    const NodePair at = top.nodes;
    const ObbNode &in_a = boxes_a[at.a], &in_b = boxes_b[at.b];
    if (in_a.is_leaf() && in_b.is_leaf()) {
      if (measure(in_a, in_b)) return true;
      continue;
    }
    const auto [first, second] = split(a, b, pair, at);
    const Near one = near(first), other = near(second);
    const bool one_is_nearer = one.bound != other.bound ? one.bound < other.bound
                                                        : pair.nearness(boxes_a[first.a], boxes_b[first.b]) <=
                                                              pair.nearness(boxes_a[second.a], boxes_b[second.b]);
    stack[size++] = one_is_nearer ? other : one;
    stack[size++] = one_is_nearer ? one : other;
  }
  return false;
}

/// measure(leaf of a, leaf of b) for the pairs of leaves of which bound(nodes) is at most `gap`, near ones first, until
/// it returns true. Returns whether it did. What is in a pair has no lower bound than the pair.
template <class Bound, class Measure>
bool visit_leaves_below(const ObbTree& a, const ObbTree& b, const BoxPair& pair, double gap, Bound bound,
                        Measure measure) {
  struct Bounded {
    NodePair nodes;
    double bound;
  };
  const auto bounded = [&](NodePair nodes) { return Bounded{nodes, bound(a.boxes()[nodes.a], b.boxes()[nodes.b])}; };
  Bounded stack[2 * ObbTree::kMaxDepth + 2];
  std::uint32_t size = 0;
  stack[size++] = bounded({0, 0});
  while (size > 0) {
    const NodePair at = stack[--size].nodes;
    if (stack[size].bound > gap) continue;
    const ObbNode &in_a = a.boxes()[at.a], &in_b = b.boxes()[at.b];
    if (in_a.is_leaf() && in_b.is_leaf()) {
      if (measure(in_a, in_b)) return true;
      continue;
    }
    const auto [first, second] = split(a, b, pair, at);
    const Bounded one = bounded(first), other = bounded(second);
    const bool one_is_nearer = one.bound <= other.bound;
    stack[size++] = one_is_nearer ? other : one;
    stack[size++] = one_is_nearer ? one : other;
  }
  return false;
}

}  // namespace prohull
