#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "robot/files/xml.h"
#include "robot/model.h"

namespace prohull::robot {

/// The attributes that say how an element is turned.
inline constexpr std::array<std::string_view, 5> kMjcfOrientations{"quat", "axisangle", "xyaxes", "zaxis", "euler"};

/// What <compiler> says.
struct MjcfCompiler {
  double angle_unit = 0;  ///< in radians
  std::string euler_sequence = "xyz";
  std::filesystem::path mesh_folder, texture_folder;  ///< relative to the file
  bool strips_paths = false, auto_limits = true, inertia_from_geoms = false;
};

/// An element with the default class that applies to it.
struct MjcfElement {
  const XmlElement* element = nullptr;
  std::string class_name;
  const XmlElement* home = nullptr;  ///< the <body> or <frame> that it is in
  Pose frame;                        ///< of the <frame>s around it, in the frame of the body
  double way = 0;                    ///< the lengths of the poses of these <frame>s together
};

struct MjcfBody {
  const XmlElement* element = nullptr;
  std::string name, child_class;
  std::size_t parent = 0;  ///< another body, or kWorld of joint_forest.h
  Pose frame;              ///< of the <frame>s around it, in the frame of the parent
  std::vector<MjcfElement> visual, colliding, joints;
  bool has_inertial = false;
  bool visual_collides = false;  ///< there are only geoms that collide: they count as visual, too
};

/// What a MuJoCo document says, with its default classes looked up.
class MjcfModel {
 public:
  using Attributes = std::map<std::string, std::string, std::less<>>;

  /// Throws InputError(Malformed): default classes that do not exist, names that occur twice.
  explicit MjcfModel(const XmlDocument& document);

  const XmlDocument& document() const { return document_; }
  const MjcfCompiler& compiler() const { return compiler_; }
  const std::vector<MjcfBody>& bodies() const { return bodies_; }  ///< a parent before its children
  const std::map<std::string, const XmlElement*>& meshes() const { return meshes_; }
  const std::string& main_class() const { return main_class_; }
  const std::vector<std::string>& notes() const { return notes_; }

  /// An attribute of the element, or of its default class; nullptr if neither has it.
  const std::string* value(const MjcfElement& element, std::string_view attribute) const;
  /// The attributes that a class sets for elements called `tag`.
  const Attributes& defaults(const std::string& class_name, const std::string& tag) const;
  /// The same of an element of <equality>, whatever its name is.
  const std::string* equality_value(const XmlElement& element, std::string_view attribute) const;
  /// The class of an element that is in no body.
  MjcfElement asset(const XmlElement& element) const;
  /// The name of a mesh asset: as it says, or the stem of its file.
  std::string mesh_name(const XmlElement& mesh) const;
  /// The file that an attribute names: without folders, if the compiler strips them.
  std::string file_name(const std::string& said) const;

 private:
  using Classes = std::map<std::string, Attributes>;  // by tag

  const std::string* value(const MjcfElement& element, const std::string& tag, std::string_view attribute) const;
  void read_compiler();
  void read_defaults();
  void read_class(const XmlElement& element, const std::string& name);
  void read_meshes();
  void read_pairs();
  struct Place {
    const XmlElement* element = nullptr;  // <worldbody>, <body> or <frame>
    std::size_t body = 0;
    std::string child_class;
    Pose frame;
    double way = 0;  // as MjcfElement::way
  };
  void read_children(const Place& place);
  void read_child(const Place& place, const XmlElement& child);
  void add_body(const Place& place, const XmlElement& element);
  void add_geom(const Place& place, const XmlElement& element);
  void add_frame(const Place& place, const XmlElement& element);
  MjcfElement with_class(const Place& place, const XmlElement& element) const;
  const std::string& known_class(const XmlElement& element, const std::string& name) const;
  void read_names(const XmlElement& parent);
  std::string name_of(const XmlElement& body);
  bool collides(const MjcfElement& geom) const;
  void note_skipped();

  const XmlDocument& document_;
  MjcfCompiler compiler_;
  std::string main_class_ = "main";
  std::map<std::string, Classes> classes_;
  std::map<std::string, const XmlElement*> meshes_;
  std::set<std::string> paired_, body_names_;
  std::vector<MjcfBody> bodies_;
  std::size_t world_geoms_ = 0;
  std::vector<std::string> notes_;
};

using MjcfAttribute = std::pair<std::string, std::string>;

/// The pose as pos and quat, where they are not those of a geom that says nothing.
std::vector<MjcfAttribute> mjcf_attributes_of(const Pose& pose);

/// The one of kMjcfOrientations that counts, of those that the element and its default class say; empty if there is
/// none. Throws InputError(Malformed) where that depends on the version of MuJoCo.
std::string_view mjcf_orientation(const MjcfModel& model, const MjcfElement& element);

/// The pose that pos and quat, axisangle, euler, xyaxes or zaxis say, fromto too where that is allowed.
Pose mjcf_pose(const MjcfModel& model, const MjcfElement& element);

/// The numbers of an attribute; `least` is how many there have to be at least, `most` at most. Empty if there is none.
std::vector<double> mjcf_numbers(const MjcfModel& model, const MjcfElement& element, std::string_view attribute,
                                 std::size_t least, std::size_t most);

}  // namespace prohull::robot
