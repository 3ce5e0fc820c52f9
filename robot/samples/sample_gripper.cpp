#include <cmath>
#include <numbers>

#include "robot/samples/sample_parts.h"

// What is in gripper.urdf: it has the same lengths.
//
// Each finger is held by two bars of equal length, the driver and the follower, so that it moves without turning. The
// gripper opens along x. Its meshes are in millimetres, as many are; the URDF file scales them.
//
//          finger                  seen along y
//     D____|
//     |    B
//     |    |  driver: A to B       L: from A to B, and from C to D
//     C    |  follower: C to D
//    ______A____
//       palm

namespace prohull::robot {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr Vec3 kA{30, 0, 92}, kC{12, 0, 104}, kL{45, 0, 35};
constexpr Vec3 kD = {kC.x - kA.x, 0, kC.z - kA.z};  // in the frame of the finger, whose origin is B

/// A plate in x and z, whose middle is at y.
TriangleMesh upright(const Vec3& middle, double thickness, double pitch, const TriangleMesh& plate) {
  return at({middle.x, middle.y + thickness / 2, middle.z}, {kQuarterTurn, pitch, 0}, plate);
}

/// Along y, about its middle.
TriangleMesh pin(const Vec3& middle, double radius, double length, const Detail& detail) {
  return at({middle.x, middle.y + length / 2, middle.z}, {kQuarterTurn, 0, 0}, disk(radius, length, 0.6, 0.6, detail));
}

TriangleMesh palm() {
  const Detail fine{.segments = 72}, small{.segments = 36};
  std::vector<TriangleMesh> parts{disk(37.5, 10, 0.5, 1.5, fine),
                                  at({0, 0, 9}, {}, disk(31, 14, 0, 2, fine, Ends::OpenBottom)),
                                  at({0, 0, 20}, {}, rounded_box({96, 58, 66}, 12, 5, fine)),
                                  at({-48, 0, 40}, {0, -kQuarterTurn, 0}, disk(9, 12, 0, 3, small, Ends::OpenBottom))};
  const std::vector<Corner> cheek{{{-43, -16, 0}, 3}, {{43, -16, 0}, 3}, {{39, 8, 0}, 8},
                                  {{20, 22, 0}, 8},   {{-20, 22, 0}, 8}, {{-39, 8, 0}, 8}};
  for (const double y : {-22., 22.}) parts.push_back(upright({0, y, 92}, 8, 0, plate(cheek, 8, 1, fine)));
  for (const double x : {-1., 1.}) {
    parts.push_back(pin({x * kA.x, 0, kA.z}, 4, 55, small));
    parts.push_back(pin({x * kC.x, 0, kC.z}, 3, 55, small));
  }
  const TriangleMesh screws =
      together({in_circle(bolt(2.5, 1.4, small), 2, 29, 0.5), in_circle(bolt(2.5, 1.4, small), 2, 29, -0.5)});
  const TriangleMesh lid = together({rounded_box({62, 40, 3}, 6, 1, fine), at({0, 0, 3}, {}, screws)});
  for (const double side : {-1., 1.})
    parts.push_back(at({0, side * 29, 52}, {-side * kQuarterTurn, 0, 0}, side > 0 ? lid : inside_out(lid)));
  return together(parts);
}

/// Two plates from the origin to L, and what they turn about.
TriangleMesh bars(double width, double thickness, double apart, double boss, const Detail& detail) {
  const double half = width / 2, end = norm(kL) + half, pitch = -std::atan2(kL.z, kL.x);
  const TriangleMesh bar = plate({{{-half, -half, 0}, 0.98 * half},
                                  {{end, -half, 0}, 0.98 * half},
                                  {{end, half, 0}, 0.98 * half},
                                  {{-half, half, 0}, 0.98 * half}},
                                 thickness, 1, detail);
  const double length = apart + thickness + 1;
  return together({upright({0, apart / 2, 0}, thickness, pitch, bar),
                   upright({0, -apart / 2, 0}, thickness, pitch, bar), pin({}, boss, length, detail),
                   pin(kL, boss, length, detail)});
}

TriangleMesh driver(const Detail& detail) { return bars(18, 5, 28, 7, detail); }
TriangleMesh follower(const Detail& detail) { return bars(12, 4, 16, 4, detail); }

TriangleMesh finger(const Detail& detail) {
  const Vec3 middle{-18, 0, 16};  // sees the whole outline
  const std::vector<Corner> outline{{{26, -24, 0}, 6}, {{28, -10, 0}, 6}, {{6, 8, 0}, 8},    {{0, 54, 0}, 4},
                                    {{-10, 58, 0}, 3}, {{-15, 53, 0}, 2}, {{-15, 10, 0}, 6}, {{-9, -3, 0}, 4},
                                    {{-5, -14, 0}, 5}, {{10, -24, 0}, 5}};
  return together(
      {upright(middle, 20, 0, plate(outline, 20, 1.5, detail)), pin({}, 5, 25, detail), pin(kD, 4, 24, detail)});
}

/// In its own frame: on z = 0, grips along z.
TriangleMesh pad(const Detail& detail) {
  std::vector<TriangleMesh> parts{rounded_box({40, 20, 2}, 2, 0.5, detail)};
  for (int rib = 0; rib < 8; ++rib)
    parts.push_back(at({-17.5 + 5 * rib, 0, 1.5}, {}, rounded_box({3, 19, 1.5}, 0.8, 0.5, detail)));
  return together(parts);
}

}  // namespace

NamedMeshes sample_gripper_meshes() {
  const Detail flat{.segments = 48}, coarse{.segments = 16, .is_export = false};
  return {{"meshes/visual/palm.stl", palm()},
          {"meshes/visual/driver.stl", driver(flat)},
          {"meshes/visual/follower.stl", follower(flat)},
          {"meshes/visual/finger.stl", finger(flat)},
          {"meshes/visual/pad.stl", pad({.segments = 24})},
          {"meshes/collision/palm.stl", loose_convex_hull(palm())},
          {"meshes/collision/driver.stl", driver(coarse)},
          {"meshes/collision/finger.stl", loose_convex_hull(finger(coarse))}};
}

}  // namespace prohull::robot
