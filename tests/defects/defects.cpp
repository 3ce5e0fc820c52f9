#include "defects/defects.h"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <string_view>
#include <utility>

#include "meshes.h"

namespace prohull::meshes {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string off(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
  for (const Vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", index(a), index(b), index(c));
  return text;
}

void append_little_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(mesh.face_count()));
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    for (const Vec3& p : {Vec3{0, 0, 0}, t.a, t.b, t.c})
      for (const double x : {p.x, p.y, p.z}) append_little_endian(bytes, std::bit_cast<std::uint32_t>(float(x)));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

TriangleMesh ball() { return sphere(3); }

/// The faces of which `keep(center, number)`.
template <class Keep>
TriangleMesh with_faces(const TriangleMesh& mesh, Keep keep) {
  TriangleMesh result;
  result.positions = mesh.positions;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    if (keep((t.a + t.b + t.c) * (1.0 / 3), index(f))) result.triangles.push_back(mesh.triangles[f]);
  }
  return result;
}

TriangleMesh with_every_tenth_face_turned(TriangleMesh mesh) {
  for (FaceId f{0}; index(f) < mesh.face_count(); f = FaceId(index(f) + 10))
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  return mesh;
}

TriangleMesh with_every_tenth_face_twice(TriangleMesh mesh) {
  const std::size_t faces = mesh.face_count();
  for (FaceId f{0}; index(f) < faces; f = FaceId(index(f) + 10)) mesh.triangles.push_back(mesh.triangles[f]);
  return mesh;
}

TriangleMesh with_first_vertex(TriangleMesh mesh, const Vec3& p) {
  mesh.positions[VertexId(0)] = p;
  return mesh;
}

/// A tetrahedron whose edge 0-1 has vertex 4 on it, of which the face beside it, (0, 1, 3), knows nothing.
TriangleMesh t_junction() {
  return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}},
              {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

/// The same, closed by a face on a line.
TriangleMesh with_face_without_area() {
  TriangleMesh mesh = t_junction();
  mesh.triangles.push_back({VertexId(1), VertexId(0), VertexId(4)});
  return mesh;
}

/// Every face in three, around a vertex that is 10^-9 of the edges from a corner.
TriangleMesh needles() {
  const TriangleMesh coarse = bipyramid(12);
  TriangleMesh mesh;
  mesh.positions = coarse.positions;
  for (const auto& [a, b, c] : coarse.triangles) {
    const Vec3 &p = coarse.positions[a], &q = coarse.positions[b], &r = coarse.positions[c];
    const VertexId middle = mesh.positions.push_back(p + ((q - p) + (r - p)) * 1e-9);
    mesh.triangles.push_back({a, b, middle});
    mesh.triangles.push_back({b, c, middle});
    mesh.triangles.push_back({c, a, middle});
  }
  return mesh;
}

TriangleMesh two_tetrahedra_at_a_vertex() {
  return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {5, 6, 0}});
}

TriangleMesh two_tetrahedra_at_an_edge() {
  return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 3}, {4, 5, 3}, {5, 0, 3}});
}

TriangleMesh two_sided_sheet() {
  TriangleMesh sheet = make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  sheet.triangles.push_back({VertexId(0), VertexId(2), VertexId(1)});
  sheet.triangles.push_back({VertexId(0), VertexId(3), VertexId(2)});
  return sheet;
}

}  // namespace

std::vector<DefectiveFile> defective_files() {
  const TriangleMesh beside = moved(ball(), {3, 0, 0});
  const auto is_above = [](const Vec3& center, std::size_t) { return center.z > 0; };
  const auto is_no_hole = [](const Vec3&, std::size_t face) { return face % 50 > 2; };
  const std::string soup = binary_stl(ball());
  return {
      {"sound.off", off(ball())},
      {"soup.stl", soup},
      {"inside_out.off", off(inside_out(ball()))},
      {"flipped_faces.off", off(with_every_tenth_face_turned(ball()))},
      {"flipped_component.off", off(together(ball(), inside_out(beside)))},
      {"holes.off", off(with_faces(ball(), is_no_hole))},
      {"open_shell.off", off(with_faces(ball(), is_above))},
      {"single_triangle.off", off(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}))},
      {"two_sided_sheet.off", off(two_sided_sheet())},
      {"non_manifold_vertex.off", off(two_tetrahedra_at_a_vertex())},
      {"non_manifold_edge.off", off(two_tetrahedra_at_an_edge())},
      {"duplicated_faces.off", off(with_every_tenth_face_twice(ball()))},
      {"zero_area.off", off(with_face_without_area())},
      {"needles.off", off(needles())},
      {"t_junction.off", off(t_junction())},
      {"self_intersecting.off", off(with_first_vertex(ball(), ball().positions[VertexId(0)] * -2.0))},
      {"overlapping_components.off", off(together(ball(), moved(ball(), {0.5, 0.25, 0.125})))},
      {"nested_components.off", off(together(ball(), scaled(ball(), 0.5)))},
      {"cavity.off", off(together(ball(), inside_out(scaled(ball(), 0.5))))},
      {"touching_components.off", off(together(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})))},
      {"disjoint_components.off", off(together(ball(), beside))},
      {"nan.off", off(with_first_vertex(ball(), {kNaN, 0, 1}))},
      {"nan.stl", binary_stl(with_first_vertex(ball(), {kNaN, 0, 1}))},
      {"infinity.off", off(with_first_vertex(ball(), {0, kInfinity, 0}))},
      {"infinity.stl", binary_stl(with_first_vertex(ball(), {0, kInfinity, 0}))},
      {"huge_offset.off", off(moved(ball(), {1e9, -1e9, 1e9}))},
      {"huge_offset.stl", binary_stl(moved(ball(), {1e6, -1e6, 1e6}))},
      {"tiny_scale.off", off(scaled(ball(), 1e-30))},
      {"huge_scale.off", off(scaled(ball(), 1e30))},
      {"index_out_of_range.off", off(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}))},
      {"truncated.stl", soup.substr(0, soup.size() / 2)},
      {"truncated.off", off(ball()).substr(0, 5000)},
      {"empty.ply", ""},
      {"points_only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"},
      {"nul_filled.stl", std::string(5000, '\0')},
      {"nul_filled.ply", std::string(5000, '\0')},
      {"wrong_extension.stl", off(ball())},
      {"wrong_extension.off", soup},
  };
}

}  // namespace prohull::meshes
