#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>

#include <array>

#include "geometry/orientation.h"

namespace prohull {
namespace {

using Interval = CGAL::Interval_nt_advanced;

/// Six times the volume, seen from a corner of the mesh, so that a distant mesh loses no digits.
template <class Field>
Field sixfold_volume(std::span<const Triangle> faces) {
  Field sum(0);
  if (faces.empty()) return sum;
  const Vec3 o = faces[0].a;
  const auto relative = [&](const Vec3& p) {
    return std::array{Field(p.x) - Field(o.x), Field(p.y) - Field(o.y), Field(p.z) - Field(o.z)};
  };
  for (const Triangle& t : faces) {
    const auto a = relative(t.a), b = relative(t.b), c = relative(t.c);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

}  // namespace

int volume_sign(std::span<const Triangle> faces) {
  {
    const CGAL::Protect_FPU_rounding<true> upwards;
    const Interval sum = sixfold_volume<Interval>(faces);
    if (sum.inf() > 0) return 1;
    if (sum.sup() < 0) return -1;
  }
  return int(CGAL::sign(sixfold_volume<CGAL::Gmpq>(faces)));
}

}  // namespace prohull
