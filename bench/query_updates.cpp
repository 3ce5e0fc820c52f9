#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "io/file.h"
#include "query_section.h"
#include "table.h"

namespace prohull::bench {
namespace {

// P&T 3.2.2: does it pay to keep the refined hull from one query to the next?

struct NamedUpdate {
  std::string_view name;
  RefinementOptions options;
};
constexpr std::array kUpdates{
    NamedUpdate{"roll back", {BetweenQueries::RollBack, 1}},
    NamedUpdate{"roll back every 2", {BetweenQueries::RollBack, 2}},
    NamedUpdate{"roll back every 10", {BetweenQueries::RollBack, 10}},
    NamedUpdate{"roll back every 100", {BetweenQueries::RollBack, 100}},
    NamedUpdate{"coarsen", {BetweenQueries::Coarsen, 1}},
};

struct UpdateBatch {
  std::string name;
  std::vector<Segment> segments;
};

/// Through the pixels of a picture of the mesh, row by row.
UpdateBatch picture(const Box& box, std::size_t count) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  const double size = box.diagonal();
  const Vec3 forward = Vec3{-0.48, -0.36, -0.8}, right{0.6, -0.8, 0}, up = cross(right, forward);
  const Vec3 eye = box.center() - 1.5 * size * forward;
  UpdateBatch batch{"picture", {}};
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column) {
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(side) - 0.5,
                   y = 0.5 - (static_cast<double>(row) + 0.5) / static_cast<double>(side);
      const Vec3 pixel = box.center() + size * (x * right + y * up);
      batch.segments.push_back({eye, eye + 2 * (pixel - eye)});
    }
  return batch;
}

/// Short segments through the surface, where segments to the centre from a spiral around the mesh meet it first.
UpdateBatch sweep(const TriangleMesh& mesh, std::size_t count) {
  const Box box = bounding_box(mesh);
  MeshQuery query{QueryIndex(mesh)};
  UpdateBatch batch{"sweep", {}};
  for (std::size_t i = 0; i < count; ++i) {
    constexpr double kTurns = 10;
    const double done = (static_cast<double>(i) + 0.5) / static_cast<double>(count),
                 angle = 2 * std::numbers::pi * kTurns * done, height = 2 * done - 1,
                 radius = std::sqrt(1 - height * height);
    const Vec3 outwards{radius * std::cos(angle), radius * std::sin(angle), height};
    const auto hit = query.first_hit(Segment{box.center() + box.diagonal() * outwards, box.center()});
    constexpr double kHalfLength = 0.01;  // of the diagonal
    const Vec3 half = kHalfLength * box.diagonal() * outwards;
    if (hit) batch.segments.push_back({hit->position + half, hit->position - half});
  }
  return batch;
}

struct UpdateFacts {
  std::string model, batch;
  std::string_view update;
  double microseconds = 0, tests = 0, splits = 0, coarsenings = 0;  ///< per query
};

class UpdatesSection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions& options) override {
    const ProgressiveHull hull = model.hull_of_table4();
    for (const UpdateBatch& batch :
         {UpdateBatch{"random", model.segments}, picture(bounding_box(model.mesh), model.segments.size()),
          sweep(model.mesh, model.segments.size())})
      measure_batch(model.name, hull, batch, options.rounds);
  }

  std::string text() const override {
    Table table({"model", "batch", "between queries", "time", "/ roll back", "tests", "splits", "coarsenings"});
    double roll_back = 0;
    for (const UpdateFacts& f : facts_) {
      if (f.update == kUpdates[0].name) roll_back = f.microseconds;
      table.add({f.model, f.batch, std::string(f.update), number(f.microseconds, 2, " us"),
                 number(f.microseconds / roll_back, 2), number(f.tests, 1), number(f.splits, 1),
                 number(f.coarsenings, 1)});
    }
    return fmt::format(
        "## 3.2.2: what becomes of the refined hull between queries\n\n"
        "Per query, all crossings, refined as published, the hull of Table 4. random: the segments of Table "
        "3;\npicture: through neighbouring pixels; sweep: short segments along the surface.\n\n{}",
        table.markdown());
  }

  void write(const std::filesystem::path& folder) const override {
    Table table({"mesh", "batch", "between_queries", "us_per_query", "tests", "splits", "coarsenings"});
    for (const UpdateFacts& f : facts_)
      table.add({f.model, f.batch, std::string(f.update), number(f.microseconds, 3), number(f.tests, 2),
                 number(f.splits, 2), number(f.coarsenings, 2)});
    write_file(folder / "updates.csv", table.csv());
  }

 private:
  void measure_batch(const std::string& model, const ProgressiveHull& hull, const UpdateBatch& batch,
                     std::size_t rounds) {
    std::vector<QueryIndex> indices;
    for (const NamedUpdate& update : kUpdates)
      indices.push_back(prohull::index_called("paper-refinement", hull, update.options));
    std::vector<QueryCounts> counts(kUpdates.size());
    std::vector<std::function<void()>> runs;
    for (std::size_t i = 0; i < kUpdates.size(); ++i)
      runs.emplace_back([&, i] {
        MeshQuery query(indices[i]);
        ask_all(query, batch.segments);
        counts[i] = query.counts();
      });
    const auto seconds = best_seconds(rounds, runs);
    const auto queries = static_cast<double>(batch.segments.size());
    for (std::size_t i = 0; i < kUpdates.size(); ++i)
      facts_.push_back({model, batch.name, kUpdates[i].name, 1e6 * seconds[i] / queries,
                        static_cast<double>(counts[i].tests) / queries, static_cast<double>(counts[i].splits) / queries,
                        static_cast<double>(counts[i].coarsenings) / queries});
  }

  std::vector<UpdateFacts> facts_;
};

}  // namespace

std::unique_ptr<QuerySection> make_updates_section() { return std::make_unique<UpdatesSection>(); }

}  // namespace prohull::bench
