#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "prohull/detail/shapes.h"
#include "prohull/enclosure.h"
#include "prohull/verdict.h"

// What stands the same way in all reports, and on pages.
namespace prohull {

inline void to_json(nlohmann::json& json, const Vec3& p) { json = {p.x, p.y, p.z}; }

inline void to_json(nlohmann::json& json, const Ball& ball) {
  json = {{"center", ball.center}, {"radius", ball.radius}};
}

inline void to_json(nlohmann::json& json, const Offender& o) {
  json = {{"face", index(o.face)}, {"point", o.point}, {"distance", o.distance}};
}

/// facts(x) of each x, as a list.
template <class Range, class Facts>
nlohmann::json json_list(const Range& range, Facts facts) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& each : range) list.push_back(std::invoke(facts, each));
  return list;
}

/// Throws InputError(Malformed) with `file`.
nlohmann::json parsed_json(std::string_view text, const std::string& file);

/// The verdict as all reports have it.
nlohmann::json facts(const Verdict& verdict);
nlohmann::json facts(const DistanceBounds& bounds);  ///< `farthest` is null where no point is known to be away

}  // namespace prohull
