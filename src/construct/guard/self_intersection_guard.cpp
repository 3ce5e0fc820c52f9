#include "construct/guard/self_intersection_guard.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include "construct/progressive/cells.h"
#include "geometry/triangle_intersection.h"

namespace prohull {
namespace {

/// The lanes whose bits are set in a mask of four, the first ones.
struct SetLanes {
  Truth4 lanes{};
  std::uint32_t count = 0;
};
constexpr std::array<SetLanes, 16> kSetLanes = [] {
  std::array<SetLanes, 16> all;
  for (unsigned mask = 0; mask < all.size(); ++mask) {
    std::array<std::int32_t, 4> lanes{};
    for (int lane = 0; lane < 4; ++lane)
      if ((mask >> lane & 1) != 0) lanes[all[mask].count++] = lane;
    all[mask].lanes = Truth4{lanes[0], lanes[1], lanes[2], lanes[3]};
  }
  return all;
}();

Triangle triangle(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners) {
  return {mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2])};
}

Box bounding_box_of(const HalfEdgeMesh& mesh) {
  Box box;
  for (const VertexId v : mesh.positions().ids())
    if (mesh.has(v)) box.extend(mesh.position(v));
  return box;
}

Triangle triangle(const HalfEdgeMesh& mesh, FaceId f) { return triangle(mesh, mesh.corners(f)); }

}  // namespace

SelfIntersectionGuard::SelfIntersectionGuard(const HalfEdgeMesh& mesh, const std::vector<FaceId>& faces)
    : unit_cube_(bounding_box_of(mesh)), slot_of_(mesh.face_id_count()) {
  face_at_.reserve(faces.size());
  for (const FaceId f : faces) face_at_.push_back({{}, f});
  pack(mesh);
}

// The order of the faces is kept: they move little.
void SelfIntersectionGuard::pack(const HalfEdgeMesh& mesh) {
  std::erase_if(face_at_, [&](const Face& face) { return !mesh.has(face.id); });
  faces_when_packed_ = face_at_.size();
  std::vector<FloatBox> boxes;
  boxes.reserve(face_at_.size());
  for (std::uint32_t slot = 0; slot < face_at_.size(); ++slot) {
    Face& at = face_at_[slot];
    at = face(mesh, at.id);
    slot_of_[at.id] = slot;
    boxes.push_back(unit_cube_.at(triangle(mesh, at.corners)));
  }
  levels_ = four_wide_tree(std::move(boxes));
  cones_ = Cones(static_cast<std::uint32_t>(face_at_.size()),
                 [&](std::uint32_t slot) { return triangle(mesh, face_at_[slot].corners); });
}

void SelfIntersectionGuard::collapsed(const HalfEdgeMesh& mesh, const VertexSplit& inverse) {
  for (const std::uint32_t corner : {inverse.od, inverse.do_}) {
    const std::uint32_t slot = slot_of_[FaceId{corner / 3}];
    levels_[0][slot / kWidth].set(slot % kWidth, kEmptyBox);
  }
  changed(mesh, VertexId{index(mesh.positions().next_id()) - 1});
}

void SelfIntersectionGuard::changed(const HalfEdgeMesh& mesh, VertexId s) {
  if (mesh.face_count() < faces_when_packed_ / 2) return pack(mesh);
  for (const HalfEdgeId h : mesh.around(s)) {
    const FaceId f{index(h) / 3};
    const std::uint32_t slot = slot_of_[f];
    face_at_[slot] = face(mesh, f);
    const Triangle t = triangle(mesh, face_at_[slot].corners);
    place(slot, unit_cube_.at(t));
    if (!cones_.empty()) cones_.place(slot, t);
  }
}

// Boxes of the upper levels only grow; where much is gone they soon are packed anew.
void SelfIntersectionGuard::place(std::uint32_t slot, const FloatBox& box) {
  levels_[0][slot / kWidth].set(slot % kWidth, box);
  std::uint32_t child = slot / kWidth;
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    FourBoxes& node = levels_[level][child / kWidth];
    FloatBox around = node.child(child % kWidth);
    if (around.holds(box)) return;
    around.extend(box);
    node.set(child % kWidth, around);
    child /= kWidth;
  }
}

