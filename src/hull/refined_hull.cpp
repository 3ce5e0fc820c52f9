#include "prohull/refined_hull.h"

#include <algorithm>

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

/// Memory that is not in a cache is most of what a split waits for.
void prefetch(const void* p) { __builtin_prefetch(p); }

struct FaceCorners {
  explicit FaceCorners(std::uint32_t corner) {
    const std::uint32_t c = corner % 3, first = corner - c;
    here = corner, next = first + (c + 1) % 3, previous = first + (c + 2) % 3;
  }
  std::uint32_t here, next, previous;
};

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
  Node& node = nodes_[number(made)];
  node.split = hull_.splits()[number(made)];
  HalfEdgeId first = mesh.out(made);
  while (mesh.tip(first) != node.split.l) first = mesh.rotated(first);
  node.star = stars_.size();
  HalfEdgeId h = first;
  do {
    if (mesh.tip(h) == node.split.r) node.corners_of_o = node.star_size;
    stars_.push_back(index(h));
    ++node.star_size;
    h = mesh.rotated(h);
  } while (h != first);
}

void RefinableHull::record_needs(const HalfEdgeMesh& mesh, VertexId made, const PerVertex<VertexId>& parents) {
  std::vector<VertexId> makers{parents[made]};
  for (const std::uint32_t corner : star(made)) makers.push_back(parents[mesh.tip(HalfEdgeId(corner))]);
  std::ranges::sort(makers);
  makers.erase(std::unique(makers.begin(), makers.end()), makers.end());
  if (makers.back() == ProgressiveHull::kAbsent) makers.pop_back();

  // Saves a third of them; longer lists are left as they are, so that the time is linear whatever the hull.
  constexpr std::size_t kReduced = 16;
  const auto implied = [&](VertexId v) {
    return std::ranges::any_of(makers, [&](VertexId w) { return w < v && std::ranges::binary_search(needs(w), v); });
  };
  Node& node = nodes_[number(made)];
  node.needs = needs_.size();
  for (const VertexId v : makers)
    if (makers.size() > kReduced || !implied(v)) needs_.push_back(v);
  node.need_count = static_cast<std::uint32_t>(needs_.size() - node.needs);
}

Box RefinableHull::completed_faces(const HalfEdgeMesh& mesh, VertexId made) const {
  Box box;
  const auto add_if_original = [&](std::uint32_t corner) {
    const auto face = mesh.corners(FaceId(corner / 3));
    if (std::ranges::any_of(face, [&](VertexId v) { return is_made(v); })) return;
    for (const VertexId v : face) box.extend(positions()[v]);
  };
  std::ranges::for_each(star(made), add_if_original);
  add_if_original(split_of(made).od);
  add_if_original(split_of(made).do_);
  return box;
}

std::size_t RefinableHull::memory_bytes() const {
  return sizeof(*this) + hull_.positions().size() * sizeof(Vec3) + hull_.base_corners().size() * sizeof(VertexId) +
         hull_.splits().size() * sizeof(VertexSplit) + nodes_.capacity() * sizeof(Node) +
         stars_.capacity() * sizeof(std::uint32_t) + needs_.capacity() * sizeof(VertexId) +
         bounds_.capacity() * sizeof(Box);
}

RefinedHull::RefinedHull(std::shared_ptr<const RefinableHull> hull)
    : hull_(std::move(hull)),
      corners_(hull_->hull().base_corners()),
      dependents_(hull_->hull().splits().size(), kWhole) {}

std::size_t RefinedHull::split(VertexId made) {
  const std::size_t before = splits_.size();
  if (is_split(made)) return 0;
  pending_.push_back({made, 0});
  while (!pending_.empty()) {
    auto& [vertex, seen] = pending_.back();
    const auto needs = hull_->needs(vertex);
    prefetch(hull_->star(vertex).data());
    while (seen < needs.size() && is_split(needs[seen])) ++seen;
    if (seen < needs.size()) {
      pending_.push_back({needs[seen], 0});
    } else {
      make_split(vertex);
      pending_.pop_back();
    }
  }
  return splits_.size() - before;
}

void RefinedHull::make_split(VertexId made) {
  const auto& [o, d, l, r, od, do_] = hull_->split_of(made);
  const auto star = hull_->star(made);
  const std::uint32_t of_o = hull_->corners_of_o(made);
  for (std::size_t i = 0; i < star.size(); ++i) corners_[star[i]] = i < of_o ? o : d;
  const FaceCorners odl(od), dor(do_);
  corners_[odl.here] = o, corners_[odl.next] = d, corners_[odl.previous] = l;
  corners_[dor.here] = d, corners_[dor.next] = o, corners_[dor.previous] = r;
  for (const VertexId needed : hull_->needs(made)) ++dependents(needed);
  dependents(made) = 0;
  splits_.push_back(made);
  for (const VertexId v : {o, d}) {
    prefetch(&hull_->positions()[v]);
    if (hull_->is_made(v)) prefetch(&hull_->split_of(v));
  }
}

void RefinedHull::restore_star(VertexId made) {
  for (const std::uint32_t corner : hull_->star(made)) corners_[corner] = made;
  const VertexSplit& split = hull_->split_of(made);
  for (const std::uint32_t corner : {split.od, split.do_})
    std::fill_n(corners_.begin() + (corner - corner % 3), 3, ProgressiveHull::kAbsent);
  dependents(made) = kWhole;
}

void RefinedHull::undo(VertexId made) {
  assert(can_unsplit(made));
  restore_star(made);
  for (const VertexId needed : hull_->needs(made)) --dependents(needed);
}

void RefinedHull::unsplit(VertexId made) {
  undo(made);
  splits_.erase(std::find(splits_.rbegin(), splits_.rend(), made).base() - 1);
}

void RefinedHull::roll_back() {
  for (auto split = splits_.rbegin(); split != splits_.rend(); ++split) restore_star(*split);
  splits_.clear();
}

TriangleMesh RefinedHull::triangle_mesh() const {
  TriangleMesh mesh;
  PerVertex<VertexId> renumbered(hull_->positions().size(), ProgressiveHull::kAbsent);
  for (const VertexId v : corners_)
    if (v != ProgressiveHull::kAbsent) renumbered[v] = v;
  for (const VertexId v : renumbered)
    if (v != ProgressiveHull::kAbsent) renumbered[v] = mesh.positions.push_back(hull_->positions()[v]);
  mesh.triangles.reserve(face_count());
  for (std::size_t corner = 0; corner < corners_.size(); corner += 3)
    if (corners_[corner] != ProgressiveHull::kAbsent)
      mesh.triangles.push_back(
          {renumbered[corners_[corner]], renumbered[corners_[corner + 1]], renumbered[corners_[corner + 2]]});
  return mesh;
}

std::size_t RefinedHull::memory_bytes() const {
  return sizeof(*this) + corners_.capacity() * sizeof(VertexId) + dependents_.capacity() * sizeof(std::uint32_t) +
         splits_.capacity() * sizeof(VertexId) + pending_.capacity() * sizeof(Pending);
}

}  // namespace prohull
