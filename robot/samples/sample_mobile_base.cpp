#include <numbers>

#include "robot/samples/sample_parts.h"

// What is in mobile-base.urdf: it has the same lengths. x is forwards. Two driven wheels stand in the middle, a caster
// before and one behind them.

namespace prohull::robot {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kWheelRadius = 0.1, kWheelWidth = 0.044;
constexpr double kCasterRadius = 0.032;

/// A loop in x and z at this y, as a pipe.
TriangleMesh arch(double half_length, double height, double y, double radius, const Detail& detail) {
  return swept({{{-half_length, y, 0}},
                {{-half_length, y, height}, 0.07},
                {{half_length, y, height}, 0.07},
                {{half_length, y, 0}}},
               radius, radius, detail);
}

TriangleMesh chassis(const Detail& detail) {
  const Detail thin{.segments = detail.segments / 2, .is_around = detail.is_around, .is_export = detail.is_export};
  std::vector<TriangleMesh> parts{
      at({0, 0, -0.05}, {}, rounded_box({0.56, 0.36, 0.17}, 0.07, 0.02, detail)),
      at({0, 0, 0.135}, {}, rounded_box({0.5, 0.32, 0.012}, 0.05, 0.003, detail)),
      swept({{{0.15, -0.175, 0}}, {{0.305, -0.175, 0}, 0.08}, {{0.305, 0.175, 0}, 0.08}, {{0.15, 0.175, 0}}}, 0.016,
            0.016, thin),
      at({-0.275, 0, 0.04}, {0, -kQuarterTurn, 0}, inside_out(rounded_box({0.07, 0.18, 0.012}, 0.01, 0.003, detail)))};
  for (const double y : {-1., 1.}) {
    parts.push_back(arch(0.13, 0.125, y * 0.187, 0.010, thin));
    parts.push_back(
        at({0, y * 0.17, 0}, {-y * kQuarterTurn, 0, 0}, disk(0.035, 0.03, 0, 0.003, detail, Ends::OpenBottom)));
    for (const double x : {-0.2, 0., 0.2}) {
      parts.push_back(at({x, y * 0.12, 0.115}, {}, disk(0.012, 0.025, 0, 0, thin, Ends::Open)));
      if (detail.is_export) parts.push_back(at({x, y * 0.12, 0.147}, {}, bolt(0.006, 0.003, {.segments = 24})));
    }
  }
  return together(parts);
}

/// About z, from z = 0 on.
TriangleMesh wheel(const Detail& detail) {
  std::vector<TriangleMesh> parts{
      turned({{{0.060, 0, 0.004}},
              {{0.070, 0, 0}, 0.003},
              {{0.096, 0, 0}, 0.010},
              {{0.096, 0, kWheelWidth}, 0.010},
              {{0.070, 0, kWheelWidth}, 0.003},
              {{0.060, 0, kWheelWidth - 0.004}}},
             detail, Ends::Open),
      turned({{{0.020, 0, 0.012}},
              {{0.062, 0, 0.006}},
              {{0.062, 0, kWheelWidth - 0.006}},
              {{0.020, 0, kWheelWidth - 0.012}}},
             detail),
      at({0, 0, kWheelWidth - 0.014}, {}, disk(0.022, 0.014, 0, 0.003, detail, Ends::OpenBottom))};
  const Detail block{.segments = 24};
  const double row = kWheelWidth / 2;
  if (!detail.is_export) return together(parts);
  const TriangleMesh tread = at({0, 0, 0.25 * kWheelWidth}, {0, kQuarterTurn, 0},
                                at({0, 0, -0.006}, {}, rounded_box({0.8 * row, 0.009, 0.010}, 0.001, 0.001, block)));
  parts.push_back(in_circle(tread, 32, kWheelRadius - 0.004));
  parts.push_back(at({0, 0, row}, {}, in_circle(tread, 32, kWheelRadius - 0.004, std::numbers::pi / 32)));
  const TriangleMesh spoke = rounded_box({0.044, 0.014, 0.008}, 0.003, 0.002, {.segments = 36});
  parts.push_back(at({0, 0, kWheelWidth - 0.016}, {}, inside_out(in_circle(spoke, 5, 0.040))));
  parts.push_back(at({0, 0, kWheelWidth}, {}, in_circle(bolt(0.003, 0.002, {.segments = 24}), 5, 0.014)));
  return together(parts);
}

TriangleMesh caster_fork(const Detail& detail) {
  std::vector<TriangleMesh> parts{disk(0.026, 0.012, 0.002, 0.002, detail),
                                  at({0, 0, -0.008}, {}, disk(0.020, 0.012, 0, 0, detail))};
  const std::vector<Corner> side{{{-0.012, -0.022, 0}, 0.008},
                                 {{0.012, -0.022, 0}, 0.008},
                                 {{0.020, 0.022, 0}, 0.002},
                                 {{-0.020, 0.022, 0}, 0.002}};
  for (const double y : {-0.018, 0.018})
    parts.push_back(at({-0.012, y + 0.002, -0.026}, {kQuarterTurn, 0.25, 0}, plate(side, 0.004, 0.001, detail)));
  parts.push_back(at({-0.008, 0, -0.008}, {}, rounded_box({0.044, 0.04, 0.004}, 0.004, 0.001, detail)));
  parts.push_back(at({-0.018, 0.022, -0.038}, {kQuarterTurn, 0, 0}, disk(0.005, 0.044, 0.001, 0.001, detail)));
  return together(parts);
}

TriangleMesh caster_wheel(const Detail& detail) {
  return together({disk(kCasterRadius, 0.022, 0.006, 0.006, detail),
                   at({0, 0, -0.003}, {}, disk(0.012, 0.028, 0.001, 0.001, detail))});
}

TriangleMesh mast(const Detail& detail) {
  std::vector<TriangleMesh> parts{
      swept({{{0, -0.12, 0}}, {{0, -0.12, 0.42}, 0.08}, {{0, 0.12, 0.42}, 0.08}, {{0, 0.12, 0}}}, 0.013, 0.013, detail,
            Ends::OpenBottom)};
  for (const double y : {-0.12, 0.12}) {
    parts.push_back(at({0, y, 0}, {}, disk(0.030, 0.006, 0, 0.002, detail)));
    if (detail.is_export)
      parts.push_back(at({0, y, 0.006}, {}, in_circle(bolt(0.004, 0.0018, {.segments = 24}), 4, 0.022, 0.4)));
  }
  return together(parts);
}

}  // namespace

NamedMeshes sample_mobile_base_meshes() {
  const Detail fine, small{.segments = 64}, coarse{.segments = 12, .is_export = false};
  return {{"meshes/visual/chassis.stl", chassis(fine)},
          {"meshes/visual/wheel.stl", wheel(fine)},
          {"meshes/visual/caster_fork.stl", caster_fork(small)},
          {"meshes/visual/caster_wheel.stl", caster_wheel(small)},
          {"meshes/visual/mast.stl", mast(small)},
          {"meshes/collision/chassis.stl", chassis(coarse)},
          {"meshes/collision/caster_fork.stl", loose_convex_hull(caster_fork(small))},
          {"meshes/collision/mast.stl", mast(coarse)}};
}

}  // namespace prohull::robot
