#include "view/template.h"

namespace prohull::view {

std::span<const std::string_view> page_template() { return {}; }

}  // namespace prohull::view
