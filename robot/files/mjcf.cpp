#include "robot/files/mjcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "robot/files/joint_forest.h"
#include "robot/files/mjcf_model.h"
#include "robot/files/xml_values.h"
#include "robot/motion/kinematics.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

class MjcfReader {
 public:
  MjcfReader(const XmlDocument& document, const Packages& packages)
      : document_(document), packages_(packages), model_(document) {}

  RobotFile read() {
    const std::string* const name = document_.root().attribute("model");
    file_.robot.name = name ? *name : "MuJoCo Model";
    file_.notes = model_.notes();
    for (const MjcfBody& body : model_.bodies()) add_link(body);
    if (file_.robot.links.empty()) refuse_without_bodies();
    if (filled_ > 0)
      note(fmt::format("meshes that collide: {}; they count as their convex hulls, as in MuJoCo", filled_));
    for (std::size_t body = 0; body < model_.bodies().size(); ++body) add_joints(body);
    for (const XmlElement* section : document_.root().children_called("equality"))
      for (const XmlElement* element : section->children)
        element->name == "joint" ? follow(*element) : note_equality(*element);
    set_joints(file_.robot, std::move(listed_), in_world_, JointType::Fixed, file_.notes);
    if (const Joint* joint = joint_in_mimic_loop(file_.robot))
      document_.refuse(document_.root(), fmt::format("joint '{}' in line {} follows itself by way of <equality>",
                                                     joint->name, joint->line));
    file_.robot.fills_collision_meshes = true;
    file_.path = document_.file();
    return std::move(file_);
  }

 private:
  [[noreturn]] void refuse_without_bodies() const {
    std::string why = "the model has no <body>";
    for (const std::string& note : model_.notes())
      if (note.find("neither is what it makes") != note.npos) why += "; " + note;
    document_.refuse(document_.root(), why);
  }

  void note(std::string sentence) { file_.notes.push_back(std::move(sentence)); }

  // Links

  void add_link(const MjcfBody& body) {
    const Pose pose = composed(body.frame, mjcf_pose(model_, {body.element, "", nullptr, {}}));
    in_parent_.push_back(pose);
    in_world_.push_back(body.parent == kWorld ? pose : composed(in_world_[body.parent], pose));
    Link link;
    link.name = body.name, link.line = body.element->line;
    for (const MjcfElement& geom : body.visual) add_shape(geom, link, link.visual);
    for (const MjcfElement& geom : body.colliding) add_collision(geom, link, body.visual_collides);
    file_.robot.links.push_back(std::move(link));
  }

  void add_shape(const MjcfElement& geom, const Link& link, std::vector<Shape>& shapes) {
    shapes.push_back(shape(geom));
    note_other_form(geom, link, shapes.back().form);
  }

  void add_collision(const MjcfElement& geom, Link& link, bool is_told) {
    Shape& collides = link.collision.emplace_back(shape(geom));
    if (auto* const file = std::get_if<MeshFile>(&collides.form)) {
      file->is_filled = true;
      if (is_cut(geom))
        collides.form = OtherForm{"mesh whose convex hull maxhullvert cuts"}, is_told = false;
      else
        ++filled_;
    }
    if (!is_told) note_other_form(geom, link, collides.form);
  }

  /// Whether the convex hull that collides may have fewer vertices than it would need.
  bool is_cut(const MjcfElement& geom) const {
    const MjcfElement asset = model_.asset(*model_.meshes().at(*model_.value(geom, "mesh")));
    const std::vector<double> most = mjcf_numbers(model_, asset, "maxhullvert", 1, 1);
    return !most.empty() && most[0] >= 0;
  }

  void note_other_form(const MjcfElement& geom, const Link& link, const Form& form) {
    if (const auto* const other = std::get_if<OtherForm>(&form))
      note(fmt::format("{}: the {} of body '{}' is not read", document_.short_place_of(*geom.element), other->what,
                       link.name));
  }

  Shape shape(const MjcfElement& geom) const {
    Shape shape;
    if (const std::string* name = geom.element->attribute("name")) shape.name = *name;
    shape.line = geom.element->line;
    shape.origin = mjcf_pose(model_, geom);
    if (geom.way > 0 || geom.frame != Pose{}) {
      shape.way = geom.way + norm(shape.origin.translation);
      shape.origin = composed(geom.frame, shape.origin);
    }
    const std::string* const said = model_.value(geom, "type");
    const std::string type = said ? *said : "sphere";
    if (type == "mesh")
      shape.form = mesh(geom, shape);
    else if (model_.value(geom, "mesh"))
      shape.form = OtherForm{type + " fitted to a mesh"};
    else
      shape.form = primitive(geom, type);
    return shape;
  }

  Form primitive(const MjcfElement& geom, const std::string& type) const {
    if (type == "box") return box(geom);
    if (type == "sphere") return SphereForm{sizes(geom, 1)[0]};
    if (type == "cylinder") return CylinderForm{sizes(geom, 1)[0], length(geom)};
    if (type == "capsule") return CapsuleForm{sizes(geom, 1)[0], length(geom)};
    if (type == "ellipsoid" || type == "plane" || type == "hfield" || type == "sdf") return OtherForm{type};
    document_.refuse(*geom.element, fmt::format("<geom> has the unknown type '{}'", type));
  }

