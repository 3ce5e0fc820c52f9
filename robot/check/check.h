#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/distance.h"
#include "prohull/progress.h"
#include "robot/link_triangles.h"
#include "robot/model.h"

namespace prohull::robot {

enum class CheckVerdict {
  Covered,      ///< every triangle of the visual geometry lies within the collision geometry; exact
  Leaks,        ///< a point of the visual geometry lies outside of it; exact
  Undecided,    ///< the two touch, as far as can be told, within LinkCheck::sticks_out_at_most
  NoCollision,  ///< there is visual geometry, but no collision geometry
  NoVisual,     ///< there is nothing to cover
  Missing,      ///< not checked: geometry that matters was not found or not read; a note says which
};
std::string_view name_of(
    CheckVerdict verdict);  ///< "covered", "leaks", "undecided", "no-collision", "no-visual", "missing"

/// How the collision geometry of one link lies to its visual geometry. Lengths are in metres.
struct LinkCheck {
  std::size_t link = 0;
  CheckVerdict verdict = CheckVerdict::NoVisual;
  double sticks_out_at_least = 0;  ///< proven: some point of the visual geometry is that far outside
  double sticks_out_at_most = 0;   ///< proven: none is farther
  double rounding = 0;             ///< what is below may come of rounding; about 1e-12 of the link's size and frames
  /// Such a point, in the frame of the link. If sticks_out_at_least is 0, the middle of a face that is not covered, if
  /// there are any.
  Vec3 worst_point;
  std::size_t faces_outside = 0;  ///< faces of the visual geometry that are not covered
  std::size_t visual_faces = 0, collision_faces = 0, pieces = 0;
  double visual_volume = 0;     ///< of what lies inside of the visual geometry: as EnclosingHulls::volume; 0: unknown
  double collision_volume = 0;  ///< of the union of the pieces; estimated, where they overlap
  double convex_volume = 0;     ///< of the convex hull of the visual geometry
  bool is_estimated = false;    ///< one of the two volumes before
  /// How far the collision geometry reaches out of the solid of the visual one, whose openings count as closed; from
  /// its triangles if they bound none. What is inside counts as 0. `farthest` is a point if the lower bound is not 0.
  DistanceBounds reach;
  double mean_distance = 0;        ///< of the surface of the collision geometry, measured as `reach`, by samples
  std::vector<std::string> notes;  ///< sentences for the user
  TriangleMesh visual, collision;  ///< both in the frame of the link, for pictures
};

struct CheckOptions {
  unsigned threads = 0;    ///< 0: one for each core
  Progress progress = {};  ///< as LinkHullOptions::progress
};

/// Whether the collision geometry that a robot ships covers its visual geometry, for each link in the order of
/// Robot::links. Throws Cancelled; what is wrong with the files of a link is its verdict Missing and a note.
///
/// The collision geometry is the union of its pieces: boxes, spheres, cylinders and capsules; what a closed mesh,
/// turned outwards, winds around at least once; and the triangles of every mesh. The openings of an open mesh are
/// closed first, and a note says so. Visual meshes and boxes are their triangles; other visual forms are solid.
///
/// What "exact" means: the verdict is that of the coordinates as they are computed. If all shapes of a link have the
/// same origin, these are those of the files (times their scale). Otherwise rotations, and sums with translations,
/// round them on the way into the frame of the link: Covered and Leaks hold for the rounded coordinates, and what
/// sticks out of them by no more than LinkCheck::rounding is Undecided. Where frames of SDF or MJCF lead a thousand
/// times the size of the link away, and back, Covered becomes Undecided, too, and what the frames may have rounded
/// counts as sticking out. A face that lies in the plane of the triangles of an open mesh may be covered by several of
/// them together: also Undecided.
std::vector<LinkCheck> check_links(const Robot& robot, const CheckOptions& options = {});

/// Whether this link is as it should be: covered, nothing to cover, or sticking out provably by no more than `allow`;
/// or Undecided and not sticking out by more than the rounding.
bool passes(const LinkCheck& check, double allow = 0);

}  // namespace prohull::robot
