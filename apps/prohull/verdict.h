#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "prohull/detail/summary.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/verification.h"

namespace prohull::cli {

/// Two meshes of which one should lie close around the other, and perhaps does not have the same unit.
class SizeComparison {
 public:
  SizeComparison(const Box& hull, std::size_t hull_faces, const Box& original, HullSide side);

  /// The outer one is larger than a hull of a few faces is.
  bool is_doubtful() const;
  /// "the hull is about 1,000 times as large as the original: are their units different? ..."
  std::string doubt() const;
  nlohmann::json facts() const;

 private:
  HullSide side_;
  double limit_;
  /// How large the outer box is by the inner one, along the axis where that is least: a spike makes a box larger along
  /// one or two axes, another unit along all. NaN if the inner box is a point.
  double ratio_ = std::numeric_limits<double>::quiet_NaN();
};

/// What `lod` says behind "certified: " of a level as it is written, which was compared with the finest one.
std::string certificate_of_level(const Verification& found);

/// What was proven, against what, as reports have it.
nlohmann::json facts(const Verification& found);
nlohmann::json facts(const DistanceBounds& bounds);  ///< `farthest` is null where no point is known to be away
nlohmann::json facts(const Folds& folds);

}  // namespace prohull::cli
