#include "render/draw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "render/compose.h"

namespace prohull::render {
namespace {

constexpr int kWidth = 100, kHeight = 80;

PanelPlan plan(std::size_t shown, const char* color) {
  PanelPlan plan;
  plan.shown = shown;
  plan.color = *parse_color(color);
  return plan;
}

Image drawn(const std::vector<PanelPlan>& plans, const std::vector<TriangleMesh>& meshes, const Look& look = {},
            const DrawOptions& options = {}) {
  return draw(kWidth, kHeight, compose(plans, meshes, look, kWidth, kHeight), options);
}

bool is_red(const Pixel& p) { return p[3] == 255 && p[0] > p[1] + 30 && p[0] > p[2] + 30; }
bool is_blue(const Pixel& p) { return p[3] == 255 && p[2] > p[0] + 30; }

TEST(Draw, ShowsTheMeshInTheMiddleOfATransparentPicture) {
  const Image image = drawn({plan(0, "red")}, {meshes::sphere(3)});
  EXPECT_TRUE(is_red(image.at(kWidth / 2, kHeight / 2)));
  for (const int x : {0, kWidth - 1})
    for (const int y : {0, kHeight - 1}) EXPECT_EQ(image.at(x, y), Pixel{});
}

// Of 1.7e308, twice as much is no double.
TEST(Draw, ShowsMeshesOfAnySizeTheSame) {
  const Image usual = drawn({plan(0, "red")}, {meshes::sphere(3)});
  for (const int exponent : {-1000, 1000, 1023}) {
    TriangleMesh mesh = meshes::sphere(3);
    for (Vec3& p : mesh.positions) p = std::ldexp(1.0, exponent) * p;
    EXPECT_EQ(drawn({plan(0, "red")}, {mesh}).pixels(), usual.pixels()) << exponent;
  }
}

TEST(Draw, FillsTheBackground) {
  DrawOptions options;
  options.background = *parse_color("white");
  const Image image = drawn({plan(0, "red")}, {meshes::sphere(3)}, {}, options);
  EXPECT_EQ(image.at(0, 0), (Pixel{255, 255, 255, 255}));
}

TEST(Draw, IsLitFromTheUpperLeft) {
  const Image image = drawn({plan(0, "grey")}, {meshes::sphere(4)});
  const int middle = kWidth / 2, center = kHeight / 2, away = kHeight / 4;
  EXPECT_GT(image.at(middle - away, center - away)[1], image.at(middle + away, center + away)[1] + 30);
}

TEST(Draw, DoesNotDependOnOrientationPlaceOrSize) {
  const TriangleMesh mesh = meshes::torus(24, 12);
  const Image image = drawn({plan(0, "blue")}, {mesh});
  EXPECT_EQ(drawn({plan(0, "blue")}, {meshes::inside_out(mesh)}).pixels(), image.pixels());
  EXPECT_EQ(drawn({plan(0, "blue")}, {meshes::scaled(mesh, 0x1p900)}).pixels(), image.pixels());
  EXPECT_EQ(drawn({plan(0, "blue")}, {meshes::scaled(mesh, 0x1p-900)}).pixels(), image.pixels());
}

TEST(Draw, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh pony = make_sample("pony", 4000);
  PanelPlan over = plan(1, "blue");
  over.inside = 0;
  over.line_width = 1;
  Look look;
  look.ground = true;
  DrawOptions options;
  options.threads = 1;
  const std::vector<TriangleMesh> meshes{pony, meshes::scaled(pony, 1.1)};
  const Image one = drawn({plan(0, "clay"), over}, meshes, look, options);
  options.threads = 3;
  EXPECT_EQ(drawn({plan(0, "clay"), over}, meshes, look, options).pixels(), one.pixels());
}

TEST(Draw, PanelsStandSideBySide) {
  const TriangleMesh sphere = meshes::sphere(3);
  const Image image = drawn({plan(0, "red"), plan(0, "blue")}, {sphere});
  EXPECT_TRUE(is_red(image.at(kWidth / 4, kHeight / 2)));
  EXPECT_TRUE(is_blue(image.at(3 * kWidth / 4, kHeight / 2)));
  EXPECT_EQ(image.at(kWidth / 2, kHeight / 2), Pixel{});
}

TEST(Draw, ASplitShowsEachMeshInItsHalf) {
  const TriangleMesh sphere = meshes::sphere(3);
  PanelPlan split = plan(0, "blue");
  split.right = 1;
  const Image image = drawn({split}, {sphere, sphere});
  EXPECT_TRUE(is_blue(image.at(kWidth / 2 - 3, kHeight / 2)));
  const Pixel right = image.at(kWidth / 2 + 3, kHeight / 2);
  EXPECT_GT(right[0], right[2]);  // clay
}

TEST(Draw, ATranslucentMeshTintsWhatIsInside) {
  const TriangleMesh inner = meshes::sphere(3), outer = meshes::scaled(inner, 1.5);
  PanelPlan over = plan(1, "blue");
  over.inside = 0;
  Look look;
  const int y = kHeight / 2, between = kWidth / 2 + kHeight * 9 / 20;
  const Image image = drawn({over}, {inner, outer}, look);
  look.opacity = 0;
  const Image clear = drawn({over}, {inner, outer}, look);
  const auto blueness = [](const Pixel& p) { return p[2] - p[0]; };
  EXPECT_GT(blueness(image.at(kWidth / 2, y)), blueness(clear.at(kWidth / 2, y)) + 10);
  EXPECT_EQ(image.at(kWidth / 2, y)[3], 255);
  EXPECT_GT(image.at(between, y)[3], 0);
  EXPECT_LT(image.at(between, y)[3], 255);
}

TEST(Draw, TheGroundShowsOnlyShadow) {
  Look look;
  look.ground = true;
  const Image image = drawn({plan(0, "red")}, {meshes::box({-1, -1, 0}, {1, 1, 1})}, look);
  const Pixel shadow = image.at(kWidth * 3 / 4, kHeight * 4 / 5);
  EXPECT_EQ(shadow[0] + shadow[1] + shadow[2], 0);
  EXPECT_GT(shadow[3], 20);
  EXPECT_LT(shadow[3], 220);
  EXPECT_EQ(image.at(0, kHeight - 1), Pixel{});
}

TEST(Draw, MarksShineThrough) {
  PanelPlan marked = plan(0, "blue");
  const TriangleMesh sphere = meshes::sphere(3);
  const Image without = drawn({marked}, {sphere});
  marked.segment = MarkedSegment{{{-3, 0, 0}, {3, 0, 0}}, {}, {0.4, 0.6}};
  const Image image = drawn({marked}, {sphere});
  const Pixel center = image.at(kWidth / 2, kHeight / 2), plain = without.at(kWidth / 2, kHeight / 2);
  EXPECT_LT(center[0] + center[1] + center[2], plain[0] + plain[1] + plain[2] - 10);
}

TEST(Draw, CanBeCancelled) {
  DrawOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW(drawn({plan(0, "red")}, {meshes::sphere(2)}, {}, options), Cancelled);
}

TEST(Draw, ProgressEndsAtOne) {
  DrawOptions options;
  double last = 0;
  options.progress = [&](std::string_view, double fraction) {
    EXPECT_GT(fraction, last);
    last = fraction;
    return true;
  };
  drawn({plan(0, "red")}, {meshes::sphere(2)}, {}, options);
  EXPECT_EQ(last, 1);
}

TEST(Draw, RefusesWhatHasNoSize) {
  EXPECT_THROW(drawn({plan(0, "red")}, {meshes::scaled(meshes::octahedron(), 0)}), InputError);
}

}  // namespace
}  // namespace prohull::render
