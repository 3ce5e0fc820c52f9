#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "point_command.h"
#include "prohull/detail/query_io.h"

namespace prohull::cli {
namespace {

const OutputKind kAnswers{"the answers", {".npz", ".csv"}};

PointAnswers ask(const QueryIndex& index, const std::vector<Vec3>& points, const BatchOptions& batch) {
  const std::vector<bool> inside = contains(index, points, batch);
  const auto count = static_cast<std::size_t>(std::ranges::count(inside, true));
  const double share = static_cast<double>(count) / static_cast<double>(points.size());
  return {fmt::format("{} of {} inside ({:.2f} %)", grouped(count), counted(points.size(), "point"), 100 * share),
          {{"inside", count}},
          [inside](const auto& file) { write_inside(file, inside); }};
}

}  // namespace

void add_contains(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<PointOptions>(
      app, run, "contains",
      "Decides which points are inside of a mesh, exactly. A point is inside if the mesh winds around it at least "
      "once, so cavities are outside. A closed mesh that is inside out is turned. Of a mesh that is not closed, the "
      "solid is asked that `prohull repair` makes of "
      "it; one that repairs do not close is refused.",
      [](const PointOptions& chosen) { return run_points(chosen, kAnswers, ask); });
  options.is_about_inside = options.closes = true;
  add_point_options(command, options, kAnswers);
  add_examples(command,
               {"prohull contains horse.ply --random 1e6", "prohull contains part.stl --points p.npy -o in.npz",
                "prohull contains part.stl --points - -o - --out-format csv <points.csv"});
}

}  // namespace prohull::cli
