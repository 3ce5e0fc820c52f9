#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "prohull/progressive_hull.h"

namespace prohull::render {

/// Throws InputError, with the name of the file, for a mesh without faces or with coordinates that are not finite.
void require_drawable(const TriangleMesh& mesh, const std::filesystem::path& path);

/// The meshes of a picture. Each file is read once, whatever is drawn of it. Throws InputError for files that cannot be
/// read or drawn.
class MeshTable {
 public:
  static constexpr std::size_t kFinest = ~std::size_t{0};

  /// What reads a file; throws InputError.
  using Reader = std::function<std::variant<TriangleMesh, ProgressiveHull>(const std::filesystem::path&)>;
  explicit MeshTable(Reader read_file) : read_file_(std::move(read_file)) {}

  bool is_hull(const std::filesystem::path& path);
  /// The hull in a .phull file.
  const ProgressiveHull& hull(const std::filesystem::path& path);

  /// A mesh file, or the finest level of at most `faces` faces of a .phull file; returns its place in meshes().
  std::size_t add(const std::filesystem::path& path, std::size_t faces);
  /// A mesh that comes from no file.
  std::size_t add(TriangleMesh mesh);

  const std::vector<TriangleMesh>& meshes() const { return meshes_; }

 private:
  void read(const std::filesystem::path& path);

  Reader read_file_;
  std::map<std::filesystem::path, ProgressiveHull> hulls_;
  std::map<std::pair<std::filesystem::path, std::size_t>, std::size_t> places_;
  std::vector<TriangleMesh> meshes_;
};

}  // namespace prohull::render
