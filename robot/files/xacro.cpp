#include "robot/files/xacro.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "prohull/detail/run_program.h"
#include "prohull/error.h"

namespace prohull::robot {
namespace {

constexpr std::size_t kMostOutput = std::size_t{1} << 28;  // bytes
constexpr std::size_t kMostErrors = 2000;                  // bytes of them in messages

bool has_macro(const XmlElement& element) {
  const auto is_macro = [](const auto& attribute) {
    return attribute.second.find("${") != std::string::npos || attribute.second.find("$(") != std::string::npos;
  };
  return element.name.starts_with("xacro:") || std::ranges::any_of(element.attributes, is_macro) ||
         std::ranges::any_of(element.children, [](const XmlElement* child) { return has_macro(*child); });
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(Defect::Malformed, fmt::format("{}: {}", file.string(), why));
}

std::string trimmed(std::string text) {
  if (text.size() > kMostErrors) text = "..." + text.substr(text.size() - kMostErrors);
  text.resize(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

}  // namespace

/// The manifest of a package and a launch file have substitutions of their own.
bool is_xacro(const XmlDocument& document) {
  const std::string& root = document.root().name;
  return root != "package" && root != "launch" && has_macro(document.root());
}

void refuse_xacro(const std::filesystem::path& file) {
  throw InputError(Defect::UnknownFormat,
                   fmt::format("{0}: this is xacro, macros for URDF, and the program xacro is not installed; install "
                               "it (ros-<distro>-xacro, or pip install xacro), or expand the file elsewhere: "
                               "xacro {0} > robot.urdf",
                               file.string()));
}

std::string expanded_by_xacro(const std::filesystem::path& file, std::chrono::seconds time) {
  using End = ProgramResult::End;
  const std::string argument = file.string().starts_with('-') ? "./" + file.string() : file.string();
  ProgramResult result = run_program("xacro", {argument}, "", {time, kMostOutput, kMostOutput}, {});
  const bool was_started = result.end != End::NotStarted,
             has_ended = result.end == End::Exited || result.end == End::Signalled;
  if (!was_started && result.number == ENOENT) refuse_xacro(file);
  if (!was_started)
    refuse(file, fmt::format("the program xacro could not be started: {}", std::strerror(result.number)));
  if (result.end == End::TimedOut)
    refuse(file, fmt::format("xacro was stopped after {} s; expand the file by hand: xacro {} > robot.urdf",
                             time.count(), file.string()));
  if (result.end == End::TooMuchOutput) refuse(file, "xacro was stopped: its output is too large for a robot");
  if (has_ended && result.number != 0)
    refuse(file, fmt::format("xacro failed; if the file needs arguments, expand it by hand: xacro {} NAME:=VALUE > "
                             "robot.urdf. xacro says: {}",
                             file.string(), trimmed(result.errors)));
  return std::move(result.output);
}

}  // namespace prohull::robot
