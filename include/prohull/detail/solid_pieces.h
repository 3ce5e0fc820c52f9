#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "prohull/collide.h"
#include "prohull/detail/shapes.h"
#include "prohull/distance.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Whether the sum of two finite numbers is not rounded.
bool is_exact_sum(double a, double b);

/// On which side of a curved surface the flat faces lie that stand for it; or on both, with the volume that is its own.
enum class Curved { Around, Within, SameVolume };

/// A sphere, cylinder or capsule where a pose puts it: all points p for which R^T (p - t) lies in the form, computed
/// with real numbers from the stored doubles of R and t; of a sphere R is the identity. So it is convex and closed, and
/// `contains` can be exact. Its own middle is the origin, and its axis is z. Lengths are 0, or between 1e-100 and
/// 1e100.
class CurvedForm {
 public:
  static CurvedForm sphere(const Ball& ball) {
    return CurvedForm(Kind::Sphere, ball.radius, 0, {.translation = ball.center});
  }
  static CurvedForm cylinder(double radius, double length, const Pose& pose = {}) {
    return CurvedForm(Kind::Cylinder, radius, length, pose);
  }
  /// `length` is that of the cylinder between the two half spheres.
  static CurvedForm capsule(double radius, double length, const Pose& pose = {}) {
    return CurvedForm(Kind::Capsule, radius, length, pose);
  }

  Vec3 middle() const { return pose_.translation; }

  /// If it is a sphere, the same one.
  std::optional<Ball> ball() const;

  /// Exact.
  bool contains(const Vec3& p) const;

  struct Distance {
    double lower = 0, upper = 0;
  };
  /// Proven bounds of how far p is from the form, some rounding apart; 0 is the least.
  Distance distance(const Vec3& p) const;

  /// A mesh of flat faces, closed and outwards. Guaranteed, exactly: with Curved::Around it encloses the form, with
  /// Curved::Within the form encloses it. With Curved::SameVolume it has the volume of the form, but for rounding.
  /// `segments` is the number of corners around the axis, at least 8.
  TriangleMesh mesh(Curved curved, std::size_t segments) const;

  /// No coordinate of a point of the form, or of its pose, is greater, but for rounding.
  double largest_coordinate() const;

  bool operator==(const CurvedForm&) const = default;

 private:
  enum class Kind { Sphere, Cylinder, Capsule };
  CurvedForm(Kind kind, double radius, double length, const Pose& pose)
      : kind_(kind), radius_(radius), half_(length / 2), pose_(pose) {}

  template <class Number>
  Number excess(int bound, const Vec3& p) const;
  bool keeps(int bound, const Vec3& p) const;
  double skew() const;
  double margin() const;
  double volume() const;
  bool has_exact_caps() const;
  TriangleMesh own_mesh(Curved curved, std::size_t segments) const;

  Kind kind_;
  double radius_, half_;  // half the length
  Pose pose_;
};

/// Pieces that together cover something: meshes and curved forms.
struct SolidPieces {
  TriangleMesh solids;  ///< closed meshes, each turned outwards: all that they wind around at least once. Windings are
                        ///< added, so none of them is tangled, or there is no other solid piece.
  std::vector<TriangleMesh> tangled;  ///< other closed meshes, each by itself
  TriangleMesh triangles;             ///< of all meshes, also of those that bound no solid
  std::vector<CurvedForm> curved;     ///< solid

  bool empty() const { return solids.face_count() + triangles.face_count() + curved.size() == 0; }
};

/// If the pieces are balls and nothing else: these.
std::vector<Ball> only_balls(const SolidPieces& pieces);

/// Whether a closed mesh winds around some point a negative number of times, as in a lobe that is inside out; or
/// intersects itself so often that this takes too long to find out. No is exact.
bool is_tangled(const TriangleMesh& mesh, const Progress& progress = {});

enum class Covers { Yes, No, Unknown };

struct PieceCover {
  /// Exact, but Unknown where a part and a curved piece are close to each other, where tangled pieces share the work,
  /// where all that is left lies in planes of the pieces' triangles, and where it is not found out whether the pieces
  /// leave a hole in a form.
  Covers covers = Covers::Yes;
  TriangleMesh outside;  ///< faces that are not covered, at least in part; of a curved part those around it; none if
                         ///< it is not covered inside
  /// Bounds of how far the part reaches out of the union, and a point where; only if not Yes. The upper bound is less
  /// than 2 % more than the lower one, unless that would take too long or a curved form is in the way.
  DistanceBounds reach;
};

/// Decides whether the union of the pieces covers triangles, which are finite, or a solid form: whether each of their
/// points lies in one of the pieces. For closed meshes alone, or balls alone, verify_union decides without Unknown.
///
/// A triangle that equals one of the pieces' triangles is covered, and so is one in a single curved piece. Of all
/// others, verify_cover decides: curved pieces are replaced by meshes within them to prove that a triangle is covered,
/// and by meshes around them to prove that it is not. Of unions of balls alone, verify_union decides. A form is covered
/// if a mesh around it is, and its inside: verify_enclosure, or verify_union, looks for holes. Throws Cancelled.
PieceCover verify_pieces(const TriangleMesh& triangles, const SolidPieces& pieces, const Progress& progress = {});
PieceCover verify_pieces(const CurvedForm& form, const SolidPieces& pieces, const Progress& progress = {});

}  // namespace prohull
