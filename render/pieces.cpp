#include "render/pieces.h"

#include <array>
#include <limits>
#include <vector>

#include "prohull/detail/disjoint_sets.h"

namespace prohull::render {
namespace {

/// The number of the part that each vertex is of; numbers grow with the first face of a part.
class Parts {
 public:
  explicit Parts(const TriangleMesh& mesh) : sets_(mesh.vertex_count()), numbers_(mesh.vertex_count(), kNone) {
    for (const auto& t : mesh.triangles)
      for (const VertexId v : t) sets_.join(index(v), index(t[0]));
    for (const auto& t : mesh.triangles)
      if (std::size_t& number = numbers_[sets_.find(index(t[0]))]; number == kNone) number = count_++;
  }

  std::size_t count() const { return count_; }
  std::size_t operator[](VertexId v) { return numbers_[sets_.find(index(v))]; }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  DisjointSets sets_;
  std::vector<std::size_t> numbers_;
  std::size_t count_ = 0;
};

std::vector<Box> boxes_of(const TriangleMesh& mesh, Parts& parts) {
  std::vector<Box> boxes(parts.count());
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) boxes[parts[v]].extend(mesh.positions[v]);
  return boxes;
}

}  // namespace

Rgb piece_color(std::size_t i) {
  // The colours of Okabe and Ito (2008), without black; then lighter, then darker.
  static const std::array<Rgb, 7> kColors{*parse_color("#56b4e9"), *parse_color("#e69f00"), *parse_color("#009e73"),
                                          *parse_color("#f0e442"), *parse_color("#0072b2"), *parse_color("#d55e00"),
                                          *parse_color("#cc79a7")};
  const Rgb color = kColors[i % kColors.size()];
  const std::size_t round = i / kColors.size() % 3;
  return round == 0 ? color : mix(color, *parse_color(round == 1 ? "white" : "black"), 0.5f);
}

Exploded exploded(TriangleMesh mesh, double factor) {
  Parts parts(mesh);
  const std::vector<Box> boxes = boxes_of(mesh, parts);
  Box whole;
  for (const Box& box : boxes) whole.extend(box);
  Exploded result{{}, {}, parts.count()};
  for (const auto& t : mesh.triangles) result.colors.push_back(piece_color(parts[t[0]]));
  PerVertex<char> used(mesh.vertex_count(), false);
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) used[v] = true;
  for (const VertexId v : used.ids())
    if (used[v]) mesh.positions[v] = mesh.positions[v] + factor * (boxes[parts[v]].center() - whole.center());
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace prohull::render
