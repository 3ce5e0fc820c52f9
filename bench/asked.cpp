#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "bound_trials.h"
#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "references.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Is what is asked for what comes: bounds of distance, and tight hulls that are never worse than the default's?

constexpr std::array kBounds{0.001, 0.003, 0.01, 0.03};  // of the diagonal
constexpr std::size_t kBoundedFaces = 20, kTightFaces = 100;

struct AskedOptions {
  ModelOptions models{.folder = {}, .samples = {"bracket"}, .sample_faces = 2000};
  std::filesystem::path data = "../shared/data";
  std::vector<std::string> folders{"robots", "models", "dirty"};
  std::size_t every = 1;
  double budget = 60;
  std::vector<double> exhaustive;
  std::filesystem::path out;
};

/// What came of one request; `hull` is empty if it was refused or took too long.
struct Answer {
  std::optional<EnclosingHull> hull;
  double seconds = 0;
  std::string said;
};

class Asking {
 public:
  Asking(const TriangleMesh& mesh, double budget) : mesh_(mesh), budget_(budget) {}

  Answer operator()(std::size_t faces, EnclosingOptions options) const {
    Answer answer;
    const double begin = processor_seconds();
    options.hull.threads = 1;
    options.hull.relax_guards = true;
    options.progress = [&](std::string_view, double) { return processor_seconds() - begin < budget_; };
    try {
      answer.hull = enclosing_hull(mesh_, faces, options);
      if (!answer.hull->notes.empty()) answer.said = answer.hull->notes.back();
    } catch (const InputError& error) {
      answer.said = error.what();
    } catch (const Cancelled&) {
      answer.said = "over the budget";
    }
    answer.seconds = processor_seconds() - begin;
    return answer;
  }

 private:
  const TriangleMesh& mesh_;
  double budget_;
};

bool is_kept(const Answer& answer) { return answer.hull && answer.hull->certified && answer.hull->within_bounds; }

/// In per cent of the diagonal; unknown if there is no hull.
double distance_percent(const Answer& answer, double bound) {
  return answer.hull ? 100 * bound * answer.hull->excess : kUnknown;
}

/// A bound that is kept is kept by what keeps a closer one, with as few faces; where the closer one is missed, its
/// hull is no farther away.
bool is_monotone(const Answer& closer, double bound, const Answer& looser, double looser_bound) {
  if (!closer.hull || !looser.hull) return true;
  if (is_kept(closer)) return is_kept(looser) && looser.hull->mesh.face_count() <= closer.hull->mesh.face_count();
  return distance_percent(closer, bound) <= distance_percent(looser, looser_bound);
}

class AskedBench {
 public:
  explicit AskedBench(const AskedOptions& options) : options_(options) {}

  void measure(const std::string& name, const TriangleMesh& mesh) {
    std::vector<std::string> cells{as_cell(name), fmt::to_string(mesh.face_count())};
    const Asking ask(mesh, options_.budget);
    add_bounds(ask, bounding_box(mesh).diagonal(), cells);
    add_tight(ask, cells);
    add_inner(ask, cells);
    std::string line;
    for (const std::string& cell : cells) line += (line.empty() ? "" : " | ") + cell;
    fmt::print(stderr, "{}\n", line);
    table_.add(std::move(cells));
  }

  int publish_all(const std::vector<std::string>& refused) const {
    std::string text = fmt::format(
        "# Is what is asked for what comes?\n\n{}; {} s of processor time for one hull at most; one mesh in {}.\n\n",
        machine(), options_.budget, options_.every);
    for (std::size_t i = 0; i < kBounds.size(); ++i)
      text += fmt::format("* {:g} % of the diagonal at {} faces: kept {}, missed {}, refused {}, over the budget {}\n",
                          100 * kBounds[i], kBoundedFaces, bounds_[i].kept, bounds_[i].missed, bounds_[i].refused,
                          bounds_[i].over_budget);
    text += fmt::format(
        "* closer bounds with looser hulls or fewer faces: {}\n* tight at {} faces: {} hulls, {} of them worse than "
        "the "
        "default; times the default's time: median {:.1f}, worst {:.1f}\n* voids of the wrong sign: {}\n\n",
        not_monotone_, kTightFaces, ratios_.size(), worse_, median(ratios_),
        ratios_.empty() ? kUnknown : std::ranges::max(ratios_), wrong_voids_);
    for (const std::string& why : refused) text += fmt::format("* not read: {}\n", why);
    publish(options_.out, "asked", text + table_.markdown(), table_.csv());
    return not_monotone_ + worse_ + wrong_voids_ == 0 ? kDone : kAnswerIsNo;
  }

