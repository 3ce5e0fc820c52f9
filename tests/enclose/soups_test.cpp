#include "soups.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>

#include "checker.h"
#include "effort.h"
#include "few_trials.h"
#include "geometry/float32.h"
#include "judge.h"
#include "prohull/cage.h"
#include "prohull/certificate.h"
#include "prohull/convex_cover.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/sphere_cover.h"
#include "prohull/union_verification.h"
#include "prohull/verification.h"
#include "random.h"

namespace prohull {
namespace {

using meshes::Soup;
using meshes::SoupMaker;
using oracle::Judge;
using oracle::Number;
using oracle::Point;

std::string text(const Point& p) {
  return fmt::format("({}, {}, {})", CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
}

TriangleMesh finite_part(TriangleMesh mesh) {
  std::vector<std::array<VertexId, 3>> finite;
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); is_finite(t.a) && is_finite(t.b) && is_finite(t.c))
      finite.push_back(mesh.triangles[f]);
  mesh.triangles = PerFace<std::array<VertexId, 3>>(std::move(finite));
  return mesh;
}

/// How many soups a campaign makes, by the environment; 0: a few, in little time.
int campaign() {
  const char* const variable = std::getenv("PROHULL_TEST_SOUPS");
  return variable && *variable ? std::atoi(variable) : 0;
}

/// A soup and what is asked of it. All that is random depends on the seed and the product alone.
struct Case {
  explicit Case(unsigned seed) : random(seed), soup(random.soup()), judge(soup.mesh), finite(finite_part(soup.mesh)) {}

  SoupMaker random;
  Soup soup;
  Judge judge;  ///< of the raw triangles
  TriangleMesh finite;
  std::string command = {};  ///< which does the same, about
  int certificates = 0, proven = 0;

  std::vector<Point> inside_points();

  Progress progress = [this](std::string_view, double) { return seconds() < (campaign() > 0 ? kMostSeconds : 1); };
  double seconds() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }  ///< of processors

  static constexpr double kMostSeconds = 10;

 private:
  std::clock_t start_ = std::clock();
};

/// Around which the soup winds, if it is closed: whichever components count as turned.
std::vector<Point> Case::inside_points() {
  std::vector<Point> inside;
  if (!judge.is_closed() || judge.faces().empty()) return inside;
  const int turn = judge.volume_times_six() < 0 ? -1 : 1;
  const Box box = finite_bounding_box(soup.mesh);
  for (int i = 0; i < rounds(30); ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const double t = random.real(0, 1);
      p[axis] = box.min[axis] * (1 - t) + box.max[axis] * t;
    }
    const Point x = oracle::exact(p);
    if (judge.winding_number(x, random).value_or(0) * turn >= 1) inside.push_back(x);
  }
  return inside;
}

// --- what products claim ---

void expect_covered(Case& given, const Judge& hull) {
  for (const Point& x : given.judge.points_on_faces(given.random))
    ASSERT_TRUE(hull.covers(x, given.random).value_or(true)) << text(x) << " on a triangle is outside of the hull";
  for (const Point& x : given.inside_points())
    ASSERT_TRUE(hull.covers(x, given.random).value_or(true)) << text(x) << " inside is outside of the hull";
}

/// Points of the hull are in some part, whichever way that is turned; of an open soup in the closed mesh that stands
/// for it.
void expect_inside(Case& given, const Judge& hull, const TriangleMesh* stand_in) {
  std::vector<Judge> parts(given.soup.parts.begin(), given.soup.parts.end());
  if (!given.judge.is_closed()) {
    ASSERT_TRUE(stand_in) << "certified to be inside of what is open";
    parts.assign(1, Judge(*stand_in));
    ASSERT_TRUE(parts.front().is_closed());
  }
  for (const Point& x : hull.points_on_faces(given.random))
    ASSERT_TRUE(std::ranges::any_of(
        parts, [&](const Judge& part) { return part.winding_number(x, given.random).value_or(1) != 0; }))
        << text(x) << " on the hull is outside of the original";
}

void expect_near(Case& given, const Judge& hull, const Judge& original, double distance) {
  for (const Point& x : hull.points_on_faces(given.random))
    ASSERT_TRUE(original.is_within(x, Number(distance) * Number(distance)))
        << text(x) << " on the hull is farther than " << distance << " from all triangles";
}

