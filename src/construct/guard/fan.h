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

  /// Bit i is set unless the triangle of `corners`, of which the apex is none, certainly has nothing in common with
  /// face i beyond the corner or the edge that they share. What is found of a corner is kept until the next set().
  std::uint64_t perhaps_met(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners);

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
  // The planes through the edges link[i]-link[i + 1], parallel to the axis along which the fan is seen: masks of walls
  // have bit i. Two at a time; the last comes twice if they are odd.
  struct TwoWalls {
    Double2 u, v, du, dv;
  };
  struct Sides {
    std::uint64_t inside = 0, outside = 0;  ///< the walls of which a point certainly is
  };
  struct Known {
    std::uint64_t outside, time = 0;
  };

  std::uint64_t all_faces() const { return (std::uint64_t{1} << count_) - 1; }
  /// Masks of link vertices, faces and walls: bit i goes to i + 1, the last to 0.
  std::uint64_t next(std::uint64_t bits) const { return (bits << 1 | bits >> (count_ - 1)) & all_faces(); }
  std::uint64_t previous(std::uint64_t bits) const { return bits >> 1 | (bits & 1) << (count_ - 1); }

  std::uint64_t places(VertexId v) const;
  bool see_along(int axis);
  void set_walls(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link);
  Sides sides(const Vec3& p) const;
  std::uint64_t outside(const HalfEdgeMesh& mesh, VertexId v);
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
  std::vector<TwoWalls> walls_;
  std::vector<std::uint64_t>
      within_;                    ///< by face: the walls that it has nothing outside of, and only ends of at most on
  std::uint64_t all_within_ = 0;  ///< the same of all faces
  PerVertex<Known> known_;
  std::uint64_t time_ = 0;  ///< of the last set()
};

}  // namespace prohull
