#include "robot/files/mjcf_model.h"

#include <fmt/format.h>

#include <numbers>

#include "robot/files/joint_forest.h"
#include "robot/files/xml_values.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

bool is_true(const std::string* value) { return value && *value == "true"; }

/// Lower case letters turn about the axes that were turned before, upper case letters about those of the parent.
Pose euler_rotation(const std::vector<double>& angles, const std::string& sequence, double unit) {
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 axis;
    axis[(sequence[i] | 0x20) - 'x'] = 1;
    const Pose turn = rotation_about(axis, angles[i] * unit);
    pose = sequence[i] >= 'x' ? composed(pose, turn) : composed(turn, pose);
  }
  return pose;
}

Pose axes_rotation(const MjcfModel& model, const XmlElement& element, const std::vector<double>& v) {
  const Vec3 x = unit_vector(model.document(), element, {v[0], v[1], v[2]}, "the x axis of xyaxes");
  const Vec3 y = unit_vector(model.document(), element, {v[3], v[4], v[5]}, "the y axis of xyaxes");
  const Vec3 upright = unit_vector(model.document(), element, y - x * dot(x, y), "what xyaxes spans");
  return of_columns(x, upright, cross(x, upright));
}

Pose rotation_by(const MjcfModel& model, const MjcfElement& element, std::string_view attribute) {
  const XmlDocument& document = model.document();
  const double unit = model.compiler().angle_unit;
  const XmlElement& xml = *element.element;
  const std::size_t count = attribute == "xyaxes" ? 6 : attribute == "euler" || attribute == "zaxis" ? 3 : 4;
  const std::vector<double> v = mjcf_numbers(model, element, attribute, count, count);
  if (attribute == "quat") return quaternion_rotation(document, xml, v[0], v[1], v[2], v[3]);
  if (attribute == "euler") return euler_rotation(v, model.compiler().euler_sequence, unit);
  if (attribute == "zaxis") return turn_of_z_to(unit_vector(document, xml, {v[0], v[1], v[2]}, "zaxis"));
  if (attribute == "xyaxes") return axes_rotation(model, xml, v);
  return rotation_about(unit_vector(document, xml, {v[0], v[1], v[2]}, "the axis of axisangle"), v[3] * unit);
}

}  // namespace

// All but quat replace quat, also one of the element that its class says. Where there are several others, MuJoCo 2
// takes the last one in the order of kMjcfOrientations, and MuJoCo 3 that of the element.
std::string_view mjcf_orientation(const MjcfModel& model, const MjcfElement& element) {
  std::string_view last;
  std::size_t others = 0;
  for (const std::string_view attribute : kMjcfOrientations)
    if (model.value(element, attribute)) last = attribute, others += attribute != "quat";
  if (others > 1 && !element.element->attribute(last))
    model.document().refuse(*element.element,
                            fmt::format("<{}> has {} from its default class beside another orientation; versions of "
                                        "MuJoCo differ in which one counts",
                                        element.element->name, last));
  return last;
}

std::vector<double> mjcf_numbers(const MjcfModel& model, const MjcfElement& element, std::string_view attribute,
                                 std::size_t least, std::size_t most) {
  const std::string* const text = model.value(element, attribute);
  if (!text) return {};
  std::vector<double> values = model.document().numbers(*element.element, *text);
  if (values.size() < least || values.size() > most)
    model.document().refuse(
        *element.element,
        fmt::format("{}='{}' of <{}> has {} numbers, expected {}", attribute, *text, element.element->name,
                    values.size(), least == most ? std::to_string(least) : fmt::format("{} to {}", least, most)));
  return values;
}

std::vector<MjcfAttribute> mjcf_attributes_of(const Pose& pose) {
  std::vector<MjcfAttribute> result;
  const Vec3& t = pose.translation;
  if (t != Vec3{}) result.emplace_back("pos", fmt::format("{} {} {}", t.x, t.y, t.z));
  if (pose.rotation == Pose{}.rotation) return result;
  const std::array<double, 4> q = quaternion_of(pose);
  result.emplace_back("quat", fmt::format("{} {} {} {}", q[0], q[1], q[2], q[3]));
  return result;
}

Pose mjcf_pose(const MjcfModel& model, const MjcfElement& element) {
  const XmlDocument& document = model.document();
  if (element.element->name == "geom") {
    const std::vector<double> v = mjcf_numbers(model, element, "fromto", 6, 6);
    if (!v.empty()) {
      const Vec3 from = bounded(document, *element.element, {v[0], v[1], v[2]});
      const Vec3 to = bounded(document, *element.element, {v[3], v[4], v[5]});
      Pose pose = turn_of_z_to(unit_vector(document, *element.element, from - to, "fromto"));
      pose.translation = from * 0.5 + to * 0.5;
      return pose;
    }
  }
  const std::string_view orientation = mjcf_orientation(model, element);
  Pose pose = orientation.empty() ? Pose{} : rotation_by(model, element, orientation);
  const std::vector<double> pos = mjcf_numbers(model, element, "pos", 3, 3);
  if (!pos.empty()) pose.translation = bounded(document, *element.element, {pos[0], pos[1], pos[2]});
  return pose;
}