void expect_gap(Case& given, const Judge& hull, double gap) {
  if (given.judge.faces().size() * hull.faces().size() > 20'000) return;
  for (const oracle::ExactTriangle& face : hull.faces())
    ASSERT_TRUE(given.judge.squared_distance_to(face) >= Number(gap) * Number(gap))
        << "a face of the hull is nearer than " << gap << ": it is at " << text(face[0]);
}

void expect_claims(Case& given, const TriangleMesh& hull, HullSide side, const RepairedMesh& input) {
  if (side == HullSide::Inner)
    expect_inside(given, Judge(hull), input.closed ? &input.closed->mesh : nullptr);
  else
    expect_covered(given, Judge(hull));
}

/// The checker looks at all points, where the judge has samples.
oracle::Checked expect_not_denied(Case& given, const Certificate& certificate, const std::string& hull,
                                  std::string_view suffix = ".off") {
  const oracle::Checked found = oracle::checked(certificate, hull, suffix, oracle::off(given.soup.mesh));
  ++given.certificates, given.proven += found.is_proven;
  EXPECT_FALSE(found.is_denied) << found.line;
  return found;
}

void expect_certificate(Case& given, const TriangleMesh& hull, const HullClaims& claims) {
  if (claims.side == HullSide::Inner && !given.judge.is_closed()) return;
  expect_not_denied(given, hull_certificate(hull, {given.soup.mesh}, claims), oracle::off(hull));
}

// --- products ---

template <class Value>
Value noted(Case& given, std::string_view option, const Value& value) {
  given.command += fmt::format(" {} {}", option, value);
  return value;
}

bool noted_flag(Case& given, std::string_view option, bool is_on) {
  if (is_on) given.command += fmt::format(" {}", option);
  return is_on;
}

std::size_t some_faces(Case& given) {
  return noted(given, "--faces", static_cast<std::size_t>(given.random.uniform(4, 60)));
}

/// Near the size of the mesh, and seldom less than a tenth of it: fine wraps take seconds.
double some_distance(Case& given, std::string_view option) {
  return noted(given, option,
               given.soup.size() * std::pow(10.0, given.random.real(given.random.one_in(8) ? -5 : -1, 0)));
}

EnclosingOptions some_options(Case& given) {
  SoupMaker& random = given.random;
  EnclosingOptions options;
  options.hull.threads = 1;
  options.hull.tight_trials = few_trials;
  options.progress = given.progress;
  options.hull.relax_guards = !noted_flag(given, "--keep-guards", random.one_in(4));
  options.hull.float32_coordinates = noted_flag(given, "-o hull.stl", random.one_in(3));
  options.keep_cavities = noted_flag(given, "--keep-cavities", random.one_in(3));
  if (random.one_in(3)) options.bounds.max_distance = some_distance(given, "--max-distance");
  if (random.one_in(6)) options.bounds.max_void_ratio = noted(given, "--max-void", random.real(1, 200)) / 100;
  if (random.one_in(8))
    options.bounds.max_added_volume =
        noted(given, "--max-added-volume", std::pow(given.soup.size(), 3) * random.real(0.01, 1));
  if (random.one_in(6)) options.repair = random.one_in(2) ? Repair::None : Repair::Wrap;
  if (options.repair != Repair::Auto) noted(given, "--repair", name_of(repair_names(), options.repair));
  if (noted_flag(given, "--open-shells keep", random.one_in(6))) options.open_shells = OpenShells::Keep;
  return options;
}

void build(Case& given, const EnclosingOptions& options) {
  const std::size_t faces[]{some_faces(given)};
  const EnclosingHulls made = enclosing_hulls(given.soup.mesh, faces, options);
  const EnclosingHull& hull = made.hulls.front();
  const HullSide side = options.hull.side;
  ASSERT_TRUE(hull.certified) << testing::PrintToString(hull.notes);
  EXPECT_FALSE(side == HullSide::Outer ? hull.void_ratio < 0 : hull.void_ratio > 0) << hull.void_ratio;
  EXPECT_TRUE(!options.hull.float32_coordinates || std::ranges::all_of(hull.mesh.positions, is_float32));
  expect_claims(given, hull.mesh, side, made.input);
  if (options.bounds.max_distance < std::numeric_limits<double>::infinity() && hull.within_bounds)
    expect_near(given, Judge(hull.mesh), Judge(triangles_to_cover(made, hull)), options.bounds.max_distance);
  if (options.padding > 0) expect_gap(given, Judge(hull.mesh), hull.padding);
  EXPECT_TRUE(options.repair == Repair::None || verify_hull(hull.mesh, given.finite, side).encloses)
      << "verify_hull says no";
  expect_certificate(
      given, hull.mesh,
      {.side = side, .gap = claimed_gap(options.padding, hull.padding), .distance = options.bounds.max_distance});
  if (!hull.levels || side == HullSide::Inner || options.repair == Repair::None) return;
  expect_covered(given, Judge(hull.levels->base()));
  EXPECT_TRUE(verify_hull(hull.levels->with_finest_level(finest_level(made, hull)), given.finite).encloses)
      << "verify_hull says no of the levels";
}

void build_outer(Case& given) {
  given.command = "build";
  EnclosingOptions options = some_options(given);
  if (given.random.one_in(3)) options.hull.strategy = given.random.one_in(2) ? Strategy::Paper1 : Strategy::Paper2;
  noted(given, "--strategy", name_of(strategy_names(), options.hull.strategy));
  options.levels = noted_flag(given, "--hierarchy h.phull", given.random.one_in(4));
  build(given, options);
}

void build_tight(Case& given) {
  given.command = "build --tight";
  EnclosingOptions options = some_options(given);
  options.tight = true;
  if (given.random.one_in(6)) options.padding = some_distance(given, "--gap");
  build(given, options);
}

void build_inner(Case& given) {
  given.command = "build --side inner";
  EnclosingOptions options = some_options(given);
  options.hull.side = HullSide::Inner;
  options.tight = noted_flag(given, "--tight", given.random.one_in(4));
  if (given.random.one_in(6)) options.padding = some_distance(given, "--gap");
  build(given, options);
}

void build_gap(Case& given) {
  given.command = "build";
  EnclosingOptions options = some_options(given);
  options.padding = some_distance(given, "--gap");
  build(given, options);
}

void cage(Case& given) {
  given.command = "cage";
  CageOptions options{.threads = 1, .progress = given.progress};
  options.outer_faces = some_faces(given);
  if (noted_flag(given, "--inner inner.off", given.random.one_in(3))) options.inner_faces = options.outer_faces;
  options.even = noted_flag(given, "--even", given.random.one_in(3));
  options.float32_coordinates = noted_flag(given, "-o hull.stl", given.random.one_in(3));
  if (!given.random.one_in(3)) options.gap = some_distance(given, "--gap");
  const Cage made = build_cage(given.soup.mesh, options);
  const auto check = [&](const CageHull& hull, HullSide side) {
    if (hull.hull().certified) {
      expect_claims(given, hull.hull().mesh, side, hull.made.input);
      expect_certificate(given, hull.hull().mesh,
                         {.side = side, .gap = claimed_gap(hull.hull().padding, hull.hull().padding)});
    }
    EXPECT_TRUE(!hull.keeps_gap || hull.hull().padding >= made.gap);
    expect_gap(given, Judge(hull.hull().mesh), hull.hull().padding);
  };
  check(made.outer, HullSide::Outer);
  if (made.inner) check(*made.inner, HullSide::Inner);
}

/// `contains` tells whether a piece has a point; `surface` yields points of which a point of the union's surface is at
/// most so far away. Pieces are convex or balls.
template <class Cover, class Contains>
void expect_cover(Case& given, const Cover& cover, bool covers_inside, std::size_t pieces, const Contains& contains) {
  const auto has = [&](const Point& x) {
    for (std::size_t i = 0; i < pieces; ++i)
      if (contains(i, x)) return true;
    return false;
  };
  ASSERT_TRUE(cover.verdict.certified) << testing::PrintToString(cover.notes);
  for (const Point& x : given.judge.points_on_faces(given.random))
    ASSERT_TRUE(has(x)) << text(x) << " on a triangle is outside of all pieces";
  if (!covers_inside) return;
  EXPECT_GE(cover.volume, (1 - 1e-9) * cover.original_volume) << "the union is smaller than what it covers";
  if (!given.judge.is_closed()) {  // the inside is that of the mesh with its openings closed
    EXPECT_FALSE(cover.verdict.original_closed);
    return;
  }
  for (const Point& x : given.inside_points()) ASSERT_TRUE(has(x)) << text(x) << " inside is outside of all pieces";
}

bool is_of_triangles_alone(const ConvexCover& cover) { return cover.verdict.cap_faces == 0; }
bool is_of_triangles_alone(const SphereCover& cover) { return cover.verdict.cap_faces == 0 && !cover.is_of_wrap; }

/// Of points of the union from the triangles. Bounds that were asked for hold for the distance from the solid, to which
/// caps on openings belong.
template <class Cover>
double bound_of_reach(const Cover& cover, double max_distance) {
  const double proven = cover.verdict.distance_to_triangles->upper;
  return cover.within_bounds && is_of_triangles_alone(cover) ? std::min(proven, max_distance) : proven;
}

/// x is on the surface of the union, but for `slack`.
void expect_reach(Case& given, const Point& x, double bound, double slack) {
  const Number most = Number(bound) + Number(slack);
  if (given.judge.is_within(x, most * most)) return;
  if (given.judge.is_closed() && given.judge.winding_number(x, given.random) != 0) return;
  ADD_FAILURE() << text(x) << " of the union is farther than " << bound << " from all triangles";
}

void convex(Case& given) {
  given.command = "convex";
  ConvexCoverOptions options{.threads = 1, .progress = given.progress};
  options.max_pieces = noted(given, "--pieces", static_cast<std::size_t>(given.random.uniform(1, 8)));
  options.max_vertices = noted(given, "--vertices", static_cast<std::size_t>(given.random.uniform(4, 32)));
  options.float32_coordinates = noted_flag(given, "-o hull.stl", given.random.one_in(3));
  if (given.random.one_in(3)) options.bounds.max_distance = some_distance(given, "--max-distance");
  options.shape = static_cast<PieceShape>(given.random.one_in(3) ? given.random.uniform(0, 3) : 0);
  noted(given, "--shape", name_of(piece_shape_names(), options.shape));
  const ConvexCover cover = convex_cover(given.soup.mesh, options);
  std::vector<TriangleMesh> parts;
  TriangleMesh file;
  std::vector<Judge> pieces;
  for (const ConvexPiece& piece : cover.pieces) {
    parts.push_back(piece.mesh);
    file = meshes::together(std::move(file), piece.mesh);
    const Judge& made = pieces.emplace_back(piece.mesh);
    for (const Vec3& p : piece.mesh.positions) {
      ASSERT_TRUE(made.has_within_planes(oracle::exact(p))) << "a piece is not convex";
      const Ball* const ball = std::get_if<Ball>(&piece.primitive);
      ASSERT_TRUE(!ball || oracle::contains(*ball, oracle::exact(p))) << "a piece sticks out of its sphere";
      ASSERT_TRUE(!options.float32_coordinates || !std::holds_alternative<std::monostate>(piece.primitive) ||
                  is_float32(p));
    }
  }
  expect_cover(given, cover, cover.verdict.encloses_solid == Answer::Yes, pieces.size(),
               [&](std::size_t i, const Point& x) { return pieces[i].has_within_planes(x); });
  expect_not_denied(given, pieces_certificate(parts, {given.soup.mesh}), oracle::off(file));
  const double bound = bound_of_reach(cover, options.bounds.max_distance);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const Point& x : pieces[i].points_on_faces(given.random)) {
      bool is_covered = false;
      for (std::size_t j = 0; j < pieces.size(); ++j) is_covered |= j != i && pieces[j].has_within_planes(x);
      if (!is_covered) expect_reach(given, x, bound, 0);
    }
}

