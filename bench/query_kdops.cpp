#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "io/file.h"
#include "machine.h"
#include "query_peers.h"
#include "query_section.h"
#include "table.h"

namespace prohull::bench {
namespace {

constexpr std::array<std::string_view, 4> kOverlapping{"kdop6-overlap", "kdop14-overlap", "kdop18-overlap",
                                                       "kdop26-overlap"};
constexpr std::array<int, 4> kDirections{6, 14, 18, 26};
constexpr std::string_view kHull = "paper-refinement";

enum class Ask { First, Any, All };
constexpr std::array kAsks{Ask::First, Ask::Any, Ask::All};

/// Something that answers segments.
class KdopContestant {
 public:
  KdopContestant(std::string_view engine, const QueryModel& model)
      : name_(engine), ours_(MeshQuery(index_called(engine, model))) {}
  KdopContestant(std::string name, std::unique_ptr<QueryPeer> peer) : name_(std::move(name)), peer_(std::move(peer)) {}

  const std::string& name() const { return name_; }

  /// The answers are counted, so that no compiler leaves them out.
  std::size_t run(Ask ask, std::span<const Segment> segments) {
    if (!ours_) return run_peer(ask, segments);
    if (ask == Ask::All) return ask_all(*ours_, segments);
    return static_cast<std::size_t>(std::ranges::count_if(segments, [&](const Segment& s) {
      return ask == Ask::First ? ours_->first_hit(s).has_value() : ours_->any_hit(s).has_value();
    }));
  }

 private:
  std::size_t run_peer(Ask ask, std::span<const Segment> segments) {
    std::size_t hits = 0;
    for (const Segment& s : segments)
      hits += ask == Ask::First ? peer_->first_hit(s).has_value()
              : ask == Ask::Any ? peer_->any_hit(s)
                                : peer_->all_hits(s).size();
    return hits;
  }

  std::string name_;
  std::optional<MeshQuery> ours_;
  std::unique_ptr<QueryPeer> peer_;
};

struct KdopFacts {
  std::string name;
  std::size_t faces = 0, segments = 0, segments_that_meet = 0;
  const PaperModel* paper = nullptr;
  std::vector<double> seconds;  ///< Table 4: overlapping k-DOPs, then the hull

  struct Trees {
    std::string name;
    std::array<double, kAsks.size()> nanoseconds;
  };
  std::vector<Trees> trees;  ///< second Table 4
};

/// Of each contestant for all crossings of all segments: the median of the rounds. The contestants take short turns, so
/// that all of them have their share of whatever else the machine does.
std::vector<double> median_seconds(std::vector<KdopContestant>& contestants, std::span<const Segment> segments,
                                   std::size_t rounds) {
  constexpr std::size_t kTurn = 1000;
  std::vector<std::vector<double>> seconds(contestants.size(), std::vector<double>(rounds));
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t first = 0; first < segments.size(); first += kTurn)
      for (std::size_t i = 0; i < contestants.size(); ++i)
        seconds[i][round] += seconds_of(
            [&] { contestants[i].run(Ask::All, segments.subspan(first, std::min(kTurn, segments.size() - first))); });
  std::vector<double> medians;
  for (std::vector<double>& all : seconds) {
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(rounds / 2));
    medians.push_back(all[rounds / 2]);
  }
  return medians;
}

void measure_table4(const QueryModel& model, std::size_t rounds, KdopFacts& facts) {
  std::vector<KdopContestant> contestants;
  for (const std::string_view engine : kOverlapping) contestants.emplace_back(engine, model);
  contestants.emplace_back(kHull, model);
  facts.seconds = median_seconds(contestants, model.segments, rounds);
  facts.segments_that_meet = contestants.back().run(Ask::First, model.segments);
}

std::vector<KdopContestant> todays_contestants(const QueryModel& model) {
  std::vector<KdopContestant> contestants;
  for (const std::string_view engine : {"paper-refinement", "refinement", "kdop6", "kdop14", "kdop18", "kdop26", "bvh"})
    contestants.emplace_back(engine, model);
  if (auto peer = make_cgal_tree(model.mesh)) contestants.emplace_back("CGAL AABB tree", std::move(peer));
  if (auto peer = make_embree(model.mesh, false)) contestants.emplace_back("Embree", std::move(peer));
  if (auto peer = make_embree(model.mesh, true)) contestants.emplace_back("Embree robust", std::move(peer));
  return contestants;
}

void measure_trees(const QueryModel& model, std::size_t rounds, KdopFacts& facts) {
  std::vector<KdopContestant> contestants = todays_contestants(model);
  for (const KdopContestant& c : contestants) facts.trees.push_back({c.name(), {}});
  for (std::size_t ask = 0; ask < kAsks.size(); ++ask) {
    std::vector<std::function<void()>> runs;
    for (KdopContestant& c : contestants) runs.emplace_back([&, ask] { c.run(kAsks[ask], model.segments); });
    const auto seconds = best_seconds(rounds, runs);
    for (std::size_t i = 0; i < contestants.size(); ++i)
      facts.trees[i].nanoseconds[ask] = 1e9 * seconds[i] / static_cast<double>(model.segments.size());
  }
}

