#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <memory>
#include <regex>
#include <vector>

#include "io/file.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "random.h"
#include "robot/robot_testing.h"

namespace prohull::robot {
namespace {

namespace fs = std::filesystem;

// Bullet makes convex hulls of what `prohull convex --for bullet` writes, as its importer of URDF does, which Debian
// does not have. The test names the meshes to it that the URDF file names.

constexpr int kBalls = 200;
constexpr double kRadius = 0.05;
constexpr double kStep = 1.0 / 400, kTime = 4;
constexpr int kBallGroup = 1, kPartGroup = 2;  // balls pass through each other

std::vector<std::unique_ptr<btConvexHullShape>> pieces_of(const fs::path& urdf) {
  const std::string text = read_file(urdf);
  const std::regex named("filename=\"([^\"]*)\"");
  std::vector<std::unique_ptr<btConvexHullShape>> pieces;
  for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at) {
    pieces.push_back(std::make_unique<btConvexHullShape>());
    pieces.back()->setMargin(0);
    for (const Vec3& p : read_mesh(urdf.parent_path() / (*at)[1].str()).positions)
      pieces.back()->addPoint(btVector3(btScalar(p.x), btScalar(p.y), btScalar(p.z)), false);
    pieces.back()->recalcLocalAabb();
  }
  return pieces;
}

/// Balls that fall on something that does not move.
class Fall {
 public:
  explicit Fall(const Box& above) : ball_(btScalar(kRadius)) {
    world_.setGravity(btVector3(0, 0, -1));
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> at(0, 1);
    for (int i = 0; i < kBalls; ++i) {
      const double x = above.min.x + at(random) * (above.max.x - above.min.x);
      const double y = above.min.y + at(random) * (above.max.y - above.min.y);
      balls_.push_back(std::make_unique<btRigidBody>(1, nullptr, &ball_, btVector3(0, 0, 0)));
      balls_.back()->setWorldTransform(btTransform(
          btQuaternion::getIdentity(), btVector3(btScalar(x), btScalar(y), btScalar(above.max.z + 2 * kRadius))));
      balls_.back()->setActivationState(DISABLE_DEACTIVATION);
      world_.addRigidBody(balls_.back().get(), kBallGroup, kPartGroup);
    }
  }
  ~Fall() {
    for (const auto& body : balls_) world_.removeRigidBody(body.get());
    if (part_) world_.removeRigidBody(part_.get());
  }
  Fall(const Fall&) = delete;
  Fall& operator=(const Fall&) = delete;

  void add(btCollisionShape& shape) {
    part_ = std::make_unique<btRigidBody>(0, nullptr, &shape);
    world_.addRigidBody(part_.get(), kPartGroup, kBallGroup);
  }

  /// How many come to have their centre inside of the mesh.
  std::size_t inside(const TriangleMesh& mesh) {
    const QueryIndex index(mesh);
    MeshQuery query(index);
    std::vector<bool> is_inside(balls_.size());
    for (double time = 0; time < kTime; time += kStep) {
      world_.stepSimulation(btScalar(kStep), 0);
      for (std::size_t i = 0; i < balls_.size(); ++i) {
        const btVector3& p = balls_[i]->getWorldTransform().getOrigin();
        is_inside[i] = is_inside[i] || query.contains({p.x(), p.y(), p.z()});
      }
    }
    return static_cast<std::size_t>(std::ranges::count(is_inside, true));
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btSphereShape ball_;
  std::vector<std::unique_ptr<btRigidBody>> balls_;
  std::unique_ptr<btRigidBody> part_;
};

TEST(InBullet, NoBallPassesThroughConvexPieces) {
  const TemporaryFolder folder;
  const TriangleMesh part = make_sample("bracket", 3000);
  write_mesh(folder / "part.stl", part);
  const std::string command = fmt::format("cd '{}' && '{}' convex part.stl --pieces 8 --for bullet -o pieces.urdf >out",
                                          folder.path().string(), PROHULL_PROGRAM);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto pieces = pieces_of(folder / "pieces.urdf");
  ASSERT_GE(pieces.size(), 4u);
  btCompoundShape shape;
  for (const auto& piece : pieces) shape.addChildShape(btTransform::getIdentity(), piece.get());
  Fall onto_pieces(bounding_box(part));
  onto_pieces.add(shape);
  EXPECT_EQ(onto_pieces.inside(part), 0u);
  EXPECT_GT(Fall(bounding_box(part)).inside(part), kBalls / 2u) << "nothing stops them";
}

}  // namespace
}  // namespace prohull::robot
