#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string>

#include "prohull/error.h"

namespace prohull::robot {

/// A name as YAML writes a string in double quotes.
inline std::string quoted(const std::string& name) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << name;
  return out.c_str();
}

/// For the reader of one YAML file: its errors, InputError(Malformed), name the file and the line.
class YamlReader {
 public:
  explicit YamlReader(std::string name) : name_(std::move(name)) {}

  /// Calls read(node) with the top of the file.
  template <class Read>
  auto parse(const std::string& text, Read read) const {
    try {
      return read(YAML::Load(text));
    } catch (const YAML::Exception& error) {
      refuse(error.mark, "no YAML: " + error.msg);
    }
  }

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& what) const { refuse(node.Mark(), what); }

  template <class Value>
  Value value(const YAML::Node& node, const std::string& expected) const {
    try {
      return node.as<Value>();
    } catch (const YAML::Exception&) {
      refuse(node, fmt::format("'{}': expected {}", node.IsScalar() ? node.Scalar() : "...", expected));
    }
  }

 private:
  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& what) const {
    throw InputError(Defect::Malformed, fmt::format("{}: line {}: {}", name_, std::max(mark.line, 0) + 1, what));
  }

  const std::string name_;
};

}  // namespace prohull::robot
