#include "build/self_intersection_guard.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "geometry/triangle_intersection.h"

namespace prohull {
namespace {

Triangle triangle(const HalfEdgeMesh& mesh, FaceId f) {
  const auto [a, b, c] = mesh.corners(f);
  return {mesh.position(a), mesh.position(b), mesh.position(c)};
}

bool has_corner(const HalfEdgeMesh& mesh, FaceId f, VertexId o, VertexId d) {
  return std::ranges::any_of(mesh.corners(f), [&](VertexId v) { return v == o || v == d; });
}

// Spreads ten bits so that two zeros follow each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

std::uint32_t morton_code(const std::array<float, 3>& p) {
  const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp(511.5f + 511.5f * x, 0.0f, 1023.0f)); };
  return spread(cell(p[0])) | spread(cell(p[1])) << 1 | spread(cell(p[2])) << 2;
}

}  // namespace

void SelfIntersectionGuard::FloatBox::extend(const FloatBox& other) {
  for (int i = 0; i < 3; ++i) min[i] = std::min(min[i], other.min[i]), max[i] = std::max(max[i], other.max[i]);
}

bool SelfIntersectionGuard::FloatBox::overlaps(const FloatBox& other) const {
  // One branch for all: most boxes that are asked for overlap along some axes.
  return (int(min[0] <= other.max[0]) & int(other.min[0] <= max[0]) & int(min[1] <= other.max[1]) &
          int(other.min[1] <= max[1]) & int(min[2] <= other.max[2]) & int(other.min[2] <= max[2])) != 0;
}

bool SelfIntersectionGuard::FloatBox::contains(const FloatBox& other) const {
  return min[0] <= other.min[0] && other.max[0] <= max[0] && min[1] <= other.min[1] && other.max[1] <= max[1] &&
         min[2] <= other.min[2] && other.max[2] <= max[2];
}

SelfIntersectionGuard::SelfIntersectionGuard(const HalfEdgeMesh& mesh) : slot_of_(mesh.face_id_count()) {
  Box box;
  for (const VertexId v : mesh.positions().ids())
    if (mesh.has(v)) box.extend(mesh.position(v));
  center_ = box.center();
  const Vec3 half = box.max * 0.5 - box.min * 0.5;
  inverse_unit_ = 1 / std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
  rebuild(mesh);
}

SelfIntersectionGuard::FloatBox SelfIntersectionGuard::box_of(const Triangle& t) const {
  FloatBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = static_cast<float>((std::min({t.a[i], t.b[i], t.c[i]}) - center_[i]) * inverse_unit_);
    box.max[i] = static_cast<float>((std::max({t.a[i], t.b[i], t.c[i]}) - center_[i]) * inverse_unit_);
  }
  return box;
}

