#include "robot/motion/motion_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <system_error>
#include <utility>

#include "prohull/mesh_io.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

constexpr std::size_t kLetters = 26;

std::string text_of(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

std::string text_of(const Pose& pose) {
  std::string text;
  for (const Vec3& row : pose.rotation) text += text_of(row) + "  ";
  return text + text_of(pose.translation);
}

/// A name for the end of a line.
std::string line_of(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' '; }, '?');
  return name;
}

/// Letters of the freedoms that are halved, and dots.
std::string text_of(const CellTree& tree) {
  constexpr std::size_t kLine = 100;
  std::string text;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (i % kLine == 0) text += '\n';
    text += tree[i] == kLeaf ? '.' : static_cast<char>('a' + tree[i]);
  }
  return text + '\n';
}

/// Writes frames: those of links on which others hang, then one of each joint, then those of bodies.
class Writer {
 public:
  /// If `rest` is given, it has a position of each joint, and no joint is anywhere else.
  explicit Writer(Robot robot, std::span<const double> rest = {})
      : robot_(std::move(robot)), of_link_(robot_.links.size(), kNone) {
    for (const Joint& joint : robot_.joints) of_link_[joint.child] = 0;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
      if (of_link_[i] != kNone) continue;
      of_link_[i] = frames_++;
      add("frame root {}\n", line_of(robot_.links[i].name));
    }
    first_joint_ = frames_;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      Joint joint = robot_.joints[j];
      if (joint.type == JointType::Continuous) joint.lower = -kEver, joint.upper = kEver;
      if (!rest.empty()) joint.lower = joint.upper = rest[j];
      add(joint, continues_row(robot_, j) ? frames_ - 1 : of_link_[joint.parent]);
    }
  }

  std::size_t frame_of_joint(std::size_t joint) const { return first_joint_ + joint; }

  /// Writes the body, which the link moves, if it is not there yet.
  std::size_t number_of(const CertifiedBody& body, std::size_t link) {
    const auto [found, is_new] = numbers_.try_emplace({body.name, link}, numbers_.size());
    if (is_new) add(body, of_link_[link]);
    return found->second;
  }

  /// How its rows place the joints that it names.
  void add(const JointPath& path) {
    const PathRows& rows = path.rows();
    add("path {} {} ", rows.positions.size(), path.joints().size());
    for (const std::size_t joint : path.joints()) add(" {}", frame_of_joint(joint));
    for (std::size_t row = 0; row < rows.positions.size(); ++row) {
      const auto has = [&](const auto& values) { return !values.empty() && !values[row].empty(); };
      const int derivatives = has(rows.accelerations) ? 2 : has(rows.velocities) ? 1 : 0;
      add("\n{} {} ", rows.times.empty() ? static_cast<double>(row) : rows.times[row], derivatives);
      for (std::size_t k = 0; k < path.joints().size(); ++k) {
        add(" {}", rows.positions[row][k]);
        if (derivatives > 0) add(" {}", rows.velocities[row][k]);
        if (derivatives > 1) add(" {}", rows.accelerations[row][k]);
      }
    }
    add("\n");
  }

  template <typename... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  MotionCertificate finished(std::size_t pairs) && { return {std::move(text_) + "end\n", pairs}; }

 private:
  static constexpr double kEver = std::numeric_limits<double>::infinity();

  void add(const Joint& joint, std::size_t parent) {
    const char* const kind = joint.type == JointType::Fixed ? "fixed"
                             : turns(joint)                 ? "turns"
                             : slides(joint)                ? "slides"
                                                            : "loose";
    add("frame {} {}  {}", kind, parent, text_of(joint.origin));
    if (moves(joint)) add("  {}  {}  {} {} ", text_of(joint.anchor), text_of(joint.axis), joint.lower, joint.upper);
    if (moves(joint) && joint.mimic)
      add("{} {} {}", frame_of_joint(joint.mimic->joint), joint.mimic->multiplier, joint.mimic->offset);
    else if (moves(joint))
      add("free");
    add(" {}\n", line_of(joint.name));
    of_link_[joint.child] = frames_++;
  }

  void add(const CertifiedBody& body, std::size_t frame) {
    if (body.in_link != Pose{}) {
      add("frame fixed {}  {} {}\n", frame, text_of(body.in_link), line_of(body.name));
      frame = frames_++;
    }
    add("body {} {}\n", frame, line_of(body.name));
    if (!body.stl.empty()) return add("stl {}\n", body.stl.generic_string());
    const TriangleMesh& mesh = body.triangles;
    add("triangles {} {}\n", mesh.positions.size(), mesh.face_count());
    for (const Vec3& p : mesh.positions) add("{}\n", text_of(is_finite(p) ? p : Vec3()));
    for (const auto& [a, b, c] : mesh.triangles) add("{} {} {}\n", index(a), index(b), index(c));
  }

  const Robot robot_;
  std::string text_ = "prohull-motion 1\n";
  std::vector<std::size_t> of_link_;
  std::map<std::pair<std::string, std::size_t>, std::size_t> numbers_;  // of bodies by their names and links
  std::size_t frames_ = 0, first_joint_ = 0;
};