void spheres(Case& given) {
  given.command = "spheres";
  SphereCoverOptions options{.threads = 1, .progress = given.progress};
  options.max_balls = noted(given, "--count", static_cast<std::size_t>(given.random.uniform(1, 24)));
  options.fill = noted_flag(given, "--fill", given.random.one_in(3));
  if (given.random.one_in(3)) options.max_distance = some_distance(given, "--max-distance");
  const SphereCover cover = sphere_cover(given.soup.mesh, options);
  // Of what is open, the inside is that of a wrap.
  expect_cover(given, cover, cover.verdict.encloses_solid == Answer::Yes && cover.verdict.original_closed,
               cover.balls.size(), [&](std::size_t i, const Point& x) { return oracle::contains(cover.balls[i], x); });
  expect_not_denied(given, balls_certificate(cover.balls, {given.soup.mesh}), oracle::yaml(cover.balls), ".yaml");
  const double bound = bound_of_reach(cover, options.max_distance);
  for (std::size_t i = 0; i < cover.balls.size(); ++i)
    for (int k = 0; k < rounds(20); ++k) {
      Vec3 d{given.random.real(-1, 1), given.random.real(-1, 1), given.random.real(-1, 1)};
      const Ball& ball = cover.balls[i];
      const Point x = oracle::exact(ball.center + d / norm(d) * (ball.radius * (1 - 1e-9)));
      const double slack = 1e-8 * ball.radius;
      if (!oracle::contains(ball, x) || oracle::contains(Ball{ball.center, ball.radius - slack}, x)) continue;
      bool is_covered = false;
      for (std::size_t j = 0; j < cover.balls.size(); ++j)
        is_covered |= j != i && oracle::contains({cover.balls[j].center, cover.balls[j].radius + slack}, x);
      if (!is_covered) expect_reach(given, x, bound, slack);
    }
}

