#include <fmt/format.h>

#include "prohull/hull_builder.h"
#include "prohull/text.h"

namespace prohull {

std::string listed(const RefusalCounts& counts) {
  std::string text;
  for (std::size_t i = 0; i < kRefusalKinds; ++i)
    if (const std::size_t count = counts[Refusal(i)])
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name(Refusal(i)), grouped(count));
  return text;
}

}  // namespace prohull
