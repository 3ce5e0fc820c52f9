#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A rigid motion: a rotation, then a translation.
struct Pose {
  std::array<Vec3, 3> rotation{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< the rows of the matrix
  Vec3 translation;

  bool operator==(const Pose&) const = default;
};

/// How far the product of a rotation matrix and its transpose may be from the identity, in each entry.
inline constexpr double kRotationTolerance = 1e-6;

/// Throws InputError(InvalidOption) unless the matrix is a rotation: within kRotationTolerance, without mirroring. The
/// matrix is used as it is, not corrected. Throws InputError(NonFiniteCoordinate) for a translation beyond 1e100.
void require_rigid(const Pose& pose);

/// From a quaternion, of any length but 0. Throws InputError(InvalidOption) for 0 and for numbers that are not finite.
Pose pose_of_quaternion(double w, double x, double y, double z, const Vec3& translation = {});

/// Where the pose puts the point: R p + t in double precision, each coordinate as ((x + y) + z) + t. This rounded point
/// is what all answers below are about: a mesh in a pose is the mesh of the rounded points of its vertices.
Vec3 placed(const Pose& pose, const Vec3& point);
TriangleMesh placed(const Pose& pose, TriangleMesh mesh);

/// What a closed mesh stands for.
enum class StandsFor : std::uint8_t { Solid, Surface };

struct CollisionMesh;

/// A mesh made ready for collisions. It is immutable and cheap to copy: copies share their data, and any number of
/// threads may share one index. Built once, it serves every pose.
///
/// If the mesh is closed (is_closed in triangle_mesh.h), it stands for a solid: its faces, and the points that it winds
/// around at least once. So a cavity is free, and a mesh that is inside out has no inside. Any other mesh stands for
/// its faces alone, and so does a closed one with StandsFor::Surface: what lies within it is free.
class CollisionIndex {
 public:
  /// Takes any triangles. Throws InputError: EmptyMesh without faces; NonFiniteCoordinate if a vertex of a face is not
  /// finite or beyond 1e100.
  explicit CollisionIndex(const TriangleMesh& mesh, StandsFor what = StandsFor::Solid);

  /// Whether the mesh is closed, stands for its solid, and is not inside out in all of its components, so that there is
  /// nothing inside.
  bool is_solid() const;
  std::size_t face_count() const;
  std::size_t memory_bytes() const;  ///< of what all copies share

 private:
  friend struct CollisionAccess;
  std::shared_ptr<const CollisionMesh> mesh_;
};

/// Where the two meshes are.
struct PosePair {
  Pose a, b;
};

/// Whether the two meshes, each in its pose, have a point in common. Touching counts, and so does one solid wholly
/// inside of the other. Exact for the rounded vertices of `placed`. Throws as require_rigid, and
/// InputError(NonFiniteCoordinate) where both meshes are large but so far from the origin that rounding crushes them.
///
///     const CollisionIndex arm(arm_mesh), wall(wall_mesh);
///     if (collide(arm, pose, wall, {})) stop();
bool collide(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b);

/// Whether the two meshes, or any meshes that these enclose or cover, may have a point in common in these poses. With
/// two outer hulls this is the conservative answer for what they enclose. `false` is certain, although rounding moves
/// the vertices of hull and mesh apart: it says that the two hulls are farther from each other than that. `true` says
/// that the hulls collide, or nearly touch; what they enclose may still be free. Throws as collide, and
/// InputError(OpenEdge) if a mesh is not closed: it encloses nothing.
bool may_collide(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b);

struct FacePair {
  FaceId a{}, b{};

  bool operator==(const FacePair&) const = default;
};

/// All pairs of faces that have a point in common; touching counts. Exact; sorted. Faces without area count as the
/// segments or points that they are. Empty where one mesh is wholly inside of the other. Throws as collide.
std::vector<FacePair> intersecting_faces(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b,
                                         const Pose& pose_b);

/// Two bounds of the least distance between two meshes, in the input's unit.
struct Separation {
  double lower = 0;  ///< proven: the meshes are at least this far apart
  double upper = 0;  ///< proven: they are at most this far apart
  Vec3 point_a;      ///< points of the two faces, rounded, that far apart
  Vec3 point_b;
  FaceId face_a{}, face_b{};

  bool collide() const { return upper == 0; }
};

/// The least distance. The bounds differ by rounding only. If the meshes collide, everything is 0, and only then is
/// `upper` 0. Throws as collide.
///
/// Where the meshes are at least `limit` apart, which is greater than 0, the distance is not looked for: `lower` is the
/// limit, but for rounding, and `upper` infinite. That takes less time.
Separation separation(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b,
                      double limit = std::numeric_limits<double>::infinity());

struct CollisionOptions {
  unsigned threads = 0;    ///< threads at most; 0: one for each core
  Progress progress = {};  ///< stage "collide"
};

/// Batches of the functions above, answered by many threads: entry i is that of poses[i]. Throws as these do, with
/// the number of the first pose that is not rigid; Cancelled.
std::vector<bool> collide(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                          const CollisionOptions& options = {});

std::vector<bool> may_collide(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                              const CollisionOptions& options = {});
std::vector<Separation> separation(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                                   const CollisionOptions& options = {});

/// The pairs of faces that meet in pose i are pairs[offsets[i]] to pairs[offsets[i + 1] - 1].
struct FacePairBatch {
  std::vector<std::size_t> offsets;
  std::vector<FacePair> pairs;
};
FacePairBatch intersecting_faces(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                                 const CollisionOptions& options = {});

}  // namespace prohull