/// A freedom for each letter.
bool is_written(const CellTree& tree, std::size_t freedoms) { return !tree.empty() && freedoms <= kLetters; }

/// Whether it is a binary STL file with the triangles of the body, and no others, whose name fits into a line.
bool is_whole(const PathBody& body) {
  const std::string name = body.file.string();
  if (body.file.extension() != ".stl" || std::ranges::any_of(name, [](unsigned char c) { return c < ' '; }))
    return false;
  std::error_code error;
  if (std::filesystem::file_size(body.file, error) != 84 + 50 * body.triangles.face_count() || error) return false;
  return has_triangles_of(placed(body.in_link, read_mesh(body.file)), body.triangles);
}

}  // namespace

std::vector<CertifiedBody> certified_bodies(std::span<const PathBody> bodies, const std::filesystem::path& folder) {
  std::vector<CertifiedBody> certified;
  for (const PathBody& body : bodies) {
    certified.push_back({.name = body.name, .link = body.link});
    if (is_whole(body))
      certified.back().stl = std::filesystem::proximate(body.file, folder), certified.back().in_link = body.in_link;
    else
      certified.back().triangles = body.triangles;
  }
  return certified;
}

MotionCertificate pairs_certificate(const Robot& robot, std::span<const std::optional<CertifiedBody>> bodies,
                                    std::span<const PairProof> proofs) {
  Writer writer(robot);
  std::size_t pairs = 0;
  for (const PairProof& proof : proofs) {
    if (!is_written(proof.tree, proof.freedoms.size())) continue;
    const std::size_t a = writer.number_of(*bodies[proof.a], proof.a), b = writer.number_of(*bodies[proof.b], proof.b);
    writer.add("pair {} {} {}", a, b, proof.freedoms.size());
    for (std::size_t f = 0; f < proof.freedoms.size(); ++f)
      writer.add("  {} {} {}", writer.frame_of_joint(proof.freedoms[f]), proof.ranges[f].lower, proof.ranges[f].upper);
    writer.add("{}", text_of(proof.tree)), ++pairs;
  }
  return std::move(writer).finished(pairs);
}

MotionCertificate path_certificate(const Robot& robot, const JointPath& path, double gap,
                                   std::span<const CertifiedBody> bodies, const PathProof& proof) {
  Writer writer(moved_by(robot, path), path.positions_at(0));
  std::size_t pairs = 0;
  if (gap > 0) writer.add("gap {}\n", gap);
  writer.add(path);
  for (const PathPairProof& pair : proof.pairs) {
    if (!is_written(pair.tree, 1)) continue;
    // The world stands still in the frame of the root on which the first body hangs.
    const CertifiedBody &a = bodies[pair.a], &b = bodies[pair.b];
    const std::size_t of_a = writer.number_of(a, *a.link),
                      of_b = writer.number_of(b, b.link ? *b.link : root_of(robot, *a.link));
    writer.add("pair {} {}{}", of_a, of_b, text_of(pair.tree)), ++pairs;
  }
  return std::move(writer).finished(pairs);
}

}  // namespace prohull::robot
