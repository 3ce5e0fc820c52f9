#include "render/mesh_table.h"

#include <fmt/format.h>

#include "prohull/error.h"

namespace prohull::render {

void require_drawable(const TriangleMesh& mesh, const std::filesystem::path& path) {
  if (mesh.triangles.empty()) throw InputError(Defect::EmptyMesh, path.string() + ": there are no faces to draw");
  for (const auto& triangle : mesh.triangles)
    for (const VertexId v : triangle)
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate,
                         fmt::format("{}: vertex {} has a coordinate that is not finite", path.string(), index(v)));
}

bool MeshTable::is_hull(const std::filesystem::path& path) {
  read(path);
  return hulls_.contains(path);
}

const ProgressiveHull& MeshTable::hull(const std::filesystem::path& path) {
  read(path);
  return hulls_.at(path);
}

std::size_t MeshTable::add(const std::filesystem::path& path, std::size_t faces) {
  const std::pair key{path, is_hull(path) ? faces : kFinest};
  if (const auto known = places_.find(key); known != places_.end()) return known->second;
  return places_[key] = add(hull(path).level(faces));
}

std::size_t MeshTable::add(TriangleMesh mesh) {
  meshes_.push_back(std::move(mesh));
  return meshes_.size() - 1;
}

void MeshTable::read(const std::filesystem::path& path) {
  if (hulls_.contains(path) || places_.contains({path, kFinest})) return;
  auto content = read_file_(path);
  if (auto* const hull = std::get_if<ProgressiveHull>(&content)) {
    hulls_.emplace(path, std::move(*hull));
  } else {
    TriangleMesh& mesh = std::get<TriangleMesh>(content);
    require_drawable(mesh, path);
    places_[{path, kFinest}] = add(std::move(mesh));
  }
}

}  // namespace prohull::render
