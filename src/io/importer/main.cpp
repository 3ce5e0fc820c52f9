// prohull-import: reads a file with assimp and writes its polygons (io/import_protocol.h), all meshes of the scene at
// all places, in a process of its own that limits itself.

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "io/affine.h"
#include "io/import_protocol.h"
#include "io/vertex_welder.h"

namespace prohull {
namespace {

constexpr bool kSanitized =
#if defined(__SANITIZE_ADDRESS__)
    true;
#elif defined(__has_feature)
    __has_feature(address_sanitizer);
#else
    false;
#endif

/// Without the destructors of libraries that a damaged file may have confused, and without the leak check of
/// sanitizers.
[[noreturn]] void leave(int exit_code) {
  if (std::fflush(stdout) != 0) exit_code = EXIT_FAILURE;
  _exit(exit_code);
}

void limit(int resource, rlim_t most) {
  rlimit limits{};
  getrlimit(resource, &limits);
  limits.rlim_cur = std::min(most, limits.rlim_cur);
  setrlimit(resource, &limits);
}

/// The address sanitizer reserves more address space than there is memory: it goes without that limit.
void limit_resources(rlim_t seconds, rlim_t bytes) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  if (bytes > 0 && !kSanitized) limit(RLIMIT_AS, bytes);
  std::set_new_handler([] { _exit(kImportOutOfMemory); });
}

std::string all_of_stdin() {
  std::string content;
  constexpr std::size_t kChunk = std::size_t{1} << 18;
  std::size_t size = 0;
  do {
    content.resize(std::max(size + kChunk, 2 * size));
    size += std::fread(content.data() + size, 1, content.size() - size, stdin);
  } while (size == content.size());
  content.resize(size);
  return content;
}

/// The main file is in memory; of others only regular files are opened, for a pipe or a device may have no end. If it
/// has to stand alone, one that asks for another file is refused.
class FileSystem : public Assimp::DefaultIOSystem {
 public:
  FileSystem(const std::string& name, const std::string& content, bool alone)
      : name_(name), content_(content), alone_(alone) {}

  bool Exists(const char* path) const override { return path == name_ || may_read(path); }

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (path == name_)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()), content_.size());
    return may_read(path) ? Assimp::DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  /// Another file. Does not return where there may be none.
  bool may_read(const char* path) const {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    if (!alone_) return true;
    std::printf("it has data in %s, which --no-outside-files refuses", path);
    leave(kImportRefused);
  }

  const std::string& name_;
  const std::string& content_;
  const bool alone_;
};

Affine affine(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

template <class T>
void write(const T* values, std::size_t count) {
  std::fwrite(values, sizeof(T), count, stdout);
}

/// All polygons of a scene. Corners of a node at equal positions become one vertex: assimp gives each face vertices of
/// its own.
class Polygons {
 public:
  explicit Polygons(const aiScene& scene) : scene_(scene) {
    struct PlacedNode {
      const aiNode* node;
      Affine place;  ///< of the parent
    };
    std::vector<PlacedNode> left = {{scene.mRootNode, {}}};
    while (!left.empty()) {
      const PlacedNode placed = left.back();
      left.pop_back();
      const Affine place = placed.place * affine(placed.node->mTransformation);
      add(*placed.node, place);
      for (unsigned i = placed.node->mNumChildren; i > 0; --i) left.push_back({placed.node->mChildren[i - 1], place});
    }
  }

  void write_all() const {
    const std::array<std::uint64_t, 2> counts = {positions_.size(), polygon_count_};
    write(kImportMagic.data(), kImportMagic.size());
    write(counts.data(), counts.size());
    write(positions_.data(), positions_.size());
    write(corners_.data(), corners_.size());
    write(kImportEnd.data(), kImportEnd.size());
  }

 private:
  void add(const aiNode& node, const Affine& place) {
    PerVertex<Vec3> positions;
    VertexWelder welder(positions);
    const auto first = static_cast<std::uint32_t>(positions_.size());
    const auto vertex_at = [&](const aiVector3D& corner) {
      const Vec3 position = place(Vec3{corner.x, corner.y, corner.z});
      const std::uint32_t number = welder.number_of(position);
      if (number == positions.size()) positions.push_back(position);
      return first + number;
    };
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      for (unsigned f = 0; f < mesh.mNumFaces; ++f) add(mesh, mesh.mFaces[f], place.mirrors(), vertex_at);
    }
    positions_.insert(positions_.end(), positions.begin(), positions.end());
  }

  template <class VertexAt>
  void add(const aiMesh& mesh, const aiFace& face, bool reversed, const VertexAt& vertex_at) {
    if (face.mNumIndices < 3) return;  // points and lines
    corners_.push_back(face.mNumIndices);
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      const unsigned index = face.mIndices[reversed ? face.mNumIndices - 1 - c : c];
      if (index >= mesh.mNumVertices) {
        std::fputs("a face has a vertex that does not exist", stdout);
        leave(kImportRefused);
      }
      corners_.push_back(vertex_at(mesh.mVertices[index]));
    }
    ++polygon_count_;
  }

  const aiScene& scene_;
  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> corners_;  ///< of each polygon: how many, and which
  std::uint64_t polygon_count_ = 0;
};

int run(const std::string& name, bool alone) {
  const std::string content = all_of_stdin();
  Assimp::Importer importer;
  importer.SetIOHandler(new FileSystem(name, content, alone));
  // As rviz and MoveIt do: the unit of a COLLADA file is applied, its up_axis is not (docs/formats.md).
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = importer.ReadFile(name, 0);
  if (!scene || !scene->mRootNode) {
    std::fputs(importer.GetErrorString(), stdout);
    leave(kImportRefused);
  }
  Polygons(*scene).write_all();
  leave(EXIT_SUCCESS);
}

}  // namespace
}  // namespace prohull

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("prohull-import is run by prohull, and by nobody else\n", stderr);
    return prohull::kImportMisused;
  }
  prohull::limit_resources(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
  return prohull::run(argv[1], std::string(argv[4]) == prohull::kImportAlone);
}
