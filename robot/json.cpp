#include "robot/json.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "prohull/detail/verdict_parts.h"
#include "prohull/error.h"

namespace prohull {
namespace {

nlohmann::json json_of(bool value) { return value; }
nlohmann::json json_of(std::size_t value) { return value; }
nlohmann::json json_of(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }
nlohmann::json json_of(std::string_view text) { return std::string(text); }
nlohmann::json json_of(const DistanceBounds& bounds) { return facts(bounds); }

template <class Value>
nlohmann::json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : nlohmann::json();
}

}  // namespace

nlohmann::json parsed_json(std::string_view text, const std::string& file) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(Defect::Malformed, fmt::format("{}: no JSON: {}", file, error.what()));
  }
}

nlohmann::json facts(const Verdict& verdict) {
  nlohmann::json json;
  visit_fields(verdict, [&](const char* name, const auto& value) { json[name] = json_of(value); });
  return json;
}

nlohmann::json facts(const DistanceBounds& bounds) {
  const nlohmann::json farthest = bounds.lower > 0 ? nlohmann::json(bounds.farthest) : nlohmann::json();
  return {{"lower", json_of(bounds.lower)}, {"upper", json_of(bounds.upper)}, {"farthest", farthest}};
}

}  // namespace prohull