// Puts those faces near `box` that are others first in others_, and counts them. Level by level, and with few branches,
// which nothing could predict.
std::size_t SelfIntersectionGuard::find_others(const FloatBox& box, auto&& is_other, auto&& is_apart_from) {
  const auto make_room = [](auto& list, std::size_t size) {
    if (list.size() < size) list.resize(2 * size);
  };
  constexpr std::size_t kMany = 64;
  const FourBoxes boxes = FourBoxes::four(box);
  make_room(nodes_, 1);
  nodes_[0] = 0;
  std::size_t count = 1;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    make_room(children_, kWidth * count);
    const FourBoxes* const nodes = levels_[level].data();
    std::uint32_t* end = children_.data();
    for (const std::uint32_t i : std::span(nodes_).first(count)) {
      const SetLanes& met = kSetLanes[nodes[i].overlapping(boxes)];
      const auto first = static_cast<std::int32_t>(kWidth * i);
      const Truth4 all = met.lanes + Truth4{first, first, first, first};
      std::memcpy(end, &all, sizeof all);
      end += met.count;
    }
    count = std::size_t(end - children_.data());
    std::swap(nodes_, children_);
    if (count > kMany && level > 0 && !cones_.empty()) {
      const auto is_apart = [&](std::uint32_t node) {
        const Cone* const cone = cones_.find(level - 1, node);
        return cone && is_apart_from(*cone);
      };
      count = std::size_t(std::remove_if(nodes_.begin(), nodes_.begin() + std::ptrdiff_t(count), is_apart) -
                          nodes_.begin());
    }
  }
  make_room(others_, count);
  Face* end = others_.data();
  for (const std::uint32_t slot : std::span(nodes_).first(count)) {
    *end = face_at_[slot];
    end += is_other(face_at_[slot]);
  }
  return std::size_t(end - others_.data());
}

namespace {

auto has_no_corner_at(VertexId o, VertexId d) {
  const auto all = [](VertexId v) {
    const auto id = static_cast<std::int32_t>(index(v));
    return Truth4{id, id, id, id};
  };
  return [o = all(o), d = all(d)](const auto& face) {
    const auto ids = std::bit_cast<Truth4>(face);
    return (mask((ids == o) | (ids == d)) & 7) == 0;  // but for the face's own id
  };
}

}  // namespace

// Of the faces of `fan_`, that take the place of the stars of o and d, among themselves and with the rest.
std::size_t SelfIntersectionGuard::count_pairs_of_fan(const HalfEdgeMesh& mesh, VertexId o, VertexId d,
                                                      const std::vector<VertexId>& link, const Vec3& apex) {
  std::size_t pairs = 0;
  if (!fan_.is_certainly_embedded()) {
    set_faces(mesh, link, [&](std::size_t) { return apex; });
    pairs = count_pairs_among_faces();
  }
  const auto face = [&](std::size_t i) {
    return Triangle{apex, mesh.position(link[i]), mesh.position(link[i + 1 == link.size() ? 0 : i + 1])};
  };
  const auto is_apart_from = [&](const Cone& cone) {
    for (std::size_t i = 0; i < link.size(); ++i)
      if (!are_apart(face(i), cone)) return false;
    return true;
  };
  const std::size_t others = find_others(unit_cube_.at(fan_.box()), has_no_corner_at(o, d), is_apart_from);
  for (const auto& [corners, id] : std::span(others_).first(others))
    for (std::uint64_t met = fan_.perhaps_met(mesh, corners); met != 0; met &= met - 1)
      pairs += triangles_intersect(face(static_cast<std::size_t>(std::countr_zero(met))), triangle(mesh, corners));
  return pairs;
}

