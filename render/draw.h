#pragma once

#include "prohull/progress.h"
#include "render/tile.h"

namespace prohull::render {

struct DrawOptions {
  int samples = 4;                ///< per pixel, at least 1
  std::optional<Rgb> background;  ///< none: transparent
  int threads = 0;                ///< 0: one for each core
  Progress progress = {};         ///< stage "render"
};

/// A picture with each panel in its place. The same bits for any number of threads. Throws Cancelled.
Image draw(int width, int height, const std::vector<Panel>& panels, const DrawOptions& options);

}  // namespace prohull::render
