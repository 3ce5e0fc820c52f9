#include "io/mesh_writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/float32.h"
#include "io/append.h"

namespace prohull {
namespace {

void append_line(std::string& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) out += ' ';
    append_number(out, p[axis]);
  }
  out += '\n';
}

bool all_float32(const TriangleMesh& mesh) {
  return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                     [](const Vec3& p) { return is_float32(p.x) && is_float32(p.y) && is_float32(p.z); });
}

template <class Real>
void append_vector(std::string& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) append_bytes(out, static_cast<Real>(p[axis]));
}

/// Of length 1, or 0 for a triangle without area. Scaled, so that nothing overflows.
Vec3 unit_normal(const Triangle& t) {
  const auto largest = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const Vec3 ab = t.b - t.a, ac = t.c - t.a;
  if (largest(ab) == 0 || largest(ac) == 0) return {};
  const Vec3 normal = cross(ab / largest(ab), ac / largest(ac));
  return largest(normal) == 0 ? Vec3{} : normal / norm(normal);
}

}  // namespace

bool is_float32(double value) {
  return std::abs(value) <= std::numeric_limits<float>::max() && nearest_float32(value) == value;
}

std::string ply_content(const TriangleMesh& mesh) {
  const bool floats = all_float32(mesh);
  const bool signed_indices = mesh.vertex_count() <= std::size_t{std::numeric_limits<std::int32_t>::max()};
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment prohull\n"
      "element vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n"
      "element face {2}\nproperty list uchar {3} vertex_indices\nend_header\n",
      mesh.vertex_count(), floats ? "float" : "double", mesh.face_count(), signed_indices ? "int" : "uint");
  out.reserve(out.size() + mesh.vertex_count() * (floats ? 12 : 24) + mesh.face_count() * 13);
  for (const Vec3& p : mesh.positions) floats ? append_vector<float>(out, p) : append_vector<double>(out, p);
  for (const auto& t : mesh.triangles) {
    append_bytes(out, std::uint8_t{3});
    for (const VertexId v : t) append_bytes(out, index(v));
  }
  return out;
}

std::string obj_content(const TriangleMesh& mesh) {
  std::string out = "# prohull\n";
  for (const Vec3& p : mesh.positions) append_line(out += "v ", p);
  for (const auto& t : mesh.triangles) {
    out += 'f';
    for (const VertexId v : t) append_number(out += ' ', std::uint64_t{index(v)} + 1);
    out += '\n';
  }
  return out;
}

std::string off_content(const TriangleMesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
  for (const Vec3& p : mesh.positions) append_line(out, p);
  for (const auto& t : mesh.triangles) {
    out += '3';
    for (const VertexId v : t) append_number(out += ' ', index(v));
    out += '\n';
  }
  return out;
}

std::string stl_content(const TriangleMesh& mesh) {
  constexpr std::size_t kHeaderSize = 80, kTriangleSize = 50;
  std::string out = "prohull";
  out.resize(kHeaderSize, ' ');
  out.reserve(kHeaderSize + 4 + kTriangleSize * mesh.face_count());
  append_bytes(out, static_cast<std::uint32_t>(mesh.face_count()));
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    for (const Vec3& v : {unit_normal(t), t.a, t.b, t.c}) append_vector<float>(out, v);
    append_bytes(out, std::uint16_t{0});
  }
  return out;
}

}  // namespace prohull
