#pragma once

#include <fmt/format.h>

#include <cctype>
#include <set>
#include <string>

#include "prohull/detail/extension.h"

namespace prohull::robot {

/// Names of files, distinct also where upper and lower case are the same, of letters, digits and _-. alone. File
/// systems take 255 bytes, which leaves room for what is added.
class FileNames {
 public:
  std::string of(const std::string& wanted, const std::string& suffix = "") {
    std::string name;
    for (const char c : wanted)
      name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' ? c : '_';
    if (name.empty() || name[0] == '.') name.insert(0, 1, '_');
    if (name.size() > kLongest) name.resize(kLongest);
    std::string distinct = name + suffix;
    for (int i = 2; !taken_.insert(lower_case(distinct)).second; ++i)
      distinct = fmt::format("{}_{}{}", name, i, suffix);
    return distinct;
  }

 private:
  static constexpr std::size_t kLongest = 100;

  std::set<std::string> taken_;
};

}  // namespace prohull::robot
