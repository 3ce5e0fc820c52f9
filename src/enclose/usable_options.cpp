#include "enclose/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/face_tolerances.h"
#include "geometry/largest_coordinate.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "repair/steps.h"

namespace prohull {
namespace {

void require_usable_lengths(const EnclosingOptions& options) {
  constexpr double kRoom = 64;  // for the corners of hulls, in paddings
  const double most =
      (options.hull.float32_coordinates ? double(std::numeric_limits<float>::max()) : kLargestCoordinate) / kRoom;
  const auto require = [&](double length, const char* name) {
    if (!(length >= 0 && length <= most))
      refuse(fmt::format("the {} is {:g}; it must be a number from 0 to {:.3g}", name, length, most));
  };
  require(options.padding, "gap");
  require(options.seal_holes, "largest diameter of holes to seal");
  if (options.padding > 0 && options.bounds.max_distance <= options.padding)
    refuse(
        fmt::format("a hull that keeps a gap of {:g} is farther than {:g} from the mesh: the largest distance must be "
                    "greater than the gap",
                    options.padding, options.bounds.max_distance));
  if (options.padding > 0 && options.levels) refuse("a hull with padding has no levels: ask for one of the two");
}

void require_usable_tolerances(const TriangleMesh& triangles, const EnclosingOptions& options) {
  if (options.hull.tolerances.size() == 0) return;
  require_tolerances(options.hull.tolerances, triangles.face_count());
  if (options.tight) refuse("a tight hull has no tolerances for single faces: build it without tight");
  if (options.padding > 0)
    refuse("a hull with padding has no tolerances for single faces: all its faces move outwards");
  if (options.repair == Repair::Wrap)
    refuse("a wrap has none of the faces that have a tolerance: choose another repair");
}

void require_usable_mirror(const EnclosingOptions& options) {
  if (!options.hull.mirror) return;
  if (options.tight) refuse("a tight hull is not symmetric: build it without tight");
  if (options.padding > 0) refuse("a hull with padding is not symmetric: ask for one of the two");
  if (options.repair == Repair::Wrap || options.seal_holes > 0)
    refuse("a wrap is not symmetric: choose another repair, and no holes to seal");
}

}  // namespace

void require_usable(const TriangleMesh& triangles, std::span<const std::size_t> target_faces,
                    const EnclosingOptions& options) {
  if (target_faces.empty()) refuse("no number of faces was asked for");
  if (options.best_of < 1) refuse("best_of is 0; it must be at least 1");
  if (options.tight && options.levels) refuse("a tight hull has no levels: ask for one of the two");
  require_usable_size(finite_bounding_box(triangles));
  options.bounds.require_usable();
  require_usable_lengths(options);
  require_usable_tolerances(triangles, options);
  require_usable_mirror(options);
  if (options.hull.side == HullSide::Inner && options.repair == Repair::Wrap)
    refuse("the repair 'wrap' is for outer hulls: what lies inside of a wrap need not lie inside of the mesh");
  if (options.hull.side == HullSide::Inner && options.seal_holes > 0)
    refuse("inner hulls seal no holes: leave out how large they may be");
}

}  // namespace prohull
