#include "prohull/progressive_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/half_edge_mesh.h"
#include "prohull/detail/refuse.h"
#include "prohull/mesh_report.h"

namespace prohull {

Names<HullSide> hull_side_names() {
  static constexpr std::array<std::pair<std::string_view, HullSide>, 2> kNames{
      {{"outer", HullSide::Outer}, {"inner", HullSide::Inner}}};
  return kNames;
}

Names<FinestLevel> finest_level_names() {
  static constexpr std::array<std::pair<std::string_view, FinestLevel>, 4> kNames{
      {{"input", FinestLevel::Input},
       {"repaired", FinestLevel::Repaired},
       {"convex-hull", FinestLevel::ConvexHull},
       {"wrap", FinestLevel::Wrap}}};
  return kNames;
}

ProgressiveHull::ProgressiveHull(HullSide side, std::size_t original_vertices, PerVertex<Vec3> positions,
                                 std::vector<VertexId> base_corners, std::vector<VertexSplit> splits)
    : side_(side),
      original_vertices_(original_vertices),
      record_(
          std::make_shared<const Record>(Record{std::move(positions), std::move(base_corners), std::move(splits)})) {}

bool ProgressiveHull::operator==(const ProgressiveHull& other) const {
  return side_ == other.side_ && finest_level_ == other.finest_level_ &&
         original_vertices_ == other.original_vertices_ && (record_ == other.record_ || *record_ == *other.record_);
}

namespace {

/// How many splits are left to make on the finest level of at most `faces` faces.
std::size_t splits_below(const ProgressiveHull& hull, std::size_t faces) {
  const std::size_t base = hull.base_face_count();
  return hull.splits().size() - (faces > base ? std::min((faces - base) / 2, hull.splits().size()) : 0);
}

HalfEdgeMesh refined(const ProgressiveHull& hull, std::size_t splits_left) {
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > splits_left;) mesh.split(hull.made_vertex(i), hull.splits()[i]);
  return mesh;
}

}  // namespace

TriangleMesh ProgressiveHull::base() const {
  if (splits().empty()) return original();
  PerVertex<VertexId> number(positions().size(), kAbsent);
  for (const VertexId v : base_corners())
    if (v != kAbsent) number[v] = v;
  TriangleMesh mesh;
  for (VertexId& v : number)
    if (v != kAbsent) v = mesh.positions.push_back(positions()[v]);
  mesh.triangles.reserve(base_face_count());
  for (std::size_t c = 0; c < base_corners().size(); c += 3)
    if (const VertexId* const corners = &base_corners()[c]; corners[0] != kAbsent)
      mesh.triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
  return mesh;
}

TriangleMesh ProgressiveHull::level(std::size_t faces) const {
  if (!splits().empty() && faces < base_face_count() + 2) return base();
  const HalfEdgeMesh mesh = refined(*this, splits_below(*this, faces));
  TriangleMesh level = mesh.triangle_mesh();
  if (mesh.face_count() < original_face_count()) return level;
  // The original keeps its vertices as they were numbered, unused ones included.
  level.positions = PerVertex<Vec3>(
      std::vector<Vec3>(positions().begin(), positions().begin() + static_cast<std::ptrdiff_t>(original_vertices_)));
  for (const FaceId f : level.triangles.ids()) level.triangles[f] = mesh.corners(f);
  return level;
}

ProgressiveHull ProgressiveHull::with_base(std::size_t faces) const {
  const std::size_t left = splits_below(*this, faces);
  const HalfEdgeMesh mesh = refined(*this, left);
  std::vector<VertexId> corners;
  corners.reserve(base_corners().size());
  for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f)
    for (const VertexId v : mesh.corners(FaceId(f))) corners.push_back(v);
  const auto vertices = static_cast<std::ptrdiff_t>(original_vertices_ + left);
  ProgressiveHull coarser(side_, original_vertices_,
                          PerVertex<Vec3>(std::vector<Vec3>(positions().begin(), positions().begin() + vertices)),
                          std::move(corners), {splits().begin(), splits().begin() + static_cast<std::ptrdiff_t>(left)});
  coarser.finest_level_ = finest_level_;
  return coarser;
}

ProgressiveHull ProgressiveHull::with_finest_level(FinestLevel finest_level) const {
  ProgressiveHull hull = *this;
  hull.finest_level_ = finest_level;
  return hull;
}

