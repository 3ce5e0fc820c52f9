#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "figure.h"
#include "io/file.h"
#include "machine.h"
#include "query_section.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

constexpr std::array<std::size_t, 8> kBases{200, 500, 1000, 2000, 3000, 4000, 5000, 10000};

/// Slab test in plain doubles: what it rejects is timed, and nothing else.
bool meets(const Segment& s, const Box& box) {
  double from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = s.b[axis] - s.a[axis], low = (box.min[axis] - s.a[axis]) / d,
                 high = (box.max[axis] - s.a[axis]) / d;
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
  }
  return from <= to;
}

struct Measured {
  double seconds = std::numeric_limits<double>::infinity();  ///< for all segments
  double tests = 0, splits = 0;                              ///< per segment, those that miss the box counted
};

/// One line of Table 3.
struct BaseFacts {
  std::size_t base = 0;   ///< asked for
  std::size_t faces = 0;  ///< of the base mesh
  Strategy strategy{};
  Measured measured;
};

struct ModelFacts {
  std::string name;
  std::size_t faces = 0, segments = 0;
  const PaperModel* paper = nullptr;
  std::vector<BaseFacts> bases;
  Measured brute_force;

  /// Of as many segments as the paper's.
  double seconds(const Measured& m) const { return m.seconds * 10000 / static_cast<double>(segments); }
};

void measure_base(const QueryModel& model, BaseFacts& facts) {
  const ProgressiveHull hull = model.hull(facts.strategy).with_base(facts.base);
  facts.faces = hull.base_face_count();
  MeshQuery query{prohull::index_called("paper-refinement", hull)};
  Measured& m = facts.measured;
  m.seconds = std::min(m.seconds, seconds_of([&] { ask_all(query, model.segments); }));
  m.tests = static_cast<double>(query.counts().tests) / static_cast<double>(model.segments.size());
  m.splits = static_cast<double>(query.counts().splits) / static_cast<double>(model.segments.size());
}

// A sample of the segments: each costs as much as thousands of others.
Measured measure_brute_force(const QueryModel& model) {
  const std::size_t timed = std::min<std::size_t>(model.segments.size(), 500);
  const auto all = static_cast<double>(model.segments.size());
  const Box box = bounding_box(model.mesh);
  MeshQuery query{QueryIndex(model.mesh, Engine::Brute)};
  std::size_t in_box = 0;
  const double seconds = seconds_of([&] {
    for (std::size_t i = 0; i < timed; ++i)
      if (meets(model.segments[i], box)) ++in_box, query.all_hits(model.segments[i]);
  });
  const auto all_in_box = std::ranges::count_if(model.segments, [&](const Segment& s) { return meets(s, box); });
  const double share = static_cast<double>(all_in_box) / all;
  return {seconds / static_cast<double>(in_box) * static_cast<double>(all_in_box),
          share * static_cast<double>(model.mesh.face_count()), 0};
}

ModelFacts measured_facts(const QueryModel& model, std::size_t rounds) {
  ModelFacts facts{.name = model.name,
                   .faces = model.mesh.face_count(),
                   .segments = model.segments.size(),
                   .paper = model.paper,
                   .bases = {},
                   .brute_force = measure_brute_force(model)};
  for (const NamedStrategy& s : kStrategies)
    for (const std::size_t base : kBases)
      if (base < facts.faces) facts.bases.push_back({.base = base, .strategy = s.strategy, .measured = {}});
  for (std::size_t round = 0; round < rounds; ++round)
    for (BaseFacts& base : facts.bases) measure_base(model, base);
  return facts;
}

std::string base_name(const BaseFacts& b) {
  return b.faces <= b.base ? fmt::to_string(b.base) : fmt::format("{} (ends at {})", b.base, b.faces);
}

std::string_view name(Strategy strategy) {
  return std::ranges::find(kStrategies, strategy, &NamedStrategy::strategy)->name;
}

