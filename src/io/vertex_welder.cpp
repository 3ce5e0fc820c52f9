#include "io/vertex_welder.h"

#include <algorithm>
#include <bit>

namespace prohull {
namespace {

/// The finalizer of SplitMix64 after each coordinate.
std::uint64_t hash(const Vec3& position) {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis) {
    h += std::bit_cast<std::uint64_t>(position[axis] + 0.0) + 0x9E3779B97F4A7C15;  // + 0.0 turns -0.0 into 0.0
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EB;
    h ^= h >> 31;
  }
  return h;
}

}  // namespace

std::uint32_t& VertexWelder::find(const Vec3& position) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash(position) & mask;
  while (slots_[i] != kEmpty && positions_[VertexId(slots_[i])] != position) i = (i + 1) & mask;
  return slots_[i];
}

void VertexWelder::grow() {
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), kEmpty);
  for (const VertexId v : positions_.ids()) find(positions_[v]) = index(v);
}

}  // namespace prohull