double per_10000(const KdopFacts& m, double seconds) { return seconds * 10000 / static_cast<double>(m.segments); }

std::string table4(const std::vector<KdopFacts>& models) {
  std::vector<std::string> columns{"model", "segments that meet", "paper's"};
  for (const int k : kDirections) columns.push_back(fmt::format("{}-DOPs", k));
  columns.emplace_back("hull");
  for (const int k : kDirections) {
    columns.push_back(fmt::format("{}-DOPs / hull", k));
    columns.emplace_back("paper's");
  }
  Table table(columns);
  for (const KdopFacts& m : models) {
    std::vector<std::string> row{m.name, fmt::to_string(m.segments_that_meet),
                                 m.paper ? fmt::to_string(m.paper->lines_that_meet) : ""};
    for (const double s : m.seconds) row.push_back(number(per_10000(m, s), 3, " s"));
    for (std::size_t i = 0; i < kDirections.size(); ++i) {
      row.push_back(number(m.seconds[i] / m.seconds.back(), 2));
      row.push_back(m.paper ? number(m.paper->kdop_seconds[i] / m.paper->hull_seconds, 2) : "");
    }
    table.add(std::move(row));
  }
  return table.markdown();
}

std::string table4_csv(const std::vector<KdopFacts>& models) {
  Table table({"mesh", "faces", "segments", "segments_that_meet", "paper_segments_that_meet", "engine",
               "seconds_per_10000", "paper_seconds"});
  for (const KdopFacts& m : models)
    for (std::size_t i = 0; i < m.seconds.size(); ++i) {
      const bool is_hull = i == kOverlapping.size();
      table.add({m.name, fmt::to_string(m.faces), fmt::to_string(m.segments), fmt::to_string(m.segments_that_meet),
                 m.paper ? fmt::to_string(m.paper->lines_that_meet) : "",
                 std::string(is_hull ? kHull : kOverlapping[i]), number(per_10000(m, m.seconds[i]), 4),
                 m.paper ? number(is_hull ? m.paper->hull_seconds : m.paper->kdop_seconds[i], 0) : ""});
    }
  return table.csv();
}

std::string trees_table(const std::vector<KdopFacts>& models) {
  Table table({"model", "engine", "first", "any", "all", "first / bvh"});
  for (const KdopFacts& m : models) {
    const double bvh = std::ranges::find(m.trees, "bvh", &KdopFacts::Trees::name)->nanoseconds[0];
    for (const KdopFacts::Trees& t : m.trees) {
      std::vector<std::string> row{m.name, t.name};
      for (const double ns : t.nanoseconds) row.push_back(number(ns, 0, " ns"));
      row.push_back(number(t.nanoseconds[0] / bvh, 2));
      table.add(std::move(row));
    }
  }
  return table.markdown();
}

std::string trees_csv(const std::vector<KdopFacts>& models) {
  Table table({"mesh", "faces", "engine", "first_ns", "any_ns", "all_ns"});
  for (const KdopFacts& m : models)
    for (const KdopFacts::Trees& t : m.trees)
      table.add({m.name, fmt::to_string(m.faces), t.name, number(t.nanoseconds[0], 1), number(t.nanoseconds[1], 1),
                 number(t.nanoseconds[2], 1)});
  return table.csv();
}

class KDopsSection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions& options) override {
    KdopFacts& facts = models_.emplace_back();
    facts.name = model.name;
    facts.faces = model.mesh.face_count();
    facts.segments = model.segments.size();
    facts.paper = model.paper;
    measure_table4(model, options.rounds, facts);
    measure_trees(model, options.rounds, facts);
  }

  std::string text() const override {
    return fmt::format(
        "## Table 4: k-DOPs, tested by overlap, and hulls\n\n"
        "Time for 10,000 segments, all crossings, in turns of 1,000; median of the rounds. The hull is refined as "
        "published, from 2,000 faces, first "
        "strategy.\n\n"
        "{}\n## Table 4 with today's trees\n\n"
        "Time per segment for the first, any or all crossings; k-DOPs clip the segment. The hulls are those of Table "
        "4.\n\n{}",
        table4(models_), trees_table(models_));
  }

  void write(const std::filesystem::path& folder) const override {
    write_file(folder / "table4.csv", table4_csv(models_));
    write_file(folder / "trees.csv", trees_csv(models_));
  }

 private:
  std::vector<KdopFacts> models_;
};

}  // namespace

std::unique_ptr<QuerySection> make_kdops_section() { return std::make_unique<KDopsSection>(); }

}  // namespace prohull::bench
