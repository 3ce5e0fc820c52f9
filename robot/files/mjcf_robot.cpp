#include "robot/files/mjcf_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "robot/files/inertial.h"
#include "robot/files/mjcf_model.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

constexpr std::size_t kDeepest = 96;   // bodies in each other: MuJoCo 2.2.2 reads elements at most 100 deep
constexpr double kFarthest = 1e10;     // positions that MuJoCo takes
constexpr double kPlaceholder = 1e-3;  // kg

std::string pose_text(const Pose& pose) {
  std::string text;
  for (const auto& [key, value] : mjcf_attributes_of(pose)) text += fmt::format(" {}=\"{}\"", key, value);
  return text;
}

/// Whether the joint holds its child where it is.
bool is_locked(const Joint& joint) {
  return joint.type == JointType::Fixed || (moves(joint) && joint.lower == joint.upper && std::isfinite(joint.lower));
}

/// Where the child is; of a joint that moves, in its position 0.
Pose rest_of(const Joint& joint) {
  if (joint.type == JointType::Fixed || !is_locked(joint)) return joint.origin;
  return composed(joint.origin,
                  turns(joint) ? rotation_about(joint.axis, joint.lower) : translation_by(joint.axis * joint.lower));
}

class MjcfRobotWriter {
 public:
  MjcfRobotWriter(const RobotFile& file, const Robot& robot, const MujocoMesh& mesh)
      : document_(file.text, file.path.string()),
        robot_(robot),
        mesh_(mesh),
        links_(document_.root().children_called("link")),
        above_(links_.size()),
        below_(links_.size()) {
    for (const XmlElement* link : links_) inertials_.push_back(urdf_inertial(document_, *link));
    for (const XmlElement* joint : document_.root().children_called("joint"))
      joints_[*joint->attribute("name")] = joint;
    for (const Joint& joint : robot.joints) above_[joint.child] = &joint, below_[joint.parent].push_back(&joint);
    look_at(document_.root());
  }

  MjcfRobot write(std::span<const std::pair<std::size_t, std::size_t>> apart) {
    const auto root = std::ranges::find(above_, nullptr) - above_.begin();
    if (deepest() > kDeepest)
      refuse(
          fmt::format("{}: more than {} links hang below each other, and MuJoCo "
                      "reads no elements that are nested so deep",
                      document_.file(), kDeepest));
    add_body(static_cast<std::size_t>(root), 1);
    std::string contacts, equalities;
    for (const auto& [a, b] : apart)
      contacts += fmt::format("    <exclude body1=\"{}\" body2=\"{}\"/>\n", body_name(a), body_name(b));
    for (const Joint& joint : robot_.joints) equalities += equality(joint);
    add_notes();
    std::string assets;
    for (const auto& [file, name] : assets_)
      assets += fmt::format("    <mesh name=\"{}\" file=\"{}\"/>\n", xml_escaped(name), xml_escaped(file));
    return {fmt::format("<mujoco model=\"{}\">\n"
                        "  <compiler angle=\"radian\" autolimits=\"true\"/>\n"
                        "  <default>\n"
                        "    <default class=\"visual\">\n"
                        "      <geom group=\"2\" contype=\"0\" conaffinity=\"0\" density=\"0\"/>\n"
                        "    </default>\n"
                        "    <default class=\"collision\">\n"
                        "      <geom group=\"3\"/>\n"
                        "    </default>\n"
                        "  </default>\n{}  <worldbody>\n{}  </worldbody>\n{}{}</mujoco>\n",
                        xml_escaped(robot_.name), section("asset", assets), bodies_, section("contact", contacts),
                        section("equality", equalities)),
            std::move(notes_)};
  }

 private:
  static std::string section(std::string_view tag, const std::string& content) {
    return content.empty() ? "" : fmt::format("  <{0}>\n{1}  </{0}>\n", tag, content);
  }

  // Bodies

  /// A root of this name is MuJoCo's own body.
  bool is_world(std::size_t link) const { return !above_[link] && robot_.links[link].name == "world"; }

  std::string body_name(std::size_t link) const {
    const std::string& name = robot_.links[link].name;
    return xml_escaped(name == "world" && !is_world(link) ? world_link() : name);
  }

  std::string world_link() const {
    return unused("world_link",
                  [&](const std::string& name) { return std::ranges::count(robot_.links, name, &Link::name) > 0; });
  }

