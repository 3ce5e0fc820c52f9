#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// Where a query starts, and in which direction it goes; a point or triangle goes nowhere.
struct Departure {
  Vec3 start, direction;
};
inline Departure departure(const Segment& s) { return {s.a, s.b * 0.5 - s.a * 0.5}; }  // which does not overflow
inline Departure departure(const Ray& r) { return {r.origin, r.direction}; }
inline Departure departure(const Triangle& t) { return {t.a, {}}; }
inline Departure departure(const Vec3& p) { return {p, {}}; }

/// 24 bits along a Morton curve through the box, six for each axis of the start, two for each of the direction.
std::uint32_t departure_key(const Departure& departure, const Box& box);

/// The numbers of the keys, in their order; those of equal keys ascend.
std::vector<std::uint32_t> order_of_keys(std::span<const std::uint32_t> keys);

/// An order in which queries that follow each other take like ways through a tree over what lies in the box, so that
/// they find it in the cache; empty if they had better be asked as they come. Sorting costs some 40 ns a query. It pays
/// for queries that start within the box, which go deep, unless those that follow each other start together already:
/// for the ambient occlusion of points at random, for closest points (docs/performance.md).
template <class Primitive>
std::vector<std::uint32_t> coherent_order(std::span<const Primitive> primitives, const Box& box) {
  constexpr std::size_t kFewest = 4096, kSamples = 256;
  constexpr int kCoarse = 9;  // bits of a key that do not count: starts in one of 32 cells along each axis are together
  if (primitives.size() < kFewest || primitives.size() > 0xffffffff) return {};
  const auto key = [&](std::size_t i) { return departure_key(departure(primitives[i]), box); };
  std::size_t within = 0, together = 0;
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    const std::size_t i = sample * (primitives.size() / kSamples);
    const Vec3 p = departure(primitives[i]).start;
    within += box.overlaps({p, p});
    together += key(i) >> kCoarse == key(i + 1) >> kCoarse;
  }
  if (within < kSamples / 2 || together > kSamples / 2) return {};
  std::vector<std::uint32_t> keys(primitives.size());
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = key(i);
  return order_of_keys(keys);
}

}  // namespace prohull
