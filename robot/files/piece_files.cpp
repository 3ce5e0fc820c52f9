#include "robot/files/piece_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/detail/extension.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "robot/files/xml.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

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

using Primitive = decltype(NamedPiece::primitive);

/// A capsule so short that its axis is rounding is a ball.
Primitive sound(const Primitive& primitive) {
  const auto* const capsule = std::get_if<Capsule>(&primitive);
  if (!capsule) return primitive;
  const double length = norm(capsule->b - capsule->a);
  if (length > 1e-9 * capsule->radius) return primitive;
  return Ball{0.5 * (capsule->a + capsule->b), capsule->radius + length};
}

Pose pose_of(const OrientedBox& box) { return of_columns(box.axes[0], box.axes[1], box.axes[2], box.center); }

// Below, names and URIs are bytes of XML.

std::string collision(const std::string& name, const Vec3& xyz, const Vec3& rpy, const std::string& form) {
  std::string origin;
  if (xyz != Vec3{} || rpy != Vec3{})
    origin = fmt::format("      <origin xyz=\"{}\" rpy=\"{}\"/>\n", numbers(xyz), numbers(rpy));
  return fmt::format("    <collision name=\"{}\">\n{}      <geometry>{}</geometry>\n    </collision>\n", name, origin,
                     form);
}

std::string urdf_piece(const std::string& name, const std::string& uri, const Primitive& primitive) {
  if (const auto* const box = std::get_if<OrientedBox>(&primitive))
    return collision(name, box->center, rpy_of(pose_of(*box)),
                     fmt::format("<box size=\"{}\"/>", numbers(2.0 * box->half_sizes)));
  if (const auto* const ball = std::get_if<Ball>(&primitive))
    return collision(name, ball->center, {}, fmt::format("<sphere radius=\"{}\"/>", ball->radius));
  if (const auto* const capsule = std::get_if<Capsule>(&primitive)) {
    const Vec3 axis = capsule->b - capsule->a;
    const Vec3 turn_of_z{0, std::atan2(std::hypot(axis.x, axis.y), axis.z), std::atan2(axis.y, axis.x)};
    const Vec3 middle = 0.5 * (capsule->a + capsule->b);
    const double rounding = norm((capsule->a - middle) + (capsule->b - middle)) / 2;
    return collision(name, middle, turn_of_z,
                     fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", capsule->radius + rounding,
                                 norm(axis) + 2 * rounding)) +
           urdf_piece(name + "_a", uri, Ball{capsule->a, capsule->radius}) +
           urdf_piece(name + "_b", uri, Ball{capsule->b, capsule->radius});
  }
  return collision(name, {}, {}, fmt::format("<mesh filename=\"{}\"/>", uri));
}

/// The attributes that give a geom its form.
std::string mjcf_form(const std::string& name, const Primitive& primitive) {
  if (const auto* const box = std::get_if<OrientedBox>(&primitive))
    return fmt::format(R"(type="box" size="{}" pos="{}" quat="{}")", numbers(box->half_sizes), numbers(box->center),
                       fmt::join(quaternion_of(pose_of(*box)), " "));
  if (const auto* const capsule = std::get_if<Capsule>(&primitive))
    return fmt::format(R"(type="capsule" size="{}" fromto="{} {}")", capsule->radius, numbers(capsule->a),
                       numbers(capsule->b));
  if (const auto* const ball = std::get_if<Ball>(&primitive))
    return fmt::format(R"(type="sphere" size="{}" pos="{}")", ball->radius, numbers(ball->center));
  return fmt::format(R"(type="mesh" mesh="{}")", name);
}

void require_mujoco_reads(const std::string& uri) {
  const std::string suffix = lower_case_extension(uri);
  if (suffix != ".stl" && suffix != ".obj")
    refuse(fmt::format("{}: MuJoCo reads no such files; write the pieces as STL or OBJ", uri));
  if (uri.find("://") != std::string::npos) refuse(fmt::format("{}: MuJoCo reads paths, but no URIs", uri));
}

/// Calls `write(name, uri, primitive)` for each piece.
template <class Write>
void each_piece(const std::string& name, std::span<const NamedPiece> pieces, Write write) {
  const std::vector<std::string> names = piece_names(name, pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    write(escaped(names[i]), escaped(pieces[i].uri), sound(pieces[i].primitive));
}

}  // namespace

std::vector<std::string> piece_names(const std::string& name, std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(2, fmt::formatted_size("{}", count));
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("{}_{:0{}}", name, i, digits));
  return names;
}

std::string urdf_of(const std::string& name, std::span<const NamedPiece> pieces) {
  std::string text =
      fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{0}\">\n  <link name=\"{0}\">\n", escaped(name));
  each_piece(name, pieces, [&](auto&&... piece) { text += urdf_piece(piece...); });
  return text + "  </link>\n</robot>\n";
}

std::string mjcf_of(const std::string& name, std::span<const NamedPiece> pieces) {
  for (const NamedPiece& piece : pieces)
    if (std::holds_alternative<std::monostate>(piece.primitive)) require_mujoco_reads(piece.uri);
  const std::string model = escaped(name);
  std::string assets, geoms;
  each_piece(name, pieces, [&](const std::string& piece, const std::string& uri, const Primitive& primitive) {
    if (std::holds_alternative<std::monostate>(primitive))
      assets += fmt::format("    <mesh name=\"{}\" file=\"{}\"/>\n", piece, uri);
    // The attributes are those of geoms that mjcf_write.cpp adds to a body that has none to collide.
    geoms += fmt::format("      <geom name=\"{}\" contype=\"1\" conaffinity=\"1\" group=\"3\" mass=\"0\" {}/>\n", piece,
                         mjcf_form(piece, primitive));
  });
  if (!assets.empty()) assets = "  <asset>\n" + assets + "  </asset>\n";
  // MuJoCo refuses a body without mass, though one that does not move needs none.
  return fmt::format(
      "<mujoco model=\"{0}\">\n{1}  <worldbody>\n    <body name=\"{0}\">\n"
      "      <inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>  <!-- a placeholder: before the body moves, "
      "put its own here -->\n"
      "{2}    </body>\n  </worldbody>\n</mujoco>\n",
      model, assets, geoms);
}

}  // namespace prohull::robot
