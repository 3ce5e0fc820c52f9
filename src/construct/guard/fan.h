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
  std::uint64_t perhaps_met(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners) {
    const auto& [a, b, c] = corners;
    const std::uint64_t walls = is_embedded_ ? outside(mesh, a) & outside(mesh, b) & outside(mesh, c) : 0;
    return (walls & all_within_) != 0 ? 0 : perhaps_met(mesh, corners, walls);
  }

 private:
  // |error| <= (7 + 56 eps) eps * permanent, eps = 2^-53, for the triple product of differences u, v, w where the
  // permanent is that of their magnitudes (Shewchuk 1997, 4.3, as in side()). Products that underflow add at most
  // 2^-1072 (1 + |w|_1), which kTiny covers as long as differences are below kReach; those of two differences, of which
  // each error is smaller, likewise.
  static constexpr double kBound = 8 * 0x1p-53, kTiny = 0x1p-700, kReach = 0x1p300;
  // Of walls: du, dv, offset and the point are rounded to floats, and so are two products and two differences. With r
  // the reach of the point, that is at most 5 2^-24 (|du| + |dv|) (1 + r).
  static constexpr float kFloatBound = 0x1p-21f, kFloatTiny = 0x1p-120f;

  struct FourIds {
    Truth4 four;
  };
  // Of the planes through the edges link[i]-link[i + 1], parallel to the axis along which the fan is seen: masks of
  // walls have bit i. As floats of a frame with the apex at the origin, in which the fan has size 1; those behind the
  // last are 0.
  struct FourWalls {
    Float4 du{}, dv{}, offset{}, error{};
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
  void add_wall(std::size_t i, const Vec3& from, const Vec3& to);
  void see_walls(const Vec3& p, auto&& see) const;
  std::uint64_t seen_outside(const Vec3& p) const;
  /// The walls of which a vertex is strictly outside, or an end.
  std::uint64_t outside(const HalfEdgeMesh& mesh, VertexId v) {
    Known& known = known_[v];
    if (known.time != time_) known = {seen_outside(mesh.position(v)), time_};
    return known.outside;
  }
  /// The triangle lies outside of all `walls`.
  std::uint64_t perhaps_met(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners,
                            std::uint64_t walls) const;
  bool is_beside(const Triangle& t, std::uint64_t shared) const;
  std::uint64_t faces_beside(const Triangle& t, const std::array<std::uint64_t, 3>& at_corner) const;

  std::size_t count_ = 0;  ///< of the link
  std::vector<FourIds> ids_;
  Vec3 apex_;
  std::vector<Vec3Pair> vertices_;  ///< the link, then the apex
  std::vector<Vec3Pair> normals_;   ///< (link[i] - apex) x (link[i + 1] - apex)
  Box box_;
  double size_ = 0, per_size_ = 0;  ///< of the longest side of the box
  bool is_moderate_ = false, is_embedded_ = false;
  double Vec3::*u_ = &Vec3::x;  ///< the axes across, so that the fan turns counter-clockwise
  double Vec3::*v_ = &Vec3::y;
  std::vector<FourWalls> walls_;
  std::vector<std::uint64_t>
      within_;                    ///< by face: the walls that it has nothing outside of, and only ends of at most on
  std::uint64_t all_within_ = 0;  ///< the same of all faces
  PerVertex<Known> known_;
  std::uint64_t time_ = 0;  ///< of the last set()
};

}  // namespace prohull
