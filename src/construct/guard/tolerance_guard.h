#pragma once

#include <array>
#include <limits>
#include <vector>

#include "construct/star.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/ids.h"

namespace prohull {

/// How far a hull under construction may go from the mesh, and how far it has gone. Empty without tolerances.
///
/// Each point of the hull stands for a point of the mesh, and each point of the mesh has one that stands for it. A face
/// has the least tolerance of the faces that its points stand for. Where a point stands for a face with a tolerance,
/// the linear interpolation of `deviations` bounds the distance between the two; elsewhere it says nothing.
struct Tolerances {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  PerFace<double> faces;         ///< input unit; 0: the face stays as it is, and so do its corners
  PerVertex<double> deviations;  ///< input unit

  bool empty() const { return faces.empty(); }
};

/// Refuses collapses after which a face could be farther from the mesh than it may be.
///
/// Follows Cohen, Manocha and Olano 1997 (Simplifying polygonal models using successive mappings): where the star and
/// its replacement both project to a plane without folds, the points that project to the same place stand for each
/// other, whichever plane it is. The mapping is linear in each cell of the overlay of the two projections, so that the
/// corners of the cells bound it everywhere: the ends of the edge, the new vertex, and the points where edges cross.
/// Departs from the paper, which adds the greatest displacements: here deviations are interpolated.
///
/// Computes in floating point. What it lets pass is checked again when the hull is done (verify_tolerances).
class ToleranceGuard {
 public:
  explicit ToleranceGuard(Tolerances& tolerances) : tolerances_(tolerances) {}

  /// Whether the collapse of the star's edge to the apex (local) could exceed a tolerance. Requires measure_star.
  bool would_exceed(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex);

  /// To be told of every collapse: it is the one that was asked about last.
  void collapsed();

 private:
  struct Point {
    Vec3 local;
    double x = 0, y = 0;   ///< projected
    double deviation = 0;  ///< local
  };
  using Corners = std::array<const Point*, 3>;
  using Weights = std::array<double, 3>;
  struct OldFace {
    FaceId id;
    double tolerance;
    Corners corners;
  };

  void set_old_faces(const HalfEdgeMesh& mesh, const Star& star);
  void set_points(const Star& star, const Vec3& apex);
  bool holds_along(const Vec3& direction);
  bool project_without_folds(const Vec3& direction);
  bool winds_once() const;
  Corners new_face(std::size_t i) const { return {&apex_, &link_[i], &link_[i + 1 == link_.size() ? 0 : i + 1]}; }
  void bound_apex();
  void bound_at_apex();
  void bound_at_end(const Point& end);
  void bound_at_crossings(const Point& from, const Point& to);
  void raise_apex(double weight, double rest, double needed);
  void set_new_tolerances();
  bool is_beyond_all() const;
  bool is_within_tolerances() const;

  static std::array<Vec3, 3> directions(const Star& star, const Vec3& apex);
  static double double_area(const Corners& corners);
  static Weights weights_at(const Point& p, const Corners& corners);
  static bool overlap(const Corners& a, const Corners& b);

  Tolerances& tolerances_;
  std::vector<OldFace> old_faces_;  ///< of the star: those along its link, then the two at the edge
  std::vector<Point> link_;
  double least_tolerance_ = 0, greatest_tolerance_ = 0;  ///< of them
  Point o_, d_, apex_;
  double scale_ = 1;
  std::vector<double> new_tolerances_;  ///< of the faces along the link
};

}  // namespace prohull
