#pragma once

#include <string>
#include <string_view>

namespace prohull::robot {

/// &, <, > and quotes as HTML shows them; what is no UTF-8, and control characters, as U+FFFD.
std::string html_escaped(std::string_view text);

/// The style sheet of the page: light, dark, narrow and printed.
std::string_view page_style();

}  // namespace prohull::robot