  template <class IsUsed>
  static std::string unused(std::string name, IsUsed is_used) {
    while (is_used(name)) name += '_';
    return name;
  }

  void add_body(std::size_t link, std::size_t depth) {
    const std::string indent(2 * depth + 2, ' ');
    if (is_world(link)) {
      bodies_ += geoms(link, indent);
      for (const Joint* joint : below_[link]) add_body(joint->child, depth);
      return;
    }
    const Joint* const above = above_[link];
    const bool moves = above && !is_locked(*above);
    const std::string inner = indent + "  ", shapes = geoms(link, inner);
    bodies_ +=
        fmt::format("{}<body name=\"{}\"{}>\n", indent, body_name(link), above ? pose_text(rest_of(*above)) : "");
    if (const auto mass = mass_of(link, moves, shapes)) bodies_ += inner + mjcf_inertial(*mass) + "\n";
    if (moves) add_joint(*above, inner);
    bodies_ += shapes;
    for (const Joint* joint : below_[link]) add_body(joint->child, depth + 1);
    bodies_ += indent + "</body>\n";
  }

  /// None if MuJoCo is to compute the mass from the geoms, or if there are none and it needs no mass. MuJoCo asks for
  /// the mass of all that moves, and would give one to all else that has geoms.
  std::optional<Inertial> mass_of(std::size_t link, bool moves, const std::string& geoms) {
    const std::string& name = robot_.links[link].name;
    std::optional<Inertial> mass = std::exchange(inertials_[link], std::nullopt);
    if (!mass && moves) mass = taken_from_below(link);
    if (mass) {
      const auto tensor = mujoco_tensor(mass->tensor, moves);
      if (!tensor) impossible_.push_back(name);
      mass->tensor = tensor ? *tensor : mean_tensor(*mass);
    } else if (!moves) {
      if (!geoms.empty()) mass = Inertial{};
    } else if (geoms.find("\"collision\"") != std::string::npos) {
      of_geoms_.push_back(name);
    } else {
      without_mass_.push_back(name);
      mass = Inertial{.mass = kPlaceholder};
      mass->tensor = mean_tensor(*mass);
    }
    return mass;
  }

  /// The mass of a link that is fixed to this one, in the frame of this one.
  std::optional<Inertial> taken_from_below(std::size_t link) {
    for (const Joint* joint : below_[link]) {
      if (!is_locked(*joint)) continue;
      std::optional<Inertial> mass = std::exchange(inertials_[joint->child], std::nullopt);
      if (!mass) mass = taken_from_below(joint->child);
      if (mass) return Inertial{mass->mass, composed(rest_of(*joint), mass->origin), mass->tensor};
    }
    return std::nullopt;
  }

  /// How many bodies are in each other at most, with the link. Parents come before their children in Robot::joints.
  std::size_t deepest() const {
    std::vector<std::size_t> depth(links_.size(), 1);
    std::size_t most = 1;
    for (const Joint& joint : robot_.joints)
      most = std::max(most, depth[joint.child] = depth[joint.parent] + !is_world(joint.parent));
    return most;
  }

  // Joints

  void add_joint(const Joint& joint, const std::string& indent) {
    const auto add = [&](const char* type, const std::string& name, const Vec3& axis, const std::string& rest = "") {
      bodies_ += fmt::format("{}<joint name=\"{}\" type=\"{}\" axis=\"{} {} {}\"{}/>\n", indent, xml_escaped(name),
                             type, axis.x, axis.y, axis.z, rest);
    };
    const std::string rest = range(joint) + dynamics(joint);
    const Pose plane = joint.type == JointType::Planar ? turn_of_z_to(joint.axis) : Pose{};
    const auto along = [&](const Vec3& axis, const char* suffix) {
      add("slide", joint_name(joint.name + suffix), placed(plane, axis), rest);
    };
    switch (joint.type) {
      case JointType::Fixed:
        return;
      case JointType::Revolute:
      case JointType::Continuous:
        return add("hinge", joint.name, joint.axis, rest);
      case JointType::Prismatic:
        return add("slide", joint.name, joint.axis, rest);
      case JointType::Planar:
        along({1, 0, 0}, "_TX"), along({0, 1, 0}, "_TY");
        return add("hinge", joint_name(joint.name + "_RZ"), joint.axis, rest);
      case JointType::Floating:
        if (is_world(joint.parent)) {
          bodies_ += fmt::format("{}<freejoint name=\"{}\"/>\n", indent, xml_escaped(joint.name));
          return;
        }
        along({1, 0, 0}, "_TX"), along({0, 1, 0}, "_TY"), along({0, 0, 1}, "_TZ");  // MuJoCo nests no free joints
        [[fallthrough]];
      case JointType::Ball:
        bodies_ += fmt::format("{}<joint name=\"{}\" type=\"ball\"{}/>\n", indent, xml_escaped(joint.name), rest);
    }
  }

