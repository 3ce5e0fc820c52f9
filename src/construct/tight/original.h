#pragma once

#include <optional>
#include <vector>

#include "construct/tight/triangle_sieve.h"
#include "geometry/tetrahedron_contact.h"
#include "geometry/winding_number.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What the vertices of a hull move towards: a closed mesh, or any triangles, of which the hull covers every one.
class Original {
 public:
  /// For an inner hull turned inside out, as the hull is: then it too is outside of it.
  static Original closed(const TriangleMesh& mesh, HullSide side, unsigned threads);
  /// Hulls never touch triangles, and keep a small clearance from them, about.
  static Original triangles(const TriangleMesh& mesh, unsigned threads);
  /// New faces of hulls keep this distance from triangles.
  static Original padded_triangles(const TriangleMesh& mesh, double padding, unsigned threads);

  const TriangleMesh& mesh() const { return sieve_.mesh(); }
  const Box& bounds() const { return bounds_; }
  /// What vertices stay in that hang over the original, or what the padding adds to it, by so much at most, relative to
  /// its diagonal.
  Box allowed(double max_overhang) const;
  double clearance() const { return clearance_; }  ///< 0: faces may touch

  /// Whether the hull may give up the tetrahedron. Exact; false where that is not certain.
  bool lies_outside_of(const Tetrahedron& removed) const;

  // The same in steps, for tetrahedra that share a corner.
  /// Adds the triangles that may be within the clearance of the tetrahedron.
  void find_near(const Tetrahedron& removed, std::vector<FaceId>& near) const;
  /// Whether the triangle is in the way. Exact.
  bool is_in_the_way(FaceId f, const Tetrahedron& removed) const;
  /// Whether tetrahedra at p are outside where no triangle is in the way; false where that is not certain.
  bool is_outside_at(const Vec3& p) const;
  /// Whether one such tetrahedron is.
  bool is_outside_inside_of(const Tetrahedron& removed) const;

  double padding() const { return padding_; }
  /// Whether a face of the hull keeps the padding. True without one.
  bool keeps_padding(const Triangle& face) const;
  struct Near {
    Vec3 point, away;  ///< of the triangles; from there to the face
    double distance;   ///< at least
  };
  /// Of the triangles that are nearer to the face than the padding, the point nearest to it.
  std::optional<Near> nearest_within_padding(const Triangle& face) const;

 private:
  Original(TriangleSieve sieve, double clearance);

  TriangleSieve sieve_;
  Box bounds_;
  double clearance_;
  double padding_ = 0;
  std::optional<WindingNumber> winding_;  ///< of a closed mesh
  int least_covered_ = 1;
};

}  // namespace prohull
