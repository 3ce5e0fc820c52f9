#include "robot/files/sdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "robot/files/joint_forest.h"
#include "robot/files/sdf_frames.h"
#include "robot/files/xml_values.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

class SdfReader {
 public:
  SdfReader(const XmlDocument& document, const Packages& packages)
      : document_(document), packages_(packages), model_(sdf_model(document)), frames_(document, model_) {}

  RobotFile read() {
    note_models();
    if (const std::string* name = model_.attribute("name")) file_.robot.name = *name;
    for (std::size_t frame = 0; frame < frames_.all().size(); ++frame) add_link(frame);
    if (file_.robot.links.empty()) refuse_without_links();
    add_joints();
    note_includes_beside();
    note_includes(model_);
    file_.path = document_.file();
    return std::move(file_);
  }

 private:
  void note(std::string sentence) { file_.notes.push_back(std::move(sentence)); }

  void note_models() {
    const std::vector<const XmlElement*> models = sdf_models(document_);
    if (models.size() < 2) return;
    const std::string* const name = model_.attribute("name");
    note(fmt::format("the file has {} models; only the first one, '{}', is read", models.size(), name ? *name : ""));
  }

  [[noreturn]] void refuse_without_links() {
    file_.notes.clear();
    note_includes(model_);
    document_.refuse(model_, fmt::format("the model has no <link>{}{}", file_.notes.empty() ? "" : "; ",
                                         fmt::join(file_.notes, "; ")));
  }

  /// Includes that stand beside the model: in the file, or in a world of it.
  void note_includes_beside() {
    const auto note_all = [&](const XmlElement& parent) {
      for (const XmlElement* include : parent.children_called("include")) note_include(*include);
    };
    note_all(document_.root());
    for (const XmlElement* world : document_.root().children_called("world")) note_all(*world);
  }

  void note_include(const XmlElement& element) {
    const std::string why = included_model(element, packages_).why_not;
    note(fmt::format("line {} includes '{}', which is not read{}{}", element.line, sdf_text(element, "uri"),
                     why.empty() ? "" : ": ", why));
  }

  void note_includes(const XmlElement& model) {
    for (const XmlElement* child : model.children) {
      if (child->name == "model") note_includes(*child);
      if (child->name == "include") note_include(*child);
    }
  }

  // Links

  void add_link(std::size_t frame) {
    link_of_frame_.push_back(kNone);
    const SdfFrame& it = frames_.all()[frame];
    if (it.kind != SdfFrame::Kind::Link) return;
    link_of_frame_.back() = file_.robot.links.size();
    in_world_.push_back(it.in_model);
    Link& link = file_.robot.links.emplace_back();
    link.name = it.name, link.line = it.element->line;
    for (const XmlElement* child : it.element->children) {
      if (child->name == "visual") add_shape(*child, frame, link.visual);
      if (child->name == "collision") add_shape(*child, frame, link.collision);
    }
  }

  void add_shape(const XmlElement& element, std::size_t frame, std::vector<Shape>& shapes) {
    if (!sdf_collides(element))
      return note(
          fmt::format("line {}: a <collision> of link '{}' has a collide_bitmask of 0: it meets nothing, and "
                      "counts as none",
                      element.line, frames_.all()[frame].name));
    Shape& shape = shapes.emplace_back();
    if (const std::string* name = element.attribute("name")) shape.name = *name;
    shape.line = element.line;
    const ComputedPose placed = frames_.pose_in_link(element, frame);
    shape.origin = placed.pose, shape.way = placed.way;
    const XmlElement* const geometry = element.child("geometry");
    if (!geometry) document_.refuse(element, fmt::format("<{}> has no <geometry>", element.name));
    if (geometry->children.empty())
      document_.refuse(*geometry, fmt::format("the <geometry> of this <{}> says no shape", element.name));
    if (geometry->children[0]->name == "empty") return shapes.pop_back();
    shape.form = form(*geometry->children[0], element.name);
    if (const auto* const other = std::get_if<OtherForm>(&shape.form))
      note(fmt::format("line {}: the {} of link '{}' is not read", element.line, other->what,
                       frames_.all()[frame].name));
  }