  /// MuJoCo's sizes are half lengths.
  std::vector<double> sizes(const MjcfElement& geom, std::size_t count) const {
    std::vector<double> size = mjcf_numbers(model_, geom, "size", count, 3);
    if (size.empty()) document_.refuse(*geom.element, "<geom> has no size");
    for (std::size_t i = 0; i < count; ++i) positive(document_, *geom.element, size[i], "size");
    return size;
  }
  double length(const MjcfElement& geom) const {
    const std::vector<double> v = mjcf_numbers(model_, geom, "fromto", 6, 6);
    return v.empty() ? 2 * sizes(geom, 2)[1] : norm(Vec3{v[3] - v[0], v[4] - v[1], v[5] - v[2]});
  }
  Form box(const MjcfElement& geom) const {
    if (model_.value(geom, "fromto")) {
      const double width = 2 * sizes(geom, 1)[0];
      return BoxForm{{width, width, length(geom)}};
    }
    const std::vector<double> half = sizes(geom, 3);
    return BoxForm{{2 * half[0], 2 * half[1], 2 * half[2]}};
  }

  /// MuJoCo moves a vertex v to scale * (turn^-1 (v - refpos)); its origin becomes where scale * v is.
  Form mesh(const MjcfElement& geom, Shape& shape) const {
    const std::string* const name = model_.value(geom, "mesh");
    if (!name) document_.refuse(*geom.element, "<geom> of the type mesh names no mesh");
    const auto found = model_.meshes().find(*name);
    if (found == model_.meshes().end())
      document_.refuse(*geom.element, fmt::format("<geom> names the mesh '{}', which <asset> does not have", *name));
    const MjcfElement asset = model_.asset(*found->second);
    const std::string* const file = asset.element->attribute("file");
    if (!file) return OtherForm{fmt::format("mesh '{}', which has no file,", *name)};
    const Vec3 scale = vector(asset, "scale", {1, 1, 1}), shift = vector(asset, "refpos", {});
    if (scale.x == 0 || scale.y == 0 || scale.z == 0) document_.refuse(*asset.element, "<mesh> has a scale of 0");
    if (shift != Vec3{} || model_.value(asset, "refquat")) {
      const Pose turn = inverse(reference_turn(asset));
      if (turn != Pose{} && (scale.x != scale.y || scale.y != scale.z))
        return OtherForm{"mesh that is turned by refquat and stretched"};
      const Vec3 moved = placed(turn, {-shift.x * scale.x, -shift.y * scale.y, -shift.z * scale.z});
      shape.way += norm(shape.origin.translation) + norm(moved);
      shape.origin = composed(shape.origin, {turn.rotation, moved});
    }
    return packages_.find(model_.file_name(*file), scale, model_.compiler().mesh_folder);
  }

  Pose reference_turn(const MjcfElement& asset) const {
    const std::vector<double> q = mjcf_numbers(model_, asset, "refquat", 4, 4);
    return q.empty() ? Pose{} : quaternion_rotation(document_, *asset.element, q[0], q[1], q[2], q[3]);
  }

  Vec3 vector(const MjcfElement& element, std::string_view attribute, const Vec3& fallback) const {
    const std::vector<double> v = mjcf_numbers(model_, element, attribute, 3, 3);
    return v.empty() ? fallback : bounded(document_, *element.element, {v[0], v[1], v[2]});
  }

  // Joints

  void add_joints(std::size_t body) {
    const MjcfBody& it = model_.bodies()[body];
    for (const MjcfElement& element : it.joints) add_joint(body, element, &element != &it.joints.front());
    if (!it.joints.empty()) return;
    const std::string* const mocap = it.element->attribute("mocap");
    const bool is_moved = mocap && *mocap == "true";  // by the program that simulates
    ListedJoint held;
    held.joint.name = it.name + (is_moved ? "_mocap" : "_weld"), held.joint.line = it.element->line;
    held.joint.type = is_moved ? JointType::Floating : JointType::Fixed;
    held.joint.parent = it.parent, held.joint.child = body, held.joint.origin = in_parent_[body];
    // A body that is welded to the world is a root.
    if (it.parent != kWorld || is_moved) listed_.push_back(std::move(held));
  }

