#include "prohull/length.h"

#include <gtest/gtest.h>

namespace prohull {
namespace {

constexpr double kDiagonal = 8;

TEST(Length, IsThatOfTheMeshOrAShareOfItOrHasAUnit) {
  EXPECT_EQ(length_of("0.5").value().of(kDiagonal), 0.5);
  EXPECT_EQ(length_of("+1e-3").value().of(kDiagonal), 1e-3);
  EXPECT_EQ(length_of("0.5%").value().of(kDiagonal), 0.5 / 100 * kDiagonal);
  EXPECT_EQ(length_of("5mm").value().of(kDiagonal), 5 * 0.001);
  EXPECT_EQ(length_of("2 cm").value().of(kDiagonal), 2 * 0.01);
  EXPECT_EQ(length_of("3in").value().of(kDiagonal), 3 * 0.0254);
  EXPECT_EQ(length_of("1ft").value().of(kDiagonal), 0.3048);
  EXPECT_TRUE(length_of("1m").value().needs_metres());
  EXPECT_FALSE(length_of("1").value().needs_metres());
  EXPECT_FALSE(length_of("1%").value().needs_metres());
}

TEST(Length, IsNothingElse) {
  for (const char* bad :
       {"", "mm", "%", "5mmm", "nan", "inf", "infinity", "-1", "-1mm", "1e400", "5mm ", "5 ", "1,5", "++1", "1mm%"})
    EXPECT_FALSE(length_of(bad)) << bad;
}

}  // namespace
}  // namespace prohull
