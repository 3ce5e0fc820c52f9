#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace prohull {

/// RFC 4648, the padding at the end optional; empty if `text` is none.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace prohull
