#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "exhaustive_scan.h"
#include "io/file.h"
#include "prohull/detail/random_segments.h"
#include "query_peers.h"
#include "query_section.h"
#include "table.h"

namespace prohull::bench {
namespace {

struct CheckedEngine {
  std::string_view name;
  std::size_t most;  ///< segments that are asked; slow engines get fewer
};
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
constexpr std::array kEngines{
    CheckedEngine{"brute", 1000},           CheckedEngine{"bvh", kAll},
    CheckedEngine{"kdop6", kAll},           CheckedEngine{"kdop14", kAll},
    CheckedEngine{"kdop18", kAll},          CheckedEngine{"kdop26", kAll},
    CheckedEngine{"kdop6-overlap", 20000},  CheckedEngine{"kdop14-overlap", 20000},
    CheckedEngine{"kdop18-overlap", 20000}, CheckedEngine{"kdop26-overlap", 20000},
    CheckedEngine{"refinement", kAll},      CheckedEngine{"paper-refinement", kAll},
};

using Truth = std::vector<std::vector<Hit>>;

struct Facts {
  std::string model, engine;
  bool is_ours = false, finds_all = false;          ///< by promise
  std::size_t segments = 0, meeting = 0, hits = 0;  ///< of the truth
  std::size_t wrong_first = 0;                      ///< another face, or none, or one where there is none
  std::size_t far_first = 0;                        ///< of these, those with t off by more than 1e-5
  std::size_t wrong_all = 0;                        ///< segments with other crossings
  std::size_t missed_hits = 0, missing_segments = 0;

  bool holds() const { return !is_ours || (wrong_first == 0 && (!finds_all || wrong_all == 0)); }
};

void count_truth(const Truth& truth, std::size_t segments, Facts& facts) {
  facts.segments = segments;
  for (std::size_t i = 0; i < segments; ++i) {
    facts.meeting += !truth[i].empty();
    facts.hits += truth[i].size();
  }
}

template <class SomeHit>
void check_first(const std::vector<Hit>& truth, const std::optional<SomeHit>& found, Facts& facts) {
  constexpr double kNear = 1e-5;
  const bool both = found && !truth.empty(), neither = !found && truth.empty();
  if (neither || (both && found->face == truth[0].face)) return;
  ++facts.wrong_first;
  facts.far_first += !both || !(std::abs(found->t - truth[0].t) <= kNear);
}

void check_all(const std::vector<Hit>& truth, std::span<const Hit> found, Facts& facts) {
  if (std::ranges::equal(truth, found)) return;
  ++facts.wrong_all;
  const auto missed =
      std::ranges::count_if(truth, [&](const Hit& h) { return std::ranges::find(found, h) == found.end(); });
  facts.missed_hits += static_cast<std::size_t>(missed);
  facts.missing_segments += missed > 0;
}

std::span<const Hit> hits_of(const HitBatch& batch, std::size_t i) {
  return std::span(batch.hits).subspan(batch.offsets[i], batch.offsets[i + 1] - batch.offsets[i]);
}

Facts check_engine(const QueryModel& model, const CheckedEngine& checked, std::span<const Segment> segments,
                   const Truth& truth) {
  const QueryIndex index = index_called(checked.name, model);
  const auto asked = segments.first(std::min(segments.size(), checked.most));
  Facts facts{.model = model.name,
              .engine = std::string(checked.name),
              .is_ours = true,
              .finds_all = checked.name != "paper-refinement"};
  count_truth(truth, asked.size(), facts);
  const HitBatch first = find_hits(index, asked, HitMode::First), all = find_hits(index, asked, HitMode::All);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto found = hits_of(first, i);
    check_first(truth[i], found.empty() ? std::nullopt : std::optional(found[0]), facts);
    check_all(truth[i], hits_of(all, i), facts);
  }
  return facts;
}

Facts check_peer(const QueryModel& model, std::string name, QueryPeer& peer, std::span<const Segment> segments,
                 const Truth& truth) {
  Facts facts{.model = model.name, .engine = std::move(name)};
  count_truth(truth, segments.size(), facts);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    check_first(truth[i], peer.first_hit(segments[i]), facts);
    facts.wrong_all += peer.all_hits(segments[i]).size() != truth[i].size();
  }
  return facts;
}

class CorrectnessSection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions& options) override {
    const auto segments = random_segments(bounding_box(model.mesh), options.checked, options.seed + 1);
    const Truth truth = ExhaustiveScan(model.mesh).all_hits(segments);
    for (const CheckedEngine& checked : kEngines) facts_.push_back(check_engine(model, checked, segments, truth));
    const auto check = [&](std::string name, std::unique_ptr<QueryPeer> peer) {
      if (peer) facts_.push_back(check_peer(model, std::move(name), *peer, segments, truth));
    };
    check("CGAL AABB tree", make_cgal_tree(model.mesh));
    check("Embree", make_embree(model.mesh, false));
    check("Embree robust", make_embree(model.mesh, true));
  }

  std::string text() const override {
    Table table({"model", "engine", "segments", "that meet", "crossings", "wrong first", "t off by 1e-5", "wrong all"});
    Table missed({"model", "segments with missed crossings", "of those that meet", "missed crossings", "of all"});
    for (const Facts& f : facts_) {
      table.add({f.model, f.engine, fmt::to_string(f.segments), fmt::to_string(f.meeting), fmt::to_string(f.hits),
                 fmt::to_string(f.wrong_first), fmt::to_string(f.far_first), fmt::to_string(f.wrong_all)});
      if (f.is_ours && !f.finds_all)
        missed.add({f.model, fmt::to_string(f.missing_segments), share(f.missing_segments, f.meeting),
                    fmt::to_string(f.missed_hits), share(f.missed_hits, f.hits)});
    }
    return "## Correctness, against exact brute force\n\n"
           "wrong first: another face than the exact one, or none, or one where there is none; the next column counts "
           "those\nof them of which t is off by more than 1e-5, or missing. wrong all: segments with another list of "
           "crossings; of\npeers, another number.\n\n" +
           table.markdown() + "\n## Inner crossings that refinement as published misses (P&T 3.2.1, Figure 5)\n\n" +
           missed.markdown();
  }

  void write(const std::filesystem::path& folder) const override {
    Table table({"mesh", "engine", "segments", "segments_that_meet", "crossings", "wrong_first", "wrong_first_t",
                 "wrong_all", "segments_with_missed", "missed_crossings"});
    for (const Facts& f : facts_)
      table.add({f.model, f.engine, fmt::to_string(f.segments), fmt::to_string(f.meeting), fmt::to_string(f.hits),
                 fmt::to_string(f.wrong_first), fmt::to_string(f.far_first), fmt::to_string(f.wrong_all),
                 f.is_ours ? fmt::to_string(f.missing_segments) : "", f.is_ours ? fmt::to_string(f.missed_hits) : ""});
    write_file(folder / "correctness.csv", table.csv());
  }

  bool holds() const override { return std::ranges::all_of(facts_, &Facts::holds); }

 private:
  static std::string share(std::size_t part, std::size_t whole) {
    return number(100 * static_cast<double>(part) / static_cast<double>(whole), 3, " %");
  }

  std::vector<Facts> facts_;
};

}  // namespace

std::unique_ptr<QuerySection> make_correctness_section() { return std::make_unique<CorrectnessSection>(); }

}  // namespace prohull::bench
