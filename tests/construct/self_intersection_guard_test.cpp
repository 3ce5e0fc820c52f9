#include "construct/guard/self_intersection_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "construct/guard/fan.h"
#include "effort.h"
#include "geometry/triangle_intersection.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

using Corners = std::array<VertexId, 3>;

Triangle triangle(const HalfEdgeMesh& mesh, const Corners& corners) {
  return {mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2])};
}

/// Pairs of `faces` that meet, and pairs of one of them and a face of the mesh without a corner at o or d.
std::size_t pairs(const HalfEdgeMesh& mesh, VertexId o, VertexId d, const std::vector<Triangle>& faces) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) count += triangles_intersect(faces[i], faces[j]);
  for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f) {
    if (!mesh.has(FaceId{f})) continue;
    const Corners corners = mesh.corners(FaceId{f});
    if (std::ranges::any_of(corners, [&](VertexId v) { return v == o || v == d; })) continue;
    for (const Triangle& t : faces) count += triangles_intersect(t, triangle(mesh, corners));
  }
  return count;
}

std::vector<Triangle> fan(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, const Vec3& apex) {
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < link.size(); ++i)
    faces.push_back({apex, mesh.position(link[i]), mesh.position(link[(i + 1) % link.size()])});
  return faces;
}

std::vector<VertexId> link_of(const HalfEdgeMesh& mesh, VertexId v) {
  std::vector<VertexId> link;
  HalfEdgeId h = mesh.out(v);
  do {
    link.push_back(mesh.tip(h));
    h = mesh.rotated(h);
  } while (h != mesh.out(v));
  return link;
}

bool adds_pairs(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex) {
  std::vector<Triangle> before;
  for (const VertexId end : {star.o, star.d}) {
    HalfEdgeId h = mesh.out(end);
    do {
      const Corners corners = mesh.corners(FaceId{index(h) / 3});
      if (end == star.o || std::ranges::find(corners, star.o) == corners.end())
        before.push_back(triangle(mesh, corners));
      h = mesh.rotated(h);
    } while (h != mesh.out(end));
  }
  return pairs(mesh, star.o, star.d, fan(mesh, star.link, apex)) > pairs(mesh, star.o, star.d, before);
}

bool adds_pairs(const HalfEdgeMesh& mesh, VertexId v, const std::vector<VertexId>& link, const Vec3& to) {
  return pairs(mesh, v, v, fan(mesh, link, to)) > pairs(mesh, v, v, fan(mesh, link, mesh.position(v)));
}

struct Random {
  std::mt19937 engine{test_seed()};
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return {normal(engine), normal(engine), normal(engine)};
  }
  std::size_t below(std::size_t n) { return engine() % n; }
};

/// A point about as far from `p` as `reach`; now and then in a plane or at a vertex of the mesh.
Vec3 point_near(Random& random, const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, const Vec3& p,
                double reach) {
  const auto some = [&] { return mesh.position(link[random.below(link.size())]); };
  switch (random.below(4)) {
    case 0:
      return some() * 0.5 + some() * 0.5;
    case 1:
      return p;
    default:
      return p + random.direction() * (reach * std::exp2(-static_cast<double>(random.below(6))));
  }
}

std::vector<TriangleMesh> meshes_to_change() {
  return {sphere(2),
          torus(12, 8),
          together(sphere(2), moved(sphere(2), {1.7, 0, 0})),
          make_sample("pony", 600),
          make_sample("bracket", 500),
          scaled(make_sample("knot", 600), 0x1p-100)};
}

// While the mesh is simplified and its vertices are moved, with new pairs every now and then.
TEST(SelfIntersectionGuard, AgreesWithExactTestsOfAllPairs) {
  Random random;
  int added = 0, kept = 0;
  for (const TriangleMesh& original : meshes_to_change()) {
    HalfEdgeMesh mesh(original);
    SelfIntersectionGuard guard(mesh, faces_along_curve(mesh));
    const auto count = [&](bool adds) {
      ++(adds ? added : kept);
      return adds;
    };
    for (int i = 0; i < rounds(200); ++i) {
      const EdgeId edge{static_cast<std::uint32_t>(random.below(mesh.edge_id_count()))};
      if (!mesh.has(edge)) continue;
      Star star;
      gather_star(mesh, edge, star);
      const Vec3 middle = mesh.position(star.o) * 0.5 + mesh.position(star.d) * 0.5;
      const double reach = 3 * norm(mesh.position(star.o) - mesh.position(star.d));
      const Vec3 apex = point_near(random, mesh, star.link, middle, reach);
      const bool adds = count(adds_pairs(mesh, star, apex));
      ASSERT_EQ(guard.would_add_intersections(mesh, star, apex), adds);
      if (satisfies_link_condition(star) && mesh.face_count() > 20 && (!adds || random.below(10) == 0)) {
        guard.collapsed(mesh, mesh.collapse(star.edge, apex));
      }

      const VertexId v = mesh.corners(FaceId{index(mesh.out(star.link[0])) / 3})[0];
      const std::vector<VertexId> link = link_of(mesh, v);
      const Vec3 to = point_near(random, mesh, link, mesh.position(v), reach / 3);
      const bool adds_too = count(adds_pairs(mesh, v, link, to));
      ASSERT_EQ(guard.would_add_intersections(mesh, v, link, to), adds_too);
      if (!adds_too) {
        mesh.move(v, to);
        guard.changed(mesh, v);
      }
    }
  }
  EXPECT_GT(added, rounds(20));
  EXPECT_GT(kept, rounds(20));
}

