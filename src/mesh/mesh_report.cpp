#include "prohull/mesh_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "geometry/no_index.h"
#include "geometry/triangle_predicates.h"
#include "prohull/detail/disjoint_sets.h"

namespace prohull {
namespace {

/// One use of an edge by a face: corner number of its tail, the vertex that is not the bucket's, and its direction.
struct EdgeUse {
  VertexId other;
  bool away;  ///< from the bucket's vertex to `other`
  std::uint32_t corner;
};

std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }

class Inspector {
 public:
  explicit Inspector(const TriangleMesh& mesh)
      : mesh_(mesh), fans_(3 * mesh.face_count()), connected_(mesh.vertex_count()), used_(mesh.vertex_count(), 0) {}

  MeshReport run() {
    report_.faces = mesh_.face_count();
    look_at_faces();
    look_at_edges();
    look_at_vertices();
    report_.box = finite_bounding_box(mesh_);
    report_.volume = signed_volume(mesh_);
    return report_;
  }

 private:
  VertexId corner(std::uint32_t c) const { return mesh_.triangles[FaceId(c / 3)][c % 3]; }

  void look_at_faces() {
    for (const FaceId f : mesh_.triangles.ids()) {
      const auto [a, b, c] = mesh_.triangles[f];
      for (const VertexId v : {a, b, c}) used_[v] = 1;
      connected_.join(index(a), index(b)), connected_.join(index(b), index(c));
      if (a == b || b == c || c == a) {
        if (++report_.repeated_corner_faces == 1)
          note(2, Defect::Malformed, fmt::format("face {} has the same vertex twice", index(f)));
        continue;
      }
      const Triangle t = mesh_.triangle(f);
      if (!(is_finite(t.a) && is_finite(t.b) && is_finite(t.c))) continue;
      if (!projection_axis(t)) ++report_.zero_area_faces;
    }
  }

  // Bucketed by the smaller vertex, in linear time.
  void look_at_edges() {
    const auto corners = static_cast<std::uint32_t>(3 * mesh_.face_count());
    std::vector<std::uint32_t> first(mesh_.vertex_count() + 1, 0);
    const auto lower = [&](std::uint32_t c) { return std::min(corner(c), corner(next_corner(c))); };
    for (std::uint32_t c = 0; c < corners; ++c) ++first[index(lower(c)) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<EdgeUse> uses(corners);
    std::vector<std::uint32_t> cursor(first.begin(), first.end() - 1);
    for (std::uint32_t c = 0; c < corners; ++c) {
      const VertexId a = corner(c), b = corner(next_corner(c));
      uses[cursor[index(std::min(a, b))]++] = {std::max(a, b), a < b, c};
    }
    long edges = 0;
    for (const VertexId v : mesh_.positions.ids()) {
      const auto begin = uses.begin() + first[index(v)], end = uses.begin() + first[index(v) + 1];
      std::sort(begin, end, [](const EdgeUse& a, const EdgeUse& b) {
        return std::pair(a.other, a.corner) < std::pair(b.other, b.corner);
      });
      for (auto i = begin; i != end; ++edges) {
        const auto j = std::find_if(i, end, [&](const EdgeUse& u) { return u.other != i->other; });
        look_at_edge(v, i, j);
        i = j;
      }
    }
    const long used = std::accumulate(used_.begin(), used_.end(), 0L);
    report_.euler_characteristic = used - edges + static_cast<long>(mesh_.face_count());
  }

  template <class Iterator>
  void look_at_edge(VertexId v, Iterator begin, Iterator end) {
    const auto where = [&] { return fmt::format("edge {}-{}", index(v), index(begin->other)); };
    const auto faces = end - begin;
    if (begin->other == v) return;  // a face with the same vertex twice
    if (faces == 1) {
      if (++report_.open_edges == 1) note(4, Defect::OpenEdge, where() + " has 1 face, expected 2");
    } else if (faces > 2) {
      if (++report_.non_manifold_edges == 1)
        note(3, Defect::NonManifoldEdge, fmt::format("{} has {} faces, expected 2", where(), faces));
    } else {
      const EdgeUse a = *begin, b = *(begin + 1);
      const bool opposed = a.away != b.away;
      if (!opposed && ++report_.misoriented_edges == 1)
        note(5, Defect::InconsistentOrientation, where() + ": its two faces disagree about which side is outside");
      const std::uint32_t a_next = next_corner(a.corner), b_next = next_corner(b.corner);
      fans_.join(a.corner, opposed ? b_next : b.corner);
      fans_.join(a_next, opposed ? b.corner : b_next);
    }
  }

  void look_at_vertices() {
    PerVertex<std::uint32_t> fan(mesh_.vertex_count(), kNone);
    PerVertex<std::uint8_t> pinched(mesh_.vertex_count(), 0);
    for (std::uint32_t c = 0; c < 3 * mesh_.face_count(); ++c) {
      std::uint32_t& known = fan[corner(c)];
      if (known == kNone) known = fans_.find(c);
      if (known != fans_.find(c)) pinched[corner(c)] = 1;
    }
    for (const VertexId v : mesh_.positions.ids()) {
      if (!used_[v]) {
        ++report_.unused_vertices;
        continue;
      }
      ++report_.vertices;
      report_.components += connected_.find(index(v)) == index(v);
      if (pinched[v] && ++report_.non_manifold_vertices == 1)
        note(6, Defect::NonManifoldVertex,
             fmt::format("vertex {}: the faces around it are more than one disk", index(v)));
      if (!is_finite(mesh_.positions[v]) && ++report_.non_finite_vertices == 1)
        note(1, Defect::NonFiniteCoordinate, fmt::format("vertex {} has a coordinate that is not finite", index(v)));
    }
  }

  void note(int rank, Defect defect, std::string text) {
    if (rank >= rank_) return;
    rank_ = rank;
    report_.worst_defect = defect;
    report_.first_defect = std::move(text);
  }

  const TriangleMesh& mesh_;
  DisjointSets fans_;  ///< of corners: joined where faces around a vertex share an edge
  DisjointSets connected_;
  PerVertex<std::uint8_t> used_;
  MeshReport report_;
  int rank_ = 100;
};

}  // namespace

std::vector<DefectCount> defect_counts(const MeshReport& report) {
  const auto defect = [](std::string_view name, std::string_view one, std::string_view many, std::size_t count,
                         bool allowed = false) {
    return DefectCount{name, count == 1 ? one : many, count, allowed};
  };
  return {defect("open_edges", "open edge", "open edges", report.open_edges),
          defect("non_manifold_edges", "edge with more than two faces", "edges with more than two faces",
                 report.non_manifold_edges),
          defect("misoriented_edges", "edge whose faces disagree about the outside",
                 "edges whose faces disagree about the outside", report.misoriented_edges),
          defect("non_manifold_vertices", "non-manifold vertex", "non-manifold vertices", report.non_manifold_vertices),
          defect("repeated_corner_faces", "face with the same vertex twice", "faces with the same vertex twice",
                 report.repeated_corner_faces),
          defect("non_finite_vertices", "vertex that is not finite", "vertices that are not finite",
                 report.non_finite_vertices),
          defect("zero_area_faces", "face without area", "faces without area", report.zero_area_faces, true),
          defect("unused_vertices", "unused vertex", "unused vertices", report.unused_vertices, true)};
}

MeshReport inspect(const TriangleMesh& mesh) { return Inspector(mesh).run(); }

}  // namespace prohull
