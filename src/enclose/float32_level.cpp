#include "prohull/detail/float32_hull.h"
#include "prohull/error.h"
#include "prohull/verification.h"

namespace prohull {

TriangleMesh float32_level(const ProgressiveHull& hull, const TriangleMesh& level) try {
  return with_float32_coordinates(level, hull.side()).mesh;
} catch (const InputError& error) {
  if (error.defect() != Defect::NoVolume) throw;
  TriangleMesh rounded = with_float32_coordinates(level, hull.side(), NoRoom::Round).mesh;
  if (!verify_hull(rounded, hull.original(), hull.side()).certified) throw;
  return rounded;
}

}  // namespace prohull
