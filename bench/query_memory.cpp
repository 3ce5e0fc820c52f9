#include <fmt/format.h>

#include <algorithm>

#include "prohull/file.h"
#include "query_section.h"
#include "table.h"

namespace prohull::bench {
namespace {

struct Facts {
  std::string model, engine;
  std::size_t queries;                              ///< many
  std::size_t index, fresh, after_one, after_many;  ///< bytes

  bool is_constant() const { return fresh == after_one && fresh == after_many; }
};

class MemorySection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions& options) override {
    const ProgressiveHull hull = model.hull_of_table4();
    for (const auto& [name, engine] : {std::pair{"bvh", Engine::Bvh},
                                       {"kdop26", Engine::KDop26},
                                       {"refinement", Engine::Refinement},
                                       {"paper-refinement", Engine::PaperRefinement}}) {
      const QueryIndex index(hull, engine);
      MeshQuery query(index);
      Facts facts{model.name, name, 10 * options.segments, index.memory_bytes(), query.memory_bytes(), 0, 0};
      query.all_hits(model.segments[0]);
      facts.after_one = query.memory_bytes();
      for (std::size_t asked = 1; asked < facts.queries; ++asked)
        query.all_hits(model.segments[asked % model.segments.size()]);
      facts.after_many = query.memory_bytes();
      facts_.push_back(std::move(facts));
    }
  }

  std::string text() const override {
    Table table({"model", "engine", "index", "query object", "after 1 query", "after many", "many"});
    for (const Facts& f : facts_)
      table.add({f.model, f.engine, fmt::format("{:.1f} MB", static_cast<double>(f.index) / 1e6),
                 fmt::format("{} bytes", f.fresh), fmt::format("{} bytes", f.after_one),
                 fmt::format("{} bytes", f.after_many), fmt::to_string(f.queries)});
    return "## Memory of an index, and of a query object before and after queries\n\n" + table.markdown();
  }

  void write(const std::filesystem::path& folder) const override {
    Table table(
        {"mesh", "engine", "index_bytes", "query_bytes", "query_bytes_after_1", "queries", "query_bytes_after"});
    for (const Facts& f : facts_)
      table.add({f.model, f.engine, fmt::to_string(f.index), fmt::to_string(f.fresh), fmt::to_string(f.after_one),
                 fmt::to_string(f.queries), fmt::to_string(f.after_many)});
    write_file(folder / "query_memory.csv", table.csv());
  }

  bool holds() const override { return std::ranges::all_of(facts_, &Facts::is_constant); }

 private:
  std::vector<Facts> facts_;
};

}  // namespace

std::unique_ptr<QuerySection> make_memory_section() { return std::make_unique<MemorySection>(); }

}  // namespace prohull::bench
