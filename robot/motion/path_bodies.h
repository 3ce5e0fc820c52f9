#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "prohull/progress.h"
#include "robot/model.h"
#include "robot/motion/pair_proof.h"
#include "robot/motion/proof_body.h"

namespace prohull::robot {

/// What may meet others on a path: a link, or a mesh of the world, which stands still in the frame of the root.
struct PathBody {
  std::string name;
  std::optional<std::size_t> link;  ///< none: of the world
  /// The parts are the body's closed shapes, which are one solid, and its others, which are faces alone.
  std::optional<ProofBody> shape = {};
  std::string unread = {};              ///< why nothing can be proven about it; empty if all of it was read
  std::vector<std::string> notes = {};  ///< of its closed meshes, as OutwardSolid has them (detail/inside_out.h)
  TriangleMesh triangles = {};          ///< of all parts
  /// A mesh file that has all of it but for where its frame is in that of the link; empty if there is none.
  std::filesystem::path file = {};
  Pose in_link = {};
};

/// The bodies of a robot and its world. A link without the geometry that is asked for has the other one.
struct PathBodies {
  std::vector<PathBody> bodies;    ///< of links with geometry, in their order; then of the world
  std::vector<std::string> notes;  ///< sentences: what stands for what, and what was turned
};

/// A mesh of the world.
struct WorldMesh {
  std::string name;
  TriangleMesh mesh;
};

/// A closed mesh that is inside out is turned. Throws InputError: as mesh_triangles; InvalidOption if two bodies have
/// the same name; EmptyMesh and NonFiniteCoordinate for what is no mesh. Throws Cancelled.
PathBodies path_bodies(const Robot& robot, Geometry which, std::span<const WorldMesh> world = {},
                       const Progress& progress = {});

/// A link by one of its geometries; without any it has no shape. Throws as mesh_triangles.
PathBody link_body(const Robot& robot, std::size_t link, Geometry which);

PathBody path_body(std::string name, std::optional<std::size_t> link, const TriangleMesh& mesh);

/// Two bodies, numbered as in PathBodies::bodies, the lower number first.
using BodyPair = std::pair<std::size_t, std::size_t>;

/// All pairs that may meet: neither links that a joint connects directly (JointPaths::are_adjacent), nor two meshes of
/// the world, nor those to ignore. `links` are pairs of links, `bodies` pairs of names. Throws
/// InputError(InvalidOption) for a name that no body has.
std::vector<BodyPair> pairs_on_path(const Robot& robot, std::span<const PathBody> bodies,
                                    std::span<const LinkPair> links = {},
                                    std::span<const std::pair<std::string, std::string>> names = {});

}  // namespace prohull::robot