MjcfModel::MjcfModel(const XmlDocument& document) : document_(document) {
  read_compiler();
  read_defaults();
  read_meshes();
  read_pairs();
  read_names(document.root());
  for (const XmlElement* section : document.root().children_called("worldbody"))
    read_children({section, kWorld, main_class_, {}});
  for (MjcfBody& body : bodies_) {
    body.visual_collides = body.visual.empty() && !body.colliding.empty();
    if (body.visual_collides) body.visual = body.colliding;
  }
  note_skipped();
}

void MjcfModel::read_compiler() {
  compiler_.angle_unit = std::numbers::pi / 180;
  for (const XmlElement* element : document_.root().children_called("compiler")) {
    const auto text = [&](std::string_view key) { return element->attribute(key); };
    if (text("strippath")) compiler_.strips_paths = is_true(text("strippath"));
    if (text("autolimits")) compiler_.auto_limits = is_true(text("autolimits"));
    if (text("inertiafromgeom")) compiler_.inertia_from_geoms = is_true(text("inertiafromgeom"));
    if (const auto* folder = text("assetdir")) compiler_.mesh_folder = compiler_.texture_folder = *folder;
    if (const auto* folder = text("meshdir")) compiler_.mesh_folder = *folder;
    if (const auto* folder = text("texturedir")) compiler_.texture_folder = *folder;
    if (const auto* sequence = text("eulerseq")) compiler_.euler_sequence = *sequence;
    if (const auto* angle = text("angle")) {
      if (*angle != "degree" && *angle != "radian")
        document_.refuse(*element, fmt::format("angle='{}': expected degree or radian", *angle));
      compiler_.angle_unit = *angle == "radian" ? 1 : std::numbers::pi / 180;
    }
    if (const auto* coordinate = text("coordinate"); coordinate && *coordinate == "global")
      document_.refuse(*element, "coordinate='global' is not read; MuJoCo 2.3.3 and later do not read it either");
    if (compiler_.euler_sequence.size() != 3 ||
        compiler_.euler_sequence.find_first_not_of("xyzXYZ") != std::string::npos)
      document_.refuse(*element,
                       fmt::format("eulerseq='{}': expected three of x, y, z, X, Y and Z", compiler_.euler_sequence));
  }
}

void MjcfModel::read_defaults() {
  classes_[main_class_];
  for (const XmlElement* section : document_.root().children_called("default")) {
    if (const std::string* name = section->attribute("class"); name && *name != main_class_) {
      classes_[*name] = classes_[main_class_];
      main_class_ = *name;
    }
    read_class(*section, main_class_);
  }
}

void MjcfModel::read_class(const XmlElement& element, const std::string& name) {
  for (const XmlElement* child : element.children)
    if (child->name != "default")
      for (const auto& [key, value] : child->attributes) classes_[name][child->name].insert_or_assign(key, value);
  for (const XmlElement* child : element.children_called("default")) {
    const std::string& nested = document_.required(*child, "class");
    if (classes_.contains(nested)) document_.refuse(*child, fmt::format("there is a second class '{}'", nested));
    classes_[nested] = classes_[name];
    read_class(*child, nested);
  }
}

void MjcfModel::read_meshes() {
  for (const XmlElement* section : document_.root().children_called("asset"))
    for (const XmlElement* mesh : section->children_called("mesh")) {
      const std::string name = mesh_name(*mesh);
      if (name.empty()) document_.refuse(*mesh, "<mesh> has neither a name nor a file");
      const auto [other, is_new] = meshes_.emplace(name, mesh);
      if (!is_new)
        document_.refuse(*mesh, fmt::format("there is a second mesh called '{}', the first is in line {}", name,
                                            other->second->line));
    }
}

/// Pairs collide whatever contype and conaffinity of their geoms say.
void MjcfModel::read_pairs() {
  for (const XmlElement* section : document_.root().children_called("contact"))
    for (const XmlElement* pair : section->children)
      for (const std::string_view key : {"geom1", "geom2"})
        if (const std::string* name = pair->attribute(key)) paired_.insert(*name);
}

std::string MjcfModel::mesh_name(const XmlElement& mesh) const {
  if (const std::string* name = mesh.attribute("name")) return *name;
  const std::string* const file = mesh.attribute("file");
  return file ? std::filesystem::path(*file).stem().string() : "";
}

std::string MjcfModel::file_name(const std::string& said) const {
  return compiler_.strips_paths ? said.substr(said.find_last_of("/\\") + 1) : said;
}

const std::string* MjcfModel::value(const MjcfElement& element, std::string_view attribute) const {
  return value(element, element.element->name, attribute);
}

const std::string* MjcfModel::equality_value(const XmlElement& element, std::string_view attribute) const {
  return value(asset(element), "equality", attribute);
}

const std::string* MjcfModel::value(const MjcfElement& element, const std::string& tag,
                                    std::string_view attribute) const {
  if (const std::string* own = element.element->attribute(attribute)) return own;
  const Attributes& inherited = defaults(element.class_name, tag);
  const auto found = inherited.find(attribute);
  return found == inherited.end() ? nullptr : &found->second;
}

