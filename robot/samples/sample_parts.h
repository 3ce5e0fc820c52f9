#pragma once

#include <cstddef>
#include <vector>

#include "prohull/collide.h"
#include "prohull/triangle_mesh.h"
#include "robot/samples/sample_robots.h"

namespace prohull::robot {

// Parts of sample robots, in any unit. They face outwards. Those that do not follow a line stand on z = 0.

/// How closely flat faces follow what is round.
struct Detail {
  std::size_t segments = 96;  ///< of a full circle
  bool is_around = false;  ///< corners lie outside of what is round, and edges stay sharp; otherwise corners lie on it
  bool is_export = true;   ///< with small parts, and open where `Ends` says so; otherwise every part is closed
};

/// A corner of a line that a fillet of this radius rounds.
struct Corner {
  Vec3 point;
  double fillet = 0;
};

/// Which ends of a part have faces. Ends that other parts hide are often left open.
enum class Ends { Closed, OpenBottom, OpenTop, Open };

/// Turns a profile about the z axis. Each corner has a radius as x and a height as z. The profile runs from the bottom
/// to the top where its outside is to its right.
TriangleMesh turned(const std::vector<Corner>& profile, const Detail& detail, Ends ends = Ends::Closed);

/// A cylinder on z = 0 with fillets around its bottom and top.
TriangleMesh disk(double radius, double height, double bottom_fillet, double top_fillet, const Detail& detail,
                  Ends ends = Ends::Closed);

/// A plate with this outline in x and y, which is seen whole from the origin and runs counter-clockwise. Its edges at
/// bottom and top are bevelled.
TriangleMesh plate(const std::vector<Corner>& outline, double height, double bevel, const Detail& detail);

/// A plate with a rectangular outline about the z axis.
TriangleMesh rounded_box(const Vec3& size, double corner, double bevel, const Detail& detail);

/// A pipe along a line of corners. Its radius changes evenly from the first to the last.
TriangleMesh swept(const std::vector<Corner>& path, double first_radius, double last_radius, const Detail& detail,
                   Ends ends = Ends::Closed);

/// The head of a screw with a round socket. Its bottom is open.
TriangleMesh bolt(double radius, double height, const Detail& detail);

/// `count` times the part, moved out by `radius` along x, and turned about the z axis.
TriangleMesh in_circle(const TriangleMesh& part, std::size_t count, double radius, double first_angle = 0);

TriangleMesh inside_out(TriangleMesh mesh);

/// In the pose, with a rotation by roll, pitch and yaw.
TriangleMesh at(const Vec3& translation, const Vec3& rpy, TriangleMesh mesh);

/// The convex hull, grown by 0.2 % from the middle of its box, so that rounding leaves nothing outside.
TriangleMesh loose_convex_hull(const TriangleMesh& mesh);

// The parts of the sample robots, before coordinates are rounded.
using NamedMeshes = decltype(SampleRobot::meshes);
NamedMeshes sample_arm_meshes();
NamedMeshes sample_gripper_meshes();
NamedMeshes sample_mobile_base_meshes();

// Their URDF files, which stand beside the sources.
extern const char* const kArmUrdf;
extern const char* const kGripperUrdf;
extern const char* const kMobileBaseUrdf;

}  // namespace prohull::robot
