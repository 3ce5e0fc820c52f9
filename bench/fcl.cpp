#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "collide_peers.h"

namespace prohull::bench {
namespace {

template <class Box>
class Fcl : public CollisionPeer {
 public:
  Fcl(std::string name, const TriangleMesh& a, const TriangleMesh& b)
      : name_(std::move(name)), a_(model_of(a)), b_(model_of(b)) {}

  std::string name() const override { return name_; }
  bool collide(const PosePair& poses) override {
    fcl::CollisionResult<double> result;
    return fcl::collide(a_.get(), transform(poses.a), b_.get(), transform(poses.b), fcl::CollisionRequest<double>(),
                        result) > 0;
  }

 protected:
  using Model = fcl::BVHModel<Box>;

  static std::unique_ptr<Model> model_of(const TriangleMesh& mesh) {
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
    for (const auto& [i, j, k] : mesh.triangles) triangles.emplace_back(index(i), index(j), index(k));
    auto model = std::make_unique<Model>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
  }
  static fcl::Transform3d transform(const Pose& pose) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation[static_cast<unsigned>(i)][j];
    transform.translation() = fcl::Vector3d(pose.translation.x, pose.translation.y, pose.translation.z);
    return transform;
  }

  std::string name_;
  std::unique_ptr<Model> a_, b_;
};

class FclDistance final : public Fcl<fcl::OBBRSSd> {
 public:
  using Fcl::Fcl;

  bool collide(const PosePair& poses) override {
    fcl::DistanceResult<double> result;
    return fcl::distance(a_.get(), transform(poses.a), b_.get(), transform(poses.b), fcl::DistanceRequest<double>(),
                         result) <= 0;
  }
};

}  // namespace

std::unique_ptr<CollisionPeer> make_fcl_obb(const TriangleMesh& a, const TriangleMesh& b) {
  return std::make_unique<Fcl<fcl::OBBd>>("FCL OBB", a, b);
}
std::unique_ptr<CollisionPeer> make_fcl_obbrss(const TriangleMesh& a, const TriangleMesh& b) {
  return std::make_unique<Fcl<fcl::OBBRSSd>>("FCL OBBRSS", a, b);
}
std::unique_ptr<CollisionPeer> make_fcl_distance(const TriangleMesh& a, const TriangleMesh& b) {
  return std::make_unique<FclDistance>("FCL OBBRSS distance", a, b);
}

}  // namespace prohull::bench
