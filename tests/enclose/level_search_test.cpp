#include "enclose/level_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace prohull {
namespace {

struct Searched {
  LevelTrial found;
  std::size_t faces_tried = 0;
};

/// Levels of up to a million faces, of which those with n faces break the bounds by so much.
Searched searched(std::size_t fewest, const std::function<double(double n)>& excess) {
  Searched result;
  result.found = search_levels(fewest, 1'000'000, [&](std::size_t faces) {
    result.faces_tried += faces;
    return LevelTrial{faces, {}, excess(double(faces))};
  });
  return result;
}

TEST(LevelSearch, FindsNearlyTheFewestFacesThatKeepTheBounds) {
  for (const double order : {0.5, 1.0, 2.0})
    for (const double fewest_within : {30.0, 500.0, 2000.0}) {
      const LevelTrial found = searched(20, [&](double n) { return std::pow(fewest_within / n, order); }).found;
      EXPECT_TRUE(found.keeps_bounds());
      EXPECT_LT(double(found.faces), 1.2 * fewest_within) << order;
    }
}

TEST(LevelSearch, TriesWhatIsAskedForFirst) {
  const Searched result = searched(20, [](double) { return 1; });
  EXPECT_EQ(result.found.faces, 20u);
  EXPECT_EQ(result.faces_tried, 20u);
}

TEST(LevelSearch, TriesFewFacesInAllAndAnswersWithTheNearest) {
  const Searched flat = searched(20, [](double n) { return 2 + 1 / n; });
  EXPECT_FALSE(flat.found.keeps_bounds());
  EXPECT_LT(flat.faces_tried, 20'000u);
  EXPECT_GT(flat.found.faces, 1000u);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_LT(searched(20, [&](double) { return infinite; }).faces_tried, 20'000u);
  EXPECT_LT(searched(20'000, [](double) { return 2; }).faces_tried, 80'000u);
}

}  // namespace
}  // namespace prohull
