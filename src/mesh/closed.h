#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "prohull/triangle_mesh.h"

// Whether a mesh is closed (is_closed), with edges matched by position.

namespace prohull {

/// Throws InputError, with `name` in the message, if the mesh is empty, refers to vertices that it has not, or is not
/// finite.
void require_usable(const TriangleMesh& mesh, std::string_view name);

/// For each vertex the first one, in lexicographic order, at its position; 0.0 and -0.0 are the same position.
/// Positions that are not finite belong to no face, and have no number.
std::vector<std::uint32_t> numbered_by_position(const PerVertex<Vec3>& positions);

/// Throws InputError, with `name` in the message, if the mesh is not closed. Requires what require_usable does;
/// `number` is that of its vertices by position.
void require_closed(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, std::string_view name);

/// The same as both.
void require_closed(const TriangleMesh& mesh, std::string_view name);

/// The sides of all faces, each as item(tail, tip, face), by the lesser of the numbers of its ends. In linear time, and
/// in half of the memory that sorting them by both ends takes.
template <class Item>
class SidesByEnd {
 public:
  template <class MakeItem>
  SidesByEnd(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, MakeItem item)
      : first_(number.size() + 1, 0) {
    for_each(mesh, number, [&](std::uint32_t v, std::uint32_t w, FaceId) { ++first_[std::min(v, w) + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    items_.resize(first_.back());
    std::vector<std::size_t> cursor(first_.begin(), first_.end() - 1);
    for_each(mesh, number,
             [&](std::uint32_t v, std::uint32_t w, FaceId f) { items_[cursor[std::min(v, w)]++] = item(v, w, f); });
  }

  std::span<Item> of(std::uint32_t v) { return std::span(items_).subspan(first_[v], first_[v + 1] - first_[v]); }

 private:
  template <class Visit>
  static void for_each(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, Visit visit) {
    for (const FaceId f : mesh.triangles.ids())
      for (int i = 0; i < 3; ++i) {
        const auto& t = mesh.triangles[f];
        visit(number[index(t[i])], number[index(t[(i + 1) % 3])], f);
      }
  }

  std::vector<std::size_t> first_;
  std::vector<Item> items_;
};

}  // namespace prohull
