#include "paper/refined_hull.h"

#include <algorithm>
#include <utility>

#include "mesh/half_edge_mesh.h"

namespace prohull {
namespace {

/// What the collapse that removed each vertex made; kAbsent for vertices of the base mesh.
PerVertex<VertexId> parents_of(const ProgressiveHull& hull) {
  PerVertex<VertexId> parents(hull.positions().size(), ProgressiveHull::kAbsent);
  for (std::size_t i = 0; i < hull.splits().size(); ++i)
    parents[hull.splits()[i].o] = parents[hull.splits()[i].d] = hull.made_vertex(i);
  return parents;
}

/// From 3 face + corner to 4 face + corner.
std::uint32_t widened(std::uint32_t corner) { return corner + corner / 3; }

/// This corner of a face, the next and the one after it.
std::array<std::uint32_t, 3> corners_from(std::uint32_t corner) {
  const std::uint32_t first = corner / 3 * 3, c = corner % 3;
  return {widened(corner), widened(first + (c + 1) % 3), widened(first + (c + 2) % 3)};
}

HalfEdgeId half_edge(std::uint32_t widened_corner) { return HalfEdgeId(widened_corner - widened_corner / 4); }

}  // namespace

RefinableHull::RefinableHull(ProgressiveHull hull)
    : hull_(std::move(hull)), original_vertices_(static_cast<std::uint32_t>(hull_.original_vertex_count())) {
  const std::size_t count = hull_.splits().size();
  nodes_.resize(count);
  bounds_.resize(count);
  const PerVertex<VertexId> parents = parents_of(hull_);
  HalfEdgeMesh mesh(hull_.positions(), hull_.base_corners());
  for (std::size_t i = count; i-- > 0;) {
    const VertexId made = hull_.made_vertex(i);
    record_star(mesh, made);
    record_needs(mesh, made, parents);
    mesh.split(made, hull_.splits()[i]);
    bounds_[i] = completed_faces(mesh, made);
  }
  for (std::size_t i = 0; i < count; ++i)
    for (const VertexId child : {hull_.splits()[i].o, hull_.splits()[i].d})
      if (is_made(child)) bounds_[i].extend(bounds(child));
}

void RefinableHull::record_star(const HalfEdgeMesh& mesh, VertexId made) {
  const auto& [o, d, l, r, od, do_] = split_of(made);
  Node& node = nodes_[number(made)];
  node = {o, d, l, r, corners_from(od), corners_from(do_), 0, 0, 0, pool_.size()};
  HalfEdgeId first = mesh.out(made);
  while (mesh.tip(first) != l) first = mesh.rotated(first);
  HalfEdgeId h = first;
  do {
    if (mesh.tip(h) == r) node.corners_of_o = node.star_size;
    pool_.push_back(widened(index(h)));
    ++node.star_size;
    h = mesh.rotated(h);
  } while (h != first);
}

void RefinableHull::record_needs(const HalfEdgeMesh& mesh, VertexId made, const PerVertex<VertexId>& parents) {
  std::vector<VertexId> makers{parents[made]};
  for (const std::uint32_t corner : star(made)) makers.push_back(parents[mesh.tip(half_edge(corner))]);
  std::ranges::sort(makers);
  makers.erase(std::unique(makers.begin(), makers.end()), makers.end());
  if (makers.back() == ProgressiveHull::kAbsent) makers.pop_back();

  // Saves a third of them; longer lists are left as they are, so that the time is linear whatever the hull.
  constexpr std::size_t kReduced = 16;
  const auto is_implied = [&](VertexId v) {
    return std::ranges::any_of(makers,
                               [&](VertexId w) { return w < v && std::ranges::binary_search(needs(w), number(v)); });
  };
  Node& node = nodes_[number(made)];
  for (const VertexId v : makers) {
    if (makers.size() <= kReduced && is_implied(v)) continue;
    pool_.push_back(number(v));
    ++node.needs_size;
  }
}

Box RefinableHull::completed_faces(const HalfEdgeMesh& mesh, VertexId made) const {
  Box box;
  const auto add_if_original = [&](FaceId f) {
    const auto corners = mesh.corners(f);
    if (std::ranges::any_of(corners, [&](VertexId v) { return is_made(v); })) return;
    for (const VertexId v : corners) box.extend(positions()[v]);
  };
  for (const std::uint32_t corner : star(made)) add_if_original(FaceId(corner / 4));
  for (const FaceId f : new_faces(made)) add_if_original(f);
  return box;
}

std::size_t RefinableHull::memory_bytes() const {
  return sizeof(*this) + hull_.positions().size() * sizeof(Vec3) + hull_.base_corners().size() * sizeof(VertexId) +
         hull_.splits().size() * sizeof(VertexSplit) + nodes_.capacity() * sizeof(Node) +
         pool_.capacity() * sizeof(std::uint32_t) + bounds_.capacity() * sizeof(Box);
}

RefinedHull::RefinedHull(std::shared_ptr<const RefinableHull> hull)
    : hull_(std::move(hull)), is_split_(hull_->hull().splits().size(), false) {
  splits_.reserve(is_split_.size());
  pending_.reserve(is_split_.size());
  const std::vector<VertexId>& corners = hull_->hull().base_corners();
  faces_.resize(corners.size() / 3 * 4);
  for (std::uint32_t c = 0; c < corners.size(); ++c) put(corners[c], widened(c));
}

std::size_t RefinedHull::split(VertexId made) {
  if (is_split(made)) return 0;
  const std::size_t before = splits_.size();
  pending_.push_back({hull_->number(made), 0});
  while (!pending_.empty()) {
    auto& [number, seen] = pending_.back();
    const VertexId next = hull_->hull().made_vertex(number);
    const auto needs = hull_->needs(next);
    while (seen < needs.size() && is_split_[needs[seen]]) ++seen;
    if (seen < needs.size()) {
      pending_.push_back({needs[seen], 0});
    } else {
      make_split(next);
      pending_.pop_back();
    }
  }
  return splits_.size() - before;
}

void RefinedHull::make_split(VertexId made) {
  const auto& [o, d, l, r, odl, dor, star_size, corners_of_o, needs_size, pool] = hull_->nodes_[hull_->number(made)];
  const auto star = hull_->star(made);
  for (std::size_t i = 0; i < star.size(); ++i) put(i < corners_of_o ? o : d, star[i]);
  put(o, odl[0]), put(d, odl[1]), put(l, odl[2]);
  put(d, dor[0]), put(o, dor[1]), put(r, dor[2]);
  is_split_[hull_->number(made)] = true;
  splits_.push_back(made);
  for (const VertexId v : {o, d}) {
    __builtin_prefetch(&hull_->positions()[v]);
    if (hull_->is_made(v)) hull_->prefetch(v);
  }
}

void RefinedHull::restore_star(VertexId made) {
  for (const std::uint32_t corner : hull_->star(made)) put(made, corner);
  const auto& node = hull_->nodes_[hull_->number(made)];
  for (const auto& face : {node.odl, node.dor})
    for (const std::uint32_t corner : face) put(ProgressiveHull::kAbsent, corner);
  is_split_[hull_->number(made)] = false;
}

bool RefinedHull::can_unsplit(VertexId made) const {
  if (!is_split(made)) return false;
  for (auto split = splits_.rbegin(); *split != made; ++split)
    if (std::ranges::count(hull_->needs(*split), hull_->number(made)) > 0) return false;
  return true;
}

void RefinedHull::unsplit(VertexId made) {
  assert(can_unsplit(made));
  restore_star(made);
  splits_.erase(std::find(splits_.rbegin(), splits_.rend(), made).base() - 1);
}

void RefinedHull::roll_back() {
  for (auto split = splits_.rbegin(); split != splits_.rend(); ++split) restore_star(*split);
  splits_.clear();
}

TriangleMesh RefinedHull::triangle_mesh() const {
  TriangleMesh mesh;
  PerVertex<VertexId> renumbered(hull_->positions().size(), ProgressiveHull::kAbsent);
  const PerFace<bool>::Ids faces(static_cast<std::uint32_t>(faces_.size() / 4));
  for (const FaceId f : faces)
    if (has(f))
      for (const VertexId v : corners(f)) renumbered[v] = v;
  for (VertexId& v : renumbered)
    if (v != ProgressiveHull::kAbsent) v = mesh.positions.push_back(hull_->positions()[v]);
  mesh.triangles.reserve(face_count());
  for (const FaceId f : faces) {
    if (!has(f)) continue;
    const auto [a, b, c] = corners(f);
    mesh.triangles.push_back({renumbered[a], renumbered[b], renumbered[c]});
  }
  return mesh;
}

std::size_t RefinedHull::memory_bytes() const {
  return sizeof(*this) + faces_.capacity() * sizeof(std::uint32_t) + is_split_.capacity() +
         splits_.capacity() * sizeof(VertexId) + pending_.capacity() * sizeof(Pending);
}

}  // namespace prohull
