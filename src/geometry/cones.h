#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/no_index.h"
#include "prohull/geometry.h"

namespace prohull {

/// Where triangles with a corner in common lie: in the convex hull of it and of the box of their other corners.
struct Cone {
  Vec3 apex;
  Box rim;

  void extend(const Triangle& t) {
    for (const Vec3& p : {t.a, t.b, t.c})
      if (p != apex) rim.extend(p);
  }
};

/// Whether a plane proves that no triangle of one meets one of the other, but for an apex that they share. Around a
/// vertex of many faces all boxes overlap: this tells most of these faces apart, many at a time.
bool are_apart(const Cone& a, const Cone& b);
bool are_apart(const Triangle& t, const Cone& cone);

/// The cones of faces that lie in a tree, `kWidth` nodes to a node and `kWidth` faces to a node of level 0. Only where
/// all faces of a node of level 1 have a corner in common it has one, and so have the nodes below: few meshes have any.
class Cones {
 public:
  static constexpr std::uint32_t kWidth = 4;

  Cones() = default;
  /// face_at(i) is the i-th face as a Triangle.
  template <class FaceAt>
  Cones(std::uint32_t count, const FaceAt& face_at) {
    const std::uint32_t leaves = nodes_of(count), parents = nodes_of(leaves);
    for (std::uint32_t i = 0; i < parents; ++i) {
      const std::uint32_t begin = kWidth * kWidth * i, end = std::min(begin + kWidth * kWidth, count);
      for (const Triangle first = face_at(begin); const Vec3& apex : {first.a, first.b, first.c}) {
        if (!have_all(apex, begin, end, face_at)) continue;
        if (at_.empty()) at_ = {std::vector(leaves, kNone), std::vector(parents, kNone)};
        add(1, i, {apex, {}});
        for (std::uint32_t slot = begin; slot < end; ++slot) {
          if (slot % kWidth == 0) add(0, slot / kWidth, {apex, {}});
          for (const std::uint32_t cone : {at_[0][slot / kWidth], at_[1][i]}) cones_[cone].extend(face_at(slot));
        }
        break;
      }
    }
    if (!at_.empty()) join_upwards();
  }

  bool empty() const { return at_.empty(); }

  /// Makes room for a face that has changed; nodes lose their cone if it has the corner no more.
  void place(std::uint32_t slot, const Triangle& t);

  /// Of the faces in a node; null if there is none.
  const Cone* find(std::size_t level, std::uint32_t node) const {
    if (level >= at_.size() || at_[level][node] == kNone) return nullptr;
    return &cones_[at_[level][node]];
  }

 private:
  static std::uint32_t nodes_of(std::uint32_t children) { return (children + kWidth - 1) / kWidth; }

  template <class FaceAt>
  static bool have_all(const Vec3& apex, std::uint32_t begin, std::uint32_t end, const FaceAt& face_at) {
    for (std::uint32_t slot = begin; slot < end; ++slot)
      if (const Triangle t = face_at(slot); t.a != apex && t.b != apex && t.c != apex) return false;
    return true;
  }

  void add(std::size_t level, std::uint32_t node, const Cone& fan) {
    at_[level][node] = static_cast<std::uint32_t>(cones_.size());
    cones_.push_back(fan);
  }
  void join_upwards();

  std::vector<std::vector<std::uint32_t>> at_;  ///< by level and node
  std::vector<Cone> cones_;
};

}  // namespace prohull
