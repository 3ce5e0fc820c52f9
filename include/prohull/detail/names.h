#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace prohull {

/// The values of an enumeration with their names, as the command line, Python and reports spell them. Each enumeration
/// that users choose from, or read in reports, has such a list beside it: strategy_names(), hull_side_names() and so
/// on.
template <class Value>
using Names = std::span<const std::pair<std::string_view, Value>>;

/// The name of a value. The list must contain the value.
template <class Value>
constexpr std::string_view name_of(Names<Value> names, std::type_identity_t<Value> value) {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return {};
}

/// The value with this name, if there is one.
template <class Value>
constexpr std::optional<Value> value_of(Names<Value> names, std::string_view text) {
  for (const auto& [name, value] : names)
    if (name == text) return value;
  return std::nullopt;
}

/// All names in their order, for messages: "lazy, paper1, paper2".
template <class Value>
std::string joined(Names<Value> names) {
  std::string text;
  for (const auto& [name, value] : names) (text += text.empty() ? "" : ", ") += name;
  return text;
}

}  // namespace prohull
