#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "prohull/distance.h"
#include "prohull/progressive_hull.h"

namespace prohull {

/// What is known of one question. Of two parts together, the less is.
enum class Answer {
  No,         ///< exact
  Undecided,  ///< neither yes nor no was found
  NotAsked,
  Yes,  ///< proven
};

/// What is proven of a hull, or of pieces or spheres together, and against what. Every command that makes or verifies
/// one tells it, with the same names in reports and in Python; docs/proofs.md has the words. What was not asked, not
/// decided or not measured is NotAsked, Undecided or empty.
struct Verdict {
  /// The answer: what the record says is proven. Of verify_hull, the gap that was asked for is kept, too.
  bool certified = false;
  std::string why_not = {};  ///< why the answer is no; empty if it is yes
  /// How it was decided: "replay" of the vertex splits of a progressive hull, "enclosure" of one closed mesh by
  /// another, "coverage" of every triangle of an original that is not closed, "union" of pieces or spheres, "padding"
  /// of a hull that keeps a gap, "sweep" of pieces along a motion, "identity" of the original itself.
  std::string_view proof = {};
  HullSide side = HullSide::Outer;

  /// Every point of every finite triangle of the original lies in the solid; of an inner hull, every point of every
  /// triangle of the hull lies in that of the original.
  Answer covers_triangles = Answer::NotAsked;
  /// The solid of the original is enclosed; of an inner hull, the original encloses it.
  Answer encloses_solid = Answer::NotAsked;
  std::optional<double> gap = {};  ///< no point is nearer to a triangle of the original than that
  /// No point of the surface is farther than `upper` from all triangles of the original, or from its solid with what
  /// closes it. Of pieces and spheres, points in the solid of a closed original do not count.
  std::optional<DistanceBounds> distance_to_triangles = {}, distance_to_solid = {};

  bool original_closed = false;      ///< as it was given
  std::size_t cap_faces = 0;         ///< faces that are none of the original, and count as if they closed its openings
  std::size_t non_finite_faces = 0;  ///< faces of the original that were left out: a corner is not finite

  /// From the solid, or from the triangles if there is none. Requires a distance to be known.
  const DistanceBounds& distance() const { return distance_to_solid ? *distance_to_solid : *distance_to_triangles; }
  /// All that was asked of the finite triangles is proven.
  bool is_yes() const { return !is_any(Answer::No) && !is_any(Answer::Undecided); }
  /// Of what was asked, something is not decided, and nothing is denied.
  bool is_undecided() const { return !is_yes() && !is_any(Answer::No); }
  bool is_any(Answer answer) const { return covers_triangles == answer || encloses_solid == answer; }
};

}  // namespace prohull
