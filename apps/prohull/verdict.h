#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/verification.h"

namespace prohull::cli {

/// What is proven, or what is not: "hull.stl encloses part.stl", "hull.stl does not cover every triangle of part.stl";
/// and what closes the openings of an original that is not closed. docs/proofs.md has these words.
std::string claim(const Verification& found, const std::string& subject, const std::string& object);

/// ", void 3.125 %"; empty if the void is not known.
std::string text_of_void(double void_ratio);

/// The same of a hull that was made; where its volume is only estimated, it says so.
std::string described_void(const EnclosingHulls& made, const EnclosingHull& hull);

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
  /// Of the boxes, outer to inner, along the axis where it is least: a spike makes a box larger along one or two of
  /// them, another unit along all. NaN if the inner one is a point.
  double ratio_ = std::numeric_limits<double>::quiet_NaN();
};

/// What a summary says behind "certified: "; `written` is whether the file holds the very bits of the hull.
std::string certificate_of(const EnclosingHulls& made, const EnclosingHull& hull, bool written);

/// Behind a distance that counts from the mesh: that its openings are closed, and how far the triangles alone are.
std::string text_of_openings(bool has_openings, const DistanceBounds& from_triangles);

/// As reports have them: what was proven, against what.
nlohmann::json facts(const Verification& found);
nlohmann::json facts(const DistanceBounds& bounds);
nlohmann::json facts(const Folds& folds);

}  // namespace prohull::cli
