#include "query/coherent_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/morton_code.h"

namespace prohull {
namespace {

constexpr std::uint32_t kDigitsOfKey = 1 << 12;

/// Moves `from` to `to` in the order of twelve bits of their keys, without changing that of equal ones.
void sort_by_digit(std::span<const std::uint32_t> keys, int shift, std::span<const std::uint32_t> from,
                   std::span<std::uint32_t> to) {
  std::array<std::uint32_t, kDigitsOfKey> place{};
  const auto digit = [&](std::uint32_t i) { return keys[i] >> shift & (kDigitsOfKey - 1); };
  for (const std::uint32_t i : from) ++place[digit(i)];
  std::exclusive_scan(place.begin(), place.end(), place.begin(), 0u);
  for (const std::uint32_t i : from) to[place[digit(i)]++] = i;
}

}  // namespace

std::uint32_t departure_key(const Departure& departure, const Box& box) {
  const Vec3 center = box.center(), half = box.max * 0.5 - box.min * 0.5, p = departure.start - center;
  const double size = std::max({half.x, half.y, half.z, 1e-300});
  const Vec3& d = departure.direction;
  const double length = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z), 1e-300});
  const auto code = [](const Vec3& v, double scale) {
    return morton_code(static_cast<float>(v.x / scale), static_cast<float>(v.y / scale),
                       static_cast<float>(v.z / scale));
  };
  return code(p, size) >> 12 << 6 | code(d, length) >> 24;
}

std::vector<std::uint32_t> order_of_keys(std::span<const std::uint32_t> keys) {
  std::vector<std::uint32_t> order(keys.size()), half_sorted(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  sort_by_digit(keys, 0, order, half_sorted);
  sort_by_digit(keys, 12, half_sorted, order);
  return order;
}

}  // namespace prohull
