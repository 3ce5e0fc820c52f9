#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

#include "collide_peers.h"
#include "surface_mesh.h"

namespace prohull::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

class CgalCollision final : public CollisionPeer {
 public:
  CgalCollision(const TriangleMesh& a, const TriangleMesh& b)
      : a_(surface_mesh<Kernel::Point_3>(a)), b_(surface_mesh<Kernel::Point_3>(b)) {
    detection_.add_mesh(a_);
    detection_.add_mesh(b_);
  }

  std::string name() const override { return "CGAL exact"; }
  bool collide(const PosePair& poses) override {
    detection_.set_transformation(0, transformation(poses.a));
    detection_.set_transformation(1, transformation(poses.b));
    return !detection_.get_all_intersections_and_inclusions(0).empty();
  }

 private:
  static Kernel::Aff_transformation_3 transformation(const Pose& pose) {
    const auto& [x, y, z] = pose.rotation;
    const Vec3& t = pose.translation;
    return {x.x, x.y, x.z, t.x, y.x, y.y, y.z, t.y, z.x, z.y, z.z, t.z};
  }

  SurfaceMesh a_, b_;
  CGAL::Rigid_triangle_mesh_collision_detection<SurfaceMesh> detection_;
};

}  // namespace

std::unique_ptr<CollisionPeer> make_cgal_collision(const TriangleMesh& a, const TriangleMesh& b) {
  return std::make_unique<CgalCollision>(a, b);
}

}  // namespace prohull::bench
