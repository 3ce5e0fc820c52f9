#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "io_testing.h"

namespace prohull {
namespace {

template <class T>
std::string msh_bytes(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

std::string msh_header(std::int32_t vertices, std::int32_t normals, std::int32_t textures, std::int32_t faces) {
  return msh_bytes({vertices, normals, textures, faces});
}

const std::string kMshVertices = msh_bytes<float>({0, 0, 0, 0.1F, 0, 0, 0, 1, 0});
const std::string kMshFace = msh_bytes<std::int32_t>({0, 1, 2});

TEST(Msh, SkipsNormalsAndTextureCoordinates) {
  const std::string skipped = msh_bytes<float>({9, 9, 9, 8, 8});
  const TriangleMesh mesh = read_mesh(msh_header(3, 1, 1, 1) + kMshVertices + skipped + kMshFace, "a.msh");
  EXPECT_EQ(mesh.positions, PerVertex<Vec3>({{0, 0, 0}, {double(0.1F), 0, 0}, {0, 1, 0}}));
  ASSERT_EQ(mesh.face_count(), 1U);
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2));
}

TEST(Msh, RefusesWhatTheHeaderDoesNotSay) {
  expect_refused(msh_header(3, 0, 0, 2) + kMshVertices + kMshFace, "a.msh",
                 "a.msh: byte 64: the file has 64 bytes, and 76 by the numbers of its header");
  constexpr std::int32_t kMost = 2147483647;
  expect_refused(msh_header(kMost, kMost, kMost, kMost), "a.msh",
                 "a.msh: byte 16: the file has 16 bytes, and 94489280484 by the numbers of its header");
  expect_refused(msh_header(3, -1, 0, 1) + kMshVertices + kMshFace, "a.msh",
                 "a.msh: byte 4: a number of the header is negative");
  expect_refused("123", "a.msh", "a.msh: byte 3: the file ends within its header of 16 bytes");
  expect_refused("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "a.msh",
                 "a.msh: line 1: an MSH file of Gmsh, which is not read; MSH files of MuJoCo are");
}

TEST(Msh, RefusesBadIndices) {
  expect_refused(msh_header(3, 0, 0, 1) + kMshVertices + msh_bytes<std::int32_t>({0, 1, 3}), "a.msh",
                 "a.msh: byte 52: the face has vertex 3, but the file has 3 vertices, counted from 0");
}

}  // namespace
}  // namespace prohull
