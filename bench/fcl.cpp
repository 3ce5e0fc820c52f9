#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "collide/fcl_model.h"
#include "collide_peers.h"

namespace prohull::bench {
namespace {

template <class Box>
class Fcl : public CollisionPeer {
 public:
  Fcl(std::string name, const TriangleMesh& a, const TriangleMesh& b)
      : name_(std::move(name)), a_(fcl_peer::model_of<Box>(a)), b_(fcl_peer::model_of<Box>(b)) {}

  std::string name() const override { return name_; }
  bool collide(const PosePair& poses) override {
    fcl::CollisionResult<double> result;
    return fcl::collide(a_.get(), fcl_peer::transform_of(poses.a), b_.get(), fcl_peer::transform_of(poses.b),
                        fcl::CollisionRequest<double>(), result) > 0;
  }

 protected:
  using Model = fcl::BVHModel<Box>;

  std::string name_;
  std::unique_ptr<Model> a_, b_;
};

class FclDistance final : public Fcl<fcl::OBBRSSd> {
 public:
  using Fcl::Fcl;

  bool collide(const PosePair& poses) override {
    fcl::DistanceResult<double> result;
    return fcl::distance(a_.get(), fcl_peer::transform_of(poses.a), b_.get(), fcl_peer::transform_of(poses.b),
                         fcl::DistanceRequest<double>(), result) <= 0;
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
