#include "io/utf8.h"

#include <iconv.h>

#include <memory>

namespace prohull {

std::optional<std::string> utf8_of_utf16(std::string_view text) {
  if (!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF")) return std::nullopt;
  iconv_t const opened = iconv_open("UTF-8", "UTF-16");
  if (opened == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  const auto close = [](void* converter) { iconv_close(converter); };
  const std::unique_ptr<void, decltype(close)> converter(opened, close);
  std::string copy(text), result(text.size() / 2 * 3, '\0');  // two bytes are at most three
  char *in = copy.data(), *out = result.data();
  std::size_t in_left = copy.size(), out_left = result.size();
  if (iconv(converter.get(), &in, &in_left, &out, &out_left) == static_cast<std::size_t>(-1)) return std::nullopt;
  result.resize(result.size() - out_left);
  return result;
}

}  // namespace prohull
