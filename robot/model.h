#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "prohull/collide.h"
#include "prohull/detail/names.h"

namespace prohull::robot {

/// No number of a link, of a joint and so on.
inline constexpr auto kNone = static_cast<std::size_t>(-1);

// A robot as its file describes it, whichever format that has. Lengths are in metres, angles in radians.

struct MeshFile {
  std::string uri;                  ///< as the file says it
  std::filesystem::path path = {};  ///< where it is; empty if it was not found
  std::string why_not = {};         ///< if it was not found: where it was looked for
  Vec3 scale{1, 1, 1};              ///< of the coordinates in the mesh file
  bool alone = false;               ///< as ReadOptions::alone
  bool is_filled = false;           ///< it stands for the convex hull of the vertices that its faces use

  /// Whether files say the same of two meshes.
  friend bool operator==(const MeshFile& a, const MeshFile& b) { return a.uri == b.uri && a.scale == b.scale; }
};
struct BoxForm {
  Vec3 size;  ///< full lengths of the sides
  bool operator==(const BoxForm&) const = default;
};
struct SphereForm {
  double radius = 0;
  bool operator==(const SphereForm&) const = default;
};
/// About the z axis; the origin is its middle.
struct CylinderForm {
  double radius = 0, length = 0;
  bool operator==(const CylinderForm&) const = default;
};
/// About the z axis; the origin is its middle. `length` is that of the cylinder between the two half spheres.
struct CapsuleForm {
  double radius = 0, length = 0;
  bool operator==(const CapsuleForm&) const = default;
};
/// What is not read here, such as a plane or a height field.
struct OtherForm {
  std::string what;  ///< "heightmap"
  bool operator==(const OtherForm&) const = default;
};
using Form = std::variant<MeshFile, BoxForm, SphereForm, CylinderForm, CapsuleForm, OtherForm>;

/// A piece of the geometry of a link.
struct Shape {
  Form form;
  Pose origin = {};       ///< in the frame of the link
  std::string name = {};  ///< may be empty
  std::size_t line = 0;   ///< of its element in the file
  double way = 0;  ///< how far the frames lead that `origin` was computed from; 0: the file says it, and nothing rounds

  const MeshFile* mesh() const { return std::get_if<MeshFile>(&form); }
};

struct Link {
  std::string name;
  std::vector<Shape> visual = {}, collision = {};
  std::size_t line = 0;
};

enum class JointType { Fixed, Revolute, Continuous, Prismatic, Ball, Planar, Floating };

inline Names<JointType> joint_type_names() {
  static constexpr std::pair<std::string_view, JointType> kNames[] = {
      {"fixed", JointType::Fixed},         {"revolute", JointType::Revolute}, {"continuous", JointType::Continuous},
      {"prismatic", JointType::Prismatic}, {"ball", JointType::Ball},         {"planar", JointType::Planar},
      {"floating", JointType::Floating}};
  return kNames;
}

/// The joint follows another one: position = multiplier * position of the other + offset.
struct Mimic {
  std::size_t joint = 0;  ///< in Robot::joints
  double multiplier = 1, offset = 0;
};

/// How a link moves against its parent. In the frame of the parent, the frame of the child is at
///   origin * translation(anchor) * motion(axis, position) * translation(-anchor).
/// A link with several joints (MJCF) has them in a row: the parent frame of the second is where the first has moved the
/// child.
struct Joint {
  std::string name;
  JointType type = JointType::Fixed;
  std::size_t parent = 0, child = 0;  ///< in Robot::links; equal parents and children stand one after the other
  Pose origin = {};
  Vec3 anchor = {};    ///< in the frame of the child
  Vec3 axis{1, 0, 0};  ///< in the frame of the child, of length 1
  /// Radians, or metres of a prismatic joint; infinite where the file sets no limit.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  double rest = 0;  ///< the position in which the model is drawn
  std::optional<Mimic> mimic = {};
  std::size_t line = 0;
};

inline bool turns(const Joint& joint) {
  return joint.type == JointType::Revolute || joint.type == JointType::Continuous;
}
inline bool slides(const Joint& joint) { return joint.type == JointType::Prismatic; }
/// Whether a path can say where the joint is.
inline bool moves(const Joint& joint) { return turns(joint) || slides(joint); }

/// Guaranteed by read_robot: the names of links are distinct and not empty, the joints form a forest, and every number
/// is finite but for the limits of joints.
struct Robot {
  std::string name;
  std::vector<Link> links = {};
  std::vector<Joint> joints = {};       ///< those of a parent come before those of its children
  bool fills_collision_meshes = false;  ///< MJCF: what collides with a mesh collides with its convex hull
};

/// Which geometry of a link.
enum class Geometry { Visual, Collision };

/// "visual", "collision"
inline Names<Geometry> geometry_names() {
  static constexpr std::pair<std::string_view, Geometry> kNames[] = {{"visual", Geometry::Visual},
                                                                     {"collision", Geometry::Collision}};
  return kNames;
}

inline const std::vector<Shape>& shapes(const Link& link, Geometry which) {
  return which == Geometry::Visual ? link.visual : link.collision;
}

}  // namespace prohull::robot
