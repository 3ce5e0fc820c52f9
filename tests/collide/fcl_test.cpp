#include <fcl/narrowphase/collision.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "collide/fcl_model.h"
#include "prohull/collide.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

// FCL, with which MoveIt and Drake look for collisions, finds the contacts that collide() finds.

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::vector<FacePair> contacts(const Model& a, const Model& b, const Pose& pose_b) {
  constexpr std::size_t kAll = 1000000;
  fcl::CollisionResult<double> result;
  fcl::collide(&a, fcl::Transform3d::Identity(), &b, fcl_peer::transform_of(pose_b),
               fcl::CollisionRequest<double>(kAll, true), result);
  std::vector<fcl::Contact<double>> found;
  result.getContacts(found);
  std::vector<FacePair> pairs;
  for (const auto& contact : found) pairs.push_back({static_cast<FaceId>(contact.b1), static_cast<FaceId>(contact.b2)});
  std::ranges::sort(pairs, {}, [](const FacePair& pair) { return std::pair(index(pair.a), index(pair.b)); });
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

TEST(InFcl, ContactsAreThoseOfCollide) {
  const TriangleMesh a = make_sample("pony", 2000), b = make_sample("bracket", 1000);
  const CollisionIndex index_a(a, StandsFor::Surface), index_b(b, StandsFor::Surface);
  const auto model_a = fcl_peer::model_of<fcl::OBBRSSd>(a), model_b = fcl_peer::model_of<fcl::OBBRSSd>(b);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(-1, 1);
  constexpr int kPoses = 300;
  int touching = 0;
  for (int i = 0; i < kPoses; ++i) {
    const double w = number(random), x = number(random), y = number(random), z = number(random);
    const Vec3 to = Vec3{number(random), number(random), number(random)} * 4;
    const Pose pose = pose_of_quaternion(w, x, y, z, to);
    const auto pairs = intersecting_faces(index_a, {}, index_b, pose);
    EXPECT_EQ(contacts(*model_a, *model_b, pose), pairs) << "pose " << i;
    EXPECT_EQ(collide(index_a, {}, index_b, pose), !pairs.empty());
    touching += !pairs.empty();
  }
  EXPECT_GT(touching, kPoses / 10);
  EXPECT_LT(touching, kPoses);
}

}  // namespace
}  // namespace prohull
