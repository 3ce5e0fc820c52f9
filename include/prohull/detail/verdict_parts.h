#pragma once

#include <algorithm>
#include <optional>

#include "prohull/verdict.h"

namespace prohull {

/// Calls `visit(name, value)` for each field of a verdict, by its name in reports and in Python. Values are bool,
/// optional<bool>, std::size_t, std::string_view, optional<double> and optional<DistanceBounds>.
template <class Visit>
void visit_fields(const Verdict& verdict, Visit visit) {
  const auto known = [](Answer answer) {
    return answer == Answer::Yes || answer == Answer::No ? std::optional(answer == Answer::Yes) : std::nullopt;
  };
  visit("certified", verdict.certified);
  visit("why_not", std::string_view(verdict.why_not));
  visit("proof", verdict.proof);
  visit("side", name_of(hull_side_names(), verdict.side));
  visit("covers_triangles", known(verdict.covers_triangles));
  visit("encloses_solid", known(verdict.encloses_solid));
  visit("gap", verdict.gap);
  visit("distance_to_triangles", verdict.distance_to_triangles);
  visit("distance_to_solid", verdict.distance_to_solid);
  visit("original_closed", verdict.original_closed);
  visit("cap_faces", verdict.cap_faces);
  visit("non_finite_faces", verdict.non_finite_faces);
}

/// After something else has moved the surface by at most that.
inline Verdict farther_by(Verdict verdict, double distance) {
  constexpr double kRounding = 1 + 0x1p-40;
  for (auto* bounds : {&verdict.distance_to_triangles, &verdict.distance_to_solid})
    if (*bounds) *bounds = DistanceBounds{.upper = ((*bounds)->upper + distance) * kRounding};
  return verdict;
}

/// Of two parts together. What is not known of one of them is not known.
inline Verdict both(Verdict a, const Verdict& b) {
  a.certified = a.certified && b.certified;
  if (a.why_not.empty()) a.why_not = b.why_not;
  a.covers_triangles = std::min(a.covers_triangles, b.covers_triangles);
  a.encloses_solid = std::min(a.encloses_solid, b.encloses_solid);
  const auto greater = [](const DistanceBounds& x, const DistanceBounds& y) { return y.upper > x.upper ? y : x; };
  if (a.distance_to_solid || b.distance_to_solid) a.distance_to_solid = greater(a.distance(), b.distance());
  if (a.distance_to_triangles && b.distance_to_triangles)
    a.distance_to_triangles = greater(*a.distance_to_triangles, *b.distance_to_triangles);
  else
    a.distance_to_triangles.reset();
  a.original_closed = a.original_closed && b.original_closed;
  a.cap_faces += b.cap_faces, a.non_finite_faces += b.non_finite_faces;
  return a;
}

}  // namespace prohull
