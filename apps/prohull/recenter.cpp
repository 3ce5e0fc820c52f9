#include "recenter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "outputs.h"
#include "prohull/detail/solid_pieces.h"

namespace prohull::cli {
namespace {

/// The decimal number nearest to x that is a multiple of the power of ten below `size`.
double rounded(double x, double size) {
  const int digits = static_cast<int>(std::floor(std::log10(std::abs(x))) - std::floor(std::log10(size)));
  return std::strtod(fmt::format("{:.{}e}", x, std::clamp(digits, 0, 16)).c_str(), nullptr);
}

}  // namespace

// With |middle| > 4 size every coordinate is between half and twice the offset, which differs from the middle by at
// most half of the size: by Sterbenz' lemma the difference is a double.
Vec3 recentering_offset(const TriangleMesh& mesh) {
  const Box box = finite_bounding_box(mesh);
  if (box.is_empty()) return {};
  const double size = std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
  const Vec3 middle = box.center();
  Vec3 offset;
  for (int axis = 0; axis < 3; ++axis)
    if (size > 0 && std::abs(middle[axis]) > 4 * size) offset[axis] = rounded(middle[axis], size);
  return offset;
}

TriangleMesh minus(TriangleMesh mesh, const Vec3& offset) {
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners)
      for (int axis = 0; axis < 3; ++axis)
        if (const double x = mesh.positions[v][axis]; std::isfinite(x) && !is_exact_sum(x, -offset[axis]))
          refuse(
              fmt::format("--offset: {:.17g} - {:g} is rounded, so that the answer would be about another mesh; give "
                          "the offset that `prohull build --recenter` has told of this one",
                          x, offset[axis]));
  for (Vec3& p : mesh.positions) p = p - offset;
  return mesh;
}

std::string text_of_offset(const Vec3& offset) { return fmt::format("{},{},{}", offset.x, offset.y, offset.z); }

}  // namespace prohull::cli
