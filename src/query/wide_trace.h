#pragma once

#include <span>
#include <string_view>

#include "query/engine.h"
#include "query/wide_line.h"

namespace prohull {

/// The way of a line through a tree, compiled for one set of instructions.
struct WideTrace {
  std::string_view instructions;
  /// Offers every face that the line may cross up to hits.limit(), nearer boxes first, until hits are complete.
  void (*trace)(const WideBvh& tree, const DirectedLine& line, HitCollector& hits);
};

/// Those that this processor has, the fastest last. All offer the same faces in the same order.
std::span<const WideTrace> wide_traces();

}  // namespace prohull