 private:
  struct Kept {
    std::size_t kept = 0, missed = 0, refused = 0, over_budget = 0;
  };

  static std::string verdict(const Answer& answer, Kept& counts) {
    if (is_kept(answer)) return ++counts.kept, "kept";
    if (answer.hull) return ++counts.missed, "missed";
    if (answer.said == "over the budget") return ++counts.over_budget, answer.said;
    return ++counts.refused, "refused";
  }

  void add_bounds(const Asking& ask, double diagonal, std::vector<std::string>& cells) {
    std::array<Answer, kBounds.size()> answers;
    bool monotone = true;
    std::string said;
    for (std::size_t i = 0; i < kBounds.size(); ++i) {
      Answer& answer = answers[i];
      answer = ask(kBoundedFaces, {.bounds = {.max_distance = kBounds[i] * diagonal}});
      cells.push_back(verdict(answer, bounds_[i]));
      cells.push_back(answer.hull ? fmt::to_string(answer.hull->mesh.face_count()) : "");
      cells.push_back(number(distance_percent(answer, kBounds[i]), 3));
      cells.push_back(number(answer.seconds, 2));
      if (!is_kept(answer) && said.empty()) said = answer.said;
      if (answer.hull) count_void(answer.hull->void_ratio, HullSide::Outer);
      for (std::size_t j = 0; j < i; ++j)
        monotone = monotone && is_monotone(answers[j], kBounds[j], answer, kBounds[i]);
    }
    if (!monotone) ++not_monotone_;
    cells.push_back(as_cell(said));
    cells.push_back(monotone ? "yes" : "NO");
  }

  void add_tight(const Asking& ask, std::vector<std::string>& cells) {
    const Answer plain = ask(kTightFaces, {}), tight = ask(kTightFaces, {.tight = true});
    const auto void_percent = [](const Answer& a) { return a.hull ? 100 * a.hull->void_ratio : kUnknown; };
    std::string verdict;
    double ratio = kUnknown;
    if (plain.hull && tight.hull) {
      for (const Answer* answer : {&plain, &tight}) count_void(answer->hull->void_ratio, HullSide::Outer);
      const bool is_worse = plain.hull->mesh.face_count() >= tight.hull->mesh.face_count() &&
                            signed_volume(tight.hull->mesh) > signed_volume(plain.hull->mesh);
      if (is_worse) ++worse_;
      ratios_.push_back(ratio = tight.seconds / plain.seconds);
      verdict = is_worse ? "WORSE" : "no worse";
    } else {
      verdict = plain.hull ? tight.said : plain.said;
    }
    cells.insert(cells.end(), {number(void_percent(plain), 2), number(plain.seconds, 3), number(void_percent(tight), 2),
                               number(tight.seconds, 3), number(ratio, 1), as_cell(verdict)});
  }

  // Only what can be closed has inner hulls.
  void add_inner(const Asking& ask, std::vector<std::string>& cells) {
    const Answer inner = ask(kTightFaces, {.hull = {.side = HullSide::Inner}});
    if (inner.hull) count_void(inner.hull->void_ratio, HullSide::Inner);
    cells.push_back(number(inner.hull ? 100 * inner.hull->void_ratio : kUnknown, 2));
  }

  void count_void(double ratio, HullSide side) {
    if (side == HullSide::Outer ? ratio < 0 : ratio > 0) ++wrong_voids_;
  }

  const AskedOptions& options_;
  std::array<Kept, kBounds.size()> bounds_{};
  std::size_t not_monotone_ = 0, worse_ = 0, wrong_voids_ = 0;
  std::vector<double> ratios_;
  Table table_ = headed();

  static Table headed() {
    std::vector<std::string> columns{"mesh", "faces"};
    for (const double bound : kBounds)
      for (const char* what : {"bound", "faces", "distance_percent", "seconds"})
        columns.push_back(fmt::format("{}_{:g}", what, 100 * bound));
    for (const char* what : {"said", "monotone", "default_void_percent", "default_seconds", "tight_void_percent",
                             "tight_seconds", "ratio", "tight", "inner_void_percent"})
      columns.push_back(what);
    return Table(columns);
  }
};

/// Are there hulls of fewer faces than those that bounds give?
class ExhaustiveBench {
 public:
  explicit ExhaustiveBench(const AskedOptions& options) : options_(options) {}

