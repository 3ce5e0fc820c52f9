#include "robot/samples/sample_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "prohull/convex_hull.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using Ring = std::vector<Vec3>;

Vec3 unit(const Vec3& v) { return v / norm(v); }

/// Faces of a fillet of a quarter turn.
std::size_t fillet_steps(const Detail& detail) { return std::max<std::size_t>(detail.segments / 12, 2); }

/// Adds the corner, or the arc that rounds it between its neighbours. Where a line is too short for the fillets at its
/// ends, these are smaller.
void add_corner(Ring& line, const Vec3& before, const Corner& corner, const Vec3& after, const Detail& detail) {
  const double length_in = norm(before - corner.point), length_out = norm(after - corner.point);
  const Vec3 in = (before - corner.point) / length_in, out = (after - corner.point) / length_out;
  const double opening = std::acos(std::clamp(dot(in, out), -1.0, 1.0)), turn = std::numbers::pi - opening;
  if (corner.fillet == 0 || turn < 1e-6) return line.push_back(corner.point);
  const double cut = std::min(corner.fillet / std::tan(opening / 2), 0.49 * std::min(length_in, length_out));
  const double radius = cut * std::tan(opening / 2);
  const Vec3 center = corner.point + unit(in + out) * (radius / std::sin(opening / 2));
  const Vec3 from = corner.point + in * cut - center;
  const double quarters = turn / (kTurn / 4);
  const auto steps = static_cast<std::size_t>(std::ceil(quarters * static_cast<double>(fillet_steps(detail)) - 1e-9));
  for (std::size_t i = 0; i <= steps; ++i) {
    const double angle = turn * static_cast<double>(i) / static_cast<double>(steps);
    line.push_back(center + from * std::cos(angle) - in * (radius * std::sin(angle)));
  }
}

Ring rounded_line(const std::vector<Corner>& corners, const Detail& detail) {
  Ring line{corners.front().point};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    add_corner(line, corners[i - 1].point, corners[i], corners[i + 1].point, detail);
  line.push_back(corners.back().point);
  return line;
}

Ring rounded_loop(const std::vector<Corner>& corners, const Detail& detail) {
  Ring line;
  for (std::size_t i = 0, n = corners.size(); i < n; ++i)
    add_corner(line, corners[(i + n - 1) % n].point, corners[i], corners[(i + 1) % n].point, detail);
  return line;
}

/// Faces of a fan from the middle of a ring, which runs counter-clockwise seen from where the fan faces.
void add_fan(TriangleMesh& mesh, const std::vector<VertexId>& ring, const Vec3& middle) {
  const VertexId center = mesh.positions.push_back(middle);
  for (std::size_t k = 0; k < ring.size(); ++k)
    mesh.triangles.push_back({center, ring[k], ring[(k + 1) % ring.size()]});
}

/// The surface through rings that run counter-clockwise seen from the last one, with fans around the middles of its
/// ends.
TriangleMesh lofted(const std::vector<Ring>& rings, const Vec3& bottom, const Vec3& top, Ends ends) {
  TriangleMesh mesh;
  std::vector<std::vector<VertexId>> vertices(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (const Vec3& p : rings[i]) vertices[i].push_back(mesh.positions.push_back(p));
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::size_t k = 0, n = rings[i].size(); k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      mesh.triangles.push_back({vertices[i][k], vertices[i][next], vertices[i + 1][next]});
      mesh.triangles.push_back({vertices[i][k], vertices[i + 1][next], vertices[i + 1][k]});
    }
  std::reverse(vertices.front().begin(), vertices.front().end());
  if (ends != Ends::OpenBottom && ends != Ends::Open) add_fan(mesh, vertices.front(), bottom);
  if (ends != Ends::OpenTop && ends != Ends::Open) add_fan(mesh, vertices.back(), top);
  return mesh;
}

Ring circle(const Vec3& center, const Vec3& x, const Vec3& y, double radius, const Detail& detail) {
  const auto n = static_cast<double>(detail.segments);
  constexpr double kSlack = 1e-4;  // for what float32 rounds
  if (detail.is_around) radius = (radius + kSlack) / std::cos(kTurn / 2 / n);
  Ring ring;
  for (std::size_t k = 0; k < detail.segments; ++k) {
    const double angle = kTurn * static_cast<double>(k) / n;
    ring.push_back(center + x * (radius * std::cos(angle)) + y * (radius * std::sin(angle)));
  }
  return ring;
}

/// The outline with its points moved inwards, about as far as `inset` everywhere.
Ring inset_outline(const Ring& outline, double inset, double z) {
  Ring ring;
  for (std::size_t k = 0, n = outline.size(); k < n; ++k) {
    const Vec3 along = unit(outline[(k + 1) % n] - outline[(k + n - 1) % n]);
    ring.push_back(outline[k] + Vec3{-along.y, along.x, 0} * inset + Vec3{0, 0, z});
  }
  return ring;
}

