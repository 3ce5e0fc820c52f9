#include "robot/files/urdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "robot/motion/kinematics.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

constexpr double kLargest = 1e100;

constexpr std::array<std::pair<std::string_view, JointType>, 7> kJointTypes{{{"fixed", JointType::Fixed},
                                                                             {"revolute", JointType::Revolute},
                                                                             {"continuous", JointType::Continuous},
                                                                             {"prismatic", JointType::Prismatic},
                                                                             {"planar", JointType::Planar},
                                                                             {"floating", JointType::Floating},
                                                                             {"spherical", JointType::Ball}}};

bool has_axis(JointType type) {
  return type == JointType::Revolute || type == JointType::Continuous || type == JointType::Prismatic ||
         type == JointType::Planar;
}

// Numbers, up to 1e100: products of some stay finite

double bounded(const XmlDocument& document, const XmlElement& element, double number) {
  if (std::abs(number) <= kLargest) return number;
  document.refuse(element, fmt::format("<{}> has the number {}, which is beyond {}", element.name, number, kLargest));
}

Vec3 bounded_vector(const XmlDocument& document, const XmlElement& element, std::string_view attribute,
                    const Vec3& fallback) {
  const Vec3 vector = document.vector(element, attribute, fallback);
  for (int axis = 0; axis < 3; ++axis) bounded(document, element, vector[axis]);
  return vector;
}

/// Links or joints by their names.
class NameTable {
 public:
  NameTable(const XmlDocument& document, std::string what) : document_(document), what_(std::move(what)) {}

  std::string add(const XmlElement& element) {
    const std::string& name = document_.required(element, "name");
    if (name.empty()) document_.refuse(element, fmt::format("a {} has an empty name", what_));
    const auto [known, is_new] = elements_.try_emplace(name, elements_.size(), &element);
    if (!is_new)
      document_.refuse(element, fmt::format("there are two {}s called '{}'; the other one is in line {}", what_, name,
                                            known->second.second->line));
    return name;
  }

  bool has(const std::string& name) const { return elements_.contains(name); }

  /// The number of the one that an attribute names.
  std::size_t find(const XmlElement& element, std::string_view attribute) const {
    const std::string& name = document_.required(element, attribute);
    const auto known = elements_.find(name);
    if (known == elements_.end())
      document_.refuse(element, fmt::format("<{}> names a {} that does not exist: '{}'", element.name, what_, name));
    return known->second.first;
  }

 private:
  const XmlDocument& document_;
  std::string what_;
  std::unordered_map<std::string, std::pair<std::size_t, const XmlElement*>> elements_;
};

class UrdfReader {
 public:
  UrdfReader(const XmlDocument& document, const Packages& packages)
      : document_(document), packages_(packages), link_names_(document, "link"), joint_names_(document, "joint") {}

  RobotFile read() {
    const XmlElement& root = document_.root();
    if (const std::string* name = root.attribute("name")) robot_.name = *name;
    for (const XmlElement* element : root.children_called("link")) read_link(*element);
    if (robot_.links.empty()) document_.refuse(root, "the robot has no links");
    joint_elements_ = root.children_called("joint");
    for (const XmlElement* element : joint_elements_) joint_names_.add(*element);
    for (const XmlElement* element : joint_elements_) read_joint(*element);
    note_still_joints();
    refuse_loops_of_mimics();
    sort_joints();
    return {std::move(robot_), RobotFormat::Urdf, document_.file(), document_.text(), std::move(notes_)};
  }

 private:
  // Links

  void read_link(const XmlElement& element) {
    Link link;
    link.name = link_names_.add(element);
    link.line = element.line;
    for (const XmlElement* child : element.children) {
      if (child->name == "visual") link.visual.push_back(shape(*child));
      if (child->name == "collision") link.collision.push_back(shape(*child));
    }
    for (const Geometry which : {Geometry::Visual, Geometry::Collision})
      for (const Shape& shape : shapes(link, which)) note_other_form(link, shape);
    robot_.links.push_back(std::move(link));
  }