// The same of any `faces_`, with those of the rest that are others.
std::size_t SelfIntersectionGuard::count_pairs(const HalfEdgeMesh& mesh, auto&& is_other) {
  face_boxes_.clear();
  for (const Triangle& t : faces_) face_boxes_.push_back(unit_cube_.at(t));
  FloatBox whole = face_boxes_.front();
  for (const FloatBox& box : face_boxes_) whole.extend(box);
  std::size_t pairs = count_pairs_among_faces();
  const std::size_t others = find_others(whole, is_other, [&](const Cone& cone) {
    return std::ranges::all_of(faces_, [&](const Triangle& t) { return are_apart(t, cone); });
  });
  for (const auto& [corners, id] : std::span(others_).first(others)) {
    const Triangle other = triangle(mesh, corners);
    const FloatBox box = unit_cube_.at(other);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      pairs += face_boxes_[i].overlaps(box) && triangles_intersect(faces_[i], other);
  }
  return pairs;
}

std::size_t SelfIntersectionGuard::count_pairs_among_faces() const {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs += triangles_intersect(faces_[i], faces_[j]);
  return pairs;
}

void SelfIntersectionGuard::set_faces(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, auto&& apex) {
  faces_.clear();
  for (std::size_t i = 0; i < link.size(); ++i)
    faces_.push_back({apex(i), mesh.position(link[i]), mesh.position(link[i + 1 == link.size() ? 0 : i + 1])});
}

bool SelfIntersectionGuard::adds_pairs(const HalfEdgeMesh& mesh, VertexId o, VertexId d,
                                       const std::vector<VertexId>& link, const Vec3& apex, auto&& set_faces_before) {
  std::size_t after;
  if (link.size() <= Fan::kMostFaces) {
    fan_.set(mesh, link, apex);
    after = count_pairs_of_fan(mesh, o, d, link, apex);
  } else {
    set_faces(mesh, link, [&](std::size_t) { return apex; });
    after = count_pairs(mesh, has_no_corner_at(o, d));
  }
  if (after == 0) return false;
  set_faces_before();
  return after > count_pairs(mesh, has_no_corner_at(o, d));
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex) {
  return adds_pairs(mesh, star.o, star.d, star.link, apex, [&] {
    const Vec3 &o = mesh.position(star.o), &d = mesh.position(star.d);
    set_faces(mesh, star.link, [&](std::size_t i) { return i < star.o_faces ? o : d; });
    faces_.push_back({o, d, mesh.position(star.link[0])});
    faces_.push_back({d, o, mesh.position(star.link[star.o_faces])});
  });
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, VertexId v,
                                                    const std::vector<VertexId>& link, const Vec3& to) {
  return adds_pairs(mesh, v, v, link, to,
                    [&] { set_faces(mesh, link, [&](std::size_t) { return mesh.position(v); }); });
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, HalfEdgeId flipped) {
  const HalfEdgeId g = mesh.twin(flipped);
  const FaceId left{index(flipped) / 3}, right{index(g) / 3};
  const auto is_other = [&](const Face& face) { return face.id != left && face.id != right; };
  const Vec3 &o = mesh.position(mesh.tail(flipped)), &d = mesh.position(mesh.tip(flipped));
  const Vec3 &l = mesh.position(mesh.tail(mesh.previous(flipped))), &r = mesh.position(mesh.tail(mesh.previous(g)));
  faces_ = {{r, l, o}, {l, r, d}};
  const std::size_t after = count_pairs(mesh, is_other);
  if (after == 0) return false;
  faces_ = {{o, d, l}, {d, o, r}};
  return after > count_pairs(mesh, is_other);
}

bool SelfIntersectionGuard::would_add_intersections(const HalfEdgeMesh& mesh, const std::vector<FaceId>& gone,
                                                    const std::vector<Triangle>& made) {
  const auto is_other = [&](const Face& face) { return !std::ranges::binary_search(gone, face.id); };
  faces_ = made;
  const std::size_t after = count_pairs(mesh, is_other);
  if (after == 0) return false;
  faces_.clear();
  for (const FaceId f : gone) faces_.push_back(triangle(mesh, f));
  return after > count_pairs(mesh, is_other);
}

std::vector<FaceId> faces_along_curve(const HalfEdgeMesh& mesh) {
  const UnitCube unit_cube(bounding_box_of(mesh));
  std::vector<BoxedFace> faces;
  for (std::uint32_t i = 0; i < mesh.face_id_count(); ++i)
    if (const FaceId f{i}; mesh.has(f)) faces.push_back({f, unit_cube.at(triangle(mesh, f))});
  return along_curve(faces);
}

}  // namespace prohull
