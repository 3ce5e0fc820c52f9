#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "enclose/solids.h"

namespace prohull {

enum class Method {
  Levels,          ///< a level of the progressive hull
  Within,          ///< a progressive hull without collapses that could break the bound of the distance
  InSteps,         ///< a progressive hull whose vertices move towards the triangles before it has come down, too
  Early,           ///< the same, moving earlier and more often, where that stays near the triangles
  Tight,           ///< a tight hull (tight_hull.h)
  TightOfGapBody,  ///< a tight hull of a body that keeps the gap (gap_body.h)
  Searched,        ///< a hull of few faces, searched on from (few_faces.h)
  Further,         ///< a hull that keeps the bound of the distance, with further collapses that could not break it
};

/// A hull that touches a closed mesh is tighter than one that keeps away from single triangles. But where the mesh
/// intersects itself, it may not cover them all.
enum class Approach { Touching, Clear };

struct Recipe {
  Method method;
  bool moves = false;  ///< towards the triangles in the end, so that it is no level
  Approach approach = Approach::Touching;
};

/// What is left to be tried with the same solid where the recipe fails, if anything.
std::optional<Recipe> other_way(Recipe recipe, const Request& request);

/// What may be tried: nothing else decides what comes of it.
struct Candidate {
  SolidId solid;
  std::size_t target_faces;
  Recipe recipe;
  HullBounds bounds = {};  ///< that the hull is built to keep
  std::uint64_t seed = 0;
  std::size_t least_faces = 0;  ///< Method::Levels: of the level
  double within = 0;  ///< Method::Within: the distance that collapses keep; Further: those of `start` kept; 0 if none;
                      ///< Early: how far the hull may reach, about
  std::size_t most_faces = std::numeric_limits<std::size_t>::max();  ///< with more, it is not better than another hull
  std::optional<EnclosingHull> start = {};  ///< Method::Searched and Further: what they begin with
};

/// What came of a candidate.
struct Attempt {
  Candidate candidate;
  EnclosingHull hull;
  std::string why_not_storable = {};  ///< with the float32 coordinates asked for; empty if it is
  /// With padding, of a hull of the mesh: the void before it was moved away.
  std::optional<double> void_before_padding = {};
};

/// Builds and certifies it. None if the recipe cannot be followed: the gap's body of the solid intersects itself.
std::optional<Attempt> attempt(const Candidate& candidate, const Request& request, Solids& solids);

/// Decides exactly whether the hull is one of the triangles that were given, and sets its `certified`, `verdict` and
/// `proof`. With padding, it is moved away first as far as that takes, and its `padding` is what is proven. Where few
/// triangles of a closed mesh stick out, as those of folds, vertices of the hull are lifted over them.
void certify(Attempt& attempt, const Request& request, Solids& solids);

/// Sets how far the hull is from bounds that it was not built to keep.
void measure(Attempt& made, const HullBounds& bounds, const Request& request, Solids& solids);

}  // namespace prohull
