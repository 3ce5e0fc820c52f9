#include "construct/placement.h"

#include <limits>

#include "geometry/predicates.h"
#include "geometry/simd.h"

namespace prohull {
namespace {

double cubed(double x) { return x * x * x; }

// A volume may be beyond all numbers, or nothing at all if a part of it is.
double finite(double volume) { return std::isfinite(volume) ? volume : std::numeric_limits<double>::max(); }

// The star has size 1 around the origin: nothing beyond is a shape that the guards would let pass.
constexpr double kStarReach = 8;

// Calls use(a, b, c) for the corners of each face of the star until one call returns false.
template <class Use>
bool all_faces(const HalfEdgeMesh& mesh, const Star& star, Use&& use) {
  const Vec3 &o = mesh.position(star.o), &d = mesh.position(star.d);
  const Vec3 &l = mesh.position(star.link[0]), &r = mesh.position(star.link[star.o_faces]);
  if (!use(o, d, l) || !use(d, o, r)) return false;
  for (std::size_t i = 0; i < star.link.size(); ++i)
    if (!use(i < star.o_faces ? o : d, mesh.position(star.link[i]), mesh.position(star.link[star.after(i)])))
      return false;
  return true;
}

/// Of faces 2k and 2k + 1.
Double2 double_areas(const Star& star, std::size_t k) {
  return Double2{star.double_areas[2 * k], star.double_areas[2 * k + 1]};
}

}  // namespace

double added_volume(const Star& star, const Vec3& p) {
  const Vec3Pair at = both(p);
  double sixfold = 0;
  for (std::size_t k = 0; const auto& [normal, offset] : star.planes.pairs()) {
    const Double2 volumes = double_areas(star, k++) * (dot(normal, at) - offset);
    sixfold += volumes[0];
    sixfold += volumes[1];
  }
  return finite(sixfold / 6 * cubed(star.scale));
}

namespace {

double added_volume(const Star& star, const Vec3& p, const std::vector<double>& weights) {
  double sixfold = 0;
  for (std::size_t i = 0; i < star.planes.size(); ++i)
    sixfold += weights[i] * star.double_areas[i] * (dot(star.planes[i].normal, p) - star.planes[i].offset);
  return finite(sixfold / 6 * cubed(star.scale));
}

}  // namespace

std::optional<Placement> place_outside(const Star& star, double margin) {
  static thread_local HalfSpaces constraints;
  constraints = star.planes;
  Vec3 objective;
  for (std::size_t k = 0; auto& [normal, offset] : constraints.pairs()) {
    offset += margin;
    const Vec3Pair weighted = normal * double_areas(star, k++);
    objective += weighted[0];
    objective += weighted[1];
  }
  const auto best = optimum_or_nearest(objective, constraints, kStarReach);
  if (!best) return std::nullopt;
  return Placement{*best, std::max(0.0, added_volume(star, *best))};
}

std::optional<Placement> place_outside(const Star& star, double margin, const StarPlane& plane) {
  // Coordinates along the axis count from the plane, and are held at 0.
  const int axis = plane.axis;
  static thread_local HalfSpaces constraints;
  constraints.clear();
  Vec3 objective;
  for (std::size_t i = 0; i < star.planes.size(); ++i) {
    if (star.double_areas[i] == 0) continue;
    Vec3 normal = star.planes[i].normal;
    const double offset = star.planes[i].offset - normal[axis] * plane.coordinate;
    normal[axis] = 0;
    constraints.push_back({normal, offset + margin});
    objective += normal * (plane.weights[i] * star.double_areas[i]);
  }
  Vec3 along;
  along[axis] = 1;
  constraints.push_back({along, 0});
  auto best = optimum_or_nearest(objective, constraints, kStarReach);
  if (!best) return std::nullopt;
  (*best)[axis] = plane.coordinate;
  return Placement{*best, std::max(0.0, added_volume(star, *best, plane.weights))};
}

bool lies_on_all_planes(const HalfEdgeMesh& mesh, const Star& star, const Vec3& p) {
  return all_faces(mesh, star,
                   [&](const Vec3& a, const Vec3& b, const Vec3& c) { return side(a, b, c, p) == Side::On; });
}

double link_center_volume(const Star& star) {
  Vec3 center;
  for (const Vec3& p : star.local) center += p;
  center = center / static_cast<double>(star.local.size());
  double sum = 0;
  for (std::size_t i = 0; i < star.planes.size(); ++i)
    sum += star.double_areas[i] * std::abs(dot(star.planes[i].normal, center) - star.planes[i].offset);
  return finite(sum / 6 * cubed(star.scale));
}

double estimated_volume(const HalfEdgeMesh& mesh, const Star& star) {
  if (star.link.empty()) return 0;  // two triangles back to back, which nothing may collapse
  const Vec3 &o = mesh.position(star.o), &d = mesh.position(star.d);
  Vec3 center;
  for (const VertexId v : star.link) center += mesh.position(v) - o;
  center = o + center / static_cast<double>(star.link.size());
  const Vec3Pair at_center = both(center), at_o = both(o), at_d = both(d);
  Double2 to_center{}, to_o{}, to_d{};
  // Two faces (a, b, c), one in each lane.
  const auto add = [&](const Vec3Pair& a, const Vec3Pair& b, const Vec3Pair& c) {
    const Vec3Pair n = cross(b - a, c - a);
    to_center += abs(dot(n, at_center - a));
    to_o += abs(dot(n, at_o - a));
    to_d += abs(dot(n, at_d - a));
  };
  const auto link = [&](std::size_t i) -> const Vec3& { return mesh.position(star.link[i]); };
  const auto apex = [&](std::size_t i) -> const Vec3& { return i < star.o_faces ? o : d; };
  add(both(o, d), both(d, o), both(link(0), link(star.o_faces)));
  const std::size_t n = star.link.size();
  for (std::size_t i = 0; i + 1 < n; i += 2)
    add(both(apex(i), apex(i + 1)), both(link(i), link(i + 1)), both(link(i + 1), link(star.after(i + 1))));
  // The last of an odd number: the other lane has no area.
  if (n % 2 == 1) add(both(apex(n - 1), o), both(link(n - 1), o), both(link(0), o));
  const auto sum = [](Double2 x) { return x[0] + x[1]; };
  return finite(5.0 / 3 * std::min({0.4 * sum(to_center), sum(to_o), sum(to_d)}) / 6);
}

bool is_outside(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex) {
  return all_faces(mesh, star,
                   [&](const Vec3& a, const Vec3& b, const Vec3& c) { return side(a, b, c, apex) != Side::Inside; });
}

bool is_outside(const HalfEdgeMesh& mesh, VertexId v, const Vec3& p) {
  for (const HalfEdgeId h : mesh.around(v))
    if (side(mesh.position(v), mesh.position(mesh.tip(h)), mesh.position(mesh.tail(mesh.previous(h))), p) ==
        Side::Inside)
      return false;
  return true;
}

}  // namespace prohull