struct Papers {
  double seconds, tests, splits;
};
Papers papers(const ModelFacts& m, const BaseFacts& b) {
  const PaperBase* paper = paper_base(m.paper, b.strategy, b.base);
  return paper ? Papers{paper->seconds, paper->tests, paper->splits} : Papers{kUnknown, kUnknown, kUnknown};
}
double papers_brute_force(const ModelFacts& m) {
  return m.paper && m.paper->faces == kPaperBruteForce.faces ? kPaperBruteForce.seconds : kUnknown;
}

std::string table3(const std::vector<ModelFacts>& models) {
  Table table({"model", "strategy", "base", "time", "brute force / time", "paper's", "tests", "paper's", "difference",
               "splits", "paper's", "difference"});
  for (const ModelFacts& m : models) {
    for (const BaseFacts& b : m.bases) {
      const Papers paper = papers(m, b);
      table.add({m.name, std::string(name(b.strategy)), base_name(b), number(m.seconds(b.measured), 3, " s"),
                 number(m.brute_force.seconds / b.measured.seconds, 1),
                 number(papers_brute_force(m) / paper.seconds, 1), number(b.measured.tests, 0), number(paper.tests, 0),
                 difference(b.measured.tests, paper.tests), number(b.measured.splits, 0), number(paper.splits, 0),
                 difference(b.measured.splits, paper.splits)});
    }
    const double paper_tests = std::isfinite(papers_brute_force(m)) ? kPaperBruteForce.tests : kUnknown;
    table.add({m.name, "brute force", fmt::to_string(m.faces), number(m.seconds(m.brute_force), 3, " s"), "1", "",
               number(m.brute_force.tests, 0), number(paper_tests, 0), difference(m.brute_force.tests, paper_tests), "",
               "", ""});
  }
  return table.markdown();
}

std::string csv(const std::vector<ModelFacts>& models) {
  Table table({"mesh", "faces", "strategy", "base", "base_faces", "seconds_per_10000", "tests", "splits",
               "paper_seconds", "paper_tests", "paper_splits"});
  for (const ModelFacts& m : models) {
    for (const BaseFacts& b : m.bases) {
      const Papers paper = papers(m, b);
      table.add({m.name, fmt::to_string(m.faces), std::string(name(b.strategy)), fmt::to_string(b.base),
                 fmt::to_string(b.faces), number(m.seconds(b.measured), 4), number(b.measured.tests, 1),
                 number(b.measured.splits, 1), number(paper.seconds, 2), number(paper.tests, 0),
                 number(paper.splits, 0)});
    }
    table.add({m.name, fmt::to_string(m.faces), "brute force", "", "", number(m.seconds(m.brute_force), 4),
               number(m.brute_force.tests, 1), "", number(papers_brute_force(m), 2), "", ""});
  }
  return table.csv();
}

std::string figure8_csv(const std::vector<ModelFacts>& models) {
  Table table({"mesh", "faces", "base_faces", "seconds_per_10000"});
  for (const ModelFacts& m : models)
    for (const BaseFacts& b : m.bases)
      if (b.strategy == Strategy::Paper2)
        table.add({m.name, fmt::to_string(m.faces), fmt::to_string(b.faces), number(m.seconds(b.measured), 4)});
  return table.csv();
}

class BasesSection final : public QuerySection {
 public:
  void measure(const QueryModel& model, const QueryOptions& options) override {
    models_.push_back(measured_facts(model, options.rounds));
  }

  std::string text() const override {
    return fmt::format(
        "## Table 3: hulls as published, by size of the base mesh\n\n"
        "Time for 10,000 segments, all crossings; faces tested and vertices split per segment, those that miss the\n"
        "bounding box counted too.\n\n{}",
        table3(models_));
  }

  void write(const std::filesystem::path& folder) const override {
    write_file(folder / "table3.csv", csv(models_));
    write_file(folder / "figure8.csv", figure8_csv(models_));
    draw_figure(folder / "figure8.csv");
  }

 private:
  std::vector<ModelFacts> models_;
};

}  // namespace

std::unique_ptr<QuerySection> make_bases_section() { return std::make_unique<BasesSection>(); }

}  // namespace prohull::bench
