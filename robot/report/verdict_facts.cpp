#include "robot/report/verdict_facts.h"

#include <cmath>
#include <string>

#include "prohull/detail/verdict_parts.h"

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
