#include <array>
#include <numbers>

#include "robot/samples/sample_parts.h"

// What is in arm.urdf: it has the same lengths.
//
// The arm is a chain of links that stand on a joint and hold the next one beside them, on a housing, and of links that
// hang on such a housing with a hub and rise to the next joint. Every second one rises on the other side.
//
//      |  | tube              seen along x; the joints' axes are
//    __|  |__    hanging      vertical and horizontal in turn
//   |  hub   |
//   |________|
//        ________
//   |   | housing|
//   |___|__    __|   standing
//          |  | tube

namespace prohull::robot {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kBaseHeight = 0.15;
constexpr double kGap = 0.001;  // between links
constexpr double kBoltHeight = 0.0016;

struct Standing {
  double tube, housing;  // radii
  double height;         // of the housing's axis
  double reach, back;    // of the housing, to the next link and away from it
  double side;           // 1 or -1: the next link is there, along y
};
struct Hanging {
  double hub;          // radius
  double middle;       // of the hub, where the tube rises
  double length;       // of the tube
  double first, last;  // radii of the tube
  double shift;        // of the tube's end, along z
  double side;         // of the link before
};

constexpr std::array<Standing, 3> kStanding{{{0.058, 0.062, 0.105, 0.070, 0.062, 1},
                                             {0.047, 0.051, 0.088, 0.058, 0.052, -1},
                                             {0.039, 0.043, 0.076, 0.049, 0.045, 1}}};
constexpr std::array<Hanging, 3> kHanging{{{0.062, 0.064, 0.290, 0.054, 0.047, 0, 1},
                                           {0.051, 0.053, 0.270, 0.043, 0.039, -0.026, -1},
                                           {0.043, 0.046, 0.090, 0.037, 0.036, 0, 1}}};

/// A lid with bolts on it.
TriangleMesh cover(double radius, const Detail& detail) {
  const bool is_over_bolts = detail.is_around;
  const double height = 0.009 + (is_over_bolts ? kBoltHeight + 0.0004 : 0);
  TriangleMesh lid = disk(radius, height, 0, 0.006, detail, Ends::OpenBottom);
  if (!detail.is_export) return lid;
  const Detail small{.segments = detail.segments / 4};
  return together({lid, at({0, 0, height}, {}, in_circle(bolt(0.0042, kBoltHeight, small), 6, 0.68 * radius)),
                   at({0, 0, height}, {},
                      turned({{{0.30 * radius, 0, 0}},
                              {{0.30 * radius, 0, 0.0008}},
                              {{0.26 * radius, 0, 0.0008}},
                              {{0.26 * radius, 0, 0}}},
                             detail, Ends::Open))});
}

/// A ring at the end of a tube.
TriangleMesh collar(double radius, double height, const Detail& detail) {
  return disk(radius, height, 0.003, 0.003, detail);
}

/// A cylinder with a groove near its bottom, where the next link begins.
TriangleMesh drum(double radius, double length, const Detail& detail) {
  const double from = 0.013, to = 0.016, groove = radius - 0.0025;
  if (!detail.is_export) return disk(radius, length, 0.003, 0.2 * radius, detail);
  return turned({{{0.5 * radius, 0, 0}},
                 {{radius, 0, 0}, 0.003},
                 {{radius, 0, from}},
                 {{groove, 0, from}},
                 {{groove, 0, to}},
                 {{radius, 0, to}},
                 {{radius, 0, length}, 0.2 * radius},
                 {{0.5 * radius, 0, length}}},
                detail);
}

TriangleMesh standing(const Standing& s, const Detail& detail) {
  const double upper = 0.94 * s.housing;
  const TriangleMesh tube = turned({{{0.5 * s.tube, 0, kGap}},
                                    {{s.tube, 0, kGap}},
                                    {{s.tube, 0, 0.3 * s.height}, 0.08},
                                    {{upper, 0, s.height}},
                                    {{0.5 * upper, 0, s.height}}},
                                   detail, Ends::OpenTop);
  const Vec3 back{s.side * kQuarterTurn, 0, 0};  // turns z away from the next link
  return together({at({0, 0, kGap}, {}, collar(1.06 * s.tube, 0.016, detail)), tube,
                   at({0, s.side * (s.reach - kGap), s.height}, back, drum(s.housing, s.reach + s.back, detail)),
                   at({0, -s.side * s.back, s.height}, back, cover(0.76 * s.housing, detail))});
}

TriangleMesh short_tube(const Hanging& h, const Detail& detail) {
  return swept({{{0, 0, 0}}, {{0, 0, h.length - kGap}}}, h.first, h.last, detail, Ends::OpenBottom);
}

TriangleMesh long_tube(const Hanging& h, const Detail& detail) {
  const double waist = 0.84 * h.last;
  return turned({{{0.5 * h.first, 0, 0}},
                 {{h.first, 0, 0}},
                 {{h.first, 0, 1.1 * h.hub}, 0.05},
                 {{waist, 0, 0.45 * h.length}, 0.2},
                 {{waist, 0, 0.72 * h.length}, 0.08},
                 {{h.last, 0, h.length - 0.03}, 0.03},
                 {{h.last, 0, h.length - kGap}},
                 {{0.5 * h.last, 0, h.length - kGap}}},
                detail, Ends::OpenBottom);
}

TriangleMesh bent_tube(const Hanging& h, const Detail& detail) {
  const double y = h.side * h.shift;
  return swept(
      {{{0, 0, 0}}, {{0, 0, 0.4 * h.length}, 0.12}, {{0, y, 0.72 * h.length}, 0.12}, {{0, y, h.length - kGap}}},
      h.first, h.last, detail, Ends::OpenBottom);
}

/// A hose with two clamps along a bent tube.
TriangleMesh hose(const Hanging& h, const Detail& detail) {
  const double y = h.side * h.shift, top = h.length - 0.012;
  const double lower = h.first + 0.006, upper = h.last + 0.006;
  const Detail thin{.segments = detail.segments / 3, .is_around = detail.is_around, .is_export = detail.is_export};
  const TriangleMesh clamp = rounded_box({0.022, 0.020, 0.012}, 0.004, 0.002, thin);
  return together({swept({{{0.75 * h.hub, 0, 0.02}},
                          {{lower, 0, 1.3 * h.hub}, 0.04},
                          {{lower, 0, 0.4 * h.length}, 0.10},
                          {{upper, y, 0.74 * h.length}, 0.10},
                          {{upper, y, top - 0.02}, 0.012},
                          {{0.6 * h.last, y, top}}},
                         0.005, 0.005, thin),
                   at({lower - 0.004, 0, 0.34 * h.length}, {}, clamp),
                   at({upper - 0.004, y, 0.82 * h.length}, {}, inside_out(clamp))});
}

TriangleMesh hanging_without_cover(const Hanging& h, const Detail& detail) {
  const Vec3 upwards{h.side * kQuarterTurn, 0, 0};  // turns z to where the tube rises
  TriangleMesh rising = h.shift != 0           ? together({bent_tube(h, detail), hose(h, detail)})
                        : h.length < 3 * h.hub ? short_tube(h, detail)
                                               : long_tube(h, detail);
  append(rising, at({0, h.side * h.shift, h.length - 0.017 - kGap}, {}, collar(1.06 * h.last, 0.017, detail)));
  return together(
      {at({0, 0, kGap}, {}, drum(h.hub, 2 * h.middle - kGap, detail)), at({0, 0, h.middle}, upwards, rising)});
}

Vec3 cover_place(const Hanging& h) { return {0, 0, 2 * h.middle}; }

TriangleMesh hanging(const Hanging& h, const Detail& detail) {
  return together({hanging_without_cover(h, detail), at(cover_place(h), {}, cover(0.76 * h.hub, detail))});
}

/// Two plugs on a box.
TriangleMesh connectors(const Detail& detail) {
  const Vec3 backwards{0, -kQuarterTurn, 0};
  std::vector<TriangleMesh> parts{at({-0.066, 0, 0.028}, {}, rounded_box({0.05, 0.076, 0.056}, 0.008, 0.004, detail))};
  for (const double y : {-0.018, 0.018})
    parts.push_back(at({-0.091, y, 0.056}, backwards, disk(0.011, 0.012, 0, 0.002, detail, Ends::OpenBottom)));
  return together(parts);
}

TriangleMesh base(const Detail& detail) {
  const double top = kStanding[0].tube;
  std::vector<TriangleMesh> parts{disk(0.098, 0.014, 0.001, 0.004, detail),
                                  turned({{{0.04, 0, 0.01}},
                                          {{0.080, 0, 0.01}},
                                          {{0.080, 0, 0.05}, 0.05},
                                          {{top + 0.004, 0, 0.105}, 0.05},
                                          {{top + 0.004, 0, 0.128}},
                                          {{0.5 * top, 0, 0.128}}},
                                         detail, Ends::Open),
                                  at({0, 0, 0.128}, {}, collar(1.06 * top, kBaseHeight - 0.128, detail)),
                                  connectors(detail)};
  if (detail.is_export)
    parts.push_back(
        at({0, 0, 0.014}, {}, in_circle(bolt(0.006, 0.0018, {.segments = 24}), 6, 0.088, kQuarterTurn / 3)));
  return together(parts);
}

TriangleMesh tool_flange(const Detail& detail) {
  const double wide = kHanging[2].last, narrow = 0.0315;
  return together(
      {at({0, 0, kGap}, {}, drum(wide, 0.034, detail)),
       at({0, 0, 0.03}, {},
          turned({{{0.010, 0, 0}},
                  {{narrow, 0, 0}},
                  {{narrow, 0, 0.016}, 0.001},
                  {{0.016, 0, 0.016}},
                  {{0.016, 0, 0.010}},
                  {{0.006, 0, 0.010}}},
                 detail, Ends::OpenBottom)),
       at({0, 0, 0.046}, {}, in_circle(bolt(0.003, 0.0015, {.segments = 24}), 4, 0.025)),
       at({0, 0, 0.04}, {}, inside_out(in_circle(disk(0.003, 0.008, 0, 0.001, {.segments = 24}), 1, 0.025, 0.4)))});
}

}  // namespace

