#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models.h"
#include "paper/engines.h"
#include "paper_tables.h"

namespace prohull::bench {

struct QueryOptions {
  ModelOptions models;
  std::size_t segments = 0;  ///< that are timed; 0: the paper's 10,000 for a folder of models, 1,000 for samples
  std::size_t checked = 2000;
  std::size_t rounds = 3;
  std::vector<std::string> sections;  ///< by name; none: all
  std::uint64_t seed = 1;
  std::filesystem::path out;
};

struct QueryModel {
  const ProgressiveHull& hull(Strategy strategy) const;  ///< down to kSmallestBase faces, or as far as it goes

  /// That of Table 4, which the paper does not name: its 21 s for the horse are found in Table 3 with the first
  /// strategy only, from 500 to 2,000 faces; 2,000 are those of Tables 1 and 2.
  ProgressiveHull hull_of_table4() const { return hull(Strategy::Paper1).with_base(2000); }

  static constexpr std::size_t kSmallestBase = 200;

  std::string name;
  TriangleMesh mesh;
  std::vector<ProgressiveHull> hulls;  ///< by the order of kStrategies
  std::vector<Segment> segments;       ///< P&T 4.2
  const PaperModel* paper;
};

/// A part of `prohull-bench queries`: measures one model after the other and shows them together.
class QuerySection {
 public:
  virtual ~QuerySection() = default;
  virtual void measure(const QueryModel& model, const QueryOptions& options) = 0;
  virtual std::string text() const = 0;
  /// Its CSV files and figures.
  virtual void write(const std::filesystem::path& folder) const = 0;
  /// False if an answer was wrong that must not be.
  virtual bool holds() const { return true; }
};

std::unique_ptr<QuerySection> make_bases_section();        ///< P&T Table 3 and Figure 8
std::unique_ptr<QuerySection> make_kdops_section();        ///< P&T Table 4, and a second one with today's trees
std::unique_ptr<QuerySection> make_updates_section();      ///< P&T 3.2.2
std::unique_ptr<QuerySection> make_correctness_section();  ///< wrong and missed answers
std::unique_ptr<QuerySection> make_memory_section();       ///< of a query object

/// Of the model's mesh, or for the refinement engines of hull_of_table4(): an engine of the library, or k-DOP trees.
QueryIndex index_called(std::string_view engine, const QueryModel& model);

/// Runs all in turns, `rounds` times; the best processor time of each, in seconds.
std::vector<double> best_seconds(std::size_t rounds, std::span<const std::function<void()>> contestants);

/// Finds all crossings of all segments; returns how many.
std::size_t ask_all(MeshQuery& query, std::span<const Segment> segments);

}  // namespace prohull::bench