/// Of a hull that was tampered with: a yes is no wrong word.
void verify(Case& given) {
  given.command = "verify, of a hull that was tampered with";
  SoupMaker& random = given.random;
  TriangleMesh hull = enclosing_hull(given.soup.mesh, some_faces(given), some_options(given)).mesh;
  const Box box = bounding_box(hull);
  for (int count = random.uniform(0, 2); count > 0; --count) {
    Vec3& p = hull.positions[VertexId(static_cast<std::uint32_t>(random.uniform(0, int(hull.vertex_count()) - 1)))];
    const double by = random.one_in(2) ? 1e-3 : 1e-12;
    p = random.one_in(3) ? box.center() : p + (box.center() - p) * random.real(-by, by);
  }
  if (random.one_in(6)) hull = meshes::inside_out(std::move(hull));
  if (random.one_in(6) && hull.face_count() > 4) hull.triangles[FaceId(0)] = hull.triangles[FaceId(1)];
  const double gap = given.soup.size() * std::pow(10.0, random.real(-9, 0));
  const Verification found = verify_hull(hull, given.finite, HullSide::Outer, {.gap = gap, .progress = given.progress});
  if (found.encloses) expect_covered(given, Judge(hull));
  if (found.keeps_gap) expect_gap(given, Judge(hull), gap);
  const HullClaims claims{.gap = found.keeps_gap ? claimed_gap(gap, gap) : 0};
  const Certificate certificate = hull_certificate(hull, {given.soup.mesh}, claims);
  if (found.encloses)
    expect_not_denied(given, certificate, oracle::off(hull));
  else
    EXPECT_FALSE(oracle::checked(certificate, oracle::off(hull), ".off", oracle::off(given.soup.mesh)).is_proven)
        << "the checker proves what verify_hull denies";
}

