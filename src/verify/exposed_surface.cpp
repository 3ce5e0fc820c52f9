#include "verify/exposed_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/bvh.h"

namespace prohull::verify {
namespace {

using Polygon = std::vector<Vec3>;

/// The points with dot(normal, p) <= offset are inside.
struct Plane {
  Vec3 normal;
  double offset;
  double height(const Vec3& p) const { return dot(normal, p) - offset; }
};

struct Frame {
  Vec3 origin;
  double size;  ///< what has this length, has the length 1 in the frame
};

/// A piece in a frame in which all pieces together have about the size 1.
struct ConvexPiece {
  std::vector<Triangle> faces;
  std::vector<Plane> planes;  ///< of faces; the whole piece is inside, also where rounded normals of slivers are wrong
  Box box;
};

Frame frame_of(const Box& box) { return {box.center(), std::max(box.diagonal(), std::numeric_limits<double>::min())}; }

/// As numbers in [1e-9, 2e-9) that no simple ratio connects.
double growth(std::size_t piece) {
  const double golden = static_cast<double>(piece) * 0.6180339887498949;
  return 1e-9 * (1 + golden - std::floor(golden));
}

/// Of many faces, only some are asked.
Plane supporting_plane(const Triangle& t, const Vec3& normal, const std::vector<Triangle>& faces) {
  constexpr std::size_t kMany = 2000;
  Plane plane{normal, dot(normal, t.a)};
  for (std::size_t f = 0; f < faces.size(); f += 1 + faces.size() / kMany)
    for (const Vec3& p : {faces[f].a, faces[f].b, faces[f].c}) plane.offset = std::max(plane.offset, dot(normal, p));
  return plane;
}

/// Inside of a convex mesh, which the middle of its box need not be.
Vec3 middle_of(const TriangleMesh& mesh) {
  const Vec3 origin = bounding_box(mesh).center();
  Vec3 sum;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    sum += (t.a - origin) + (t.b - origin) + (t.c - origin);
  }
  return origin + sum / (3 * double(mesh.face_count()));
}

/// Larger by a little: then faces of two pieces in nearly one plane are apart.
ConvexPiece convex_piece(const TriangleMesh& mesh, const Frame& frame, double grown) {
  ConvexPiece piece;
  const Vec3 center = middle_of(mesh);
  const auto placed = [&](const Vec3& p) { return (center - frame.origin + (p - center) * (1 + grown)) / frame.size; };
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    piece.faces.push_back({placed(t.a), placed(t.b), placed(t.c)});
    piece.box.extend(box_of(piece.faces.back()));
  }
  for (const Triangle& t : piece.faces) {
    const Vec3 n = cross(t.b - t.a, t.c - t.a);
    if (const double length = norm(n); length > 0) piece.planes.push_back(supporting_plane(t, n / length, piece.faces));
  }
  // Faces that are so small that they have no normal bound the piece, too; its box does it instead.
  if (piece.planes.size() < piece.faces.size())
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      piece.planes.push_back({axis, dot(axis, piece.box.max)});
      piece.planes.push_back({-axis, dot(-axis, piece.box.min)});
    }
  return piece;
}

/// The parts of a convex polygon outside and inside of a plane.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Plane& plane) {
  std::pair<Polygon, Polygon> parts;
  auto& [outside, inside] = parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double here = plane.height(p), next = plane.height(q);
    (here > 0 ? outside : inside).push_back(p);
    if ((here > 0) == (next > 0)) continue;
    const Vec3 x = p + (q - p) * (here / (here - next));
    outside.push_back(x);
    inside.push_back(x);
  }
  return parts;
}

/// Adds the parts of the polygon that lie outside of the piece.
void add_outside(const Polygon& polygon, const ConvexPiece& piece, std::vector<Polygon>& result) {
  const std::size_t before = result.size();
  Polygon rest = polygon;
  for (const Plane& plane : piece.planes) {
    const auto is_outside = [&](const Vec3& p) { return plane.height(p) > 0; };
    if (std::ranges::none_of(rest, is_outside)) continue;  // most planes
    if (std::ranges::all_of(rest, is_outside)) {
      result.resize(before);
      result.push_back(polygon);
      return;
    }
    auto [outside, inside] = split(rest, plane);
    result.push_back(std::move(outside));
    rest = std::move(inside);
  }
}

Box box_of(const Polygon& polygon) {
  Box box;
  for (const Vec3& p : polygon) box.extend(p);
  return box;
}

std::vector<Polygon> without(const std::vector<Polygon>& polygons, const ConvexPiece& piece) {
  std::vector<Polygon> result;
  for (const Polygon& polygon : polygons) {
    if (box_of(polygon).overlaps(piece.box))
      add_outside(polygon, piece, result);
    else
      result.push_back(polygon);
  }
  return result;
}

void add(TriangleMesh& mesh, const Polygon& polygon) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    std::array<VertexId, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = mesh.positions.push_back(polygon[k == 0 ? 0 : i - 2 + std::size_t(k)]);
    mesh.triangles.push_back(corners);
  }
}

Frame frame_of(std::span<const TriangleMesh> meshes) {
  Box box;
  for (const TriangleMesh& mesh : meshes) box.extend(bounding_box(mesh));
  return frame_of(box);
}

TriangleMesh surface_in(const Frame& frame, std::span<const TriangleMesh> meshes) {
  std::vector<ConvexPiece> pieces;
  for (const TriangleMesh& mesh : meshes) pieces.push_back(convex_piece(mesh, frame, growth(pieces.size())));
  TriangleMesh surface;
  for (const ConvexPiece& piece : pieces)
    for (const Triangle& t : piece.faces) {
      std::vector<Polygon> exposed{{t.a, t.b, t.c}};
      for (const ConvexPiece& other : pieces)
        if (&other != &piece && other.box.overlaps(prohull::box_of(t))) exposed = without(exposed, other);
      for (const Polygon& polygon : exposed) add(surface, polygon);
    }
  return surface;
}

}  // namespace

TriangleMesh exposed_surface(std::span<const TriangleMesh> meshes) {
  const Frame frame = frame_of(meshes);
  TriangleMesh surface = surface_in(frame, meshes);
  for (Vec3& p : surface.positions) p = frame.origin + p * frame.size;
  return surface;
}

double exposed_volume(std::span<const TriangleMesh> meshes) {
  const Frame frame = frame_of(meshes);
  return signed_volume(surface_in(frame, meshes)) * frame.size * frame.size * frame.size;
}

bool is_about_convex(const TriangleMesh& mesh) {
  constexpr double kRounding = 1e-6;  // of the volume; files with six digits pass
  const Frame frame = frame_of(bounding_box(mesh));
  std::vector<Triangle> faces;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    faces.push_back(
        {(t.a - frame.origin) / frame.size, (t.b - frame.origin) / frame.size, (t.c - frame.origin) / frame.size});
  }
  double room = kRounding * std::abs(signed_volume(mesh)) / (frame.size * frame.size * frame.size);
  for (const Triangle& t : faces) {
    const Vec3 n = cross(t.b - t.a, t.c - t.a);
    const double area = norm(n) / 2;
    if (area > 0) room += area * supporting_plane(t, n / (2 * area), faces).height(t.a);
    if (room < 0) return false;
  }
  return true;
}

}  // namespace prohull::verify
