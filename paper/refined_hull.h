#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "prohull/progressive_hull.h"

namespace prohull {

class HalfEdgeMesh;

/// What selective refinement needs beyond the record of a hull (P&T 3.2.1): for each vertex that a collapse made, the
/// star that it has when it is split, and the splits that come before (Xia and Varshney 1996). Immutable; any number of
/// threads may share one.
///
/// A vertex is split only when its link is in place, as it was when its collapse was made. Then its star is what it was
/// too, down to the numbers of its faces (docs/theory.md). So stars are recorded once, and refining needs no
/// connectivity.
class RefinableHull {
 public:
  /// Requires that first_defect(hull) finds none. Takes memory in proportion to the valences of all vertices made: 12
  /// each at most as hulls are built by default.
  explicit RefinableHull(ProgressiveHull hull);

  const ProgressiveHull& hull() const { return hull_; }
  const PerVertex<Vec3>& positions() const { return hull_.positions(); }

  /// Whether v was made by a collapse, so that it can be split.
  bool is_made(VertexId v) const { return index(v) >= original_vertices_; }
  /// Of a vertex that was made, here and below.
  const VertexSplit& split_of(VertexId made) const { return hull_.splits()[number(made)]; }

  /// The corners, as 4 face + corner, at which `made` stands when it is split, counter-clockwise seen from outside:
  /// first those that become o's, from the one before l on, then those that become d's, from the one before r on.
  std::span<const std::uint32_t> star(VertexId made) const {
    const Node& node = nodes_[number(made)];
    return {pool_.data() + node.pool, node.star_size};
  }
  std::uint32_t corners_of_o(VertexId made) const { return nodes_[number(made)].corners_of_o; }  ///< how many

  /// The faces (o, d, l) and (d, o, r), which the split brings forth.
  std::array<FaceId, 2> new_faces(VertexId made) const {
    const Node& node = nodes_[number(made)];
    return {FaceId(node.odl[0] / 4), FaceId(node.dor[0] / 4)};
  }

  /// The splits that come before that of `made`, to bring forth `made` and its link, without some that others of them
  /// need; as places in hull().splits(), all greater than its own.
  std::span<const std::uint32_t> needs(VertexId made) const {
    const Node& node = nodes_[number(made)];
    return {pool_.data() + node.pool + node.star_size, node.needs_size};
  }

  /// Of the original faces that come about when `made` or a vertex below it is split, as the last split of their
  /// corners. So every original face that meets something comes about if all vertices are split whose bounds meet it.
  /// May be empty.
  const Box& bounds(VertexId made) const { return bounds_[number(made)]; }

  /// To be called some time before `made` is split: starts to bring what that takes into the cache.
  void prefetch(VertexId made) const { __builtin_prefetch(&nodes_[number(made)]); }

  std::size_t memory_bytes() const;

 private:
  friend class RefinedHull;

  struct alignas(64) Node {  // one cache line: memory is what a split waits for
    VertexId o, d, l, r;
    std::array<std::uint32_t, 3> odl, dor;  // corners of the faces that come back, as 4 face + corner
    std::uint32_t star_size, corners_of_o, needs_size;
    std::size_t pool;  // where the star and, after it, the needs are
  };

  std::uint32_t number(VertexId made) const {
    assert(is_made(made));
    return index(made) - original_vertices_;
  }
  void record_star(const HalfEdgeMesh& mesh, VertexId made);
  void record_needs(const HalfEdgeMesh& mesh, VertexId made, const PerVertex<VertexId>& parents);
  Box completed_faces(const HalfEdgeMesh& mesh, VertexId made) const;

  ProgressiveHull hull_;
  std::uint32_t original_vertices_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> pool_;
  std::vector<Box> bounds_;
};

/// A progressive hull refined here and there: a mesh between base and original, changed by vertex splits and their
/// undoing, never copied. Scratch memory; use one per thread.
/// Guaranteed: whatever was split, and in whatever order, the mesh is a closed 2-manifold, each vertex is split in the
/// very star that its collapse made, and the mesh encloses every finer one as the levels of the hull do.
class RefinedHull {
 public:
  /// The base mesh.
  explicit RefinedHull(std::shared_ptr<const RefinableHull> hull);

