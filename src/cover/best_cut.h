#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "cover/part.h"

namespace prohull::cover {

/// A plane that divides a part, and what the convex hulls of both sides have.
struct Cut {
  Plane plane;
  double volume = 0;  ///< together
  /// Less is better. Between cuts that save the same, as nothing yet in a ring, even halves leave most to later cuts.
  double merit = 0;
};

/// The `count` best cuts of a part among planes of many directions and of so many even offsets, and those of steps of
/// the surface; the best first: at most one for each direction. Cuts of a greater merit than `most` may be left out.
std::vector<Cut> cuts(const Part& part, const Solid& solid, int offsets, std::size_t count,
                      double most = std::numeric_limits<double>::infinity());

/// Of the convex hull of a part. 0 of what is too flat for cuts to be compared by volumes.
double quick_volume(const Part& part);

/// Of a cut whose halves have this volume together.
double greatest_merit(double volume);

/// The volumes of the convex hulls of both sides of a plane together, for many planes.
class HalvesVolume {
 public:
  HalvesVolume(const Part& part, const Solid& solid);
  const Box& box() const { return box_; }
  /// Of several planes together: what lies on the same side of all of them is looked at once, so they had better be
  /// close to each other. The volume is infinite if all is on one side, and may be if it is greater than `most`.
  std::vector<Cut> operator()(std::span<const Plane> planes,
                              double most = std::numeric_limits<double>::infinity()) const;

 private:
  const Part& part_;
  const Solid& solid_;
  const Box box_;
  const std::vector<std::array<std::uint32_t, 2>> edges_;
};

/// Turns and moves the plane as long as that makes the volume less.
Cut refined(const HalvesVolume& halves, const Cut& cut);

/// Turns and moves the plane, which meets the box, as long as that makes its value less. `values` are those of several
/// planes that are close to each other; one that is greater than `most` may have any value that is.
using ValuesOfPlanes = std::function<std::vector<double>(std::span<const Plane>, double most)>;
Plane with_least_value(const Plane& plane, const Box& box, const ValuesOfPlanes& values);

}  // namespace prohull::cover
