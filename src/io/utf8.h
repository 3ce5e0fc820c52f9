#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace prohull {

/// The text in UTF-8 if it starts with a byte order mark of UTF-16 and is well formed.
std::optional<std::string> utf8_of_utf16(std::string_view text);

}  // namespace prohull
