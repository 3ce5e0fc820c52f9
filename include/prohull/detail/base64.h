#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace prohull {

/// Bytes as the text of RFC 4648, padded, in one line: what a data URL takes.
std::string to_base64(std::string_view bytes);

/// The bytes of such a text, whose padding is optional; empty if `text` is none.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace prohull