  void note_other_form(const Link& link, const Shape& shape) {
    if (const auto* const other = std::get_if<OtherForm>(&shape.form))
      notes_.push_back(fmt::format("line {}: the {} of link '{}' is not read", shape.line, other->what, link.name));
  }

  Shape shape(const XmlElement& element) const {
    const XmlElement* const geometry = element.child("geometry");
    if (!geometry) document_.refuse(element, fmt::format("<{}> has no <geometry>", element.name));
    if (geometry->children.empty()) document_.refuse(*geometry, "<geometry> is empty");
    const std::string* const name = element.attribute("name");
    return {form(*geometry->children.front()), origin(element), name ? *name : "", element.line};
  }

  Form form(const XmlElement& element) const {
    if (element.name == "mesh") return mesh(element);
    if (element.name == "box") {
      document_.required(element, "size");
      const Vec3 size = vector(element, "size", {});
      return std::min({size.x, size.y, size.z}) > 0 ? Form(BoxForm{size}) : flat(element);
    }
    if (element.name == "sphere") {
      const double radius = size(element, "radius");
      return radius > 0 ? Form(SphereForm{radius}) : flat(element);
    }
    if (element.name != "cylinder" && element.name != "capsule") return OtherForm{element.name};
    const double radius = size(element, "radius"), length = size(element, "length");
    if (radius <= 0 || length <= 0) return flat(element);
    return element.name == "cylinder" ? Form(CylinderForm{radius, length}) : Form(CapsuleForm{radius, length});
  }

  /// A form without extent. Simulators and viewers show nothing there, either.
  static OtherForm flat(const XmlElement& element) { return {fmt::format("{} of size 0 or less", element.name)}; }

  MeshFile mesh(const XmlElement& element) const {
    const std::string& uri = document_.required(element, "filename");
    if (uri.empty()) document_.refuse(element, "<mesh> has an empty filename");
    return packages_.find(uri, scale(element));
  }

  /// Three numbers, or one for all axes, as Drake reads it. A negative one mirrors.
  Vec3 scale(const XmlElement& element) const {
    const std::string* const text = element.attribute("scale");
    if (!text) return {1, 1, 1};
    const bool is_one = document_.numbers(element, *text).size() == 1;
    const double all = is_one ? number(element, "scale", 1) : 1;
    const Vec3 scale = is_one ? Vec3{all, all, all} : vector(element, "scale", {1, 1, 1});
    if (scale.x == 0 || scale.y == 0 || scale.z == 0)
      document_.refuse(element, fmt::format("scale='{}' of <mesh> flattens it: no number may be 0", *text));
    return scale;
  }

  double size(const XmlElement& element, std::string_view attribute) const {
    document_.required(element, attribute);
    return number(element, attribute, 0);
  }

  Pose origin(const XmlElement& parent) const { return urdf_origin(document_, parent); }
  double number(const XmlElement& element, std::string_view attribute, double fallback) const {
    return bounded(document_, element, document_.number(element, attribute, fallback));
  }
  Vec3 vector(const XmlElement& element, std::string_view attribute, const Vec3& fallback) const {
    return bounded_vector(document_, element, attribute, fallback);
  }

  // Joints

  void read_joint(const XmlElement& element) {
    Joint joint;
    joint.name = *element.attribute("name");
    joint.line = element.line;
    joint.type = joint_type(element);
    joint.parent = link_of(element, "parent"), joint.child = link_of(element, "child");
    joint.origin = origin(element);
    if (has_axis(joint.type)) joint.axis = axis(element);
    read_limits(element, joint);
    joint.mimic = mimic(element);
    robot_.joints.push_back(std::move(joint));
  }

  JointType joint_type(const XmlElement& element) const {
    const std::string& type = document_.required(element, "type");
    for (const auto& [name, value] : kJointTypes)
      if (name == type) return value;
    document_.refuse(element, fmt::format("joint '{}' has the type '{}', which is not known; revolute, continuous, "
                                          "prismatic, fixed, planar, floating and spherical are",
                                          *element.attribute("name"), type));
  }

