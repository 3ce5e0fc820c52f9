#include <fmt/format.h>

#include <algorithm>

#include "io/file.h"
#include "query_section.h"
#include "table.h"

namespace prohull::bench {
namespace {

constexpr int kTimes = 10;

struct MemoryFacts {
  std::string model, engine;
  std::size_t queries;
  std::size_t index, fresh, after_one, after_all, after_repeated;  ///< bytes

  /// What the biggest query needs is there once all have been asked.
  bool is_settled() const { return after_all == after_repeated; }
};

class MemorySection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions&) override {
    for (const std::string_view engine : {"bvh", "kdop26", "refinement", "paper-refinement"}) {
      const QueryIndex index = index_called(engine, model);
      MeshQuery query(index);
      MemoryFacts facts{
          model.name, std::string(engine), model.segments.size(), index.memory_bytes(), query.memory_bytes(), 0, 0, 0};
      query.all_hits(model.segments[0]);
      facts.after_one = query.memory_bytes();
      ask_all(query, model.segments);
      facts.after_all = query.memory_bytes();
      for (int i = 1; i < kTimes; ++i) ask_all(query, model.segments);
      facts.after_repeated = query.memory_bytes();
      facts_.push_back(std::move(facts));
    }
  }

  std::string text() const override {
    Table table({"model", "engine", "index", "query object", "after 1 query", "after all segments",
                 fmt::format("after all {} times", kTimes)});
    for (const MemoryFacts& f : facts_)
      table.add({f.model, f.engine, fmt::format("{:.1f} MB", static_cast<double>(f.index) / 1e6),
                 fmt::format("{} bytes", f.fresh), fmt::format("{} bytes", f.after_one),
                 fmt::format("{} bytes", f.after_all), fmt::format("{} bytes", f.after_repeated)});
    return "## Memory of an index, and of a query object before and after queries\n\n" + table.markdown();
  }

  void write(const std::filesystem::path& folder) const override {
    Table table({"mesh", "engine", "segments", "index_bytes", "query_bytes", "query_bytes_after_1",
                 "query_bytes_after_all", fmt::format("query_bytes_after_{}_times", kTimes)});
    for (const MemoryFacts& f : facts_)
      table.add({f.model, f.engine, fmt::to_string(f.queries), fmt::to_string(f.index), fmt::to_string(f.fresh),
                 fmt::to_string(f.after_one), fmt::to_string(f.after_all), fmt::to_string(f.after_repeated)});
    write_file(folder / "query_memory.csv", table.csv());
  }

  bool holds() const override { return std::ranges::all_of(facts_, &MemoryFacts::is_settled); }

 private:
  std::vector<MemoryFacts> facts_;
};

}  // namespace

std::unique_ptr<QuerySection> make_memory_section() { return std::make_unique<MemorySection>(); }

}  // namespace prohull::bench
