#include <cmath>
#include <utility>

#include "cover/few_vertices.h"
#include "cover/polytope.h"
#include "enclose/solids.h"
#include "mesh/area.h"
#include "prohull/convex_hull.h"
#include "prohull/distance.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

/// A pyramid around what is flat, high enough that its base is hardly larger: every vertex lies between the apex and a
/// point of the base.
TriangleMesh tent_over(const TriangleMesh& flat, double height) {
  Vec3 across;
  for (const FaceId f : flat.triangles.ids()) {
    const auto [a, b, c] = flat.triangle(f);
    if (const Vec3 n = cross(b - a, c - a); squared_norm(n) > squared_norm(across)) across = n;
  }
  across = across / norm(across);
  const Vec3 middle = cover::middle(flat);
  double low = 0, high = 0;  // above the middle
  for (const Vec3& p : flat.positions) {
    low = std::min(low, dot(across, p - middle));
    high = std::max(high, dot(across, p - middle));
  }
  const Vec3 apex = middle + across * (high + height);
  std::vector<Vec3> corners{apex};
  for (const Vec3& p : flat.positions)
    corners.push_back(apex + (p - apex) * ((high + height - low) / (high + height - dot(across, p - middle))));
  return cover::convex_hull_of(std::move(corners));
}

/// The convex hull has at least this volume: that of corners of faces which are extreme in 26 directions.
double least_convex_volume(const TriangleMesh& mesh) {
  std::vector<Vec3> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double s : {-1.0, 1.0}) {
    for (const Vec3& d : {Vec3{1, s, 0}, {1, 0, s}, {0, 1, s}, {1, s, 1}, {1, s, -1}}) directions.push_back(d);
  }
  std::vector<Vec3> corners(2 * directions.size(), mesh.positions[mesh.triangles[FaceId{0}][0]]);
  for (const auto& triangle : mesh.triangles) {
    const Vec3& p = mesh.positions[triangle[0]];
    for (std::size_t i = 0; i < directions.size(); ++i) {
      Vec3 &lowest = corners[2 * i], &highest = corners[2 * i + 1];
      const double height = dot(directions[i], p);
      if (height < dot(directions[i], lowest)) lowest = p;
      if (height > dot(directions[i], highest)) highest = p;
    }
  }
  return signed_volume(cover::convex_hull_of(std::move(corners)));
}

}  // namespace

std::optional<SolidId> Solids::convex_hull(std::optional<double> too_large) {
  if (convex_hull_ || has_no_convex_hull_) return convex_hull_;
  const TriangleMesh& points = request_.is_padded() ? request_.to_cover() : request_.input.original;
  constexpr double kRounding = 1e-9;
  if (too_large && has_mesh() && least_convex_volume(points) > (1 + kRounding) * *too_large) return std::nullopt;
  TriangleMesh convex = prohull::convex_hull(points);
  if (request_.is_padded()) {
    if (too_large && signed_volume(convex) + request_.aim() * area_of(convex) >= *too_large) return std::nullopt;
    convex = padded_convex_solid(convex.face_count() > 0 ? convex : request_.to_cover());
  }
  std::optional<Solid> solid = Solid{.source = Source::ConvexHull, .mesh = std::move(convex)};
  constexpr double kThin = 1e-7;
  const bool is_thin = signed_volume(solid->mesh) <= kThin * std::pow(request_.diagonal, 3);
  if (solid->mesh.face_count() == 0 || (is_thin && !has_mesh())) solid = slab();
  has_no_convex_hull_ = !solid;
  if (solid) convex_hull_ = add(std::move(*solid));
  return convex_hull_;
}

// As thin as the finest wraps, and nearer. Where the triangles are not convex, wraps follow them better.
std::optional<Solid> Solids::slab() const {
  constexpr double kWidth = 0x1p-12, kNear = 0x1p-10;  // to the diagonal
  const double width = kWidth * request_.diagonal;
  Solid slab{.source = Source::ConvexHull, .mesh = slab_around(request_.to_cover(), width / 2), .slab_width = width};
  if (slab.mesh.face_count() == 0 || distance_bounds(slab.mesh, request_.to_cover()).upper > kNear * request_.diagonal)
    return std::nullopt;
  return slab;
}

// A padded convex hull is one of 96 times as many points: where that takes long, those of a hull of the convex hull.
TriangleMesh Solids::padded_convex_solid(TriangleMesh convex) const {
  constexpr std::size_t kMany = 2000;
  if (convex.face_count() > kMany && inspect(convex).is_closed_manifold())
    convex = build_hull(convex, {.target_faces = kMany}).hull.base();
  return padded_convex_hull(convex, request_.aim());
}

// Where there are very few faces, one of fewer may be smaller.
std::optional<SolidId> Solids::polytope(std::size_t faces) {
  constexpr std::size_t kVeryFew = 12, kFewest = 4;
  const auto convex = convex_hull(std::nullopt);
  if (!convex || entries_[*convex].solid.mesh.face_count() <= faces) return std::nullopt;
  if (const auto known = polytopes_.find(faces); known != polytopes_.end()) return known->second;
  std::optional<SolidId> fewer;
  if (faces <= kVeryFew && faces >= kFewest + 2) fewer = polytope(faces - 2);
  const TriangleMesh& mesh = entries_[*convex].solid.mesh;
  const double width = entries_[*convex].solid.slab_width;
  Solid solid{.source = Source::ConvexHull, .mesh = {}, .slab_width = width};
  try {
    solid.mesh = cover::with_few_vertices(width > 0 ? tent_over(mesh, kTentHeight * width) : mesh, faces / 2 + 2,
                                          request_.options.hull.float32_coordinates);
  } catch (const InputError&) {  // beyond the range of coordinates
    return std::nullopt;
  }
  if (fewer && entries_[*fewer].solid.volume <= signed_volume(solid.mesh)) return polytopes_[faces] = *fewer;
  return polytopes_[faces] = add(std::move(solid));
}

}  // namespace prohull