  std::size_t link_of(const XmlElement& joint, std::string_view tag) const {
    if (const XmlElement* const element = joint.child(tag)) return link_names_.find(*element, "link");
    document_.refuse(joint, fmt::format("joint '{}' has no <{}>", *joint.attribute("name"), tag));
  }

  Vec3 axis(const XmlElement& joint) const {
    const XmlElement* const element = joint.child("axis");
    if (!element) return {1, 0, 0};
    const Vec3 axis = vector(*element, "xyz", {1, 0, 0});
    const double longest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (longest == 0) document_.refuse(*element, "<axis> has no direction: all numbers are 0");
    const Vec3 scaled = axis / longest;  // whose length neither overflows nor underflows
    return scaled / norm(scaled);
  }

  void read_limits(const XmlElement& element, Joint& joint) {
    if (joint.type != JointType::Revolute && joint.type != JointType::Prismatic) return;
    const XmlElement* const limit = element.child("limit");
    if (!limit)
      document_.refuse(element, fmt::format("joint '{}' has no <limit>, which revolute and prismatic joints need; a "
                                            "joint that turns without end is continuous",
                                            joint.name));
    if (!limit->attribute("lower") && !limit->attribute("upper")) still_.push_back(joint.name);
    joint.lower = limit_of(*limit, "lower"), joint.upper = limit_of(*limit, "upper");
    if (joint.lower <= joint.upper) return;
    std::swap(joint.lower, joint.upper);
    notes_.push_back(
        fmt::format("line {}: the lower limit of joint '{}' is above its upper one; the two were exchanged",
                    limit->line, joint.name));
  }

  void note_still_joints() {
    if (!still_.empty())
      notes_.push_back(fmt::format(
          "{} whose <limit> has neither lower nor upper, which URDF reads as 0 to 0: {} there: "
          "{}",
          counted(still_.size(), "joint"), still_.size() == 1 ? "it stays" : "they stay", first_of(still_)));
  }

  /// Tools write 1.79769e+308 for no limit.
  double limit_of(const XmlElement& element, std::string_view attribute) const {
    const double limit = document_.number(element, attribute, 0);
    return std::abs(limit) <= kLargest ? limit : std::copysign(std::numeric_limits<double>::infinity(), limit);
  }

  std::optional<Mimic> mimic(const XmlElement& joint) {
    const XmlElement* const element = joint.child("mimic");
    if (!element) return std::nullopt;
    if (const std::string* const name = element->attribute("joint"); name && !joint_names_.has(*name)) {
      notes_.push_back(fmt::format(
          "line {}: <mimic> names a joint that does not exist: '{}'; the joint moves by itself", element->line, *name));
      return std::nullopt;
    }
    return Mimic{joint_names_.find(*element, "joint"), number(*element, "multiplier", 1),
                 number(*element, "offset", 0)};
  }

  // Trees. Joints still have the order of the document here.

  void refuse_loops_of_mimics() const {
    if (const Joint* const joint = joint_in_mimic_loop(robot_))
      document_.refuse(*joint_elements_[static_cast<std::size_t>(joint - robot_.joints.data())],
                       fmt::format("joint '{}' mimics itself, by way of others or directly", joint->name));
  }