  /// Of a joint that MuJoCo has in place of a part of another one.
  std::string joint_name(std::string name) {
    name = unused(std::move(name), [&](const std::string& used) { return joints_.contains(used); });
    joints_.emplace(name, nullptr);
    return name;
  }

  static std::string range(const Joint& joint) {
    if (std::isinf(joint.lower) && std::isinf(joint.upper)) return "";
    return fmt::format(" range=\"{} {}\"", std::max(joint.lower, -kFarthest), std::min(joint.upper, kFarthest));
  }

  std::string dynamics(const Joint& joint) const {
    const XmlElement* const element = joints_.at(joint.name)->child("dynamics");
    if (!element) return "";
    std::string text;
    const double damping = document_.number(*element, "damping", 0),
                 friction = document_.number(*element, "friction", 0);
    if (damping > 0) text += fmt::format(" damping=\"{}\"", damping);
    if (friction > 0) text += fmt::format(" frictionloss=\"{}\"", friction);
    return text;
  }

  /// What <mimic> says.
  std::string equality(const Joint& joint) const {
    if (!joint.mimic || !moves(joint) || is_locked(joint)) return "";
    const auto& [other, multiplier, offset] = *joint.mimic;
    const Joint& followed = robot_.joints[other];
    const std::string follower = fmt::format("    <joint joint1=\"{}\"", xml_escaped(joint.name));
    if (moves(followed) && !is_locked(followed))
      return fmt::format("{} joint2=\"{}\" polycoef=\"{} {} 0 0 0\"/>\n", follower, xml_escaped(followed.name), offset,
                         multiplier);
    const double position = moves(followed) ? followed.lower : 0;
    return fmt::format("{} polycoef=\"{} 0 0 0 0\"/>\n", follower, offset + multiplier * position);
  }

  // Geoms

  std::string geoms(std::size_t link, const std::string& indent) {
    const std::vector<const XmlElement*> elements = links_[link]->children_called("visual");
    const Link& of = robot_.links[link];
    std::string text;
    const auto add = [&](const Shape& shape, std::string_view of_class, const std::string& color) {
      if (const std::string form = form_text(of.name, shape.form); !form.empty())
        text += fmt::format("{}<geom class=\"{}\"{}{}{}/>\n", indent, of_class, form, pose_text(shape.origin), color);
    };
    for (std::size_t i = 0; i < of.visual.size(); ++i) add(of.visual[i], "visual", color(*elements[i]));
    for (const Shape& shape : of.collision) add(shape, "collision", "");
    return text;
  }

  /// Empty for what MuJoCo does not have. Its sizes are half lengths.
  std::string form_text(const std::string& link, const Form& form) {
    if (const auto* const box = std::get_if<BoxForm>(&form)) {
      const Vec3 half = box->size / 2;
      return fmt::format(" type=\"box\" size=\"{} {} {}\"", half.x, half.y, half.z);
    }
    if (const auto* const sphere = std::get_if<SphereForm>(&form))
      return fmt::format(" type=\"sphere\" size=\"{}\"", sphere->radius);
    if (const auto* const cylinder = std::get_if<CylinderForm>(&form))
      return fmt::format(" type=\"cylinder\" size=\"{} {}\"", cylinder->radius, cylinder->length / 2);
    if (const auto* const capsule = std::get_if<CapsuleForm>(&form))
      return fmt::format(" type=\"capsule\" size=\"{} {}\"", capsule->radius, capsule->length / 2);
    const auto* const mesh = std::get_if<MeshFile>(&form);
    if (!mesh) return "";
    try {
      return fmt::format(" type=\"mesh\" mesh=\"{}\"", xml_escaped(asset(mesh_(*mesh))));
    } catch (const InputError&) {
      if (without_mesh_.empty() || without_mesh_.back() != link) without_mesh_.push_back(link);
      return "";
    }
  }

  /// "visual/base" of meshes/visual/base.stl
  const std::string& asset(const std::string& file) {
    const std::filesystem::path path(file);
    return assets_.try_emplace(file, (path.parent_path().filename() / path.stem()).generic_string()).first->second;
  }