  Form form(const XmlElement& element, std::string_view of) {
    if (element.name == "mesh") return mesh_form(element, of);
    if (element.name == "box") return BoxForm{positive_vector(element, "size")};
    if (element.name == "sphere") return SphereForm{positive_number(element, "radius")};
    if (element.name == "cylinder")
      return CylinderForm{positive_number(element, "radius"), positive_number(element, "length")};
    if (element.name == "capsule")
      return CapsuleForm{positive_number(element, "radius"), positive_number(element, "length")};
    return OtherForm{element.name};
  }

  /// Which faces a <submesh> has depends on the program that reads the mesh file. What encloses all of them encloses
  /// it, but nothing tells what it covers.
  Form mesh_form(const XmlElement& element, std::string_view of) {
    const std::string uri = sdf_text(element, "uri");
    if (uri.empty()) document_.refuse(element, "<mesh> has no <uri>");
    if (const XmlElement* submesh = element.child("submesh")) {
      const std::string center = sdf_text(*submesh, "center");
      if (center == "true" || center == "1") return OtherForm{"centred submesh"};
      if (of == "collision") return OtherForm{"submesh"};
      note(fmt::format("line {}: the whole mesh file is read, although the model shows one submesh of it",
                       submesh->line));
    }
    Vec3 scale{1, 1, 1};
    if (const XmlElement* said = element.child("scale"))
      scale = bounded(document_, *said, sdf_vector(document_, *said));
    if (scale.x == 0 || scale.y == 0 || scale.z == 0) document_.refuse(element, "<mesh> has a scale of 0");
    return packages_.find(uri, scale);
  }

  const XmlElement& required(const XmlElement& element, std::string_view child) const {
    if (const XmlElement* found = element.child(child)) return *found;
    document_.refuse(element, fmt::format("<{}> has no <{}>", element.name, child));
  }
  double positive_number(const XmlElement& element, std::string_view child) const {
    return positive(document_, element, sdf_number(document_, required(element, child)), child);
  }
  Vec3 positive_vector(const XmlElement& element, std::string_view child) const {
    const Vec3 v = sdf_vector(document_, required(element, child));
    positive(document_, element, std::min({v.x, v.y, v.z}), child);
    return bounded(document_, element, v);
  }

  // Joints

  void add_joints() {
    for (const SdfFrame& frame : frames_.all())
      if (frame.kind == SdfFrame::Kind::Joint) add_joint(frame);
    for (const auto& [joint, axis, scope] : followers_) follow(joint, *axis, scope);
    set_joints(file_.robot, std::move(listed_), in_world_, JointType::Floating, file_.notes);
    if (const Joint* joint = joint_in_mimic_loop(file_.robot)) refuse_mimic_loop(*joint);
  }

  [[noreturn]] void refuse_mimic_loop(const Joint& joint) const {
    for (const SdfFrame& frame : frames_.all())
      if (frame.element->line == joint.line)
        document_.refuse(*frame.element, fmt::format("joint '{}' mimics itself by way of others", joint.name));
    document_.refuse(model_, fmt::format("joint '{}' mimics itself by way of others", joint.name));
  }

  void add_joint(const SdfFrame& frame) {
    const XmlElement& element = *frame.element;
    Joint joint;
    joint.name = frame.name, joint.line = element.line;
    joint.child = link_of_frame_[frames_.link_of(frame.attached)];
    joint.parent = parent_link(frame);
    if (joint.parent == joint.child)
      document_.refuse(element, fmt::format("joint '{}' connects link '{}' with itself", joint.name,
                                            file_.robot.links[joint.child].name));
    const Pose& child = in_world_[joint.child];
    joint.origin = joint.parent == kWorld ? child : composed(inverse(in_world_[joint.parent]), child);
    joint.anchor = placed(inverse(child), frame.in_model.translation);
    add_with_type(frame, joint);
  }

  std::size_t parent_link(const SdfFrame& frame) const {
    const std::string name = sdf_text(*frame.element, "parent");
    const XmlElement& parent = required(*frame.element, "parent");
    if (name == "world") return kWorld;
    return link_of_frame_[frames_.link_of(frames_.find(frame.scope, name, parent))];
  }

