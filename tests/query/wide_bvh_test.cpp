#include "query/wide_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>

#include "effort.h"
#include "geometry/bvh.h"
#include "meshes.h"
#include "prohull/mesh_query.h"
#include "query/awkward_segments.h"
#include "query/coherent_order.h"
#include "query/wide_trace.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

/// All that can be asked of a line.
struct Answers {
  std::vector<Hit> all;
  std::optional<Hit> first;
  bool any;
  int winding = 0;

  bool operator==(const Answers&) const = default;
};

template <class Primitive>
Answers answers_of_brute_force(MeshQuery& brute, const Primitive& primitive) {
  Answers answers{brute.all_hits(primitive), brute.first_hit(primitive), false};
  answers.any = !answers.all.empty();
  for (const Hit& hit : answers.all) answers.winding += hit.entering ? -1 : 1;
  return answers;
}

Answers answers_by(const WideTrace& by, const WideBvh& tree, const TriangleMesh& mesh, const DirectedLine& line) {
  HitCollector all(mesh, line, HitMode::All), first(mesh, line, HitMode::First), any(mesh, line, HitMode::Any),
      winding(mesh, line, HitMode::All);
  any.ask_only(HitCollector::Only::Whether);
  winding.ask_only(HitCollector::Only::Winding);
  for (HitCollector* const hits : {&all, &first, &any, &winding}) by.trace(tree, line, *hits);
  Answers answers{{}, first.best(), any.has_any(), winding.winding()};
  all.append_all(answers.all);
  return answers;
}

void expect_hits_of_brute_force(const TriangleMesh& mesh, const std::vector<Segment>& segments) {
  const WideBvh tree(mesh);
  MeshQuery brute{QueryIndex(mesh, Engine::Brute)};
  std::size_t hits = 0;
  for (const Segment& s : segments) {
    if (s.a == s.b) continue;
    const Answers truth = answers_of_brute_force(brute, s);
    hits += truth.all.size();
    for (const WideTrace& by : wide_traces())
      ASSERT_EQ(answers_by(by, tree, mesh, DirectedLine(s)), truth) << by.instructions;
  }
  EXPECT_GT(hits, segments.size() / 10);
}

/// Also of points whose closest face is known within a quantum of the leaf, and of points far away.
void expect_closest_of_brute_force(const TriangleMesh& mesh, const std::vector<Segment>& segments) {
  const WideBvh tree(mesh);
  MeshQuery brute{QueryIndex(mesh, Engine::Brute)};
  for (const Segment& s : segments)
    for (const Vec3& p : {s.a, s.b, s.a * 0.5 + s.b * 0.5, s.b + (s.b - s.a) * 1e8, s.b + (s.b - s.a) * 1e200}) {
      const auto truth = brute.closest_point(p);
      std::optional<double> lower;
      for (const WideTrace& by : wide_traces()) {
        ClosestCollector closest(mesh, p, std::numeric_limits<double>::infinity());
        by.trace_nearest(tree, closest);
        const auto best = closest.best();
        ASSERT_TRUE(best) << by.instructions;
        ASSERT_EQ(best->face, truth->face) << by.instructions;
        ASSERT_EQ(best->position, truth->position) << by.instructions;
        ASSERT_EQ(best->upper, truth->upper) << by.instructions;
        ASSERT_EQ(best->lower, lower.value_or(best->lower)) << by.instructions;
        lower = best->lower;
      }
    }
}

TEST(WideTrace, FindsTheClosestFaceWithEveryInstructionSet) {
  for (const double size : {0x1p-300, 1.0, 0x1p300})
    for (const TriangleMesh& mesh : {octahedron(), torus(24, 16), soup(sphere(2))})
      expect_closest_of_brute_force(scaled(mesh, size), awkward_segments(scaled(mesh, size), rounds(50), test_seed()));
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const TriangleMesh speck = moved(scaled(sphere(2), size), {0.7, -0.9, 0.8});
    expect_closest_of_brute_force(together(octahedron(), speck), awkward_segments(speck, rounds(50), test_seed()));
  }
}

TEST(WideTrace, IsTheSameWithEveryInstructionSet) {
  ASSERT_EQ(wide_traces().front().instructions, "baseline");
  for (const TriangleMesh& mesh :
       {octahedron(), torus(24, 16), together(sphere(1), moved(sphere(2), {3, 0, 0})), soup(sphere(2))})
    expect_hits_of_brute_force(mesh, awkward_segments(mesh, rounds(1000), test_seed()));
}