std::vector<Corner> sharp(std::vector<Corner> corners) {
  for (Corner& corner : corners) corner.fillet = 0;
  return corners;
}

}  // namespace

TriangleMesh turned(const std::vector<Corner>& profile, const Detail& detail, Ends ends) {
  std::vector<Ring> rings;
  for (const Vec3& p : rounded_line(detail.is_around ? sharp(profile) : profile, detail))
    rings.push_back(circle({0, 0, p.z}, {1, 0, 0}, {0, 1, 0}, p.x, detail));
  return lofted(rings, {0, 0, profile.front().point.z}, {0, 0, profile.back().point.z},
                detail.is_export ? ends : Ends::Closed);
}

TriangleMesh disk(double radius, double height, double bottom_fillet, double top_fillet, const Detail& detail,
                  Ends ends) {
  const double flat = radius / 2;  // of the rings within bottom and top
  return turned(
      {{{flat, 0, 0}}, {{radius, 0, 0}, bottom_fillet}, {{radius, 0, height}, top_fillet}, {{flat, 0, height}}}, detail,
      ends);
}

TriangleMesh plate(const std::vector<Corner>& outline, double height, double bevel, const Detail& detail) {
  const Ring loop = rounded_loop(detail.is_around ? sharp(outline) : outline, detail);
  std::vector<Ring> rings;
  if (detail.is_around) bevel = 0;
  const std::size_t steps = fillet_steps(detail);
  const auto add = [&](double angle, bool is_top) {  // 0 where the bevel meets the side
    const double inset = bevel * (1 - std::cos(angle)), rise = bevel * (1 - std::sin(angle));
    rings.push_back(inset_outline(loop, inset, is_top ? height - rise : rise));
  };
  const auto angle_at = [&](std::size_t i) { return kTurn / 4 * static_cast<double>(i) / static_cast<double>(steps); };
  for (std::size_t i = bevel > 0 ? steps : 0; i > 0; --i) add(angle_at(i), false);
  add(0, false), add(0, true);
  for (std::size_t i = 1; bevel > 0 && i <= steps; ++i) add(angle_at(i), true);
  return lofted(rings, {}, {0, 0, height}, Ends::Closed);
}

TriangleMesh rounded_box(const Vec3& size, double corner, double bevel, const Detail& detail) {
  const double x = size.x / 2, y = size.y / 2;
  return plate({{{-x, -y, 0}, corner}, {{x, -y, 0}, corner}, {{x, y, 0}, corner}, {{-x, y, 0}, corner}}, size.z, bevel,
               detail);
}

TriangleMesh swept(const std::vector<Corner>& path, double first_radius, double last_radius, const Detail& detail,
                   Ends ends) {
  const Ring line = rounded_line(path, detail);
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < line.size(); ++i) lengths.push_back(lengths.back() + norm(line[i] - line[i - 1]));
  std::vector<Ring> rings;
  Vec3 x = std::abs(unit(line[1] - line[0]).x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 along = unit(line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1]);
    x = unit(x - along * dot(x, along));  // turns as little as it can
    const double radius = first_radius + (last_radius - first_radius) * lengths[i] / lengths.back();
    rings.push_back(circle(line[i], x, cross(along, x), radius, detail));
  }
  return lofted(rings, line.front(), line.back(), detail.is_export ? ends : Ends::Closed);
}

TriangleMesh bolt(double radius, double height, const Detail& detail) {
  const double socket = 0.55 * radius;
  return turned({{{radius, 0, 0}},
                 {{radius, 0, height}, 0.2 * height},
                 {{socket, 0, height}},
                 {{socket, 0, 0.4 * height}},
                 {{0.1 * socket, 0, 0.4 * height}}},
                detail, Ends::OpenBottom);
}

TriangleMesh in_circle(const TriangleMesh& part, std::size_t count, double radius, double first_angle) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = first_angle + kTurn * static_cast<double>(i) / static_cast<double>(count);
    append(mesh, placed(composed(rotation_about({0, 0, 1}, angle), translation_by({radius, 0, 0})), part));
  }
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

TriangleMesh at(const Vec3& translation, const Vec3& rpy, TriangleMesh mesh) {
  return placed(pose_of_rpy(rpy, translation), std::move(mesh));
}

TriangleMesh rounded_to_float32(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<float>(p[axis]));
  return mesh;
}

TriangleMesh loose_convex_hull(const TriangleMesh& mesh) {
  TriangleMesh hull = convex_hull(mesh);
  const Vec3 middle = bounding_box(hull).center();
  for (Vec3& p : hull.positions) p = middle + (p - middle) * 1.002;
  return hull;
}

}  // namespace prohull::robot
