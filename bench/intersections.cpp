#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "cgal_self_intersections.h"
#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosure.h"
#include "prohull/tight_hull.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Do hulls intersect themselves where their mesh does not? Counted by CGAL, which shares no code with the construction.

struct IntersectionsOptions {
  ModelOptions models{.folder = {}, .samples = {"asteroid", "bracket", "gyroid", "pony"}, .sample_faces = 10000};
  std::vector<std::size_t> hull_faces{2000, 500, 200, 100};
  std::filesystem::path out;
};

struct Kind {
  std::string_view name;
  TriangleMesh (*hull)(const TriangleMesh&, const HullOptions&);
  SelfIntersections intersections;
};

TriangleMesh progressive(const TriangleMesh& mesh, const HullOptions& options) {
  return build_hull(mesh, options).hull.base();
}
TriangleMesh tight(const TriangleMesh& mesh, const HullOptions& options) {
  return build_tight_hull(mesh, options).mesh;
}

constexpr std::array kKinds{Kind{"lazy", progressive, SelfIntersections::Refused},
                            Kind{"tight", tight, SelfIntersections::Refused},
                            Kind{"lazy unguarded", progressive, SelfIntersections::Allowed}};

struct Count {
  std::size_t hull_faces, pairs;
};

/// By model.
struct IntersectionRow {
  std::string name;
  std::size_t faces, pairs;
  std::vector<std::array<Count, kKinds.size()>> of;  ///< by hull_faces

  std::size_t added(std::size_t size, std::size_t kind) const {
    return of[size][kind].pairs - std::min(of[size][kind].pairs, pairs);
  }
};

std::size_t count_pairs(const TriangleMesh& mesh) {
  const auto by_cgal = cgal_self_intersections(mesh);
  return by_cgal ? *by_cgal : count_self_intersections(mesh);
}

std::string_view counted_by() {
  return cgal_self_intersections({}) ? "CGAL's exact predicates" : "our own exact predicates, for want of CGAL";
}

IntersectionRow measure(const ModelSource& source, const IntersectionsOptions& options) {
  const TriangleMesh mesh = load(source);
  fmt::print(stderr, "{}: {} faces", source.name, mesh.face_count());
  IntersectionRow row{source.name, mesh.face_count(), count_pairs(mesh), {}};
  for (const std::size_t faces : options.hull_faces) {
    auto& counts = row.of.emplace_back();
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      const TriangleMesh hull =
          kKinds[kind].hull(mesh, {.target_faces = faces, .self_intersections = kKinds[kind].intersections});
      counts[kind] = {hull.face_count(), count_pairs(hull)};
    }
    fmt::print(stderr, ", {}", faces);
  }
  fmt::print(stderr, "\n");
  return row;
}

bool none_added(const IntersectionRow& row) {
  for (std::size_t size = 0; size < row.of.size(); ++size)
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
      if (kKinds[kind].intersections == SelfIntersections::Refused && row.added(size, kind) > 0) return false;
  return true;
}

std::string cell(const Count& count, std::size_t added, std::size_t asked) {
  std::string text = fmt::to_string(added);
  if (count.pairs > added) text += fmt::format(" (has {})", count.pairs);
  return count.hull_faces > asked ? text + fmt::format(", ends at {}", count.hull_faces) : text;
}

int run_intersections(const IntersectionsOptions& options) {
  std::vector<std::string> columns{"model", "faces", "its own pairs", "hull"};
  for (const Kind& kind : kKinds) columns.push_back(fmt::format("{}: added", kind.name));
  Table table(columns);
  Table csv({"mesh", "faces", "mesh_pairs", "hull", "asked_faces", "hull_faces", "hull_pairs", "added_pairs"});
  bool all_hold = true;
  const std::vector<Refused> refused = measure_each(options.models, [&](const ModelSource& source) {
    const IntersectionRow row = measure(source, options);
    all_hold = all_hold && none_added(row);
    for (std::size_t size = 0; size < row.of.size(); ++size) {
      const std::size_t asked = options.hull_faces[size];
      std::vector<std::string> cells{row.name, fmt::to_string(row.faces), fmt::to_string(row.pairs),
                                     fmt::to_string(asked)};
      for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
        const Count& count = row.of[size][kind];
        cells.push_back(cell(count, row.added(size, kind), asked));
        csv.add({row.name, fmt::to_string(row.faces), fmt::to_string(row.pairs), std::string(kKinds[kind].name),
                 fmt::to_string(asked), fmt::to_string(count.hull_faces), fmt::to_string(count.pairs),
                 fmt::to_string(row.added(size, kind))});
      }
      table.add(std::move(cells));
    }
  });
  const std::string text =
      fmt::format("# Pairs of intersecting faces\n\nCounted by {}. Added: more than the mesh itself has. {}.\n\n{}\n{}",
                  counted_by(), all_hold ? "No guarded hull has added any" : "GUARDED HULLS HAVE ADDED SOME",
                  table.markdown(), listed(refused));
  publish(options.out, "intersections", text, csv.csv());
  return all_hold ? kDone : kAnswerIsNo;
}

}  // namespace

void add_intersections(CLI::App& app, Run& run) {
  const auto options = std::make_shared<IntersectionsOptions>();
  CLI::App& command =
      *app.add_subcommand("intersections", "Pairs of intersecting faces that hulls add; exits with 1 if there are any");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  add_out_option(command, options->out, "intersections.md and intersections.csv");
  command.callback([options, &run] { run = [options] { return run_intersections(*options); }; });
}

}  // namespace prohull::bench
