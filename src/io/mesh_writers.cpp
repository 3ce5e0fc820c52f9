#include "io/mesh_writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

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
  return std::all_of(mesh.positions.begin(), mesh.positions.end(), float32_stores);
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

Box box_of_all_vertices(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

using OrderedJson = nlohmann::ordered_json;

/// The colours that Okabe and Ito (2008) chose for people with any kind of colour vision, but black; linear light.
constexpr auto kColors = std::to_array<std::array<double, 3>>({{0.791, 0.347, 0.000},
                                                               {0.093, 0.456, 0.815},
                                                               {0.000, 0.342, 0.171},
                                                               {0.871, 0.776, 0.054},
                                                               {0.000, 0.168, 0.445},
                                                               {0.665, 0.112, 0.000},
                                                               {0.604, 0.191, 0.386}});

OrderedJson material(std::size_t i) {
  const auto& [r, g, b] = kColors[i];
  return {{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}, {"metallicFactor", 0}}}};
}

/// glTF 2.0, 3.6 and 3.7: of each mesh positions of float32, then indices of 32 bits.
class GltfJson {
 public:
  void add(const TriangleMesh& mesh, const std::string* name) {
    if (mesh.face_count() == 0) return;
    const std::size_t number = meshes_.size();
    const Box box = box_of_all_vertices(mesh);
    OrderedJson primitive{{"attributes", {{"POSITION", accessors_.size()}}}, {"indices", accessors_.size() + 1}};
    add_accessor(12 * mesh.vertex_count(), 34962,
                 {{"componentType", 5126},
                  {"count", mesh.vertex_count()},
                  {"type", "VEC3"},
                  {"min", {box.min.x, box.min.y, box.min.z}},
                  {"max", {box.max.x, box.max.y, box.max.z}}});
    add_accessor(12 * mesh.face_count(), 34963,
                 {{"componentType", 5125}, {"count", 3 * mesh.face_count()}, {"type", "SCALAR"}});
    if (name) {
      primitive["material"] = number % kColors.size();
      if (materials_.size() < kColors.size()) materials_.push_back(material(number));
    }
    meshes_.push_back({{"primitives", OrderedJson::array({std::move(primitive)})}});
    OrderedJson node{{"mesh", number}};
    if (name) node["name"] = *name, meshes_.back()["name"] = *name;
    nodes_.push_back(std::move(node));
    places_.push_back(number);
  }

  std::string text() const {
    OrderedJson json{{"asset", {{"version", "2.0"}, {"generator", "prohull"}}}, {"scene", 0}};
    json["scenes"] = OrderedJson::array({OrderedJson::object()});
    if (!nodes_.empty()) {
      json["scenes"][0]["nodes"] = places_, json["nodes"] = nodes_, json["meshes"] = meshes_;
      if (!materials_.empty()) json["materials"] = materials_;
      json["accessors"] = accessors_, json["bufferViews"] = views_;
      json["buffers"] = OrderedJson::array({OrderedJson{{"byteLength", bytes_}}});
    }
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  }

 private:
  void add_accessor(std::size_t bytes, int target, const OrderedJson& what) {
    OrderedJson accessor{{"bufferView", views_.size()}};
    accessor.update(what);
    accessors_.push_back(std::move(accessor));
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", bytes}, {"target", target}});
    bytes_ += bytes;
  }

  OrderedJson nodes_ = OrderedJson::array(), places_ = nodes_, meshes_ = nodes_, materials_ = nodes_,
              accessors_ = nodes_, views_ = nodes_;
  std::size_t bytes_ = 0;
};

std::string gltf_json(std::span<const TriangleMesh> meshes, std::span<const std::string> names) {
  GltfJson json;
  for (std::size_t i = 0; i < meshes.size(); ++i) json.add(meshes[i], names.empty() ? nullptr : &names[i]);
  return json.text();
}

std::size_t glb_bytes(const TriangleMesh& mesh) {
  return mesh.face_count() == 0 ? 0 : 12 * (mesh.vertex_count() + mesh.face_count());
}

void append_glb(std::string& out, const TriangleMesh& mesh) {
  for (const Vec3& p : mesh.positions) append_vector<float>(out, p);
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) append_bytes(out, index(v));
}

/// Readers end a name at a line's end, some at a blank; # begins a comment, and \\ continues a line.
std::string obj_name(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f' || c == '#' || c == '\\') c = '_';
  return name;
}

void append_obj(std::string& out, const TriangleMesh& mesh, std::uint64_t vertices_before) {
  for (const Vec3& p : mesh.positions) append_line(out += "v ", p);
  for (const auto& t : mesh.triangles) {
    out += 'f';
    for (const VertexId v : t) append_number(out += ' ', vertices_before + index(v) + 1);
    out += '\n';
  }
}

}  // namespace

bool float32_stores(const Vec3& p) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest <= std::numeric_limits<float>::max() && is_float32(p);
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
  append_obj(out, mesh, 0);
  return out;
}

std::string obj_content(std::span<const TriangleMesh> meshes, std::span<const std::string> names) {
  std::string out = "# prohull\n";
  std::uint64_t vertices = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    out += "o " + obj_name(names[i]) + "\n";
    append_obj(out, meshes[i], vertices);
    vertices += meshes[i].vertex_count();
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

std::uint64_t glb_size(std::span<const TriangleMesh> meshes, std::span<const std::string> names) {
  constexpr std::uint64_t kOverhead = 2048;  // headers and JSON, of which all but some numbers is fixed
  std::uint64_t size = kOverhead;
  for (const TriangleMesh& mesh : meshes) size += kOverhead + glb_bytes(mesh);
  for (const std::string& name : names) size += 2 * 6 * name.size();  // twice, and a byte may become \u0000
  return size;
}

std::string glb_content(const TriangleMesh& mesh) { return glb_content({&mesh, 1}, {}); }

/// glTF 2.0, 4.4: a header, a chunk of JSON and one of bytes.
std::string glb_content(std::span<const TriangleMesh> meshes, std::span<const std::string> names) {
  constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8, kAlignment = 4;
  std::string json = gltf_json(meshes, names);
  json.resize((json.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  std::size_t binary_size = 0;
  for (const TriangleMesh& mesh : meshes) binary_size += glb_bytes(mesh);
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
  for (const TriangleMesh& mesh : meshes)
    if (mesh.face_count() > 0) append_glb(out, mesh);
  return out;
}

}  // namespace prohull
