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

std::string decimals(const Vec3& p) {
  std::string out;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) out += ',';
    append_number(out, p[axis]);
  }
  return out;
}

Box box_of_all_vertices(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

/// glTF 2.0, 3.6 and 3.7: indices of 32 bits behind positions of float32.
std::string gltf_json(const TriangleMesh& mesh) {
  constexpr std::string_view kAsset = R"("asset":{"version":"2.0","generator":"prohull"},"scene":0)";
  if (mesh.face_count() == 0) return fmt::format(R"({{{},"scenes":[{{}}]}})", kAsset);
  const Box box = box_of_all_vertices(mesh);
  const std::size_t vertex_bytes = 12 * mesh.vertex_count(), face_bytes = 12 * mesh.face_count();
  return fmt::format(
      R"({{{},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[{}],"max":[{}]}},)"
      R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{},"target":34962}},)"
      R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}}],"buffers":[{{"byteLength":{}}}]}})",
      kAsset, mesh.vertex_count(), decimals(box.min), decimals(box.max), 3 * mesh.face_count(), vertex_bytes,
      vertex_bytes, face_bytes, vertex_bytes + face_bytes);
}

constexpr std::size_t kGlbOverhead = 2048;  // headers and JSON, of which all but 13 numbers is fixed

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

std::uint64_t glb_size(const TriangleMesh& mesh) {
  return kGlbOverhead + std::uint64_t{12} * mesh.vertex_count() + std::uint64_t{12} * mesh.face_count();
}

/// glTF 2.0, 4.4: a header, a chunk of JSON and one of bytes.
std::string glb_content(const TriangleMesh& mesh) {
  constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8, kAlignment = 4;
  std::string json = gltf_json(mesh);
  json.resize((json.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  const std::size_t binary_size = mesh.face_count() == 0 ? 0 : 12 * (mesh.vertex_count() + mesh.face_count());
  const std::size_t size =
      kHeaderSize + kChunkHeaderSize + json.size() + (binary_size == 0 ? 0 : kChunkHeaderSize + binary_size);
  std::string out = "glTF";
  out.reserve(size);
  append_bytes(out, std::uint32_t{2});
  append_bytes(out, static_cast<std::uint32_t>(size));
  append_bytes(out, static_cast<std::uint32_t>(json.size()));
  (out += "JSON") += json;
  if (binary_size == 0) return out;
  append_bytes(out, static_cast<std::uint32_t>(binary_size));
  out += std::string_view("BIN\0", 4);
  for (const Vec3& p : mesh.positions) append_vector<float>(out, p);
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) append_bytes(out, index(v));
  return out;
}

}  // namespace prohull