// Faces so small, and so far from the middle of the mesh, that their corners are one point in float32.
TEST(WideTrace, MissesNothingSmallFarFromTheMiddle) {
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const TriangleMesh speck = moved(scaled(sphere(2), size), {0.7, -0.9, 0.8});
    const std::vector<Segment> segments = awkward_segments(speck, rounds(500), test_seed());
    expect_hits_of_brute_force(together(octahedron(), speck), segments);
  }
}

TEST(WideTrace, HoldsForLinesFromFarAwayAndAlongAxes) {
  const TriangleMesh mesh = sphere(2);
  std::vector<Segment> segments;
  for (const Segment& s : awkward_segments(mesh, rounds(500), test_seed())) {
    const Vec3 d = s.b - s.a;
    for (const double far : {1e3, 1e8, 1e15}) segments.push_back({s.a - far * d, s.b + far * d});
    for (int axis = 0; axis < 3; ++axis) {
      Segment along{s.a, s.a};
      along.a[axis] = -4, along.b[axis] = 1e-40 + 4;
      segments.push_back(along);
    }
  }
  expect_hits_of_brute_force(mesh, segments);
}

// The leaf is so little below 2 large that 16 bits would not do for a quantum of 2^-15.
TEST(WideTrace, HoldsForALeafOfAllButAPowerOfTwo) {
  const TriangleMesh mesh = scaled(octahedron(), 1 - 0x1p-18);
  expect_hits_of_brute_force(mesh, awkward_segments(mesh, rounds(1000), test_seed()));
}

// Scales whose squares and cubes overflow and underflow.
TEST(WideTrace, HoldsForHugeAndTinyMeshes) {
  for (const double size : {0x1p-1000, 0x1p-300, 0x1p300, 0x1p1000}) {
    const TriangleMesh mesh = scaled(torus(12, 8), size);
    expect_hits_of_brute_force(mesh, awkward_segments(mesh, rounds(200), test_seed()));
  }
}

// Directions so long or so short that the frame cannot hold them, or not all of their coordinates.
TEST(WideTrace, HoldsForDirectionsOfAnotherSizeThanTheMesh) {
  for (const double size : {0x1p-1000, 1.0, 0x1p1000}) {
    const TriangleMesh mesh = scaled(torus(12, 8), size);
    const WideBvh tree(mesh);
    MeshQuery brute{QueryIndex(mesh, Engine::Brute)};
    std::size_t hits = 0;
    for (const Segment& s : awkward_segments(mesh, rounds(60), test_seed()))
      for (const double length : {0x1p-1000, 0x1p-100, 0x1p30, 0x1p1000}) {
        const Vec3 d = (s.b - s.a) / size * length;
        for (const Ray& ray : {Ray{s.a, d}, Ray{s.a, {d.x, d.y * 0x1p-20, 0}}}) {
          if (DirectedLine(ray).is_a_point() || !is_finite(ray.direction)) continue;
          const Answers truth = answers_of_brute_force(brute, ray);
          const bool has_places =
              std::ranges::all_of(truth.all, [](const Hit& hit) { return is_finite(hit.position); });
          if (!has_places) continue;  // t is beyond all doubles
          hits += truth.all.size();
          for (const WideTrace& by : wide_traces()) ASSERT_EQ(answers_by(by, tree, mesh, DirectedLine(ray)), truth);
        }
      }
    EXPECT_GT(hits, std::size_t(rounds(60)) / 10);
  }
}

TEST(WideBvh, HasEveryFaceOnceInTheNodesOfAnEnormousBox) {
  const TriangleMesh mesh = torus(60, 40);
  std::vector<int> seen(mesh.face_count());
  const double far = 1e300;
  WideBvh(mesh).visit(Box{{-far, -far, -far}, {far, far, far}},
                      [&](FaceId f, const Triangle&) { return ++seen[index(f)], true; });
  for (const int times : seen) ASSERT_EQ(times, 1);
}