TEST(SelfIntersectionGuard, AgreesWithCountsOfWholeMeshesOnFlips) {
  Random random;
  std::size_t added = 0, not_added = 0;
  for (const TriangleMesh& original : {sphere(2), make_sample("bracket", 300), make_sample("knot", 300),
                                       together(sphere(1), moved(sphere(1), {1.7, 0, 0}))}) {
    HalfEdgeMesh mesh(original);
    SelfIntersectionGuard guard(mesh, faces_along_curve(mesh));
    for (int i = 0; i < effort(150, 60); ++i) {
      const HalfEdgeId h = mesh.half_edge(EdgeId{static_cast<std::uint32_t>(random.below(mesh.edge_id_count()))});
      if (!mesh.can_flip(h)) continue;
      const std::size_t before = count_self_intersections(mesh.triangle_mesh());
      const bool adds = guard.would_add_intersections(mesh, h);
      mesh.flip(h);
      ASSERT_EQ(adds, count_self_intersections(mesh.triangle_mesh()) > before);
      ++(adds ? added : not_added);
      if (adds && random.below(4) != 0)
        for (int k = 0; k < 3; ++k) mesh.flip(h);
      guard.changed(mesh, mesh.tail(h)), guard.changed(mesh, mesh.tip(h));
    }
  }
  EXPECT_GT(added, 0u);
  EXPECT_GT(not_added, 0u);
}

// Faces around a star of a smooth mesh are told apart from it without an exact test: that is what the fan is for.
TEST(Fan, IsCertainWhereverThereIsNoDoubt) {
  for (const double scale : {1.0, 0x1p-150, 0x1p250}) {
    const HalfEdgeMesh mesh(scaled(sphere(3), scale));
    std::size_t certain = 0, all = 0;
    for (std::uint32_t e = 0; e < mesh.edge_id_count(); ++e) {
      Star star;
      gather_star(mesh, EdgeId{e}, star);
      Fan fan;
      fan.set(mesh, star.link, 1.02 * (mesh.position(star.o) * 0.5 + mesh.position(star.d) * 0.5));
      EXPECT_TRUE(fan.is_certainly_embedded()) << e;
      for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f) {
        const Corners corners = mesh.corners(FaceId{f});
        if (std::ranges::any_of(corners, [&](VertexId v) { return v == star.o || v == star.d; })) continue;
        certain += fan.perhaps_met(mesh, corners) == 0;
        ++all;
      }
    }
    EXPECT_EQ(certain, all) << "scale " << scale;
  }
}

// Triangles upright on the middle of an edge of the link, and inside of its wall by a part of it that float32 hardly
// tells.
TEST(Fan, LeavesTrianglesToTheExactTestThatReachInByLittle) {
  Random random;
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  const std::vector<VertexId> link{VertexId{0}, VertexId{1}, VertexId{2}, VertexId{3}, VertexId{4}};
  std::size_t met = 0;
  for (int round = 0; round < rounds(1000); ++round) {
    std::vector<Vec3> positions;
    for (const double first = turn(random.engine); positions.size() < link.size();) {
      const double angle = first + 2 * std::numbers::pi / 5 * static_cast<double>(positions.size());
      positions.push_back({std::cos(angle), std::sin(angle), 0});
    }
    const Vec3 apex{0.2, 0.1, 0.3}, middle = (positions[0] + positions[1]) * 0.5,
                                    corner = middle * (1 - std::exp2(-20.0 - static_cast<double>(random.below(20))));
    positions.insert(positions.end(), {corner - Vec3{0, 0, 1}, corner + Vec3{0, 0, 1}, middle * 3});
    const HalfEdgeMesh mesh(PerVertex<Vec3>(positions), {});
    Fan fan;
    fan.set(mesh, link, apex);
    ASSERT_TRUE(fan.is_certainly_embedded());
    const Corners corners{VertexId{5}, VertexId{6}, VertexId{7}};
    if (!triangles_intersect({apex, positions[0], positions[1]}, triangle(mesh, corners))) continue;
    ++met;
    ASSERT_EQ(fan.perhaps_met(mesh, corners) & 1, 1u) << round;
  }
  EXPECT_GT(met, std::size_t(rounds(900)));
}

TEST(Fan, IsNotEmbeddedIfTheLinkTurnsTwice) {
  std::vector<Vec3> positions;
  std::vector<VertexId> link;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi / 2 * i + 0.1;
    positions.push_back({std::cos(angle), std::sin(angle), 0.05 * i});
    link.push_back(VertexId{i});
  }
  const HalfEdgeMesh mesh(PerVertex<Vec3>(positions), {});
  Fan fan;
  fan.set(mesh, link, {0, 0, -1});
  EXPECT_FALSE(fan.is_certainly_embedded());
  fan.set(mesh, {link[0], link[1], link[2], link[3]}, {0, 0, -1});
  EXPECT_TRUE(fan.is_certainly_embedded());
}

}  // namespace
}  // namespace prohull
