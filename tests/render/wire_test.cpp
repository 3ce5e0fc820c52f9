#include "render/wire.h"

#include <gtest/gtest.h>

namespace prohull::render {
namespace {

constexpr std::array kTriangle{Point2{0, 0}, Point2{30, 0}, Point2{0, 40}};

TEST(Wire, LinesCoverTheirWidthAndEndSoftly) {
  for (const double width : {1.0, 3.0}) {
    EXPECT_DOUBLE_EQ(line_coverage(kTriangle, {10, 0}, width), 1);
    EXPECT_DOUBLE_EQ(line_coverage(kTriangle, {10, width / 2}, width), 0.5);
    EXPECT_DOUBLE_EQ(line_coverage(kTriangle, {10, width / 2 + 0.5}, width), 0);
    EXPECT_DOUBLE_EQ(line_coverage(kTriangle, {10, 10}, width), 0);  // the centre of the inscribed circle
  }
}

TEST(Wire, EveryEdgeHasALine) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 &a = kTriangle[k], &b = kTriangle[(k + 1) % 3];
    EXPECT_NEAR(line_coverage(kTriangle, {(a.x + b.x) / 2, (a.y + b.y) / 2}, 1), 1, 1e-12);
  }
}

TEST(Wire, FadesWhereFacesAreAFewPixels) {
  EXPECT_EQ(line_visibility(100, 1), 1);
  EXPECT_EQ(line_visibility(1, 1), 0);
  EXPECT_GT(line_visibility(9, 1), line_visibility(8, 1));
  EXPECT_EQ(line_visibility(7, 1), line_visibility(14, 2));
  EXPECT_DOUBLE_EQ(side_of({Point2{0, 0}, Point2{7, 0}, Point2{0, 7}}), 7);
}

TEST(Wire, ADegenerateTriangleIsALine) {
  const std::array flat{Point2{0, 0}, Point2{5, 0}, Point2{5, 0}};
  EXPECT_EQ(line_coverage(flat, {5, 0}, 1), 1);
  EXPECT_EQ(line_coverage(flat, {5, 3}, 1), 0);
}

}  // namespace
}  // namespace prohull::render
