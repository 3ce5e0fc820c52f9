#pragma once

#include <array>
#include <string_view>

#include "prohull/hull_builder.h"

namespace prohull::bench {

struct NamedStrategy {
  Strategy strategy;
  std::string_view name;
};
inline constexpr std::array kStrategies{NamedStrategy{Strategy::Paper1, "paper1"},
                                        NamedStrategy{Strategy::Paper2, "paper2"},
                                        NamedStrategy{Strategy::Lazy, "lazy"}};

/// On one thread, as the peers.
inline HullOptions hull_options(Strategy strategy, std::size_t faces, QueueKind queue = QueueKind::Bucket) {
  HullOptions options;
  options.target_faces = faces;
  options.strategy = strategy;
  options.queue = queue;
  options.threads = 1;
  return options;
}

/// volume(level) / volume(original) - 1, in percent (P&T 4.1).
inline double void_percent(const TriangleMesh& level, double original_volume) {
  return 100 * (signed_volume(level) / original_volume - 1);
}

}  // namespace prohull::bench