TEST(WideBvh, VisitsEveryFaceWhoseBoxOverlaps) {
  const TriangleMesh mesh = together(torus(24, 16), moved(scaled(sphere(0), 1e-9), {0.7, -0.9, 0.8}));
  const WideBvh tree(mesh);
  std::mt19937 random(test_seed());
  std::size_t overlaps = 0, visits = 0;
  for (int i = 0; i < rounds(1000); ++i) {
    const Triangle t = mesh.triangle(FaceId(static_cast<std::uint32_t>(random() % mesh.face_count())));
    Box box;
    box.extend(t.a), box.extend(i % 2 ? t.b : t.a);
    std::vector<char> visited(mesh.face_count());
    tree.visit(box, [&](FaceId f, const Triangle&) { return visited[index(f)] = true, ++visits, true; });
    for (const FaceId f : mesh.triangles.ids()) {
      const bool overlapping = box.overlaps(box_of(mesh.triangle(f)));
      ASSERT_TRUE(visited[index(f)] || !overlapping);
      overlaps += overlapping;
    }
  }
  EXPECT_LT(visits, 3 * overlaps);  // of the speck all faces are visited for each of them
}

// Large enough for the parts that are built in parallel.
TEST(WideBvh, IsTheSameTreeInEveryBuild) {
  const TriangleMesh mesh = torus(effort(300u, 60u), effort(250u, 50u));
  MeshQuery one{QueryIndex(mesh)}, other{QueryIndex(mesh)};
  for (const Segment& s : awkward_segments(mesh, rounds(1000), test_seed()))
    ASSERT_EQ(one.any_hit(s), other.any_hit(s));
}

TEST(CoherentOrder, ChangesNoAnswerOfABatch) {
  const TriangleMesh mesh = torus(effort(220u, 220u), 200);
  const QueryIndex index(mesh);
  std::mt19937 random(test_seed());
  std::vector<Ray> rays;
  std::vector<Vec3> points;
  while (rays.size() < 5000) {
    const Triangle t = mesh.triangle(FaceId(static_cast<std::uint32_t>(random() % mesh.face_count())));
    points.push_back((t.a + t.b) * 0.45);
    rays.push_back({points.back(), t.c - t.b});
  }
  ASSERT_FALSE(coherent_order(std::span<const Ray>(rays), bounding_box(mesh)).empty());
  const HitBatch all = find_hits(index, rays, HitMode::All);
  const std::vector<bool> inside = contains(index, points);
  MeshQuery query(index);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hits = std::span(all.hits).subspan(all.offsets[i], all.offsets[i + 1] - all.offsets[i]);
    ASSERT_TRUE(std::ranges::equal(hits, query.all_hits(rays[i]))) << i;
    ASSERT_EQ(inside[i], query.contains(points[i])) << i;
  }
}

TEST(CoherentOrder, LeavesQueriesFromOutsideAsTheyCome) {
  const std::vector<Ray> rays(5000, Ray{{9, 9, 9}, {-1, -1, -1}});
  EXPECT_TRUE(coherent_order(std::span<const Ray>(rays), bounding_box(octahedron())).empty());
}

TEST(CoherentOrder, LeavesQueriesThatStartTogetherAsTheyCome) {
  const TriangleMesh mesh = octahedron();
  std::vector<Ray> rays, mixed;
  for (int i = 0; i < 5000; ++i) rays.push_back({{-0.4 + 1e-4 * i, 0, 0}, {0, 1, 0}});
  for (int i = 0; i < 5000; ++i) mixed.push_back(rays[static_cast<std::size_t>(i * 1999 % 5000)]);
  EXPECT_TRUE(coherent_order(std::span<const Ray>(rays), bounding_box(mesh)).empty());
  EXPECT_FALSE(coherent_order(std::span<const Ray>(mixed), bounding_box(mesh)).empty());
}

TEST(CoherentOrder, HasKeysForTheLongestSegments) {
  const double far = 1.7e308;
  EXPECT_LT(departure_key(departure(Segment{{-far, far, 0}, {far, -far, 0}}), bounding_box(octahedron())), 1u << 24);
}

TEST(CoherentOrder, IsStable) {
  const std::vector<std::uint32_t> keys{5, 1 << 20, 5, 0, (1 << 24) - 1, 1 << 20};
  EXPECT_EQ(order_of_keys(keys), (std::vector<std::uint32_t>{3, 0, 2, 1, 5, 4}));
}

}  // namespace
}  // namespace prohull
