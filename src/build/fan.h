#pragma once

#include <cstdint>
#include <vector>

#include "geometry/simd.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {

/// The faces around an apex: face i is (apex, link[i], link[i + 1]). Answers by proven bounds, and fast, where exact
/// tests of faces against each other are not needed.
class Fan {
 public:
  static constexpr std::size_t kMostFaces = 62;

  /// Requires at least three and at most kMostFaces vertices in the link.
  void set(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, const Vec3& apex);

  const Box& box() const { return box_; }

  /// True only if no two faces have more in common than the corner or the edge that they share.
  bool is_certainly_embedded() const { return is_embedded_; }

  /// Bit i is set unless the triangle certainly has nothing in common with face i beyond the corner or the edge that
  /// they share; `corners` are the triangle's vertices, of which the apex is none.
  std::uint64_t perhaps_met(const Triangle& t, const std::array<VertexId, 3>& corners) const;

 private:
  // |error| <= (7 + 56 eps) eps * permanent, eps = 2^-53, for the triple product of differences u, v, w where the
  // permanent is that of their magnitudes (Shewchuk 1997, 4.3, as in side()). Products that underflow add at most
  // 2^-1072 (1 + |w|_1), which kTiny covers as long as differences are below kReach; those of two differences, of which
  // each error is smaller, likewise.
  static constexpr double kBound = 8 * 0x1p-53, kTiny = 0x1p-700, kReach = 0x1p300;

  struct TwoFaces {
    Vec3Pair normal;  ///< (link[i] - apex) x (link[i + 1] - apex)
    Vec3Pair minors;  ///< the same of magnitudes
  };
  struct FourIds {
    Truth4 four;
  };
  // The plane through the edge link[i]-link[i + 1] parallel to the axis along which the fan is seen.
  struct Wall {
    double u, v, du, dv;
    std::uint64_t faces_within;  ///< those that have nothing outside of it, and only corners at the edge's ends on it
  };

  std::uint64_t all_faces() const { return (std::uint64_t{1} << count_) - 1; }
  /// Masks of link vertices and of faces: bit i goes to i + 1, the last to 0.
  std::uint64_t next(std::uint64_t bits) const { return (bits << 1 | bits >> (count_ - 1)) & all_faces(); }
  std::uint64_t previous(std::uint64_t bits) const { return bits >> 1 | (bits & 1) << (count_ - 1); }

  std::uint64_t places(VertexId v) const;
  bool see_along(int axis);
  std::uint64_t within(const Wall& wall) const;
  template <class Number>
  Number depth(const Wall& wall, Number u, Number v, Number& bound) const;
  bool is_outside(const Triangle& t, const Wall& wall, unsigned but) const;
  bool is_beside(const Triangle& t, std::uint64_t shared) const;
  std::uint64_t faces_beside(const Triangle& t, const std::array<std::uint64_t, 3>& at_corner) const;

  std::size_t count_ = 0;  ///< of the link
  std::vector<FourIds> ids_;
  Vec3 apex_;
  std::vector<Vec3Pair> vertices_;  ///< the link, then the apex
  std::vector<TwoFaces> faces_;
  Box box_;
  bool is_moderate_ = false, is_embedded_ = false;
  int u_ = 0, v_ = 1;  ///< the axes across, so that the fan turns counter-clockwise
  std::vector<Wall> walls_;
};

}  // namespace prohull
