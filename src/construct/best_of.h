#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "parallel/arena.h"
#include "parallel/beside.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"

namespace prohull {

/// What `build(options)` gives for options.best_of seeds from options.seed on, each on one thread: the one that comes
/// closest to the target, of those that of the least void, of those that of the least seed.
/// `mesh_of(result)` is the hull; `stage` is that of the progress.
template <class Build, class MeshOf>
auto best_of(const HullOptions& options, const char* stage, Build build, MeshOf mesh_of) {
  using Result = decltype(build(options));
  struct Candidate {
    std::size_t faces;
    double void_volume;
    Result result;
  };
  std::vector<std::optional<Candidate>> candidates(options.best_of);
  std::vector<std::atomic<double>> done(options.best_of);
  ProgressMeter meter(options.progress, stage);
  const auto build_all = [&] {
    arena_of(options.threads).execute([&] {
      oneapi::tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        HullOptions one = options;
        one.best_of = 1;
        one.threads = 1;
        one.seed = options.seed + i;
        one.progress = [&, i](std::string_view, double fraction) {
          done[i] = fraction;
          meter.at(0);  // throws if the caller has cancelled
          return true;
        };
        Result result = build(one);
        const TriangleMesh& mesh = mesh_of(result);
        const double volume = inspect(mesh).volume;
        candidates[i] = {mesh.face_count(), options.side == HullSide::Outer ? volume : -volume, std::move(result)};
      });
    });
  };
  // The caller's thread tells the progress until the last build ends.
  const auto tell = [&] {
    meter.at(std::accumulate(done.begin(), done.end(), 0.0) / static_cast<double>(done.size()));
  };
  run_beside(build_all, tell, ProgressMeter::interval);
  meter.at(1);
  const auto best = std::ranges::min_element(candidates, {}, [&](const std::optional<Candidate>& c) {
    return std::tuple(std::max(c->faces, options.target_faces), c->void_volume);
  });
  return std::move((*best)->result);
}

}  // namespace prohull