  void measure(const std::string& name, const TriangleMesh& mesh) {
    for (const double percent : options_.exhaustive) add(name, mesh, percent);
  }

  int publish_all(const std::vector<std::string>& refused) const {
    std::string text = fmt::format("# Are there hulls of fewer faces that keep a bound?\n\n{}\n\n", machine());
    for (const std::string& why : refused) text += fmt::format("* not read: {}\n", why);
    publish(options_.out, "exhaustive", text + table_.markdown(), table_.csv());
    return kDone;
  }

 private:
  void add(const std::string& name, const TriangleMesh& mesh, double percent) {
    const double diagonal = bounding_box(mesh).diagonal();
    EnclosingOptions how{.bounds = {.max_distance = percent / 100 * diagonal}};
    const Answer given = Asking(mesh, options_.budget)(kBoundedFaces, how);
    how.hull.threads = 1, how.hull.relax_guards = true;
    constexpr double kFinest = 1.0 / 256;  // of the diagonal
    std::optional<BoundTrial> least;
    for (BoundTrial& trial : bound_trials(mesh, kBoundedFaces, how, kFinest * diagonal)) {
      fmt::print(stderr, "{}, {:g} %: {}: {}{}\n", name, percent, trial.what, trial.faces,
                 trial.is_kept ? "" : ", missed");
      if (trial.is_kept && (!least || trial.faces < least->faces)) least = std::move(trial);
    }
    const std::size_t faces = is_kept(given) ? given.hull->mesh.face_count() : 0;
    table_.add({as_cell(name), number(percent, 2), faces > 0 ? fmt::to_string(faces) : "", number(given.seconds, 2),
                least ? fmt::to_string(least->faces) : "", least ? as_cell(least->what) : "",
                number(least && faces > 0 ? double(faces) / double(least->faces) : kUnknown, 2)});
  }

  const AskedOptions& options_;
  Table table_{{"mesh", "bound_percent", "faces", "seconds", "least_faces", "least", "ratio"}};
};

/// Collision geometry is what others made of these meshes.
std::vector<std::filesystem::path> meshes_of(const std::filesystem::path& data,
                                             const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> files;
  for (const std::string& folder : folders) {
    if (!is_directory(data / folder)) {
      fmt::print(stderr, "skipped: there is no folder {}\n", (data / folder).string());
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data / folder)) {
      const bool is_collision = entry.path().string().find("collision") != std::string::npos;
      if (entry.is_regular_file() && is_named_like_a_mesh(entry.path()) && !is_collision) files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

template <class Bench>
int run_asked(const AskedOptions& options) {
  Bench bench(options);
  std::vector<std::string> refused;
  std::vector<std::filesystem::path> files = options.models.files;
  if (files.empty() && !options.models.record_sample) files = meshes_of(options.data, options.folders);
  for (std::size_t i = 0; i < files.size(); i += options.every) try {
      const TriangleMesh mesh = finite_part(read_mesh(files[i], {.non_finite = NonFinite::Keep}));
      bench.measure(files[i].lexically_relative(options.data).string(), mesh);
    } catch (const InputError& error) {
      refused.push_back(error.what());
    }
  if (options.models.files.empty())
    for (const std::string& sample : options.models.samples)
      bench.measure("bundled_" + sample, make_sample(sample, options.models.sample_faces));
  return bench.publish_all(refused);
}

}  // namespace

void add_asked(CLI::App& app, Run& run) {
  const auto options = std::make_shared<AskedOptions>();
  CLI::App& command = *app.add_subcommand(
      "asked", "Whether hulls keep the bounds that are asked for, and tight ones are no worse than the default");
  add_model_options(command, options->models);
  command.add_option("--data", options->data, "Folder of robots/, models/ and dirty/; bundled meshes come after them")
      ->capture_default_str()
      ->type_name("DIR");
  command.add_option("--folders", options->folders, "Those of them that are measured")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("NAME,...");
  command.add_option("--every", options->every, "Measure only the first mesh of so many")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--budget", options->budget, "Processor time for one hull, in seconds")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command
      .add_option("--exhaustive", options->exhaustive,
                  "Instead: the faces with these bounds, in per cent of the diagonal, beside the least that a search "
                  "over wraps and ways to collapse finds")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->type_name("PCT,...");
  add_out_option(command, options->out, "asked.md and asked.csv");
  command.callback([options, &run] {
    run = [options] {
      return options->exhaustive.empty() ? run_asked<AskedBench>(*options) : run_asked<ExhaustiveBench>(*options);
    };
  });
}

}  // namespace prohull::bench
