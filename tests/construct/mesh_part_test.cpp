#include "prohull/detail/mesh_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "effort.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  return box;
}

/// Four boxes around a line along z.
std::array<Box, 4> quarters(double x, double y) {
  const auto box = [](double x0, double y0, double x1, double y1) {
    return Box{{x0, y0, -kInfinity}, {x1, y1, kInfinity}};
  };
  return {box(-kInfinity, -kInfinity, x, y), box(x, -kInfinity, kInfinity, y), box(-kInfinity, y, x, kInfinity),
          box(x, y, kInfinity, kInfinity)};
}

std::size_t home_of(const Triangle& t, double x, double y) {
  const Vec3 center = (t.a + t.b + t.c) * (1.0 / 3);
  return (center.x >= x ? 1u : 0u) + (center.y >= y ? 2u : 0u);
}

TriangleMesh simplified_in_parts(const TriangleMesh& mesh, const HullOptions& options) {
  const Vec3 at = bounding_box(mesh).center();
  const auto boxes = quarters(at.x, at.y);
  TriangleMesh joined{mesh.positions, {}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    MeshPart part{{mesh.positions, {}}, 0, boxes[i]};
    for (const bool is_own : {true, false})
      for (const FaceId f : mesh.triangles.ids()) {
        const Triangle t = mesh.triangle(f);
        if ((home_of(t, at.x, at.y) == i) != is_own || !box_of(t).overlaps(boxes[i])) continue;
        part.mesh.triangles.push_back(mesh.triangles[f]);
        if (is_own) ++part.own_faces;
      }
    const SimplifiedPart made = simplify_part(part, options);
    std::vector<VertexId> numbers = made.kept;
    for (auto v = static_cast<std::uint32_t>(numbers.size()); v < made.mesh.vertex_count(); ++v)
      numbers.push_back(joined.positions.push_back(made.mesh.positions[VertexId{v}]));
    for (const auto& [a, b, c] : made.mesh.triangles)
      joined.triangles.push_back({numbers[index(a)], numbers[index(b)], numbers[index(c)]});
  }
  return joined;
}

TEST(MeshPart, PartsMakeUpAHullOfTheWhole) {
  const TriangleMesh mesh = make_sample("pony", effort(40000, 6000));
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    HullOptions options{.target_faces = mesh.face_count() / 80, .side = side, .threads = 2};
    const TriangleMesh joined = simplified_in_parts(mesh, options);
    EXPECT_LT(joined.face_count(), effort(6000u, 3000u));
    EXPECT_TRUE(inspect(joined).is_closed_manifold()) << inspect(joined).first_defect;
    EXPECT_EQ(count_self_intersections(joined), count_self_intersections(mesh));
    EXPECT_TRUE(side == HullSide::Outer ? verify_enclosure(mesh, joined).encloses
                                        : verify_enclosure(joined, mesh).encloses);
    options.threads = 1;
    const TriangleMesh alone = simplified_in_parts(mesh, options);
    EXPECT_TRUE(std::ranges::equal(alone.positions, joined.positions) &&
                std::ranges::equal(alone.triangles, joined.triangles));
  }
}

TEST(MeshPart, KeepsWhatItsBoxDoesNotHold) {
  const TriangleMesh ball = meshes::sphere(effort(4, 3));
  const SimplifiedPart made = simplify_part({ball, ball.face_count(), quarters(0, 0)[0]}, {.target_faces = 4});
  const auto is_beside = [](const Vec3& p) { return p.x >= 0 || p.y >= 0; };
  EXPECT_TRUE(inspect(made.mesh).is_closed_manifold());
  EXPECT_LT(made.mesh.face_count(), ball.face_count());
  EXPECT_TRUE(std::ranges::is_sorted(made.kept));
  for (const VertexId v : made.mesh.positions.ids()) {
    const Vec3& p = made.mesh.positions[v];
    if (index(v) < made.kept.size())
      EXPECT_EQ(p, ball.positions[made.kept[index(v)]]);
    else
      EXPECT_FALSE(is_beside(p));
  }
  EXPECT_EQ(std::ranges::count_if(made.mesh.positions, is_beside), std::ranges::count_if(ball.positions, is_beside));
}

TEST(MeshPart, IsRefusedWithoutFacesThatItNeeds) {
  const Box everywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const auto is_refused = [&](const TriangleMesh& mesh) {
    try {
      simplify_part({mesh, 1, everywhere});
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  const TriangleMesh ball = meshes::sphere(2);
  EXPECT_FALSE(is_refused(ball));
  TriangleMesh open = ball;
  open.triangles.pop_back();
  EXPECT_TRUE(is_refused(open));
  TriangleMesh doubled = ball;
  for (const auto& t : ball.triangles) doubled.triangles.push_back(t);
  EXPECT_TRUE(is_refused(doubled));
  TriangleMesh pinched = meshes::tetrahedron();  // twice, with one corner in common
  for (const auto& [a, b, c] : meshes::tetrahedron().triangles) {
    const auto other = [](VertexId v) { return index(v) == 0 ? v : VertexId{index(v) + 3}; };
    pinched.triangles.push_back({other(a), other(b), other(c)});
  }
  for (const Vec3& p : {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) pinched.positions.push_back(p);
  EXPECT_TRUE(is_refused(pinched));
}

TEST(MeshPart, RefusesWrongOptions) {
  const TriangleMesh ball = meshes::sphere(2);
  const Box box = bounding_box(ball);
  EXPECT_THROW(simplify_part({ball, ball.face_count() + 1, box}), InputError);
  EXPECT_THROW(simplify_part({ball, ball.face_count(), Box{}}), InputError);
  EXPECT_THROW(simplify_part({ball, ball.face_count(), box}, {.strategy = Strategy::Paper1}), InputError);
  EXPECT_THROW(simplify_part({ball, ball.face_count(), box}, {.tolerances = PerFace<double>(1)}), InputError);
  EXPECT_THROW(simplify_part({ball, ball.face_count(), box}, {.target_faces = 3}), InputError);
  TriangleMesh infinite = ball;
  infinite.positions[VertexId{0}].x = kInfinity;
  EXPECT_THROW(simplify_part({infinite, infinite.face_count(), box}), InputError);
  EXPECT_EQ(simplify_part({ball, 0, box}).mesh.face_count(), 0u);
}

}  // namespace
}  // namespace prohull