// --- the campaign ---

struct Product {
  const char* name;
  void (*make)(Case&);
  int soups;  ///< where there is no campaign
};
void PrintTo(const Product& product, std::ostream* out) { *out << product.name; }

int failures() { return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count(); }

class Soups : public testing::TestWithParam<Product> {};

// The soup of each seed is made from that seed alone: PROHULL_TEST_SEED=n PROHULL_TEST_SOUPS=1 makes it again. One that
// fails, or takes more than ten seconds, is kept as a file.
TEST_P(Soups, KeepTheirWordOrAreRefused) {
  const int soups = campaign() > 0 ? campaign() : rounds(GetParam().soups);
  int refused = 0, certificates = 0, proven = 0;
  for (int i = 0; i < soups; ++i) {
    const unsigned seed = test_seed() + static_cast<unsigned>(i);
    Case given(seed);
    const int failures_before = failures();
    std::string slow;
    try {
      GetParam().make(given);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_GE(std::string_view(error.what()).size(), 10u) << "no reason";
      EXPECT_EQ(std::string_view(error.what()).find("report"), std::string_view::npos) << error.what();
    } catch (const Cancelled&) {
      if (campaign() > 0) slow = "more than ten seconds";
    } catch (const std::exception& error) {
      ADD_FAILURE() << "another exception: " << error.what();
    }
    certificates += given.certificates, proven += given.proven;
    if (slow.empty() && given.seconds() > Case::kMostSeconds)
      slow = fmt::format("{:.1f} seconds with its checks", given.seconds());
    if (failures() == failures_before && slow.empty()) continue;
    const std::string name = fmt::format("{}_{}", GetParam().name, seed);
    fmt::print("{}: {}: PROHULL_TEST_SEED={}: prohull {} {}\n", slow.empty() ? "FALSE" : "slow", slow, seed,
               given.command, oracle::write(testing::TempDir() + name + ".off", oracle::off(given.soup.mesh)));
    std::fflush(stdout);
  }
  EXPECT_TRUE(8 * refused < 7 * soups || soups < 20) << "nearly all were refused: " << refused;
  fmt::print("{}: {} certificates, {} proven by the checker\n", GetParam().name, certificates, proven);
  EXPECT_TRUE(10 * proven >= 9 * certificates) << "the rest is not denied, but left undecided";
}