  void add_with_type(const SdfFrame& frame, const Joint& joint) {
    const XmlElement& element = *frame.element;
    const std::string& type = document_.required(element, "type");
    if (type == "revolute") return add_axis(frame, joint, JointType::Revolute, "axis");
    if (type == "continuous") return add_axis(frame, joint, JointType::Continuous, "axis");
    if (type == "prismatic") return add_axis(frame, joint, JointType::Prismatic, "axis");
    if (type == "universal" || type == "revolute2") {
      add_axis(frame, joint, JointType::Revolute, "axis");
      return add_axis(frame, joint, JointType::Revolute, "axis2");
    }
    listed_.push_back({joint});
    listed_.back().joint.type = type_without_axis(joint, type, element);
  }

  JointType type_without_axis(const Joint& joint, const std::string& type, const XmlElement& element) {
    if (type == "fixed") return JointType::Fixed;
    if (type == "ball") return JointType::Ball;
    if (type != "screw" && type != "gearbox")
      document_.refuse(element, fmt::format("joint '{}' has the unknown type '{}'", joint.name, type));
    note(
        fmt::format("joint '{}' in line {} is a {} joint; it is read as floating: nothing is proven across it, but for "
                    "paths, on which it rests",
                    joint.name, joint.line, type));
    return JointType::Floating;
  }

  void add_axis(const SdfFrame& frame, Joint joint, JointType type, const std::string& tag) {
    const XmlElement& axis = required(*frame.element, tag);
    const bool second = tag == "axis2";
    joint.type = type;
    joint.axis = axis_in_link(frame, axis, in_world_[joint.child]);
    if (type != JointType::Continuous) read_limits(axis, joint);
    if (type == JointType::Revolute && std::isinf(joint.lower) && std::isinf(joint.upper))
      joint.type = JointType::Continuous;
    if (second) {
      joint.name += "_axis2";
      joint.parent = listed_.back().joint.parent;
      joint.origin = {};
    }
    by_axis_[{frame.name, tag}] = listed_.size();
    if (axis.child("mimic")) followers_.push_back({listed_.size(), &axis, frame.scope});
    listed_.push_back({std::move(joint), second});
  }

  Vec3 axis_in_link(const SdfFrame& frame, const XmlElement& axis, const Pose& link) const {
    const XmlElement* const xyz = axis.child("xyz");
    const Vec3 said = xyz ? sdf_vector(document_, *xyz) : Vec3{0, 0, 1};
    const Vec3 direction = unit_vector(document_, xyz ? *xyz : axis, said, fmt::format("the axis of '{}'", frame.name));
    const Pose turn{axis_frame(frame, axis).in_model.rotation, {}};
    return placed(inverse(Pose{link.rotation, {}}), placed(turn, direction));
  }

  const SdfFrame& axis_frame(const SdfFrame& frame, const XmlElement& axis) const {
    const XmlElement* const xyz = axis.child("xyz");
    const std::string* const expressed = xyz ? xyz->attribute("expressed_in") : nullptr;
    if (expressed && !expressed->empty()) return frames_.all()[frames_.find(frame.scope, *expressed, *xyz)];
    const std::string in_model = sdf_text(axis, "use_parent_model_frame");
    if (sdf_axes_are_old(document_.root()) || in_model == "true" || in_model == "True" || in_model == "TRUE" ||
        in_model == "1")
      return frames_.all()[frames_.find(frame.scope, "__model__", axis)];
    return frame;
  }

  void read_limits(const XmlElement& axis, Joint& joint) const {
    const XmlElement* const limit = axis.child("limit");
    if (!limit) return;
    if (const XmlElement* lower = limit->child("lower")) joint.lower = limit_of(*lower, joint.lower);
    if (const XmlElement* upper = limit->child("upper")) joint.upper = limit_of(*upper, joint.upper);
    if (joint.lower > joint.upper)
      document_.refuse(*limit, fmt::format("joint '{}' has a lower limit above its upper one", joint.name));
  }

  /// SDF says "no limit" by 1e16, by inf or by nothing.
  double limit_of(const XmlElement& element, double none) const {
    const std::string text = element.content;
    if (text.find("inf") != text.npos) return text.find('-') != text.npos ? -HUGE_VAL : HUGE_VAL;
    if (text.find_first_not_of(" \t\r\n") == text.npos) return none;
    const double value = sdf_number(document_, element);
    return std::abs(value) >= 1e16 ? std::copysign(HUGE_VAL, value) : value;
  }

