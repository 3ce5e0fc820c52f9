#pragma once

#include <optional>
#include <vector>

#include "prohull/distance.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"
#include "robot/curved_form.h"

namespace prohull::robot {

/// The union of the pieces of a collision geometry.
struct Pieces {
  TriangleMesh solids;  ///< closed meshes, each turned outwards: all that they wind around at least once. Windings are
                        ///< added, so none of them is tangled, or there is no other solid piece.
  std::vector<TriangleMesh> tangled;  ///< other closed meshes, each by itself
  TriangleMesh triangles;             ///< of all meshes, also of those that bound no solid
  std::vector<CurvedForm> curved;     ///< solid

  bool empty() const { return solids.face_count() + triangles.face_count() + curved.size() == 0; }
};

/// If the pieces are balls and nothing else: these.
std::vector<Ball> only_balls(const Pieces& pieces);

/// Whether a closed mesh winds around some point a negative number of times, as in a lobe that is inside out. Exact.
bool is_tangled(const TriangleMesh& mesh, const Progress& progress = {});

/// Triangles, or a curved form, of which a union may cover all.
struct Part {
  TriangleMesh flat;                 ///< finite; not looked at if there is a curved form
  std::optional<CurvedForm> curved;  ///< solid
};

enum class Covers { Yes, No, Unknown };

struct PartCover {
  /// Exact, but Unknown where a part and a curved piece are close to each other, where tangled pieces share the work,
  /// and where all that is left lies in planes of the pieces' triangles.
  Covers covers = Covers::Yes;
  TriangleMesh outside;  ///< faces that are not covered, at least in part; of a curved part those around it
  /// Bounds of how far the part reaches out of the union, and a point where; only if not Yes. The upper bound is less
  /// than 2 % more than the lower one, unless that would take too long or a curved form is in the way.
  DistanceBounds reach;
};

/// Decides whether the pieces cover a part: whether each point of its triangles, or of its form, lies in one of them.
///
/// A triangle that equals one of the pieces' triangles is covered, and so is one in a single curved piece. Of all
/// others, verify_cover decides: curved pieces are replaced by meshes within them to prove that a triangle is covered,
/// and by meshes around them to prove that it is not. Of unions of balls alone, verify_union decides.
PartCover cover(const Part& part, const Pieces& pieces, const Progress& progress = {});

}  // namespace prohull::robot