  void add_joint(std::size_t body, const MjcfElement& element, bool continues) {
    const MjcfBody& it = model_.bodies()[body];
    Joint joint;
    const std::string* const name = element.element->attribute("name");
    joint.name = name ? *name : fmt::format("{}_joint_{}", it.name, element.element->line);
    joint.line = element.element->line;
    joint.parent = it.parent, joint.child = body;
    if (!continues) joint.origin = in_parent_[body];
    joint.type = type_of(element);
    joint.anchor = placed(element.frame, vector(element, "pos", {}));
    const Vec3 axis = vector(element, "axis", {0, 0, 1});
    joint.axis = placed(Pose{element.frame.rotation, {}},
                        unit_vector(document_, *element.element, axis, fmt::format("the axis of '{}'", joint.name)));
    if (moves(joint)) {
      rest_at_ref(element, joint);
      read_limits(element, joint);
    }
    if (name && !by_name_.emplace(*name, listed_.size()).second)
      document_.refuse(*element.element, fmt::format("there is a second joint called '{}'", *name));
    listed_.push_back({std::move(joint), continues});
  }

  JointType type_of(const MjcfElement& element) const {
    const std::string* const said = model_.value(element, "type");
    const std::string type = element.element->name == "freejoint" ? "free" : said ? *said : "hinge";
    if (type == "free") return JointType::Floating;
    if (type == "hinge") return JointType::Revolute;
    if (type == "slide") return JointType::Prismatic;
    if (type == "ball") return JointType::Ball;
    document_.refuse(*element.element, fmt::format("<joint> has the unknown type '{}'", type));
  }

  double unit_of(const Joint& joint) const { return turns(joint) ? model_.compiler().angle_unit : 1; }

  /// The bodies stand in the file where the joint is at `ref`.
  void rest_at_ref(const MjcfElement& element, Joint& joint) const {
    const std::vector<double> ref = mjcf_numbers(model_, element, "ref", 1, 1);
    if (ref.empty() || ref[0] == 0) return;
    joint.rest = bounded(document_, *element.element, {ref[0] * unit_of(joint), 0, 0}).x;
    joint.origin = joint_pose(joint, -joint.rest);
  }

  void read_limits(const MjcfElement& element, Joint& joint) const {
    const std::vector<double> range = mjcf_numbers(model_, element, "range", 2, 2);
    const std::string* const limited = model_.value(element, "limited");
    const bool is_auto = !limited || *limited == "auto";
    const bool has_range = range.size() == 2 && range[0] < range[1];
    const bool is_limited = is_auto ? model_.compiler().auto_limits && has_range : *limited == "true";
    if (is_limited && !has_range)
      document_.refuse(*element.element, fmt::format("joint '{}' is limited, but its range is not from a smaller to a "
                                                     "larger number",
                                                     joint.name));
    if (!is_limited) {
      if (turns(joint)) joint.type = JointType::Continuous;
      return;
    }
    joint.lower = range[0] * unit_of(joint), joint.upper = range[1] * unit_of(joint);
  }

  bool is_active(const XmlElement& equality) const {
    const std::string* const active = model_.equality_value(equality, "active");
    return !active || *active != "false";
  }

  void note_equality(const XmlElement& element) {
    if (is_active(element))
      note(fmt::format("{}: what <{}> of <equality> holds together is not read", document_.short_place_of(element),
                       element.name));
  }

  /// joint1 = a0 + a1 joint2 + ..., both counted from `ref`.
  void follow(const XmlElement& element) {
    if (!is_active(element)) return;
    std::vector<double> a{0, 1, 0, 0, 0};
    if (const std::string* text = element.attribute("polycoef")) {
      const std::vector<double> said = document_.numbers(element, *text);
      if (said.size() > 5) document_.refuse(element, "polycoef has more than 5 numbers");
      std::ranges::copy(said, a.begin());
    }
    Joint& follower = listed_[joint_named(element, "joint1")].joint;
    const bool is_straight = a[2] == 0 && a[3] == 0 && a[4] == 0;
    if (!moves(follower) || follower.mimic) return skip(element);
    if (!element.attribute("joint2")) return lock(follower, follower.rest + a[0]);
    const std::size_t followed = joint_named(element, "joint2");
    if (!is_straight || !moves(listed_[followed].joint)) return skip(element);
    follower.mimic = Mimic{followed, a[1], follower.rest + a[0] - a[1] * listed_[followed].joint.rest};
  }

  static void lock(Joint& joint, double position) {
    if (joint.type == JointType::Continuous) joint.type = JointType::Revolute;
    joint.lower = joint.upper = position;
  }

  void skip(const XmlElement& element) {
    note(fmt::format("{}: how joint '{}' follows others is not read", document_.short_place_of(element),
                     *element.attribute("joint1")));
  }

  std::size_t joint_named(const XmlElement& element, std::string_view attribute) const {
    const std::string& name = document_.required(element, attribute);
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
      document_.refuse(element, fmt::format("<{}> names the joint '{}', which does not exist", element.name, name));
    return found->second;
  }

  const XmlDocument& document_;
  const Packages& packages_;
  const MjcfModel model_;
  RobotFile file_;
  std::size_t filled_ = 0;
  std::vector<Pose> in_parent_, in_world_;  // of each link
  std::vector<ListedJoint> listed_;
  std::map<std::string, std::size_t> by_name_;  // in listed_
};

}  // namespace

RobotFile read_mjcf(const XmlDocument& document, const Packages& packages) {
  return MjcfReader(document, packages).read();
}

}  // namespace prohull::robot