  // What the file says beside the robot

  /// Finds named colours, which may be those of other links, and what is left out.
  void look_at(const XmlElement& element) {
    static const std::set<std::string_view> known{"link",    "joint",   "visual",   "collision", "inertial", "mass",
                                                  "inertia", "origin",  "geometry", "mesh",      "box",      "cylinder",
                                                  "sphere",  "capsule", "material", "color",     "parent",   "child",
                                                  "axis",    "limit",   "dynamics", "mimic"};
    for (const XmlElement* child : element.children)
      if (known.contains(child->name))
        look_at(*child);
      else
        left_out_.insert("<" + child->name + ">");
    for (const char* key : {"effort", "velocity"})
      if (element.name == "limit" && element.attribute(key)) left_out_.insert(fmt::format("{} limits", key));
    const std::string* const name = element.name == "material" ? element.attribute("name") : nullptr;
    if (std::string color = name ? own_color(element) : ""; !color.empty()) colors_[*name] = std::move(color);
  }

  std::string own_color(const XmlElement& material) const {
    const XmlElement* const color = material.child("color");
    const std::string* const rgba = color ? color->attribute("rgba") : nullptr;
    if (!rgba) return "";
    const std::vector<double> values = document_.numbers(*color, *rgba);
    if (values.size() != 4) document_.refuse(*color, fmt::format("rgba='{}' of <color>: expected four numbers", *rgba));
    return fmt::format(" rgba=\"{}\"", fmt::join(values, " "));
  }

  std::string color(const XmlElement& visual) const {
    const XmlElement* const material = visual.child("material");
    if (!material) return "";
    if (std::string own = own_color(*material); !own.empty()) return own;
    const std::string* const name = material->attribute("name");
    const auto known = name ? colors_.find(*name) : colors_.end();
    return known == colors_.end() ? "" : known->second;
  }

  void add_notes() {
    std::vector<std::string> locked;
    for (const Joint& joint : robot_.joints)
      if (joint.type != JointType::Fixed && is_locked(joint)) locked.push_back(joint.name);
    const auto note = [&](const char* what, const std::vector<std::string>& names) {
      if (!names.empty()) notes_.push_back(fmt::format("{}: {}", what, first_of(names)));
    };
    const auto world = std::ranges::find(robot_.links, "world", &Link::name);
    if (world != robot_.links.end()) {
      const auto link = static_cast<std::size_t>(world - robot_.links.begin());
      if (!is_world(link))
        notes_.push_back(fmt::format("the link world is the body {}: MuJoCo has a world of its own", world_link()));
      if (is_world(link) && inertials_[link]) left_out_.insert("the mass of world");
    }
    note("not in it", {left_out_.begin(), left_out_.end()});
    note("joints with equal limits are fixed there", locked);
    note("meshes that cannot be read, or are flat or tiny, are left out of", without_mesh_);
    note("links that move and have no mass weigh what MuJoCo computes from their collision geometry", of_geoms_);
    note("links that move and have neither mass nor collision geometry weigh 1 g, as MuJoCo refuses none",
         without_mass_);
    note("inertias that no body can have are the mean of their diagonal", impossible_);
  }

  const XmlDocument document_;
  const Robot& robot_;
  const MujocoMesh& mesh_;
  const std::vector<const XmlElement*> links_;
  std::vector<const Joint*> above_;                 // the joint that leads to each link; nullptr to the root
  std::vector<std::vector<const Joint*>> below_;    // of each link
  std::vector<std::optional<Inertial>> inertials_;  // that are not written yet
  std::map<std::string, const XmlElement*> joints_;
  std::map<std::string, std::string> colors_;  // of materials: an attribute
  std::map<std::string, std::string> assets_;  // names by files
  std::string bodies_;
  std::set<std::string> left_out_;
  std::vector<std::string> notes_, of_geoms_, without_mass_, without_mesh_, impossible_;  // names of links
};

}  // namespace

MjcfRobot mjcf_of(const RobotFile& urdf, const Robot& robot, std::span<const std::pair<std::size_t, std::size_t>> apart,
                  const MujocoMesh& mesh) {
  if (urdf.format != RobotFormat::Urdf) refuse(fmt::format("{}: only URDF becomes MJCF", urdf.path.string()));
  return MjcfRobotWriter(urdf, robot, mesh).write(apart);
}

}  // namespace prohull::robot