  struct Follower {
    std::size_t joint = 0;
    const XmlElement* axis = nullptr;
    std::size_t scope = 0;
  };

  void follow(std::size_t joint, const XmlElement& axis, std::size_t scope) {
    const XmlElement& mimic = *axis.child("mimic");
    const std::string& name = document_.required(mimic, "joint");
    const std::string* const which = mimic.attribute("axis");
    const SdfFrame& followed = frames_.all()[frames_.find(scope, name, mimic)];
    const auto found = by_axis_.find({followed.name, which ? *which : "axis"});
    if (found == by_axis_.end() || followed.kind != SdfFrame::Kind::Joint)
      document_.refuse(mimic, fmt::format("<mimic> names '{}', which is no joint that turns or slides", name));
    const auto number = [&](std::string_view child, double fallback) {
      const XmlElement* const element = mimic.child(child);
      return element ? sdf_number(document_, *element) : fallback;
    };
    const double multiplier = number("multiplier", 1),
                 offset = number("offset", 0) - multiplier * number("reference", 0);
    if (!std::isfinite(offset)) document_.refuse(mimic, "<mimic> has numbers that are too large");
    listed_[joint].joint.mimic = Mimic{found->second, multiplier, offset};
  }

  const XmlDocument& document_;
  const Packages& packages_;
  const XmlElement& model_;
  SdfFrames frames_;
  RobotFile file_;
  std::vector<std::size_t> link_of_frame_;
  std::vector<Pose> in_world_;  // of each link: its pose in the model
  std::vector<ListedJoint> listed_;
  std::map<std::pair<std::string, std::string>, std::size_t> by_axis_;  // of a joint's name and "axis" or "axis2"
  std::vector<Follower> followers_;
};

void collect_models(const XmlElement& parent, std::vector<const XmlElement*>& models) {
  for (const XmlElement* child : parent.children) {
    if (child->name == "model") models.push_back(child);
    if (child->name == "world") collect_models(*child, models);
  }
}

void collect_links(const XmlElement& model, const std::string& prefix,
                   std::map<std::string, const XmlElement*>& links) {
  for (const XmlElement* child : model.children) {
    const std::string* const name = child->attribute("name");
    if (child->name == "link" && name) links[prefix + *name] = child;
    if (child->name == "model" && name) collect_links(*child, prefix + *name + "::", links);
  }
}

}  // namespace

int sdf_version(const XmlElement& root) {
  int major = 0, minor = 0;
  const std::string* const text = root.attribute("version");
  return text && std::sscanf(text->c_str(), "%4d.%4d", &major, &minor) == 2 ? 1000 * major + minor : 0;
}

bool sdf_axes_are_old(const XmlElement& root) {
  const int version = sdf_version(root);
  return version != 0 && version < 1005;
}

bool sdf_collides(const XmlElement& shape) {
  const XmlElement* mask = &shape;
  for (const std::string_view child : {"surface", "contact", "collide_bitmask"})
    if (mask = mask->child(child); !mask) return true;
  const std::string text = mask->text();
  const char* const digits = text.starts_with("0x") || text.starts_with("0X") ? text.c_str() + 2 : text.c_str();
  return text.empty() || std::string_view(digits).find_first_not_of('0') != std::string_view::npos;
}

std::vector<const XmlElement*> sdf_models(const XmlDocument& document) {
  std::vector<const XmlElement*> models;
  collect_models(document.root(), models);
  return models;
}

const XmlElement& sdf_model(const XmlDocument& document) {
  const std::vector<const XmlElement*> models = sdf_models(document);
  if (models.empty()) document.refuse(document.root(), "<sdf> has no <model>");
  return *models[0];
}

std::map<std::string, const XmlElement*> sdf_links(const XmlDocument& document) {
  std::map<std::string, const XmlElement*> links;
  collect_links(sdf_model(document), "", links);
  return links;
}

RobotFile read_sdf(const XmlDocument& document, const Packages& packages) {
  return SdfReader(document, packages).read();
}

}  // namespace prohull::robot