  const RefinableHull& refinable() const { return *hull_; }

  std::size_t face_count() const { return hull_->hull().base_face_count() + 2 * splits_.size(); }
  bool has(FaceId f) const { return corners(f)[0] != ProgressiveHull::kAbsent; }
  /// Of a face that is there, here and below.
  std::array<VertexId, 3> corners(FaceId f) const {
    const std::uint32_t* face = faces_.data() + first(f);
    return {VertexId(face[0]), VertexId(face[1]), VertexId(face[2])};
  }
  Triangle triangle(FaceId f) const {
    const PerVertex<Vec3>& positions = hull_->positions();
    const auto [a, b, c] = corners(f);
    return {positions[a], positions[b], positions[c]};
  }
  /// Whether f is a face of the original mesh, with the corners it has there.
  bool is_original(FaceId f) const {
    const auto [a, b, c] = corners(f);
    return !hull_->is_made(a) && !hull_->is_made(b) && !hull_->is_made(c);
  }
  /// A word for the caller's own use, in the same cache line; 0 at first. Of any face, there or not.
  std::uint32_t& tag(FaceId f) { return faces_[first(f) + 3]; }

  /// The vertices that are split, in an order in which they can be.
  std::span<const VertexId> splits() const { return splits_; }
  bool is_split(VertexId made) const { return is_split_[hull_->number(made)]; }

  /// Splits `made` and, before it, whatever must be split so that it and its link are there. Returns the number of
  /// splits, which are the last of splits(); none if it is split already.
  std::size_t split(VertexId made);

  /// Whether the collapse that made a vertex can be made again: it is split, and no other split needs it to be. Takes
  /// time in proportion to the splits after it in splits(), as does unsplit.
  bool can_unsplit(VertexId made) const;
  /// Undoes the split of a vertex; requires can_unsplit.
  void unsplit(VertexId made);
  /// Undoes, from the last split to the first, each that can be undone by then and is unwanted(made). Returns how many.
  template <class Unwanted>
  std::size_t coarsen(Unwanted unwanted);
  /// Back to the base mesh.
  void roll_back();

  /// Of the faces that are there, in the order of their numbers; vertices likewise, renumbered without gaps.
  TriangleMesh triangle_mesh() const;

  std::size_t memory_bytes() const;  ///< of this object alone

 private:
  struct Pending {
    std::uint32_t split;
    std::uint32_t needs_seen;
  };

  static std::size_t first(FaceId f) { return 4 * std::size_t{index(f)}; }
  void put(VertexId v, std::uint32_t corner) { faces_[corner] = index(v); }
  void make_split(VertexId made);
  void restore_star(VertexId made);

  std::shared_ptr<const RefinableHull> hull_;
  std::vector<std::uint32_t> faces_;    ///< of each its corners' vertices and its tag
  std::vector<std::uint8_t> is_split_;  ///< each by its number; a bool, but for coarsen
  std::vector<VertexId> splits_;
  std::vector<Pending> pending_;
};

template <class Unwanted>
std::size_t RefinedHull::coarsen(Unwanted unwanted) {
  // Those that a split needs are before it, and what is kept is moved to the end: one pass sees to all.
  constexpr std::uint8_t kNeeded = 2;
  auto kept = splits_.end();
  for (auto split = splits_.end(); split != splits_.begin();) {
    const VertexId made = *--split;
    if (is_split_[hull_->number(made)] != kNeeded && unwanted(made)) {
      restore_star(made);
    } else {
      for (const std::uint32_t needed : hull_->needs(made)) is_split_[needed] = kNeeded;
      *--kept = made;
    }
  }
  const auto undone = static_cast<std::size_t>(kept - splits_.begin());
  splits_.erase(splits_.begin(), kept);
  for (const VertexId made : splits_) is_split_[hull_->number(made)] = true;
  return undone;
}

}  // namespace prohull
