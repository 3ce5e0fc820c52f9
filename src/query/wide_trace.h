#pragma once

#include <span>
#include <string_view>

#include "query/closest.h"
#include "query/engine.h"
#include "query/wide_line.h"

namespace prohull {

/// The ways of lines and points through a tree that is not empty, compiled for one set of instructions.
struct WideTrace {
  std::string_view instructions;
  /// Offers every face that the line may cross up to hits.limit(), nearer boxes first, until hits are complete.
  void (*trace)(const WideBvh& tree, const DirectedLine& line, HitCollector& hits);
  /// Offers every face of which the box may be as near to the point as closest.limit(), those of nearer boxes first.
  void (*trace_nearest)(const WideBvh& tree, ClosestCollector& closest);
};

/// Those that this processor has, the fastest last. All offer the same faces in the same order.
std::span<const WideTrace> wide_traces();

}  // namespace prohull
