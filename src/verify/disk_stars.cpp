#include "verify/disk_stars.h"

#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "geometry/predicates.h"
#include "geometry/rounded_turn.h"

namespace prohull::verify {
namespace {

/// The side of a face that is opposite to a vertex.
struct Opposite {
  VertexId from, to;
};

/// Orders them so that each begins where the one before ends. Whether that leads through all and back.
bool is_cycle(std::span<Opposite> link) {
  for (std::size_t i = 1; i < link.size(); ++i) {
    const auto next = std::find_if(link.begin() + std::ptrdiff_t(i), link.end(),
                                   [&](const Opposite& side) { return side.from == link[i - 1].to; });
    if (next == link.end()) return false;
    std::swap(link[i], *next);
  }
  return link.size() > 2 && link.back().to == link.front().from;
}

int axis_of(const TriangleMesh& mesh, VertexId v, std::span<const Opposite> link) {
  const Vec3& p = mesh.positions[v];
  Vec3 normal;
  for (const auto& [from, to] : link) normal += cross(mesh.positions[from] - p, mesh.positions[to] - p);
  return dominant_axis(normal);
}

/// Exact. The sides turn the same way around the vertex, each by less than half a turn; how often they pass a ray says
/// how many turns they make.
bool is_disk(const TriangleMesh& mesh, VertexId v, std::span<Opposite> link) {
  constexpr std::size_t kMost = 16;  // vertices of more faces are few, and to order these takes the square
  if (link.size() > kMost || !is_cycle(link)) return false;
  const Vec3& p = mesh.positions[v];
  const int axis = axis_of(mesh, v, link), up = axis == 0 ? 2 : axis - 1;
  int way = 0, turns = 0;
  for (const auto& [from, to] : link) {
    const Vec3 &a = mesh.positions[from], &b = mesh.positions[to];
    const int turned = turn(axis, p, a, b);
    if (turned == 0 || turned == -way) return false;
    way = turned;
    const Vec3 &first = way > 0 ? a : b, &second = way > 0 ? b : a;
    turns += first[up] <= p[up] && second[up] > p[up];
  }
  return turns == 1;
}

}  // namespace

DiskStars::DiskStars(const TriangleMesh& mesh) : mesh_(mesh), is_disk_(mesh.vertex_count(), 0) {
  std::vector<std::uint32_t> end(mesh.vertex_count() + 1, 0);  // of the link of the vertex before
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) ++end[index(v) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Opposite> links(end.back());
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [v, from, to] : {std::array{a, b, c}, {b, c, a}, {c, a, b}}) links[end[index(v)]++] = {from, to};
  std::uint32_t begin = 0;
  for (const VertexId v : mesh.positions.ids()) {
    is_disk_[v] = is_disk(mesh, v, std::span(links).subspan(begin, end[index(v)] - begin));
    begin = end[index(v)];
  }
}

}  // namespace prohull::verify
