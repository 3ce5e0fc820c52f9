#pragma once

#include <numbers>

#include "prohull/cage.h"
#include "prohull/closed_solid.h"
#include "prohull/convex_cover.h"
#include "prohull/detail/names.h"
#include "prohull/enclosing_hull.h"
#include "prohull/sphere_cover.h"
#include "prohull/sweep.h"

namespace prohull {

// The options of functions, by the names and in the units that Python and JavaScript have for them. `Given` holds what
// a caller has given: each of its functions sets a value and returns true if that was given, and throws InputError if
// it is wrong.

template <class Given>
EnclosingOptions enclosing_options(const Given& given) {
  EnclosingOptions options;
  HullOptions& hull = options.hull;
  given.choice("side", hull_side_names(), hull.side);
  given.choice_or_none("mirror", axis_names(), hull.mirror);
  given.choice("strategy", strategy_names(), hull.strategy);
  given.choice("self_intersections", self_intersections_names(), hull.self_intersections);
  given.count("max_valence", hull.guards.max_valence, 3);
  given.number("min_compactness_ratio", hull.guards.min_compactness_ratio);
  given.number("sufficient_compactness", hull.guards.sufficient_compactness);
  if (double degrees = 0; given.number("max_normal_deviation_degrees", degrees))
    hull.guards.max_normal_deviation = degrees * std::numbers::pi / 180;
  given.not_negative("max_overhang", hull.guards.max_overhang);
  hull.relax_guards = true;
  given.flag("relax_guards", hull.relax_guards);
  given.flag("float32_coordinates", hull.float32_coordinates);
  given.seed("seed", hull.seed);
  given.threads(hull.threads);
  given.numbers("tolerances", hull.tolerances);
  given.not_negative("max_distance", options.bounds.max_distance);
  if (given.not_negative("max_void_percent", options.bounds.max_void_ratio)) options.bounds.max_void_ratio /= 100;
  given.not_negative("gap", options.padding);
  given.count("best_of", options.best_of, 1);
  given.flag("tight", options.tight);
  given.flag("levels", options.levels);
  given.choice("repair", repair_names(), options.repair);
  given.flag("keep_cavities", options.keep_cavities);
  given.not_negative("seal_holes", options.seal_holes);
  given.choice("open_shells", open_shells_names(), options.open_shells);
  return options;
}

template <class Given>
CageOptions cage_options(const Given& given) {
  CageOptions options;
  given.count("faces", options.outer_faces, 4);
  given.count("inner_faces", options.inner_faces);
  given.not_negative("gap", options.gap);
  given.flag("even", options.even);
  given.flag("tight", options.tight);
  given.flag("float32_coordinates", options.float32_coordinates);
  given.threads(options.threads);
  return options;
}

template <class Given>
ClosedSolidOptions closed_solid_options(const Given& given) {
  ClosedSolidOptions options;
  given.not_negative("spacing", options.spacing);
  given.choice("open_shells", open_shells_names(), options.repair.open_shells);
  given.flag("keep_cavities", options.repair.keep_cavities);
  given.flag("float32_coordinates", options.float32_coordinates);
  return options;
}

template <class Given>
ConvexCoverOptions convex_cover_options(const Given& given) {
  ConvexCoverOptions options;
  given.count("pieces", options.max_pieces, 1);
  given.count("vertices", options.max_vertices, 4);
  given.positive("max_distance", options.bounds.max_distance);
  if (given.positive("max_void_percent", options.bounds.max_void_ratio)) options.bounds.max_void_ratio /= 100;
  given.choice("shape", piece_shape_names(), options.shape);
  given.flag("float32_coordinates", options.float32_coordinates);
  given.threads(options.threads);
  return options;
}

template <class Given>
SphereCoverOptions sphere_cover_options(const Given& given) {
  SphereCoverOptions options;
  given.count("count", options.max_balls, 1);
  given.positive("max_distance", options.max_distance);
  given.flag("fill", options.fill);
  given.threads(options.threads);
  return options;
}

template <class Given>
SweepOptions sweep_options(const Given& given) {
  SweepOptions options;
  given.count("pieces", options.max_pieces, 1);
  given.not_negative("max_distance", options.max_distance);
  given.flag("float32_coordinates", options.float32_coordinates);
  given.threads(options.threads);
  return options;
}

}  // namespace prohull
