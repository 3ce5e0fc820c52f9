#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>
#include <vector>

#include "prohull/collide.h"
#include "prohull/triangle_mesh.h"

// What FCL takes, for tests and prohull-bench.
namespace prohull::fcl_peer {

template <class Box>
std::unique_ptr<fcl::BVHModel<Box>> model_of(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  for (const auto& [i, j, k] : mesh.triangles) triangles.emplace_back(index(i), index(j), index(k));
  auto model = std::make_unique<fcl::BVHModel<Box>>();
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

inline fcl::Transform3d transform_of(const Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation[static_cast<unsigned>(i)][j];
  transform.translation() = fcl::Vector3d(pose.translation.x, pose.translation.y, pose.translation.z);
  return transform;
}

}  // namespace prohull::fcl_peer
