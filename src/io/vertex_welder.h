#pragma once

#include <cstdint>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Finds equal positions: -0.0 equals 0.0, otherwise what differs in one bit stays apart; no tolerance.
class VertexWelder {
 public:
  /// Numbers index `positions`, which must outlive the welder and grow by nothing but what it finds to be new.
  explicit VertexWelder(const PerVertex<Vec3>& positions) : positions_(positions) {}

  /// The number of the position equal to `position`; if there is none yet, the number of positions, and the caller must
  /// append it before the next call.
  std::uint32_t number_of(const Vec3& position) {
    if (2 * (positions_.size() + 1) > slots_.size()) grow();
    std::uint32_t& slot = find(position);
    if (slot == kEmpty) slot = index(positions_.next_id());
    return slot;
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFF;

  std::uint32_t& find(const Vec3& position);
  void grow();

  const PerVertex<Vec3>& positions_;
  std::vector<std::uint32_t> slots_;  ///< open addressing; a power of two, at most half full
};

}  // namespace prohull
