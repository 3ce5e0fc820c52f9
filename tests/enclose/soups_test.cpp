#include "soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "effort.h"
#include "few_trials.h"
#include "geometry/float32.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/verification.h"
#include "random.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

using meshes::Soup;
using meshes::SoupMaker;

/// Exact, and independent of src/geometry and src/verify.
class Judge {
 public:
  explicit Judge(const TriangleMesh& mesh) : chain_(mesh), reach_(bounding_box(mesh).diagonal()) {}

  /// Nothing on the surface.
  std::optional<int> winding_number(const oracle::Point& x, SoupMaker& random) const {
    for (int tries = 0; tries < 16; ++tries) {
      // Far away: few cones from there hold the point.
      const oracle::Exact::Vector_3 aside(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      if (const auto number = oracle::winding(chain_, x + aside * oracle::Exact::FT(64 * reach_), x)) return number;
    }
    return std::nullopt;
  }

  bool holds(const oracle::Point& x, SoupMaker& random) const { return winding_number(x, random).value_or(1) >= 1; }

  /// A point on a face.
  oracle::Point on_a_face(SoupMaker& random) const {
    const auto& [a, b, c] = chain_.faces[static_cast<std::size_t>(random.uniform(0, int(chain_.faces.size()) - 1))];
    return CGAL::barycenter(a, random.uniform(0, 9), b, random.uniform(0, 9), c, random.uniform(1, 9));
  }

 private:
  oracle::Chain chain_;
  double reach_;
};

oracle::Point point_in(const Box& box, SoupMaker& random) {
  const auto between = [&](double least, double most) { return least + (most - least) * random.real(0, 1); };
  return oracle::exact({between(box.min.x, box.max.x), between(box.min.y, box.max.y), between(box.min.z, box.max.z)});
}

std::string text(const oracle::Point& p) {
  return testing::PrintToString(std::array{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
}

/// Points on the triangles of the soup, and points around which it winds, are in the hull.
void expect_outside(const Soup& soup, const TriangleMesh& hull, SoupMaker& random) {
  const Judge outer(hull), inner(soup.mesh);
  for (int i = 0; i < rounds(100); ++i) {
    const oracle::Point x = inner.on_a_face(random);
    ASSERT_TRUE(outer.holds(x, random)) << text(x) << " on a triangle";
  }
  if (!soup.is_closed) return;
  for (int i = 0; i < rounds(50); ++i) {
    const oracle::Point x = point_in(bounding_box(soup.mesh), random);
    const bool is_inside = inner.winding_number(x, random).value_or(0) >= 1;
    ASSERT_TRUE(!is_inside || outer.holds(x, random)) << text(x) << " inside";
  }
}

/// Points on the hull are in some part, whichever way that is turned.
void expect_inside(const Soup& soup, const TriangleMesh& hull, SoupMaker& random) {
  std::vector<Judge> parts(soup.parts.begin(), soup.parts.end());
  const Judge inner(hull);
  for (int i = 0; i < rounds(100); ++i) {
    const oracle::Point x = inner.on_a_face(random);
    ASSERT_TRUE(
        std::ranges::any_of(parts, [&](const Judge& part) { return part.winding_number(x, random).value_or(1) != 0; }))
        << text(x) << " on the hull";
  }
}

TEST(SoupJudge, KnowsTheWindingNumber) {
  SoupMaker random(1);
  const TriangleMesh ball = meshes::sphere(1);
  const oracle::Point inside(0.1, 0.2, 0.3), outside(2, 0.2, 0.3), corner(1, 0, 0);
  EXPECT_EQ(Judge(ball).winding_number(inside, random), 1);
  EXPECT_EQ(Judge(ball).winding_number(outside, random), 0);
  EXPECT_EQ(Judge(ball).winding_number(corner, random), std::nullopt);
  EXPECT_EQ(Judge(meshes::inside_out(ball)).winding_number(inside, random), -1);
  EXPECT_EQ(Judge(meshes::together(ball, meshes::octahedron())).winding_number(inside, random), 2);
  EXPECT_FALSE(Judge(meshes::scaled(ball, 0.99)).holds(Judge(ball).on_a_face(random), random));
}

EnclosingOptions random_options(const Soup& soup, SoupMaker& random) {
  EnclosingOptions options;
  options.hull.relax_guards = !random.one_in(4);
  options.hull.side = random.one_in(3) ? HullSide::Inner : HullSide::Outer;
  options.tight = random.one_in(3);
  if (!options.tight && random.one_in(3))
    options.hull.strategy = random.one_in(2) ? Strategy::Paper1 : Strategy::Paper2;
  options.hull.float32_coordinates = random.one_in(3);
  options.hull.threads = 1;
  options.keep_cavities = random.one_in(3);
  options.levels = !options.tight && random.one_in(4);
  if (random.one_in(4)) options.bounds.max_distance = soup.size() * random.real(0.01, 0.5);
  if (random.one_in(6)) options.bounds.max_void_ratio = random.real(0.01, 2);
  if (random.one_in(8)) options.bounds.max_added_volume = std::pow(soup.size(), 3) * random.real(0.01, 1);
  if (random.one_in(6)) options.repair = random.one_in(2) ? Repair::None : Repair::Wrap;
  return options;
}

std::string described(const EnclosingOptions& options, std::size_t faces) {
  std::string words = std::to_string(faces) + " faces";
  const auto add = [&](bool does, const std::string& word) { words += does ? ", " + word : ""; };
  const HullOptions& hull = options.hull;
  add(hull.side == HullSide::Inner, "inner");
  add(options.tight, "tight");
  add(hull.strategy != Strategy::Lazy, std::string(name_of(strategy_names(), hull.strategy)));
  add(hull.float32_coordinates, "float32");
  add(!hull.relax_guards, "keep guards");
  add(options.keep_cavities, "keep cavities");
  add(options.levels, "levels");
  add(options.bounds.any(),
      "bounds " + testing::PrintToString(std::array{options.bounds.max_distance, options.bounds.max_void_ratio,
                                                    options.bounds.max_added_volume}));
  add(options.repair != Repair::Auto, "repair " + std::string(name_of(repair_names(), options.repair)));
  return words;
}

int failures() { return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count(); }

/// How many soups: PROHULL_TEST_SOUPS, or a few seconds' worth.
int soup_count() {
  const char* const variable = std::getenv("PROHULL_TEST_SOUPS");
  return variable && *variable ? std::atoi(variable) : rounds(40);
}

void expect_right(const Soup& soup, const EnclosingOptions& options, const EnclosingHull& hull, SoupMaker& random) {
  ASSERT_TRUE(hull.certified) << testing::PrintToString(hull.notes);
  EXPECT_TRUE(!options.hull.float32_coordinates ||
              std::ranges::all_of(hull.mesh.positions, [](const Vec3& p) { return is_float32(p); }));
  EXPECT_TRUE(options.repair == Repair::None || verify_hull(hull.mesh, soup.mesh, options.hull.side).encloses)
      << "says verify_hull";
  if (options.hull.side == HullSide::Outer)
    expect_outside(soup, hull.mesh, random);
  else
    expect_inside(soup, hull.mesh, random);
}

// The soup of each seed is made from that seed alone: PROHULL_TEST_SEED=n PROHULL_TEST_SOUPS=1 makes it again. One that
// fails is kept as a file.
TEST(Soups, EndInACertifiedHullOrInOneRefusal) {
  int built = 0;
  for (int i = 0; i < soup_count(); ++i) {
    const unsigned seed = test_seed() + static_cast<unsigned>(i);
    SoupMaker random(seed);
    const Soup soup = random.soup();
    const EnclosingOptions options = random_options(soup, random);
    const std::size_t faces = static_cast<std::size_t>(random.uniform(4, 60));
    SCOPED_TRACE("PROHULL_TEST_SEED=" + std::to_string(seed) + ": " + std::to_string(soup.mesh.face_count()) +
                 " faces at scale " + testing::PrintToString(soup.scale) + ": " + described(options, faces));
    const int failures_before = failures();
    try {
      const EnclosingHull hull = enclosing_hull(soup.mesh, faces, options);
      ++built;
      expect_right(soup, options, hull, random);
    } catch (const InputError& error) {
      EXPECT_GE(std::string_view(error.what()).size(), 10u) << "no reason";
      EXPECT_EQ(std::string_view(error.what()).find("report"), std::string_view::npos) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "another exception: " << error.what();
    }
    if (failures() == failures_before) continue;
    const std::string file = testing::TempDir() + "soup_" + std::to_string(seed) + ".off";
    write_mesh(file, soup.mesh);
    std::printf("that soup is %s\n", file.c_str());
  }
  EXPECT_TRUE(4 * built > soup_count() || soup_count() < 40) << "nearly all were refused: " << built;
}

}  // namespace
}  // namespace prohull
