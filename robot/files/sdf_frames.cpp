#include "robot/files/sdf_frames.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "robot/files/xml_values.h"

namespace prohull::robot {
namespace {

std::optional<SdfFrame::Kind> kind_of(const XmlElement& element) {
  if (element.name == "link") return SdfFrame::Kind::Link;
  if (element.name == "joint") return SdfFrame::Kind::Joint;
  if (element.name == "frame") return SdfFrame::Kind::Frame;
  if (element.name == "model") return SdfFrame::Kind::Model;
  return std::nullopt;
}

/// Old files have such a link: SDF reserves the name, and joints that name it as parent are fixed to the world.
bool stands_for_world(const XmlElement& link) {
  const std::string* const name = link.attribute("name");
  return name && *name == "world" && !link.child("visual") && !link.child("collision");
}

bool is_true_or_1(const std::string* value) { return value && (*value == "true" || *value == "1"); }

}  // namespace

std::string sdf_text(const XmlElement& element, std::string_view child) {
  const XmlElement* const found = element.child(child);
  return found ? found->text() : "";
}

double sdf_number(const XmlDocument& document, const XmlElement& element) {
  const std::vector<double> values = document.numbers(element, element.content);
  if (values.size() != 1)
    document.refuse(element, fmt::format("<{}> has {} numbers, expected one", element.name, values.size()));
  return values[0];
}

Vec3 sdf_vector(const XmlDocument& document, const XmlElement& element) {
  const std::vector<double> values = document.numbers(element, element.content);
  if (values.size() != 3)
    document.refuse(element, fmt::format("<{}> has {} numbers, expected three", element.name, values.size()));
  return {values[0], values[1], values[2]};
}

Pose sdf_pose(const XmlDocument& document, const XmlElement& pose) {
  const std::vector<double> v = document.numbers(pose, pose.content);
  if (v.empty()) return {};
  const std::string* const format = pose.attribute("rotation_format");
  const bool quaternion = format && *format == "quat_xyzw";
  if (format && !quaternion && *format != "euler_rpy")
    document.refuse(pose, fmt::format("rotation_format='{}': expected euler_rpy or quat_xyzw", *format));
  if (v.size() != (quaternion ? 7 : 6))
    document.refuse(pose, fmt::format("<pose> has {} numbers, expected {}", v.size(), quaternion ? 7 : 6));
  const Vec3 translation = bounded(document, pose, {v[0], v[1], v[2]});
  if (quaternion) return {quaternion_rotation(document, pose, v[6], v[3], v[4], v[5]).rotation, translation};
  const double unit = is_true_or_1(pose.attribute("degrees")) ? std::numbers::pi / 180 : 1;
  return pose_of_rpy({v[3] * unit, v[4] * unit, v[5] * unit}, translation);
}

SdfFrames::SdfFrames(const XmlDocument& document, const XmlElement& model) : document_(document) {
  frames_.push_back({SdfFrame::Kind::Model, &model, "__model__", 0, 0, 0, {}, {}});
  add_model(model, 0, "");
  for (std::size_t frame = 1; frame < frames_.size(); ++frame) connect(frame);
  for (std::size_t frame = frames_.size(); frame-- > 1;)
    if (frames_[frame].kind == SdfFrame::Kind::Model) move_to_placement_frame(frame);
  place_all();
}

void SdfFrames::add_model(const XmlElement& model, std::size_t frame, const std::string& prefix) {
  const std::size_t scope = prefixes_.size();
  prefixes_.push_back(prefix), models_.push_back(frame), scope_of_[frame] = scope;
  by_name_[prefix + "__model__"] = frame;
  // Links take their names first: before SDF 1.7 a joint may have the name of a link.
  for (const XmlElement* child : model.children)
    if (child->name == "link" && !stands_for_world(*child)) add(SdfFrame::Kind::Link, *child, scope, prefix);
  for (const XmlElement* child : model.children)
    if (const auto kind = kind_of(*child); kind && *kind != SdfFrame::Kind::Link) add(*kind, *child, scope, prefix);
}

std::size_t SdfFrames::add(SdfFrame::Kind kind, const XmlElement& element, std::size_t scope,
                           const std::string& prefix) {
  const std::string& name = document_.required(element, "name");
  if (name.empty()) document_.refuse(element, fmt::format("<{}> has an empty name", element.name));
  if (name == "world" || name == "__root__")
    document_.refuse(element, fmt::format("<{}> is called '{}', a name that SDF reserves", element.name, name));
  const std::size_t frame = frames_.size();
  frames_.push_back({kind, &element, prefix + name, scope, 0, 0, {}, {}});
  add_name(prefix + name, frame);
  if (kind == SdfFrame::Kind::Model) add_model(element, frame, prefix + name + "::");
  return frame;
}

void SdfFrames::add_name(const std::string& name, std::size_t frame) {
  const auto [other, is_new] = by_name_.emplace(name, frame);
  if (is_new || frames_[other->second].kind != frames_[frame].kind) return;
  document_.refuse(*frames_[frame].element,
                   fmt::format("there is a second <{}> called '{}', the first is in line {}",
                               frames_[frame].element->name, name, frames_[other->second].element->line));
}

std::size_t SdfFrames::find(std::size_t scope, const std::string& name, const XmlElement& user) const {
  const auto found = by_name_.find(prefixes_[scope] + name);
  if (found != by_name_.end()) return found->second;
  document_.refuse(user,
                   fmt::format("<{}> names '{}', which is no link, joint or frame of the model", user.name, name));
}

std::size_t SdfFrames::relative_to(const XmlElement& element, std::size_t scope, std::size_t fallback) const {
  const XmlElement* const pose = element.child("pose");
  if (!pose) return fallback;
  const std::string* name = pose->attribute("relative_to");
  if (!name) name = pose->attribute("frame");  // before SDF 1.7
  return name && !name->empty() ? find(scope, *name, *pose) : fallback;
}

void SdfFrames::connect(std::size_t frame) {
  SdfFrame& it = frames_[frame];
  std::size_t fallback = models_[it.scope];
  it.attached = frame;
  if (it.kind == SdfFrame::Kind::Joint) {
    const XmlElement* const child = it.element->child("child");
    if (!child) document_.refuse(*it.element, fmt::format("joint '{}' has no <child>", it.name));
    fallback = it.attached = find(it.scope, sdf_text(*it.element, "child"), *child);
  } else if (it.kind == SdfFrame::Kind::Frame) {
    const std::string* const to = it.element->attribute("attached_to");
    if (to && !to->empty()) fallback = find(it.scope, *to, *it.element);
    it.attached = fallback;
  } else if (it.kind == SdfFrame::Kind::Model) {
    it.attached = canonical_link(frame);
  }
  it.parent = relative_to(*it.element, it.scope, fallback);
  if (const XmlElement* const pose = it.element->child("pose")) it.in_parent = sdf_pose(document_, *pose);
}

/// A model's own link that stands for the model; the model itself if it has no links.
std::size_t SdfFrames::canonical_link(std::size_t model) const {
  const XmlElement& element = *frames_[model].element;
  const std::size_t scope = scope_of_.at(model);
  const std::string* const name = element.attribute("canonical_link");
  if (name && !name->empty()) return find(scope, *name, element);
  for (std::size_t frame = model + 1; frame < frames_.size(); ++frame) {
    if (!frames_[frame].name.starts_with(prefixes_[scope])) break;  // what a model has follows it
    if (frames_[frame].kind == SdfFrame::Kind::Link) return frame;
  }
  return model;
}

/// The pose of a nested model is that of its placement_frame, if it has one.
void SdfFrames::move_to_placement_frame(std::size_t model) {
  const XmlElement& element = *frames_[model].element;
  const std::string* const name = element.attribute("placement_frame");
  if (!name || name->empty()) return;
  Pose placement;
  std::size_t steps = 0;
  for (std::size_t at = find(scope_of_.at(model), *name, element); at != model; at = frames_[at].parent) {
    if (at == 0 || ++steps > frames_.size())
      document_.refuse(element, fmt::format("the placement_frame '{}' is not placed within the model", *name));
    placement = composed(frames_[at].in_parent, placement);
    frames_[model].way += norm(frames_[at].in_parent.translation);
  }
  frames_[model].way += norm(frames_[model].in_parent.translation);
  frames_[model].in_parent = composed(frames_[model].in_parent, inverse(placement));
}

void SdfFrames::place_all() {
  std::vector<bool> placed(frames_.size()), on_way(frames_.size());
  placed[0] = true;
  for (std::size_t frame = 1; frame < frames_.size(); ++frame) {
    std::vector<std::size_t> way;
    for (std::size_t at = frame; !placed[at]; at = frames_[at].parent) {
      if (on_way[at])
        document_.refuse(*frames_[at].element, fmt::format("the pose of '{}' is relative to itself", frames_[at].name));
      on_way[at] = true;
      way.push_back(at);
    }
    for (; !way.empty(); way.pop_back()) {
      SdfFrame& it = frames_[way.back()];
      it.in_model = composed(frames_[it.parent].in_model, it.in_parent);
      it.way += frames_[it.parent].way + norm(it.in_parent.translation);
      placed[way.back()] = true;
    }
  }
}

std::size_t SdfFrames::link_of(std::size_t frame) const {
  const std::size_t first = frame;
  for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {
    if (frames_[frame].kind == SdfFrame::Kind::Link) return frame;
    const std::size_t next = frame == 0 ? canonical_link(0) : frames_[frame].attached;
    if (next == frame) break;
    frame = next;
  }
  document_.refuse(*frames_[first].element, fmt::format("'{}' is attached to no link", frames_[first].name));
}

ComputedPose SdfFrames::pose_in_link(const XmlElement& element, std::size_t link) const {
  const XmlElement* const pose = element.child("pose");
  if (!pose) return {};
  const Pose said = sdf_pose(document_, *pose);
  const std::size_t other = relative_to(element, frames_[link].scope, link);
  if (other == link) return {said};
  return {composed(inverse(frames_[link].in_model), composed(frames_[other].in_model, said)),
          frames_[link].way + frames_[other].way + norm(said.translation)};
}

}  // namespace prohull::robot
