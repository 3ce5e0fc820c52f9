#include "certificate/finite_original.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "geometry/orientation.h"
#include "mesh/closed.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/finite.h"
#include "prohull/enclosure.h"
#include "verify/surface.h"

namespace prohull::certificate {
namespace {

constexpr std::string_view kMagic("\x89PHCER\r\n", 8);
constexpr std::uint64_t kVersion = 1;

/// Groups of faces that common edges connect.
std::vector<std::vector<FaceId>> components(const TriangleMesh& mesh, const std::vector<FaceId>& faces) {
  const std::vector<std::uint32_t> number = numbered_by_position(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first_at;
  DisjointSets clusters(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const auto& corners = mesh.triangles[faces[i]];
    for (int c = 0; c < 3; ++c) {
      const auto ends = std::minmax(number[index(corners[c])], number[index(corners[(c + 1) % 3])]);
      const auto [at, is_new] = first_at.try_emplace(ends, i);
      if (!is_new) clusters.join(at->second, i);
    }
  }
  std::map<std::uint32_t, std::vector<FaceId>> groups;
  for (std::uint32_t i = 0; i < faces.size(); ++i) groups[clusters.find(i)].push_back(faces[i]);
  std::vector<std::vector<FaceId>> result;
  for (auto& [first, group] : groups) result.push_back(std::move(group));
  return result;
}

/// Checkers divide a polygon into the fan of its first corner.
void add_faces(const CertifiedOriginal& original, const FiniteOriginal& finite, File& file) {
  if (original.divided.empty()) return;
  file.section(Section::Faces);
  file.number(original.divided.size());
  std::uint32_t seen = 0, first = 0;  // triangles of the file before the polygon, and how many of them are finite
  for (const DividedFace& face : original.divided) {
    for (; seen < index(face.first_triangle); ++seen)
      first += std::ranges::all_of(original.mesh.triangles[FaceId(seen)],
                                   [&](VertexId v) { return is_finite(original.mesh.positions[v]); });
    file.number(first);
    const bool is_turned =
        finite.is_closed && finite.turned.triangles[FaceId(first)] != finite.triangles.triangles[FaceId(first)];
    const auto& triangles = is_turned ? finite.turned.triangles : finite.triangles.triangles;
    for (std::uint32_t i = 0; i + 2 < face.corners.size(); ++i)
      for (const VertexId v : triangles[FaceId(first + i)]) {
        const auto corner = static_cast<std::uint64_t>(std::ranges::find(face.corners, v) - face.corners.begin());
        const std::uint64_t second = is_turned ? 2 : 1, third = is_turned ? 1 : 2;
        file.number(corner == 0 ? 0 : corner == 1 ? second : 3 * (corner - 2) + third);
      }
  }
}

}  // namespace

FiniteOriginal::FiniteOriginal(const TriangleMesh& mesh)
    : triangles(with_finite_faces(mesh)), is_closed(prohull::is_closed(triangles)) {
  if (!is_closed) return;
  turned = turned_outwards(triangles);
  std::vector<FaceId> faces;
  for (const FaceId f : turned.triangles.ids())
    if (turned.triangles[f] != triangles.triangles[f]) faces.push_back(f);
  if (faces.empty()) return;
  const bool are_all = faces.size() == turned.face_count();  // inside out as a whole, with its cavities
  for (const std::vector<FaceId>& component : components(triangles, faces)) {
    std::vector<Triangle> corners;
    for (const FaceId f : component) corners.push_back(triangles.triangle(f));
    if (are_all || volume_sign(corners) < 0)
      turned_components.push_back(index(component.front()));
    else  // which no checker turns
      for (const FaceId f : component) turned.triangles[f] = triangles.triangles[f];
  }
}

File header(HullSide side, const CertifiedOriginal& original, std::size_t hull_triangles,
            const FiniteOriginal& finite) {
  File file;
  file.add(kMagic);
  file.number(kVersion);
  file.number(side == HullSide::Outer ? 0 : 1);
  file.real(original.scale);
  file.number(hull_triangles);
  file.number(finite.triangles.face_count());
  file.number(finite.turned_components.size());
  for (const std::uint32_t f : finite.turned_components) file.number(f);
  add_faces(original, finite, file);
  return file;
}

}  // namespace prohull::certificate
