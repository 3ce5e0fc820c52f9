#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull::robot {

// PNG pictures: the content of files, transparent where there is nothing. Triangles that are not finite are left out.

struct PictureOptions {
  int width = 560, height = 420;
  bool lines = true;  ///< the edges of what is around
  unsigned threads = 0;
  Progress progress = {};            ///< stage "draw"
  std::filesystem::path cache = {};  ///< of HullCache
};

/// What is around a geometry tells its colour.
enum class Shell {
  Hull,     ///< blue
  Shipped,  ///< orange
};

/// A geometry inside of something translucent.
struct Picture {
  TriangleMesh inside, around;  ///< in the same frame
  Shell shell = Shell::Hull;
  std::optional<Vec3> marked;  ///< a point with a red ball
};

/// Pictures of one thing, all from the same side and at the same scale, to be put beside each other. The first point
/// that is marked is on the viewer's side. A picture in which there is nothing to be drawn is empty. Throws Cancelled.
std::vector<std::string> draw_pictures(std::span<const Picture> pictures, const PictureOptions& options = {});

}  // namespace prohull::robot