NamedMeshes sample_arm_meshes() {
  const Detail fine, coarse{.segments = 20, .is_export = false}, less_coarse{.segments = 28, .is_export = false},
      around{.segments = 12, .is_around = true, .is_export = false},
      finer_around{.segments = 40, .is_around = true, .is_export = false};
  return {
      {"meshes/visual/base.stl", base(fine)},
      {"meshes/visual/link1.stl", standing(kStanding[0], fine)},
      {"meshes/visual/link2.stl", hanging_without_cover(kHanging[0], fine)},
      {"meshes/visual/link2_cover.stl", cover(0.76 * kHanging[0].hub, fine)},
      {"meshes/visual/link3.stl", standing(kStanding[1], fine)},
      {"meshes/visual/link4.stl", hanging(kHanging[1], fine)},
      {"meshes/visual/link5.stl", standing(kStanding[2], fine)},
      {"meshes/visual/link6.stl", hanging(kHanging[2], fine)},
      {"meshes/visual/link7.stl", tool_flange(fine)},
      {"meshes/collision/base.stl", base(coarse)},
      {"meshes/collision/link1.stl", standing(kStanding[0], coarse)},
      {"meshes/collision/link2.stl", loose_convex_hull(hanging(kHanging[0], finer_around))},
      {"meshes/collision/link4.stl", hanging(kHanging[1], coarse)},
      {"meshes/collision/link5.stl", standing(kStanding[2], less_coarse)},
      {"meshes/collision/link6.stl", hanging(kHanging[2], around)},
  };
}

}  // namespace prohull::robot