const MjcfModel::Attributes& MjcfModel::defaults(const std::string& class_name, const std::string& tag) const {
  static const Attributes none;
  const auto known = classes_.find(class_name);
  if (known == classes_.end()) return none;
  const auto found = known->second.find(tag);
  return found == known->second.end() ? none : found->second;
}

const std::string& MjcfModel::known_class(const XmlElement& element, const std::string& name) const {
  if (!classes_.contains(name))
    document_.refuse(element, fmt::format("<{}> has the class '{}', which no <default> defines", element.name, name));
  return name;
}

MjcfElement MjcfModel::asset(const XmlElement& element) const {
  const std::string* const name = element.attribute("class");
  return {&element, name ? known_class(element, *name) : main_class_, nullptr, {}};
}

MjcfElement MjcfModel::with_class(const Place& place, const XmlElement& element) const {
  const std::string* const name = element.attribute("class");
  return {&element, name ? known_class(element, *name) : place.child_class, place.element, place.frame, place.way};
}

void MjcfModel::read_children(const Place& place) {
  for (const XmlElement* child : place.element->children) read_child(place, *child);
}

void MjcfModel::read_child(const Place& place, const XmlElement& child) {
  if (child.name == "body") return add_body(place, child);
  if (child.name == "geom") return add_geom(place, child);
  if (child.name == "frame") return add_frame(place, child);
  if (child.name == "inertial" && place.body != kWorld) bodies_[place.body].has_inertial = true;
  if (child.name == "joint" || child.name == "freejoint") {
    if (place.body == kWorld) document_.refuse(child, "the world has a joint");
    bodies_[place.body].joints.push_back(with_class(place, child));
  }
  if (child.name == "replicate" || child.name == "composite" || child.name == "flexcomp" || child.name == "attach")
    notes_.push_back(
        fmt::format("{}: <{}> is not read, and neither is what it makes", document_.short_place_of(child), child.name));
}

void MjcfModel::add_body(const Place& place, const XmlElement& element) {
  MjcfBody body;
  body.element = &element, body.parent = place.body, body.frame = place.frame;
  body.name = name_of(element);
  const std::string* const child_class = element.attribute("childclass");
  body.child_class = child_class ? known_class(element, *child_class) : place.child_class;
  bodies_.push_back(body);
  read_children({&element, bodies_.size() - 1, body.child_class, {}});
}

void MjcfModel::add_frame(const Place& place, const XmlElement& element) {
  const std::string* const child_class = element.attribute("childclass");
  const Pose pose = mjcf_pose(*this, {&element, "", place.element, {}});
  read_children({&element, place.body, child_class ? known_class(element, *child_class) : place.child_class,
                 composed(place.frame, pose), place.way + norm(pose.translation)});
}

void MjcfModel::add_geom(const Place& place, const XmlElement& element) {
  if (place.body == kWorld) return void(++world_geoms_);
  MjcfElement geom = with_class(place, element);
  MjcfBody& body = bodies_[place.body];
  (collides(geom) ? body.colliding : body.visual).push_back(std::move(geom));
}

bool MjcfModel::collides(const MjcfElement& geom) const {
  const std::string* const name = geom.element->attribute("name");
  if (name && paired_.contains(*name)) return true;
  for (const std::string_view key : {"contype", "conaffinity"}) {
    const std::vector<double> bits = mjcf_numbers(*this, geom, key, 1, 1);
    if (bits.empty() || bits[0] != 0) return true;  // it is 1 if nothing is said
  }
  return false;
}

void MjcfModel::read_names(const XmlElement& parent) {
  for (const XmlElement* child : parent.children) {
    const std::string* const name = child->name == "body" ? child->attribute("name") : nullptr;
    if (name && *name == "world") document_.refuse(*child, "a <body> is called 'world', a name that MuJoCo reserves");
    if (name && !name->empty() && !body_names_.insert(*name).second)
      document_.refuse(*child, fmt::format("there is a second <body> called '{}'", *name));
    read_names(*child);
  }
}

std::string MjcfModel::name_of(const XmlElement& body) {
  if (const std::string* said = body.attribute("name"); said && !said->empty()) return *said;
  return unique_name(fmt::format("body_{}", body.line), body_names_);
}

void MjcfModel::note_skipped() {
  if (world_geoms_ > 0) notes_.push_back(fmt::format("geoms of the world are not read: {}", world_geoms_));
  std::size_t shared = 0, massless = 0;
  for (const MjcfBody& body : bodies_) {
    shared += body.visual_collides;
    massless += !body.colliding.empty() && (!body.has_inertial || compiler_.inertia_from_geoms);
  }
  if (shared > 0)
    notes_.push_back(
        fmt::format("bodies that have only geoms that collide: {}; these geoms count as visual geometry too", shared));
  if (massless > 0)
    notes_.push_back(
        fmt::format("bodies whose mass MuJoCo computes from their geoms: {}; it changes with the geoms that "
                    "collide, unless they get an <inertial>",
                    massless));
}

}  // namespace prohull::robot
