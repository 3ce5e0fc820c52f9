#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "prohull/detail/summary.h"
#include "prohull/enclosing_hull.h"
#include "prohull/verdict.h"
#include "robot/json.h"

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

/// Of a verdict that was asked for; `is_sure` is false where units are in doubt.
int exit_code_of(const Verdict& verdict, bool is_sure);

nlohmann::json facts(const Folds& folds);

/// What reports say of a hull wherever it is written, but for its verdict.
nlohmann::json facts(const EnclosingHull& hull);

}  // namespace prohull::cli
