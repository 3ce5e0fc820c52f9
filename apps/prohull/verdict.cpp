#include "verdict.h"

#include <fmt/format.h>

#include <cmath>

#include "command.h"
#include "prohull/detail/text.h"

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
  constexpr double kFactors[]{10, 12, 25.4, 100, 304.8, 1000};  // of two units, and a hull is somewhat larger
  constexpr double kLeast = 0.9, kMost = 1.2;
  double said = ratio_;
  for (const double factor : kFactors)
    if (ratio_ > kLeast * factor && ratio_ < kMost * factor) said = factor;
  const bool is_outer = side_ == HullSide::Outer;
  return fmt::format(
      "the {} is about {} times as large as the {}: are their units different? If so, give the original its --unit or "
      "--scale; if not, say --any-scale",
      is_outer ? "hull" : "original", said == 1000 ? "1,000" : fmt::format("{:.4g}", said),
      is_outer ? "original" : "hull");
}

nlohmann::json SizeComparison::facts() const {
  return {{"size_ratio", finite_or_null(ratio_)}, {"units_doubtful", is_doubtful()}};
}

std::string certificate_of_level(const Verification& found) {
  const std::string file = "the file as written", finest = "the finest level";
  const bool is_outer = found.side == HullSide::Outer;
  const std::string what = claim(found, is_outer ? file : finest, is_outer ? finest : file);
  if (found.encloses) return "yes, " + what;
  if (found.faces_outside == 0) return fmt::format("no, {}: {}", what, found.why_not);
  return fmt::format("no, {} {} of {} uncovered, at least in part: {}", is_outer ? "it leaves" : finest + " leaves",
                     counted(found.faces_outside, "face"), is_outer ? finest : "it", found.why_not);
}

nlohmann::json facts(const Verification& found) {
  return {{"encloses", found.encloses},
          {"proof", std::string(found.proof)},
          {"side", std::string(name_of(hull_side_names(), found.side))},
          {"original_closed", found.original_closed},
          {"cap_faces", found.cap_faces},
          {"non_finite_faces", found.non_finite_faces},
          {"every_triangle", found.every_triangle},
          {"original_volume", finite_or_null(found.original_volume)},
          {"void_ratio", finite_or_null(found.void_ratio)}};
}

nlohmann::json facts(const Folds& folds) {
  return {{"faces", folds.faces}, {"place", {folds.place.x, folds.place.y, folds.place.z}}};
}

nlohmann::json facts(const DistanceBounds& bounds) {
  const Vec3& p = bounds.farthest;
  const nlohmann::json farthest = bounds.lower > 0 ? nlohmann::json{p.x, p.y, p.z} : nlohmann::json();
  return {{"lower", bounds.lower}, {"upper", finite_or_null(bounds.upper)}, {"farthest", farthest}};
}

}  // namespace prohull::cli
