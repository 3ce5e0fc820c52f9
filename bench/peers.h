#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

struct PeerRun {
  double seconds;  ///< of processor time, of the peer's work alone: not of turning a mesh into its own kind and back
  TriangleMesh mesh;
};

// Each makes of a closed mesh one of at most that many faces, or as many as it ends with; nothing if it was not built.
// The first four enclose nothing, nor claim to.

/// CGAL's edge collapse with Garland and Heckbert's plane quadrics.
std::optional<PeerRun> run_garland_heckbert(const TriangleMesh& mesh, std::size_t faces);
/// CGAL's edge collapse with its default, Lindstrom and Turk's volume-preserving cost and placement.
std::optional<PeerRun> run_lindstrom_turk(const TriangleMesh& mesh, std::size_t faces);
/// OpenMesh's decimater with its quadric module, in double precision.
std::optional<PeerRun> run_openmesh(const TriangleMesh& mesh, std::size_t faces);
/// meshopt_simplify; it keeps a part of the vertices, where they are.
std::optional<PeerRun> run_meshoptimizer(const TriangleMesh& mesh, std::size_t faces);

/// CGAL's alpha_wrap_3 with its default offset alpha / 30. Bisection finds the least alpha whose wrap keeps to that
/// many faces, until 98 % of them are used; the time is that of this wrap alone.
std::optional<PeerRun> run_alpha_wrap(const TriangleMesh& mesh, std::size_t faces);
/// CGAL's convex hull, whose faces cannot be chosen.
std::optional<PeerRun> run_convex_hull(const TriangleMesh& mesh);

/// Points that lie outside of a closed mesh, as CGAL's packages of exact predicates say; they share no code with ours.
struct PointsOutside {
  std::size_t count = 0;  ///< by the parity of crossings
  double farthest = 0;    ///< from the mesh, rounded
};

/// Nothing if it was not built, or if `hull` is not a closed 2-manifold.
std::optional<PointsOutside> points_outside(std::span<const Vec3> points, const TriangleMesh& hull);

/// What CGAL's packages of exact predicates say about a hull; they share no code with ours.
struct ExactFacts {
  std::size_t vertices_outside;    ///< of the original, by the parity of crossings
  std::size_t self_intersections;  ///< of the hull; see cgal_self_intersections
  bool surfaces_meet;              ///< whether a face of the hull has a point in common with one of the original
};

/// Nothing if it was not built, or if `hull` is not a closed 2-manifold.
std::optional<ExactFacts> exact_facts(const TriangleMesh& original, const TriangleMesh& hull);

}  // namespace prohull::bench
