#include "robot/files/piece_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "prohull/detail/extension.h"
#include "prohull/error.h"
#include "robot/files/xml.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw InputError(Defect::InvalidOption, what); }

/// Whether a reader of XML finds the same text again.
bool is_kept_by_xml(const std::string& text) {
  try {
    const XmlDocument document("<a b=\"" + xml_escaped(text) + "\"/>", "");
    const std::string* const found = document.root().attribute("b");
    return found && *found == text;
  } catch (const InputError&) {
    return false;
  }
}

std::string escaped(const std::string& text) {
  if (!is_kept_by_xml(text))
    refuse(fmt::format("XML cannot hold this name; choose one in UTF-8, without control characters: '{}'", text));
  return xml_escaped(text);
}

std::string numbers(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// A capsule so short that its axis is rounding is a ball.
decltype(NamedPiece::primitive) sound(const decltype(NamedPiece::primitive)& primitive) {
  const auto* const capsule = std::get_if<Capsule>(&primitive);
  if (!capsule) return primitive;
  const double length = norm(capsule->b - capsule->a);
  if (length > 1e-9 * capsule->radius) return primitive;
  return Ball{0.5 * (capsule->a + capsule->b), capsule->radius + length};
}

Pose pose_of(const OrientedBox& box) { return of_columns(box.axes[0], box.axes[1], box.axes[2], box.center); }

class UrdfPieces {
 public:
  explicit UrdfPieces(const std::string& name) {
    text_ = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n  <link name=\"{}\">\n", name, name);
  }

  /// `name` and `uri` are bytes of XML.
  void add(const std::string& name, const std::string& uri, const decltype(NamedPiece::primitive)& primitive) {
    if (const auto* const box = std::get_if<OrientedBox>(&primitive))
      add_element(name, box->center, rpy_of(pose_of(*box)),
                  fmt::format("<box size=\"{}\"/>", numbers(2.0 * box->half_sizes)));
    else if (const auto* const capsule = std::get_if<Capsule>(&primitive))
      add_capsule(name, *capsule);
    else if (const auto* const ball = std::get_if<Ball>(&primitive))
      add_ball(name, *ball);
    else
      add_element(name, {}, {}, fmt::format("<mesh filename=\"{}\"/>", uri));
  }

  std::string text() const { return text_ + "  </link>\n</robot>\n"; }

 private:
  void add_ball(const std::string& name, const Ball& ball) {
    add_element(name, ball.center, {}, fmt::format("<sphere radius=\"{}\"/>", ball.radius));
  }

  void add_capsule(const std::string& name, const Capsule& capsule) {
    const Vec3 axis = capsule.b - capsule.a;
    const Vec3 turn_of_z{0, std::atan2(std::hypot(axis.x, axis.y), axis.z), std::atan2(axis.y, axis.x)};
    add_element(name, 0.5 * (capsule.a + capsule.b), turn_of_z,
                fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", capsule.radius, norm(axis)));
    add_ball(name + "_a", {capsule.a, capsule.radius});
    add_ball(name + "_b", {capsule.b, capsule.radius});
  }

  void add_element(const std::string& name, const Vec3& xyz, const Vec3& rpy, const std::string& form) {
    text_ += fmt::format("    <collision name=\"{}\">\n", name);
    if (xyz != Vec3{} || rpy != Vec3{})
      text_ += fmt::format("      <origin xyz=\"{}\" rpy=\"{}\"/>\n", numbers(xyz), numbers(rpy));
    text_ += fmt::format("      <geometry>{}</geometry>\n    </collision>\n", form);
  }

  std::string text_;
};

class MjcfPieces {
 public:
  explicit MjcfPieces(std::string name) : name_(std::move(name)) {}

  /// `name` and `uri` are bytes of XML.
  void add(const std::string& name, const std::string& uri, const decltype(NamedPiece::primitive)& primitive) {
    if (const auto* const box = std::get_if<OrientedBox>(&primitive)) {
      const auto q = quaternion_of(pose_of(*box));
      add_geom(name, fmt::format(R"(type="box" size="{}" pos="{}" quat="{} {} {} {}")", numbers(box->half_sizes),
                                 numbers(box->center), q[0], q[1], q[2], q[3]));
    } else if (const auto* const capsule = std::get_if<Capsule>(&primitive)) {
      add_geom(name, fmt::format(R"(type="capsule" size="{}" fromto="{} {}")", capsule->radius, numbers(capsule->a),
                                 numbers(capsule->b)));
    } else if (const auto* const ball = std::get_if<Ball>(&primitive)) {
      add_geom(name, fmt::format(R"(type="sphere" size="{}" pos="{}")", ball->radius, numbers(ball->center)));
    } else {
      assets_ += fmt::format("    <mesh name=\"{}\" file=\"{}\"/>\n", name, uri);
      add_geom(name, fmt::format(R"(type="mesh" mesh="{}")", name));
    }
  }

  std::string text() const {
    const std::string assets = assets_.empty() ? "" : "  <asset>\n" + assets_ + "  </asset>\n";
    // MuJoCo refuses a body without mass, though one that does not move needs none.
    return fmt::format(
        "<mujoco model=\"{}\">\n{}  <worldbody>\n    <body name=\"{}\">\n"
        "      <inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>  <!-- a placeholder: before the body moves, "
        "put its own here -->\n"
        "{}    </body>\n  </worldbody>\n</mujoco>\n",
        name_, assets, name_, geoms_);
  }

 private:
  /// The attributes are those of geoms that mjcf_write.cpp adds to a body that has none to collide.
  void add_geom(const std::string& name, const std::string& form) {
    geoms_ += fmt::format("      <geom name=\"{}\" contype=\"1\" conaffinity=\"1\" group=\"3\" mass=\"0\" {}/>\n", name,
                          form);
  }

  std::string name_, assets_, geoms_;
};

void require_mujoco_reads(const std::string& uri) {
  const std::string suffix = lower_case_extension(uri);
  if (suffix != ".stl" && suffix != ".obj")
    refuse(fmt::format("{}: MuJoCo reads no such files; write the pieces as STL or OBJ", uri));
  if (uri.find("://") != std::string::npos) refuse(fmt::format("{}: MuJoCo reads paths, but no URIs", uri));
}

template <class Writer>
std::string written(Writer writer, const std::string& name, std::span<const NamedPiece> pieces) {
  const std::vector<std::string> names = piece_names(name, pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    writer.add(escaped(names[i]), escaped(pieces[i].uri), sound(pieces[i].primitive));
  return writer.text();
}

}  // namespace

std::vector<std::string> piece_names(const std::string& name, std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(2, fmt::formatted_size("{}", count));
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("{}_{:0{}}", name, i, digits));
  return names;
}

std::string urdf_of(const std::string& name, std::span<const NamedPiece> pieces) {
  return written(UrdfPieces(escaped(name)), name, pieces);
}

std::string mjcf_of(const std::string& name, std::span<const NamedPiece> pieces) {
  for (const NamedPiece& piece : pieces)
    if (std::holds_alternative<std::monostate>(piece.primitive)) require_mujoco_reads(piece.uri);
  return written(MjcfPieces(escaped(name)), name, pieces);
}

}  // namespace prohull::robot
