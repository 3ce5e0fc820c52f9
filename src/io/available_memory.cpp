#include "io/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "prohull/detail/memory.h"

namespace prohull {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// The number that follows a word in a file, such as "MemAvailable:".
std::optional<std::size_t> number_after(const std::filesystem::path& file, const std::string& word) {
  std::ifstream in(file);
  for (std::string found; in >> found;)
    if (found == word) {
      std::size_t number = 0;
      return in >> number ? std::optional(number) : std::nullopt;
    }
  return {};
}

std::optional<std::size_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t number = 0;
  return in >> number ? std::optional(number) : std::nullopt;  // "max" is no number
}

/// What a control group has left; what it only keeps of files would be given up.
std::size_t left_in(const std::filesystem::path& group, const char* limit, const char* usage, const char* of_files) {
  const auto most = number_in(group / limit), used = number_in(group / usage);
  if (!most || !used) return kUnlimited;
  const std::size_t held = *used - std::min(*used, number_after(group / "memory.stat", of_files).value_or(0));
  return *most - std::min(*most, held);
}

/// A group may use no more than the groups that it is in.
std::size_t left_in_groups(const std::filesystem::path& mount, const std::filesystem::path& group, const char* limit,
                           const char* usage, const char* of_files) {
  std::size_t least = kUnlimited;
  for (std::filesystem::path at = group.relative_path();; at = at.parent_path()) {
    least = std::min(least, left_in(mount / at, limit, usage, of_files));
    if (at.empty()) return least;
  }
}

std::size_t left_in_groups(const std::filesystem::path& root) {
  const std::filesystem::path mount = root / "sys/fs/cgroup";
  std::size_t least = kUnlimited;
  std::ifstream groups(root / "proc/self/cgroup");  // "0::/a/b" of version 2, "4:memory:/a/b" of version 1
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controller = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (controller.empty())
      least = std::min(least, left_in_groups(mount, group, "memory.max", "memory.current", "inactive_file"));
    else if (controller == "memory")
      least = std::min(least, left_in_groups(mount / "memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                             "total_inactive_file"));
  }
  return least;
}

}  // namespace

std::optional<std::size_t> available_memory(const std::filesystem::path& root) {
  const auto kibibytes = number_after(root / "proc/meminfo", "MemAvailable:");
  const std::size_t left = left_in_groups(root);
  if (!kibibytes) return left == kUnlimited ? std::nullopt : std::optional(left);
  return std::min(left, 1024 * *kibibytes);
}

std::optional<std::size_t> available_memory() { return available_memory("/"); }

}  // namespace prohull