void SelfIntersectionGuard::rebuild(const HalfEdgeMesh& mesh) {
  faces_when_built_ = mesh.face_count();
  std::vector<std::pair<std::uint32_t, FaceId>> by_code;
  by_code.reserve(faces_when_built_);
  for (std::uint32_t i = 0; i < mesh.face_id_count(); ++i) {
    if (!mesh.has(FaceId{i})) continue;
    const FloatBox box = box_of(triangle(mesh, FaceId{i}));
    by_code.emplace_back(
        morton_code({(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2, (box.min[2] + box.max[2]) / 2}),
        FaceId{i});
  }
  std::sort(by_code.begin(), by_code.end());

  const auto leaves = static_cast<std::uint32_t>((by_code.size() + kLeafSize - 1) / kLeafSize);
  first_leaf_ = std::bit_ceil(std::max(leaves, 1u));
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const FloatBox empty{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  nodes_.assign(2 * first_leaf_, empty);
  slots_.clear();
  for (const auto& [code, f] : by_code) {
    slot_of_[f] = static_cast<std::uint32_t>(slots_.size());
    slots_.push_back({f, box_of(triangle(mesh, f))});
    nodes_[first_leaf_ + slot_of_[f] / kLeafSize].extend(slots_.back().box);
  }
  for (std::uint32_t i = first_leaf_; i-- > 1;) {
    nodes_[i] = nodes_[2 * i];
    nodes_[i].extend(nodes_[2 * i + 1]);
  }
}

void SelfIntersectionGuard::changed(const HalfEdgeMesh& mesh, VertexId s) {
  if (mesh.face_count() < faces_when_built_ / 2) return rebuild(mesh);
  HalfEdgeId h = mesh.out(s);
  do {
    const FaceId f{index(h) / 3};
    const FloatBox box = box_of(triangle(mesh, f));
    slots_[slot_of_[f]].box = box;
    for (std::uint32_t i = first_leaf_ + slot_of_[f] / kLeafSize; i > 0 && !nodes_[i].contains(box); i /= 2)
      nodes_[i].extend(box);
    h = mesh.rotated(h);
  } while (h != mesh.out(s));
}

template <class Use>
void SelfIntersectionGuard::visit(const FloatBox& box, Use&& use) const {
  std::array<std::uint32_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 1;
  while (size > 0) {
    const std::uint32_t i = stack[--size];
    if (!nodes_[i].overlaps(box)) continue;
    if (i < first_leaf_) {
      stack[size++] = 2 * i + 1;
      stack[size++] = 2 * i;
      continue;
    }
    const std::size_t begin = std::size_t{i - first_leaf_} * kLeafSize;
    for (std::size_t k = begin; k < std::min(begin + kLeafSize, slots_.size()); ++k)
      if (slots_[k].box.overlaps(box)) use(slots_[k]);
  }
}

// Of `faces`, which take the place of the stars of o and d, among themselves and with the rest of the mesh.
std::size_t SelfIntersectionGuard::count_pairs(const HalfEdgeMesh& mesh, VertexId o, VertexId d,
                                               const std::vector<Triangle>& faces) {
  face_boxes_.clear();
  for (const Triangle& t : faces) face_boxes_.push_back(box_of(t));
  FloatBox whole = face_boxes_.front();
  for (const FloatBox& box : face_boxes_) whole.extend(box);

  std::size_t pairs = 0;
  visit(whole, [&](const Slot& slot) {
    if (!mesh.has(slot.face) || has_corner(mesh, slot.face, o, d)) return;
    const Triangle other = triangle(mesh, slot.face);
    for (std::size_t i = 0; i < faces.size(); ++i)
      pairs += face_boxes_[i].overlaps(slot.box) && triangles_intersect(faces[i], other);
  });
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      pairs += face_boxes_[i].overlaps(face_boxes_[j]) && triangles_intersect(faces[i], faces[j]);
  return pairs;
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex) {
  const auto link = [&](std::size_t i) { return mesh.position(star.link[i]); };
  faces_.clear();
  for (std::size_t i = 0; i < star.link.size(); ++i) faces_.push_back({apex, link(i), link(star.after(i))});
  const std::size_t after = count_pairs(mesh, star.o, star.d, faces_);
  if (after == 0) return false;

  const Vec3 &o = mesh.position(star.o), &d = mesh.position(star.d);
  for (std::size_t i = 0; i < star.link.size(); ++i) faces_[i].a = mesh.position(star.apex(i));
  faces_.push_back({o, d, link(0)});
  faces_.push_back({d, o, link(star.o_faces)});
  return after > count_pairs(mesh, star.o, star.d, faces_);
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, VertexId v,
                                                    const std::vector<VertexId>& link, const Vec3& to) {
  const auto set_star = [&](const Vec3& apex) {
    faces_.clear();
    for (std::size_t i = 0; i < link.size(); ++i)
      faces_.push_back({apex, mesh.position(link[i]), mesh.position(link[i + 1 == link.size() ? 0 : i + 1])});
  };
  set_star(to);
  const std::size_t after = count_pairs(mesh, v, v, faces_);
  if (after == 0) return false;
  set_star(mesh.position(v));
  return after > count_pairs(mesh, v, v, faces_);
}

}  // namespace prohull
