#pragma once

#include <nlohmann/json.hpp>

#include "view/blocks.h"
#include "view/page.h"

namespace prohull::view {

/// What a page shows, as web/src/data/objects.js reads it: facts, and the numbers that they point to.
struct Scene {
  nlohmann::json facts;
  Blocks blocks;

  std::string facts_as_text() const { return facts.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); }
};

/// The scene of a page(). Throws InputError as that does.
Scene scene_of(const std::vector<Shown>& shown, const std::optional<Original>& original, const PageOptions& options);

}  // namespace prohull::view
