#include "io/vertex_welder.h"

#include <algorithm>
#include <bit>

#include "prohull/detail/scramble.h"

namespace prohull {
namespace {

std::uint64_t hash(const Vec3& position) {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis)
    h = scramble(h + std::bit_cast<std::uint64_t>(position[axis] + 0.0));  // + 0.0 turns -0.0 into 0.0
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
