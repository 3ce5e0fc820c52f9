#include "verdict.h"

#include <fmt/format.h>

#include <cmath>

#include "command.h"

namespace prohull::cli {

// Of 190 hulls of 4 faces around small meshes, the largest were 11.2 times as large, around squares, and 10.1 around a
// solid; of 95 hulls of 12 faces, none was 4.3 times as large. An inner hull may be that of a thick part alone.
SizeComparison::SizeComparison(const Box& hull, std::size_t hull_faces, const Box& original, HullSide side)
    : side_(side), limit_(hull_faces < 12 || side == HullSide::Inner ? 20 : 9) {
  const bool is_outer = side == HullSide::Outer;
  const Box &outer = is_outer ? hull : original, &inner = is_outer ? original : hull;
  for (int axis = 0; axis < 3; ++axis)
    if (const double extent = inner.max[axis] - inner.min[axis]; extent > 0)
      ratio_ = std::fmin(ratio_, (outer.max[axis] - outer.min[axis]) / extent);
}

bool SizeComparison::is_doubtful() const { return ratio_ >= limit_; }

std::string SizeComparison::doubt() const {
  const bool is_outer = side_ == HullSide::Outer;
  return fmt::format(
      "the {} is {:.4g} times as large as the {}: are their units different? If so, give the original its --unit or "
      "--scale; if not, say --any-scale",
      is_outer ? "hull" : "original", ratio_, is_outer ? "original" : "hull");
}

nlohmann::json SizeComparison::facts() const {
  return {{"size_ratio", finite_or_null(ratio_)}, {"units_doubtful", is_doubtful()}};
}

int exit_code_of(const Verdict& verdict, bool is_sure) {
  if (verdict.certified) return is_sure ? kDone : kAnswerIsNo;
  return verdict.is_undecided() ? kUndecided : kAnswerIsNo;
}

nlohmann::json facts(const Folds& folds) { return {{"faces", folds.faces}, {"place", folds.place}}; }

nlohmann::json facts(const EnclosingHull& hull) {
  return {{"target_faces", hull.target_faces},
          {"faces", hull.mesh.face_count()},
          {"vertices", hull.mesh.vertex_count()},
          {"volume", volume_of(hull)},
          {"void_ratio", finite_or_null(hull.void_ratio)},
          {"source", name_of(source_names(), hull.source)},
          {"original_volume", finite_or_null(hull.verdict.original_volume)},
          {"self_intersections", hull.self_intersections},
          {"notes", hull.notes}};
}

}  // namespace prohull::cli