INSTANTIATE_TEST_SUITE_P(All, Soups,
                         testing::Values(Product{"build", build_outer, 12}, Product{"tight", build_tight, 3},
                                         Product{"inner", build_inner, 12}, Product{"gap", build_gap, 8},
                                         Product{"cage", cage, 8}, Product{"convex", convex, 3},
                                         Product{"spheres", spheres, 4}, Product{"verify", verify, 8}),
                         [](const auto& product) { return std::string(product.param.name); });

TEST(SoupLevels, OfFoldsAreCoveredByTheBaseMeshWhereTheFinestLevelDoesNot) {
  Case open_with_folds(70001992);
  open_with_folds.progress = {};  // however long it takes
  build_outer(open_with_folds);
}

TEST(SoupCovers, OfOpenSoupsReachFromTheirTrianglesNoFartherThanTheySay) {
  Case box_without_sides(9062);
  box_without_sides.progress = {};  // however long it takes
  convex(box_without_sides);
  for (const unsigned boxes_and_balls_or_leaves : {9005, 31000033}) {
    Case given(boxes_and_balls_or_leaves);
    given.progress = {};
    spheres(given);
  }
}

// --- the judge ---

TEST(SoupJudge, KnowsTheWindingNumber) {
  SoupMaker random(1);
  const TriangleMesh ball = meshes::sphere(1);
  const Point inside(0.1, 0.2, 0.3), outside(2, 0.2, 0.3), corner(1, 0, 0);
  EXPECT_EQ(Judge(ball).winding_number(inside, random), 1);
  EXPECT_EQ(Judge(ball).winding_number(outside, random), 0);
  EXPECT_EQ(Judge(ball).winding_number(corner, random), std::nullopt);
  EXPECT_EQ(Judge(meshes::inside_out(ball)).winding_number(inside, random), -1);
  EXPECT_EQ(Judge(meshes::together(ball, meshes::octahedron())).winding_number(inside, random), 2);
}

TEST(SoupJudge, KnowsWhatIsCovered) {
  SoupMaker random(1);
  const Judge ball(meshes::sphere(1)), inverted(meshes::inside_out(meshes::sphere(1))),
      smaller(meshes::scaled(meshes::sphere(1), 0.99));
  for (const Point& x : ball.points_on_faces(random)) {
    EXPECT_EQ(ball.covers(x, random), true);
    EXPECT_NE(inverted.covers(x, random), true);
    EXPECT_EQ(smaller.covers(x, random), false);
  }
  const Judge wall(meshes::box({0, 0, 0}, {0, 1, 1}));  // flat: it winds around nothing
  EXPECT_EQ(wall.covers(Point(0, 0.4, 0.3), random), false);
}

TEST(SoupJudge, KnowsDistances) {
  const Judge flat(meshes::make({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}));
  EXPECT_TRUE(flat.is_within(Point(1, 1, 3), 9));
  EXPECT_FALSE(flat.is_within(Point(1, 1, 3), 8));
  EXPECT_TRUE(flat.is_within(Point(-3, -4, 0), 25));
  EXPECT_EQ(flat.squared_distance_to({Point(1, 1, 5), Point(2, 1, 5), Point(1, 2, 2)}), 4);
  EXPECT_EQ(flat.squared_distance_to({Point(1, 1, 5), Point(1, 1, -5), Point(9, 9, 2)}), 0);
  EXPECT_EQ(flat.squared_distance_to({Point(1, -1, 1), Point(1, 1, 1), Point(1, 0, 9)}), 1);
  EXPECT_EQ(flat.squared_distance_to({Point(2, -2, 3), Point(2, 2, -1), Point(9, -2, 9)}), 0);
}

}  // namespace
}  // namespace prohull
