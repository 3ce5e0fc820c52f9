#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>

#include "io/byte_cursor.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"

namespace prohull {
namespace {

// MuJoCo's MSH: numbers of vertices, normals, texture coordinates and faces, and then these.
constexpr std::size_t kMshHeader = 16, kMshVector = 12, kMshTexture = 8;

struct MshCounts {
  std::size_t vertices, normals, textures, faces;
};

MshCounts read_msh_counts(std::string_view content, const std::string& file) {
  if (content.starts_with("$MeshFormat"))
    fail(file, {Place::Unit::Line, 1}, "an MSH file of Gmsh, which is not read; MSH files of MuJoCo are");
  if (content.size() < kMshHeader)
    fail(file, {Place::Unit::Byte, content.size()}, "the file ends within its header of 16 bytes");
  ByteCursor cursor(content, 0);
  std::array<std::size_t, 4> counts{};
  for (std::size_t& count : counts) {
    const Place place = cursor.place();
    const auto said = cursor.read<std::int32_t>();
    if (said < 0) fail(file, place, "a number of the header is negative");
    count = static_cast<std::size_t>(said);
  }
  return {counts[0], counts[1], counts[2], counts[3]};
}

}  // namespace

TriangleMesh read_msh(std::string_view content, const std::string& file, const ReadOptions& options) {
  const MshCounts counts = read_msh_counts(content, file);
  const std::size_t skipped = kMshVector * counts.normals + kMshTexture * counts.textures;
  const std::size_t size = kMshHeader + kMshVector * (counts.vertices + counts.faces) + skipped;
  if (content.size() != size)
    fail(file, {Place::Unit::Byte, content.size()},
         fmt::format("the file has {} bytes, and {} by the numbers of its header", content.size(), size));
  MeshBuilder builder(file, 0, content, options);
  builder.reserve_vertices(counts.vertices);
  builder.reserve_triangles(counts.faces);
  ByteCursor cursor(content, kMshHeader);
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    const Place place = cursor.place();
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = cursor.read<float>();
    builder.add_vertex(position, place);
  }
  cursor.skip(skipped);
  for (std::size_t i = 0; i < counts.faces; ++i) {
    const Place place = cursor.place();
    std::array<std::int64_t, 3> corners{};
    for (std::int64_t& corner : corners) corner = cursor.read<std::int32_t>();
    builder.add_polygon(corners, place);
  }
  return builder.finish();
}

}  // namespace prohull
