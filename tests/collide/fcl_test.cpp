#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "prohull/collide.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

// FCL, with which MoveIt and Drake look for collisions, finds the contacts that collide() finds.

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::unique_ptr<Model> model_of(const TriangleMesh& mesh) {
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

fcl::Transform3d transform_of(const Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (unsigned i = 0; i < 3; ++i) {
    const Vec3& row = pose.rotation[i];
    transform.linear().row(i) << row.x, row.y, row.z;
  }
  transform.translation() = fcl::Vector3d(pose.translation.x, pose.translation.y, pose.translation.z);
  return transform;
}

std::vector<FacePair> contacts(const Model& a, const Model& b, const Pose& pose_b) {
  constexpr std::size_t kAll = 1000000;
  fcl::CollisionResult<double> result;
  fcl::collide(&a, fcl::Transform3d::Identity(), &b, transform_of(pose_b), fcl::CollisionRequest<double>(kAll, true),
               result);
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
  const auto model_a = model_of(a), model_b = model_of(b);
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
