#include "render/color.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace prohull::render {
namespace {

struct NamedColor {
  std::string_view name, hex;
};

constexpr std::array kNamed{NamedColor{"black", "#20242a"}, NamedColor{"blue", "#7db4ea"},
                            NamedColor{"clay", "#e9c3a0"},  NamedColor{"green", "#3fae67"},
                            NamedColor{"grey", "#d9d6d1"},  NamedColor{"orange", "#f09a4e"},
                            NamedColor{"red", "#d4483b"},   NamedColor{"white", "#ffffff"}};

std::optional<Rgb> parse_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t bits = 0;
  const char* const end = text.data() + text.size();
  if (std::from_chars(text.data() + 1, end, bits, 16).ptr != end) return std::nullopt;
  const auto channel = [&](int shift) { return linear_of_srgb(static_cast<float>(bits >> shift & 0xff) / 255); };
  return Rgb{channel(16), channel(8), channel(0)};
}

}  // namespace

// IEC 61966-2-1.
float linear_of_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgb_of_linear(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

std::optional<Rgb> parse_color(std::string_view text) {
  for (const NamedColor& named : kNamed)
    if (named.name == text) return parse_hex(named.hex);
  return parse_hex(text);
}

std::string_view color_names() { return "black, blue, clay, green, grey, orange, red, white"; }

}  // namespace prohull::render
