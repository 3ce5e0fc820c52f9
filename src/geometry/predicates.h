#pragma once

#include <cmath>

#include "prohull/geometry.h"

namespace prohull {

enum class Side { Inside = -1, On = 0, Outside = 1 };

constexpr Side opposite(Side s) { return Side(-int(s)); }

/// The exact answer; slow. Coordinates must be finite.
Side exact_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// The sign of the 2x2 determinant |b-a c-a| of the points without the coordinate `axis`, taken in cyclic order: of
/// (y, z), (z, x) or (x, y) for axis 0, 1, 2. Exact; positive if a, b, c turn counter-clockwise seen from +axis.
int turn(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

/// The exact answer of determinant_sign; slow.
int exact_determinant_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e, const Vec3& f);

/// The sign of the determinant of the rows b - a, d - c, f - e. Exact for all finite coordinates, by the filter of
/// `side` below: its bound holds for any rows that are rounded differences.
inline int determinant_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e, const Vec3& f) {
  const Vec3 u = b - a, v = d - c, w = f - e;
  const double vy_wz = v.y * w.z, vz_wy = v.z * w.y, vz_wx = v.z * w.x, vx_wz = v.x * w.z, vx_wy = v.x * w.y,
               vy_wx = v.y * w.x;
  const double det = u.x * (vy_wz - vz_wy) + u.y * (vz_wx - vx_wz) + u.z * (vx_wy - vy_wx);
  const double permanent = (std::abs(vy_wz) + std::abs(vz_wy)) * std::abs(u.x) +
                           (std::abs(vz_wx) + std::abs(vx_wz)) * std::abs(u.y) +
                           (std::abs(vx_wy) + std::abs(vy_wx)) * std::abs(u.z);
  constexpr double kEpsilon = 0x1p-53;
  const double bound = (7.0 + 56.0 * kEpsilon) * kEpsilon * permanent;
  const double smallest = 0x1p-900 * (1 + std::abs(u.x) + std::abs(u.y) + std::abs(u.z));
  if (permanent > smallest && permanent < 0x1p1000) {
    if (det > bound) return 1;
    if (-det > bound) return -1;
  }
  return exact_determinant_sign(a, b, c, d, e, f);
}

/// The side of the supporting plane of (a, b, c) on which p lies; Outside sees them counter-clockwise.
///   (1) On, if and only if the four points are coplanar
///   (2) side(b, c, a, p) == side(a, b, c, p)
///   (3) side(b, a, c, p) == opposite(side(a, b, c, p))
/// Exact for all finite coordinates. The filter is Shewchuk's ("Adaptive Precision Floating-Point Arithmetic and Fast
/// Robust Geometric Predicates", 1997, section 4.3): |error| <= (7 + 56 eps) eps * permanent with eps = 2^-53. Products
/// that underflow add at most 2^-1072 (1 + |adz| + |bdz| + |cdz|), which the lower limit on the permanent makes
/// negligible.
inline Side side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const double adx = a.x - p.x, ady = a.y - p.y, adz = a.z - p.z;
  const double bdx = b.x - p.x, bdy = b.y - p.y, bdz = b.z - p.z;
  const double cdx = c.x - p.x, cdy = c.y - p.y, cdz = c.z - p.z;
  const double bdxcdy = bdx * cdy, cdxbdy = cdx * bdy;
  const double cdxady = cdx * ady, adxcdy = adx * cdy;
  const double adxbdy = adx * bdy, bdxady = bdx * ady;
  // Shewchuk's orient3d is positive if p lies below the plane, that is inside.
  const double det = adz * (bdxcdy - cdxbdy) + bdz * (cdxady - adxcdy) + cdz * (adxbdy - bdxady);
  const double permanent = (std::abs(bdxcdy) + std::abs(cdxbdy)) * std::abs(adz) +
                           (std::abs(cdxady) + std::abs(adxcdy)) * std::abs(bdz) +
                           (std::abs(adxbdy) + std::abs(bdxady)) * std::abs(cdz);
  constexpr double kEpsilon = 0x1p-53;
  constexpr double kBound = (7.0 + 56.0 * kEpsilon) * kEpsilon;
  const double bound = kBound * permanent;
  const double smallest = 0x1p-900 * (1 + std::abs(adz) + std::abs(bdz) + std::abs(cdz));
  if (permanent > smallest && permanent < 0x1p1000) {
    if (det > bound) return Side::Inside;
    if (-det > bound) return Side::Outside;
  }
  return exact_side(a, b, c, p);
}

}  // namespace prohull
