#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "robot/files/xml.h"
#include "robot/transform.h"

namespace prohull::robot {

/// The text of a child element without blanks around it, "" if there is no such child.
std::string sdf_text(const XmlElement& element, std::string_view child);

/// The only number in an element's content. Throws InputError(Malformed).
double sdf_number(const XmlDocument& document, const XmlElement& element);

/// The three numbers in an element's content. Throws InputError(Malformed).
Vec3 sdf_vector(const XmlDocument& document, const XmlElement& element);

/// What a <pose> element says, whatever it is relative to: roll, pitch and yaw in radians or degrees, or a quaternion.
Pose sdf_pose(const XmlDocument& document, const XmlElement& pose);

/// A model, a link, a joint or a <frame> of an SDF model. All of them are frames that poses can be relative to.
struct SdfFrame {
  enum class Kind { Model, Link, Joint, Frame };
  Kind kind = Kind::Frame;
  const XmlElement* element = nullptr;
  std::string name;                      ///< with the names of nested models before it, as "gripper::finger"
  std::size_t scope = 0;                 ///< which model's names it sees
  std::size_t parent = 0, attached = 0;  ///< frames: its pose is relative to the first, and it moves with the second
  Pose in_parent, in_model;
  double way = 0;  ///< the lengths of the poses that `in_model` was computed from, together
};

/// A pose, and how far the frames lead that it was computed from; 0 if nothing was rounded.
struct ComputedPose {
  Pose pose;
  double way = 0;
};

/// The frames of a model and of the models nested in it. Frame 0 is that of the model itself.
class SdfFrames {
 public:
  /// Throws InputError(Malformed): a name that occurs twice, a frame that does not exist, frames in a loop.
  SdfFrames(const XmlDocument& document, const XmlElement& model);

  const std::vector<SdfFrame>& all() const { return frames_; }
  /// The frame that `name` means in a scope. Throws InputError(Malformed) that names `user`.
  std::size_t find(std::size_t scope, const std::string& name, const XmlElement& user) const;
  /// The link that a frame moves with.
  std::size_t link_of(std::size_t frame) const;
  /// Where the <pose> child of `element`, which is in a link, puts it in the frame of the link. Nothing is rounded
  /// unless that pose is relative to another frame.
  ComputedPose pose_in_link(const XmlElement& element, std::size_t link) const;

 private:
  void add_model(const XmlElement& model, std::size_t frame, const std::string& prefix);
  std::size_t add(SdfFrame::Kind kind, const XmlElement& element, std::size_t scope, const std::string& prefix);
  void add_name(const std::string& name, std::size_t frame);
  void connect(std::size_t frame);
  std::size_t canonical_link(std::size_t model) const;
  void move_to_placement_frame(std::size_t model);
  void place_all();
  std::size_t relative_to(const XmlElement& element, std::size_t scope, std::size_t fallback) const;

  const XmlDocument& document_;
  std::vector<SdfFrame> frames_;                 // a model before everything in it
  std::vector<std::string> prefixes_;            // of the names in each scope
  std::vector<std::size_t> models_;              // the frame of each scope's model
  std::map<std::size_t, std::size_t> scope_of_;  // of the frame of a model: what is in it
  std::map<std::string, std::size_t> by_name_;
};

}  // namespace prohull::robot
