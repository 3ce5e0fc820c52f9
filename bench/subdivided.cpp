#include "subdivided.h"

#include <algorithm>
#include <random>
#include <unordered_map>

namespace prohull::bench {

TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.positions = mesh.positions;
  result.positions.reserve(mesh.vertex_count() + 3 * mesh.face_count() / 2);
  result.triangles.reserve(4 * mesh.face_count());
  std::mt19937_64 random;
  const auto shift = [&](double size) { return size * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) / 10; };
  std::unordered_map<std::uint64_t, VertexId> middles;
  middles.reserve(3 * mesh.face_count() / 2);
  const auto middle = [&](VertexId v, VertexId w) {
    const auto [less, greater] = std::minmax({index(v), index(w)});
    const auto [entry, is_new] = middles.try_emplace(std::uint64_t{less} << 32 | greater);
    if (is_new) {
      const Vec3 &p = mesh.positions[v], &q = mesh.positions[w];
      const double size = norm(q - p);
      const double x = shift(size), y = shift(size), z = shift(size);
      entry->second = result.positions.push_back(p * 0.5 + q * 0.5 + Vec3{x, y, z});
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<VertexId, 3>& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
      result.triangles.push_back(t);
  }
  return result;
}

}  // namespace prohull::bench