  /// The joint that leads to each link; kNone to a root.
  std::vector<std::size_t> joints_above() const {
    std::vector<std::size_t> above(robot_.links.size(), kNone);
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const Joint& joint = robot_.joints[j];
      std::size_t& known = above[joint.child];
      if (known != kNone)
        document_.refuse(*joint_elements_[j],
                         fmt::format("link '{}' is the child of two joints, '{}' and '{}'; a robot is a tree",
                                     robot_.links[joint.child].name, robot_.joints[known].name, joint.name));
      known = j;
    }
    return above;
  }

  /// Parents first; otherwise in the order of the document.
  std::vector<std::size_t> parents_first(const std::vector<std::size_t>& above) const {
    std::vector<std::vector<std::size_t>> below(robot_.links.size());
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) below[robot_.joints[j].parent].push_back(j);
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t link = 0; link < above.size(); ++link)
      if (above[link] == kNone)
        for (const std::size_t j : below[link]) ready.push(j);
    std::vector<std::size_t> order;
    while (!ready.empty()) {
      const std::size_t next = ready.top();
      ready.pop();
      order.push_back(next);
      for (const std::size_t j : below[robot_.joints[next].child]) ready.push(j);
    }
    return order;
  }

  /// Called if some links are below no root.
  [[noreturn]] void refuse_loop(const std::vector<std::size_t>& order, const std::vector<std::size_t>& above) const {
    std::vector<bool> is_sorted(robot_.joints.size()), is_seen(robot_.joints.size());
    for (const std::size_t j : order) is_sorted[j] = true;
    std::size_t at = static_cast<std::size_t>(std::ranges::find(is_sorted, false) - is_sorted.begin());
    for (; !is_seen[at]; at = above[robot_.joints[at].parent]) is_seen[at] = true;
    document_.refuse(*joint_elements_[at],
                     fmt::format("joint '{}' is part of a loop: link '{}' is below itself; a "
                                 "robot is a tree",
                                 robot_.joints[at].name, robot_.links[robot_.joints[at].child].name));
  }

  void refuse_second_root(const std::vector<std::size_t>& above) const {
    const auto first = std::ranges::find(above, kNone);
    const auto second = std::find(first + 1, above.end(), kNone);
    if (second == above.end()) return;
    const Link& a = robot_.links[std::size_t(first - above.begin())];
    const Link& b = robot_.links[std::size_t(second - above.begin())];
    document_.refuse(*document_.root().children_called("link")[std::size_t(second - above.begin())],
                     fmt::format("the robot has two roots: no joint leads to link '{}', nor to link '{}' in line {}; "
                                 "one of them has to be the <child> of a joint",
                                 b.name, a.name, a.line));
  }

  void sort_joints() {
    const std::vector<std::size_t> above = joints_above(), order = parents_first(above);
    if (order.size() < robot_.joints.size()) refuse_loop(order, above);
    refuse_second_root(above);
    std::vector<std::size_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    std::vector<Joint> sorted;
    sorted.reserve(order.size());
    for (const std::size_t j : order) {
      sorted.push_back(std::move(robot_.joints[j]));
      if (sorted.back().mimic) sorted.back().mimic->joint = place[sorted.back().mimic->joint];
    }
    robot_.joints = std::move(sorted);
  }

  const XmlDocument& document_;
  const Packages& packages_;
  NameTable link_names_, joint_names_;
  std::vector<const XmlElement*> joint_elements_;
  Robot robot_;
  std::vector<std::string> notes_, still_;  // `still_`: names of joints without limits
};

}  // namespace

Pose urdf_origin(const XmlDocument& document, const XmlElement& parent) {
  const XmlElement* const element = parent.child("origin");
  if (!element) return {};
  const Vec3 translation = bounded_vector(document, *element, "xyz", {});
  const std::string* const quaternion = element->attribute("quat_xyzw");
  if (!quaternion) return pose_of_rpy(bounded_vector(document, *element, "rpy", {}), translation);
  std::vector<double> q = document.numbers(*element, *quaternion);
  double longest = 0;
  for (const double part : q) longest = std::max(longest, std::abs(part));
  if (q.size() != 4 || longest == 0)
    document.refuse(*element, "quat_xyzw of <origin>: expected four numbers that are not all 0");
  for (double& part : q) part /= longest;
  return pose_of_quaternion(q[3], q[0], q[1], q[2], translation);
}

RobotFile read_urdf(const XmlDocument& document, const Packages& packages) {
  return UrdfReader(document, packages).read();
}

}  // namespace prohull::robot
