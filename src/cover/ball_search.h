#pragma once

#include <cstddef>
#include <vector>

#include "cover/depth.h"
#include "cover/patches.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/shapes.h"

namespace prohull::cover {

/// What balls are to cover, and what they reach out of.
struct BallTask {
  const Patches& patches;
  const Depth& depth;
  double size;  ///< of the cubes of the patches
  ProgressMeter& meter;
};

/// Balls that hold the points of every patch.
struct BallCover {
  std::vector<Ball> balls;
  double reach = 0;  ///< none reaches out by more
};

/// Places near the medial axis of the solid, in all parts of it: at most about `most`, some `spacing` apart.
std::vector<Place> places_for_balls(const BallTask& task, double spacing, std::size_t most);

/// At most `max_balls` balls that cover all patches and reach out as little as possible; no ball if none of the places
/// allows that within a reach of `most`.
BallCover least_reach(const BallTask& task, const std::vector<Place>& places, std::size_t max_balls, double most);

/// Few balls that reach out by no more than `reach`; no ball if that takes more than `max_balls`.
BallCover fewest_balls(const BallTask& task, const std::vector<Place>& places, std::size_t max_balls, double reach);

/// At most `max_balls` balls, moved from these places until they reach out as little as possible. Required: at the
/// places, which are no more, they hold all patches within a reach of `enough`.
BallCover improved(const BallTask& task, const std::vector<Place>& places, double enough, std::size_t max_balls);

}  // namespace prohull::cover
