#include "render/normals.h"

#include <vector>

namespace prohull::render {
namespace {

Vec3 normalized(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? v / length : Vec3{};
}

/// The corners at each vertex, one after another: those of v are corners[first[v]] to corners[first[v + 1] - 1].
struct Corners {
  explicit Corners(const TriangleMesh& mesh) : first(mesh.vertex_count() + 1), corners(3 * mesh.face_count()) {
    for (const auto& triangle : mesh.triangles)
      for (const VertexId v : triangle) ++first[index(v) + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (const FaceId f : mesh.triangles.ids())
      for (std::uint32_t k = 0; k < 3; ++k) corners[next[index(mesh.triangles[f][k])]++] = 3 * index(f) + k;
  }
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> corners;  // 3 face + corner
};

/// The face's normal, as long as its angle at corner k.
Vec3 weighted_normal(const TriangleMesh& mesh, FaceId f, std::uint32_t k) {
  const auto& triangle = mesh.triangles[f];
  const Vec3& apex = mesh.positions[triangle[k]];
  const Vec3 one = mesh.positions[triangle[(k + 1) % 3]] - apex, other = mesh.positions[triangle[(k + 2) % 3]] - apex;
  const Vec3 normal = cross(one, other);
  return normalized(normal) * std::atan2(norm(normal), dot(one, other));
}

}  // namespace

Vec3 face_normal(const Triangle& triangle) {
  return normalized(cross(triangle.b - triangle.a, triangle.c - triangle.a));
}

CornerNormals corner_normals(const TriangleMesh& mesh, double crease_angle) {
  const double least_cosine = std::cos(crease_angle);
  const Corners around(mesh);
  PerFace<Vec3> face_normals(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) face_normals[f] = face_normal(mesh.triangle(f));

  CornerNormals normals(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids())
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = index(mesh.triangles[f][k]);
      Vec3 sum;
      for (std::size_t i = around.first[v]; i < around.first[v + 1]; ++i) {
        const FaceId other{around.corners[i] / 3};
        if (other == f || dot(face_normals[f], face_normals[other]) >= least_cosine)
          sum += weighted_normal(mesh, other, around.corners[i] % 3);
      }
      normals[f][k] = normalized(sum);
    }
  return normals;
}

Vec3 interpolated_normal(const Triangle& t, const std::array<Vec3, 3>& corners, const Vec3& point) {
  const Vec3 normal = cross(t.b - t.a, t.c - t.a);
  const double a = dot(cross(t.c - t.b, point - t.b), normal), b = dot(cross(t.a - t.c, point - t.c), normal);
  return normalized(a * corners[0] + b * corners[1] + (dot(normal, normal) - a - b) * corners[2]);
}

}  // namespace prohull::render