namespace {

std::optional<std::string> first_defect_of_base(const ProgressiveHull& hull) {
  const auto& corners = hull.base_corners();
  if (corners.size() % 3 != 0) return "the base mesh ends within a face";
  if (hull.positions().size() != hull.original_vertex_count() + hull.splits().size())
    return fmt::format("{} positions for {} original vertices and {} splits", hull.positions().size(),
                       hull.original_vertex_count(), hull.splits().size());
  for (const VertexId v : hull.positions().ids())
    if (!is_finite(hull.positions()[v])) return fmt::format("vertex {} has a coordinate that is not finite", index(v));
  TriangleMesh base;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::array<VertexId, 3> face{corners[i], corners[i + 1], corners[i + 2]};
    if (std::ranges::count(face, ProgressiveHull::kAbsent) == 3) continue;
    if (std::ranges::any_of(face, [&](VertexId v) { return index(v) >= hull.positions().size(); }))
      return fmt::format("face {} of the base mesh has a vertex that does not exist", i / 3);
    base.triangles.push_back(face);
  }
  if (base.face_count() + 2 * hull.splits().size() != hull.original_face_count())
    return fmt::format("a base mesh of {} faces and {} splits cannot make {} faces", base.face_count(),
                       hull.splits().size(), hull.original_face_count());
  base.positions = hull.positions();
  if (const MeshReport report = inspect(base); !report.is_closed_manifold()) return "base mesh: " + report.first_defect;
  return std::nullopt;
}

bool in_link(const HalfEdgeMesh& mesh, VertexId s, VertexId v) {
  for (const HalfEdgeId h : mesh.around(s))
    if (mesh.tip(h) == v) return true;
  return false;
}

bool is_possible(const HalfEdgeMesh& mesh, VertexId s, const VertexSplit& split) {
  const auto exists = [&](VertexId v) { return index(v) < mesh.positions().size(); };
  const auto absent = [&](std::uint32_t corner) {
    return corner / 3 < mesh.face_id_count() && !mesh.has(FaceId{corner / 3});
  };
  const auto& [o, d, l, r, od, do_] = split;
  return mesh.has(s) && exists(o) && exists(d) && o < s && d < s && o != d && !mesh.has(o) && !mesh.has(d) && l != r &&
         in_link(mesh, s, l) && in_link(mesh, s, r) && absent(od) && absent(do_) && od / 3 != do_ / 3;
}

}  // namespace

std::optional<std::string> first_defect(const ProgressiveHull& hull) {
  if (auto defect = first_defect_of_base(hull)) return defect;
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    const VertexId s = hull.made_vertex(i);
    if (mesh.valence(s) > ProgressiveHull::kMostValence)
      return fmt::format("split {} replaces a vertex of {} faces, and may only replace one of at most {}", i,
                         mesh.valence(s), ProgressiveHull::kMostValence);
    if (!is_possible(mesh, s, hull.splits()[i])) return fmt::format("split {} does not fit the mesh it refines", i);
    mesh.split(s, hull.splits()[i]);
  }
  return std::nullopt;
}

std::size_t faces_within(const ProgressiveHull& hull, const std::function<bool(const TriangleMesh&)>& is_within) {
  // In splits made from the base mesh: fewer than `from` are too few, `near` are enough.
  std::size_t from = 0, near = hull.splits().size();
  while (from < near) {
    const std::size_t middle = from + (near - from) / 2;
    if (is_within(hull.level(hull.base_face_count() + 2 * middle)))
      near = middle;
    else
      from = middle + 1;
  }
  return hull.base_face_count() + 2 * near;
}

std::size_t symmetric_faces(const ProgressiveHull& hull, Axis mirror, std::size_t faces) {
  const std::size_t finest = hull.original_face_count() - 2 * splits_below(hull, faces);
  for (const std::size_t n : {finest, finest - 2})
    if (n >= hull.base_face_count() && inspect_symmetry(hull.level(n), mirror).is_symmetric()) return n;
  refuse(fmt::format("the hull was not built to be symmetric along {}: {}", name_of(axis_names(), mirror),
                     inspect_symmetry(hull.base(), mirror).first_defect));
}

}  // namespace prohull
