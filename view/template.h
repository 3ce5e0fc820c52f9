#pragma once

#include <span>
#include <string_view>

namespace prohull::view {

/// The page without its scene, in parts; none if it was not built. kScenePlace stands where the scene belongs.
std::span<const std::string_view> page_template();
constexpr std::string_view kScenePlace = "<!--scene-->";

}  // namespace prohull::view
