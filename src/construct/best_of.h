#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

#include "parallel/arena.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"

namespace prohull {

/// What `build(options)` gives for options.best_of seeds from options.seed on, each on one thread: the one that comes
/// closest to the target, of those that of the least void, of those that of the least seed.
/// `mesh_of(result)` is the hull.
template <class Build, class MeshOf>
auto best_of(const HullOptions& options, Build build, MeshOf mesh_of) {
  using Result = decltype(build(options));
  struct Candidate {
    std::size_t faces;
    double void_volume;
    Result result;
  };
  std::vector<std::optional<Candidate>> candidates(options.best_of);
  std::atomic<bool> cancelled = false;
  const auto caller = std::this_thread::get_id();
  const auto progress = [&](const HullProgress& p) {
    if (!cancelled && options.progress && std::this_thread::get_id() == caller && !options.progress(p))
      cancelled = true;
    return !cancelled;
  };
  arena_of(options.threads).execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
      if (cancelled && i > 0) return;
      HullOptions one = options;
      one.best_of = 1;
      one.threads = 1;
      one.seed = options.seed + i;
      one.progress = progress;
      Result result = build(one);
      const TriangleMesh& mesh = mesh_of(result);
      const double volume = inspect(mesh).volume;
      candidates[i] = {mesh.face_count(), options.side == HullSide::Outer ? volume : -volume, std::move(result)};
    });
  });
  const auto best = std::ranges::min_element(candidates, {}, [&](const std::optional<Candidate>& c) {
    constexpr auto kNone = std::numeric_limits<std::size_t>::max();
    return c ? std::tuple(std::max(c->faces, options.target_faces), c->void_volume) : std::tuple(kNone, 0.0);
  });
  return std::move((*best)->result);
}

}  // namespace prohull
