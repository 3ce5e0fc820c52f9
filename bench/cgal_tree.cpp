#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iterator>
#include <vector>

#include "query_peers.h"

namespace prohull::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

class CgalTree final : public QueryPeer {
 public:
  explicit CgalTree(const TriangleMesh& mesh) {
    triangles_.reserve(mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      triangles_.emplace_back(point(t.a), point(t.b), point(t.c));
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  // It knows the first intersection of rays only; one beyond the end of the segment does not count.
  std::optional<PeerHit> first_hit(const Segment& segment) override {
    const Kernel::Point_3 a = point(segment.a), b = point(segment.b);
    const auto found = tree_.first_intersection(Kernel::Ray_3(a, b));
    if (!found) return std::nullopt;
    const double t = parameter(found->first, a, b);
    if (t > 1) return std::nullopt;
    return PeerHit{face(found->second), t};
  }

  bool any_hit(const Segment& segment) override { return tree_.do_intersect(query(segment)); }

  std::span<const PeerHit> all_hits(const Segment& segment) override {
    found_.clear();
    tree_.all_intersections(query(segment), std::back_inserter(found_));
    hits_.clear();
    for (const auto& [place, triangle] : found_)
      hits_.push_back({face(triangle), parameter(place, point(segment.a), point(segment.b))});
    return hits_;
  }

 private:
  /// Of a point, or of the start of a segment.
  template <class Place>
  static double parameter(const Place& place, const Kernel::Point_3& a, const Kernel::Point_3& b) {
    const auto* at = boost::get<Kernel::Point_3>(&place);
    const Kernel::Point_3 where = at ? *at : boost::get<Kernel::Segment_3>(place).source();
    return (where - a) * (b - a) / (b - a).squared_length();
  }
  FaceId face(Triangles::const_iterator triangle) const {
    return FaceId(static_cast<std::uint32_t>(triangle - triangles_.begin()));
  }
  static Kernel::Segment_3 query(const Segment& s) { return {point(s.a), point(s.b)}; }

  Triangles triangles_;
  Tree tree_;
  std::vector<Tree::Intersection_and_primitive_id<Kernel::Segment_3>::Type> found_;
  std::vector<PeerHit> hits_;
};

}  // namespace

std::unique_ptr<QueryPeer> make_cgal_tree(const TriangleMesh& mesh) { return std::make_unique<CgalTree>(mesh); }

}  // namespace prohull::bench
