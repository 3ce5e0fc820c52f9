#include "robot/motion/poses.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "prohull/error.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

/// None if one of the words is no number.
std::optional<std::vector<double>> numbers_in(std::string_view line) {
  constexpr const char* kBetween = ",; \t\r";
  std::vector<double> numbers;
  for (auto begin = line.find_first_not_of(kBetween); begin != line.npos;) {
    const std::string_view word = line.substr(begin, line.find_first_of(kBetween, begin) - begin);
    double number = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || rest != word.data() + word.size() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    begin = line.find_first_not_of(kBetween, begin + word.size());
  }
  return numbers;
}

bool names_columns(std::string_view row) {
  return row.find_first_of("+-.0123456789") != 0 && row.find_first_of("xyzw") != row.npos;
}

/// Refuses names of columns that put the w of the quaternion last.
void check_order(std::string_view names, const std::string& file) {
  const auto w = names.rfind('w'), z = names.rfind('z');
  if (w != names.npos && z != names.npos && w > z)
    throw InputError(Defect::Malformed,
                     fmt::format("{}: line 1: the w of the quaternion comes last; expected x, y, z, w, x, y, z", file));
}

Pose normalized(const Pose& pose) {
  require_rigid(pose);
  const auto [w, x, y, z] = quaternion_of(pose);
  return pose_of_quaternion(w, x, y, z, pose.translation);
}

/// pose_of, with where it stands in what it throws.
Pose pose_in_line(std::span<const double> numbers, const std::string& file, std::size_t line) {
  const auto fail = [&](const std::string& why) {
    throw InputError(Defect::Malformed, fmt::format("{}: line {}: {}", file, line, why));
  };
  std::optional<Pose> pose;
  try {
    pose = pose_of(numbers);
  } catch (const InputError& error) {
    fail(error.what());
  }
  if (!pose) fail("expected x, y, z and a quaternion w, x, y, z, or the 12 or 16 numbers of a matrix");
  return *pose;
}

RigidMotion motion_between(const Pose& from, const Pose& to) {
  const Pose turn = composed({to.rotation, {}}, inverse({from.rotation, {}}));
  auto [w, x, y, z] = quaternion_of(turn);
  RigidMotion motion{
      .start = from, .through = from.translation, .axis = {x, y, z}, .shift = to.translation - from.translation};
  if (w < 0) motion.axis = -motion.axis;
  const double length = norm(motion.axis);
  motion.angle = 2 * std::atan2(length, std::abs(w));
  if (length > 0) motion.axis = motion.axis / length;
  return motion;
}

}  // namespace

std::optional<Pose> pose_of(std::span<const double> n) {
  if (n.size() == 7) return pose_of_quaternion(n[3], n[4], n[5], n[6], {n[0], n[1], n[2]});
  const bool is_matrix = n.size() == 12 || (n.size() == 16 && n[12] == 0 && n[13] == 0 && n[14] == 0 && n[15] == 1);
  if (!is_matrix) return {};
  return normalized({{Vec3{n[0], n[1], n[2]}, Vec3{n[4], n[5], n[6]}, Vec3{n[8], n[9], n[10]}}, {n[3], n[7], n[11]}});
}

std::vector<Pose> read_poses(std::string_view text, const std::string& file) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<Pose> poses;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto first = row.find_first_not_of(" \t\r");
    if (first == row.npos || row[first] == '#') continue;
    const auto numbers = numbers_in(row);
    if (!numbers && line == 1 && names_columns(row.substr(first))) {
      check_order(row, file);
      continue;
    }
    poses.push_back(pose_in_line(numbers ? *numbers : std::vector<double>{}, file, line));
  }
  if (poses.empty()) throw InputError(Defect::Malformed, fmt::format("{}: there are no poses", file));
  return poses;
}

std::vector<RigidMotion> motions_between(std::span<const Pose> poses) {
  if (poses.size() == 1) return {{.start = poses[0]}};
  std::vector<RigidMotion> motions;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) motions.push_back(motion_between(poses[i], poses[i + 1]));
  return motions;
}

}  // namespace prohull::robot
