#include "render/pattern.h"

#include <gtest/gtest.h>

#include <set>

namespace prohull::render {
namespace {

/// The strip of the unit interval, of `count`, that holds the value; -1 if none does.
int strip(double value, int count) { return 0 <= value && value < 1 ? static_cast<int>(value * count) : -1; }

TEST(Pattern, EveryPixelAndEveryBlockFillTheSquareEvenly) {
  for (const int samples : {1, 4, 16}) {
    const Pattern pattern(samples);
    const int count = samples * Pattern::kBlock * Pattern::kBlock;
    std::set<int> columns, rows;
    for (int y = 0; y < Pattern::kBlock; ++y)
      for (int x = 0; x < Pattern::kBlock; ++x) {
        std::set<int> columns_of_pixel, rows_of_pixel;
        for (int i = 0; i < samples; ++i) {
          const Point2 at = pattern.in_block(x, y, i);
          columns.insert(strip(at.x, count)), rows.insert(strip(at.y, count));
          columns_of_pixel.insert(strip(at.x, samples)), rows_of_pixel.insert(strip(at.y, samples));
        }
        EXPECT_EQ(columns_of_pixel.size(), static_cast<std::size_t>(samples));
        EXPECT_EQ(rows_of_pixel.size(), static_cast<std::size_t>(samples));
      }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    EXPECT_FALSE(columns.contains(-1) || rows.contains(-1));
  }
}

TEST(Pattern, AnyNumberOfSamplesStaysInTheSquare) {
  for (int samples = 1; samples <= 40; ++samples)
    for (int pixel = 0; pixel < 16; ++pixel)
      for (int i = 0; i < samples; ++i) {
        const Point2 at = Pattern(samples).in_block(pixel % 4, pixel / 4, i);
        EXPECT_GE(strip(at.x, 1), 0) << samples << " samples, sample " << i;
        EXPECT_GE(strip(at.y, 1), 0) << samples << " samples, sample " << i;
      }
}

TEST(Pattern, IsTheSameInEveryBlock) {
  const Pattern pattern(4);
  for (const int shift : {-8, -4, 4, 400}) {
    EXPECT_EQ(pattern.in_block(1, 2, 3).x, pattern.in_block(1 + shift, 2 - shift, 3).x);
    EXPECT_EQ(pattern.in_block(1, 2, 3).y, pattern.in_block(1 + shift, 2 - shift, 3).y);
  }
}

}  // namespace
}  // namespace prohull::render
