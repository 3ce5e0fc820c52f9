#pragma once

#include <memory>

#include "prohull/progressive_hull.h"
#include "view/blocks.h"

namespace prohull::view {

/// A record of vertex splits as a page replays it: web/src/data/levels.js. Vertices and faces are numbered in the order
/// in which they come: first those of the base mesh. Split k lets its vertex s become o, adds the vertex d as the next
/// one and the faces (o, d, l) and (d, o, r) as the next two. Every vertex has a list of its corners, to which faces
/// are appended as they come; a bit for each corner in the list of s tells whether the split gives it to d. Those that
/// o keeps stay in their order, and so do those of d. A number for each split tells which corners of its new faces are
/// o of the first and d of the second, as in the original. The link of s tells l and r: see web/src/data/levels.js.
///
/// `distances` holds the distance of each vertex from the original, by its number in the hull.
nlohmann::json levels_facts(const ProgressiveHull& hull, const PerVertex<double>& distances, const Grid& grid,
                            Blocks& blocks);

/// The faces of levels, split by split from the base mesh to the original.
class MadeFaces {
 public:
  explicit MadeFaces(const ProgressiveHull& hull);
  ~MadeFaces();
  /// All faces that the splits after those of the last call make, up to so many splits: every face of the levels up to
  /// there is one of these, or a face of the level of the last call. Vertices are those of the hull.
  TriangleMesh until(std::size_t splits);

 private:
  const ProgressiveHull& hull_;
  std::unique_ptr<class Replay> replay_;
  std::size_t made_ = 0;
};

/// The volume of each level, from the base mesh to the original, rounded.
std::vector<double> volumes_of_levels(const ProgressiveHull& hull);

}  // namespace prohull::view
