#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "prohull/enclosing_hull.h"
#include "prohull/tight_hull.h"

namespace prohull {

/// Throws InputError where the options of a hull exclude each other, or no hull can be what they say.
void require_usable(const TriangleMesh& triangles, std::span<const std::size_t> target_faces,
                    const EnclosingOptions& options);

/// What is asked for, and of which triangles, repaired. Nothing in it changes while hulls are built.
struct Request {
  /// The stage of progress is "repair". Throws InputError as enclosing_hulls does.
  Request(TriangleMesh triangles, std::size_t fewest_faces, const EnclosingOptions& options);

  bool is_outer() const { return options.hull.side == HullSide::Outer; }
  bool is_padded() const { return options.padding > 0; }
  bool has_tolerances() const { return !options.hull.tolerances.empty(); }
  bool is_symmetric() const { return options.hull.mirror.has_value(); }
  /// Only the mesh itself will do, and hulls that do not move.
  bool is_bound_to_mesh() const { return has_tolerances() || is_symmetric(); }
  /// The convex hull and wraps will do.
  bool is_free() const { return is_outer() && options.repair != Repair::None && !is_bound_to_mesh(); }

  /// The triangles, and the caps of their openings.
  const TriangleMesh& to_cover() const { return input.caps.face_count() > 0 ? with_caps : input.original; }
  /// The padding and a hair, for rounding, and at least so much that hulls move; 0 without padding.
  double aim() const {
    return is_padded() ? std::max(options.padding * (1 + 1e-6) + 1e-12 * diagonal, 1e-7 * diagonal) : 0;
  }

  /// Of one hull.
  HullOptions hull_options(std::size_t target_faces, std::uint64_t seed) const;
  MoveOptions move_options(unsigned max_rounds) const;
  /// What every hull must have that was built with them. Throw InputError otherwise.
  void require_tolerances(const TriangleMesh& hull) const;
  void require_symmetry(const TriangleMesh& hull) const;

  const EnclosingOptions& options;
  const std::size_t fewest_faces;  ///< of all numbers of faces that are asked for
  RepairedMesh input;
  TriangleMesh with_caps;      ///< empty if there are no caps
  PerFace<double> tolerances;  ///< of the closed mesh
  double diagonal;             ///< of the input
  double repair_seconds;
};

}  // namespace prohull
