#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "prohull/convex_cover.h"
#include "prohull/enclosing_hull.h"
#include "prohull/sphere_cover.h"

namespace prohull {

// What Python and JavaScript tell of a result beside its numbers: its notes, and what its flags say.

inline void add_note_of_estimate(bool is_estimated, std::vector<std::string>& notes) {
  if (is_estimated) notes.emplace_back("the volume of the mesh is not known: the void is measured against an estimate");
}

inline std::vector<std::string> told_notes(const EnclosingHull& hull, const EnclosingHulls& made) {
  std::vector<std::string> notes = hull.notes;
  if (!hull.target_reached)
    notes.push_back("the hull has " + std::to_string(hull.mesh.face_count()) + " faces, more than the " +
                    std::to_string(hull.target_faces) + " asked for" +
                    describe_refusals(hull.blocked, ": of its edges, "));
  if (!hull.within_bounds) notes.emplace_back("the hull is not within the bounds asked for: no hull that was tried is");
  add_note_of_estimate(made.is_estimated && !std::isnan(hull.void_ratio), notes);
  return notes;
}

inline std::vector<std::string> told_notes(const SphereCover& cover) {
  std::vector<std::string> notes = cover.notes;
  add_note_of_estimate(cover.is_estimated && cover.original_volume > 0, notes);
  return notes;
}

inline std::vector<std::string> told_notes(const ConvexCover& cover) {
  std::vector<std::string> notes = cover.notes;
  if (!cover.within_bounds)
    notes.emplace_back("the pieces are not within the bounds asked for: no cover that was tried is");
  add_note_of_estimate(cover.is_estimated && cover.original_volume > 0, notes);
  return notes;
}

}  // namespace prohull
