#include "mesh/half_edge_mesh.h"

#include <fmt/format.h>

#include "mesh/half_edges_by_tail.h"

namespace prohull {
namespace {

constexpr EdgeId kNoEdge{0xffffffff};

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh) {
  allocate(mesh.vertex_count(), mesh.face_count());
  positions_ = mesh.positions;
  for (const FaceId f : mesh.triangles.ids())
    for (std::uint32_t c = 0; c < 3; ++c) half_edges_[HalfEdgeId(3 * index(f) + c)].tail = mesh.triangles[f][c];
  link_twins();
}

HalfEdgeMesh::HalfEdgeMesh(PerVertex<Vec3> positions, const std::vector<VertexId>& corners)
    : positions_(std::move(positions)) {
  allocate(positions_.size(), corners.size() / 3);
  for (const HalfEdgeId h : half_edges_.ids()) half_edges_[h].tail = corners[index(h)];
  link_twins();
}

HalfEdgeMesh::HalfEdgeMesh(PerVertex<Vec3> positions, const std::vector<VertexId>& corners,
                           const std::vector<HalfEdgeId>& twins)
    : positions_(std::move(positions)) {
  allocate(positions_.size(), corners.size() / 3);
  for (const HalfEdgeId h : half_edges_.ids()) {
    const VertexId v = corners[index(h)];
    half_edges_[h].tail = v;
    if (v == kNoVertex) continue;
    out_[v] = h;
    ++valence_[v];
    if (index(h) % 3 == 0) ++face_count_;
    const HalfEdgeId g = twins[index(h)];
    if (g != kNoHalfEdge && h < g) pair(h, g, half_edge_.push_back(h));
  }
}

void HalfEdgeMesh::allocate(std::size_t vertices, std::size_t faces) {
  out_.assign(vertices, kNoHalfEdge);
  valence_.assign(vertices, 0);
  half_edges_.assign(3 * faces, {kNoVertex, kNoHalfEdge});
  edge_.assign(3 * faces, kNoEdge);
  half_edge_.reserve(3 * faces / 2);
}

void HalfEdgeMesh::link_twins() {
  const HalfEdgesByTail by_tail(out_.size(), half_edges_.size(), [this](HalfEdgeId h) { return tail(h); });
  for (const VertexId v : out_.ids()) valence_[v] = static_cast<std::uint32_t>(by_tail.leaving(v).size());
  for (const HalfEdgeId h : half_edges_.ids()) {
    if (tail(h) == kNoVertex) continue;
    out_[tail(h)] = h;
    if (index(h) % 3 == 0) ++face_count_;
    if (twin(h) != kNoHalfEdge) continue;
    if (const HalfEdgeId g = by_tail.between(tip(h), tail(h)); g != kNoHalfEdge) pair(h, g, half_edge_.push_back(h));
  }
}

// The half-edges around a vertex, counter-clockwise, from `from` to the one before `until`.
void HalfEdgeMesh::set_tails_around(HalfEdgeId from, HalfEdgeId until, VertexId v) {
  HalfEdgeId h = from;
  do {
    half_edges_[h].tail = v;
    h = rotated(h);
  } while (h != until);
}

VertexSplit HalfEdgeMesh::collapse(HalfEdgeId h, const Vec3& apex) {
  const HalfEdgeId g = twin(h);
  const HalfEdgeId dl = next(h), lo = previous(h), or_ = next(g), rd = previous(g);
  const HalfEdgeId ld = twin(dl), ol = twin(lo), ro = twin(or_), dr = twin(rd);
  const VertexId o = tail(h), d = tail(g), l = tail(lo), r = tail(rd);
  const VertexId s = positions_.push_back(apex);

  set_tails_around(h, h, s);
  set_tails_around(g, g, s);
  half_edge_[edge(h)] = half_edge_[edge(dl)] = half_edge_[edge(or_)] = kNoHalfEdge;
  pair(ol, ld, edge(lo));
  pair(dr, ro, edge(rd));
  for (const HalfEdgeId dead : {h, dl, lo, g, or_, rd}) half_edges_[dead].tail = kNoVertex;

  out_.push_back(ol);
  valence_.push_back(valence_[o] + valence_[d] - 4);
  out_[o] = out_[d] = kNoHalfEdge;
  out_[l] = ld, out_[r] = ro;
  --valence_[l], --valence_[r];
  face_count_ -= 2;
  return {o, d, l, r, index(h), index(g)};
}

void HalfEdgeMesh::split(VertexId s, const VertexSplit& record) {
  const auto& [o, d, l, r, od, do_] = record;
  const HalfEdgeId h{od}, g{do_};
  const HalfEdgeId dl = next(h), lo = previous(h), or_ = next(g), rd = previous(g);
  HalfEdgeId sl = out(s);
  while (tip(sl) != l) sl = rotated(sl);
  HalfEdgeId sr = sl;
  std::uint32_t o_valence = 2;
  for (; tip(sr) != r; sr = rotated(sr)) ++o_valence;
  const HalfEdgeId ls = twin(sl), rs = twin(sr);

  set_tails_around(sl, sr, o);
  set_tails_around(sr, sl, d);
  half_edges_[h].tail = o, half_edges_[dl].tail = d, half_edges_[lo].tail = l;
  half_edges_[g].tail = d, half_edges_[or_].tail = o, half_edges_[rd].tail = r;
  const auto revived = [&](HalfEdgeId x) {
    if (edge_[x] != kNoEdge) return edge_[x];  // undoing a collapse of this very mesh: edges get back their ids
    return half_edge_.push_back(kNoHalfEdge);
  };
  const EdgeId sl_edge = edge(sl), sr_edge = edge(sr);
  pair(h, g, revived(h));
  pair(dl, ls, revived(dl));
  pair(sl, lo, sl_edge);
  pair(or_, rs, revived(or_));
  pair(sr, rd, sr_edge);

  valence_[o] = o_valence;
  valence_[d] = valence_[s] + 4 - valence_[o];
  out_[o] = h, out_[d] = g, out_[s] = kNoHalfEdge;
  out_[l] = lo, out_[r] = rd;
  ++valence_[l], ++valence_[r];
  face_count_ += 2;
}

bool HalfEdgeMesh::can_flip(HalfEdgeId h) const {
  const VertexId l = tail(previous(h)), r = tail(previous(twin(h)));
  if (l == r || valence_[tail(h)] <= 3 || valence_[tip(h)] <= 3) return false;
  for (const HalfEdgeId a : around(l))
    if (tip(a) == r) return false;
  return true;
}

void HalfEdgeMesh::flip(HalfEdgeId h) {
  const HalfEdgeId g = twin(h);
  const HalfEdgeId dl = next(h), lo = previous(h), or_ = next(g), rd = previous(g);
  const HalfEdgeId ld = twin(dl), ol = twin(lo), ro = twin(or_), dr = twin(rd);
  const VertexId o = tail(h), d = tail(g), l = tail(lo), r = tail(rd);
  const EdgeId dl_edge = edge(dl), lo_edge = edge(lo), or_edge = edge(or_), rd_edge = edge(rd);

  // The faces are (r, l, o) and (l, r, d) now.
  half_edges_[h].tail = r, half_edges_[dl].tail = l, half_edges_[lo].tail = o;
  half_edges_[g].tail = l, half_edges_[or_].tail = r, half_edges_[rd].tail = d;
  pair(dl, ol, lo_edge), pair(lo, ro, or_edge);
  pair(or_, dr, rd_edge), pair(rd, ld, dl_edge);
  out_[o] = lo, out_[d] = rd, out_[l] = dl, out_[r] = or_;
  --valence_[o], --valence_[d], ++valence_[l], ++valence_[r];
}

TriangleMesh HalfEdgeMesh::triangle_mesh() const {
  TriangleMesh mesh;
  PerVertex<VertexId> renumbered(positions_.size(), kNoVertex);
  for (const VertexId v : positions_.ids())
    if (has(v)) renumbered[v] = mesh.positions.push_back(positions_[v]);
  mesh.triangles.reserve(face_count_);
  for (std::uint32_t f = 0; f < face_id_count(); ++f) {
    if (!has(FaceId(f))) continue;
    const auto [a, b, c] = corners(FaceId(f));
    mesh.triangles.push_back({renumbered[a], renumbered[b], renumbered[c]});
  }
  return mesh;
}

std::optional<std::string> first_defect(const HalfEdgeMesh& mesh) {
  std::size_t faces = 0, half_edges_seen_around_vertices = 0;
  for (std::uint32_t i = 0; i < 3 * mesh.face_id_count(); ++i) {
    const HalfEdgeId h{i};
    if (mesh.tail(h) == kNoVertex) continue;
    faces += i % 3 == 0;
    const HalfEdgeId t = mesh.twin(h);
    if (t == kNoHalfEdge) return fmt::format("half-edge {}: has no twin", i);
    if (t == h || mesh.twin(t) != h) return fmt::format("half-edge {}: twin of twin is {}", i, index(mesh.twin(t)));
    if (mesh.tail(mesh.next(h)) != mesh.tail(t))
      return fmt::format("half-edge {}: ends at {}, its twin starts at {}", i, index(mesh.tail(mesh.next(h))),
                         index(mesh.tail(t)));
    if (mesh.edge(h) != mesh.edge(t)) return fmt::format("half-edge {}: its twin has another edge", i);
    if (const HalfEdgeId e = mesh.half_edge(mesh.edge(h)); e != h && e != t)
      return fmt::format("edge {}: names half-edge {}, not {} or {}", index(mesh.edge(h)), index(e), i, index(t));
    if (!mesh.has(mesh.tail(h)))
      return fmt::format("half-edge {}: starts at removed vertex {}", i, index(mesh.tail(h)));
  }
  if (faces != mesh.face_count()) return fmt::format("{} faces, but face_count() is {}", faces, mesh.face_count());
  PerVertex<VertexId> met_from(mesh.positions().size(), kNoVertex);
  for (const VertexId v : mesh.positions().ids()) {
    if (!mesh.has(v)) continue;
    std::size_t valence = 0;
    HalfEdgeId h = mesh.out(v);
    do {
      if (mesh.tail(h) != v) return fmt::format("vertex {}: half-edge {} does not start there", index(v), index(h));
      const VertexId tip = mesh.tip(h);
      if (tip == v || met_from[tip] == v)
        return fmt::format("vertex {}: more than one edge to {}, or one to itself", index(v), index(tip));
      met_from[tip] = v;
      h = mesh.rotated(h);
    } while (++valence <= 3 * faces && h != mesh.out(v));
    if (valence != mesh.valence(v))
      return fmt::format("vertex {}: {} faces around it, but valence() is {}", index(v), valence, mesh.valence(v));
    half_edges_seen_around_vertices += valence;
  }
  if (half_edges_seen_around_vertices != 3 * faces) return "a vertex has more than one disk of faces";
  return std::nullopt;
}

}  // namespace prohull
