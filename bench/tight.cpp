#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosure.h"
#include "prohull/tight_hull.h"
#include "table.h"

namespace prohull::bench {
namespace {

// The void of tight hulls, over several seeds: hulls of few faces have much luck in them.

struct TightOptions {
  ModelOptions models{.folder = {}, .samples = {"asteroid", "bracket", "pony"}, .sample_faces = 20000};
  std::vector<std::size_t> hull_faces{200, 50, 20, 12};
  std::size_t seeds = 3;
  HullSide side = HullSide::Outer;
  std::filesystem::path out;
};

class TightBench {
 public:
  explicit TightBench(const TightOptions& options) : options_(options) {}

  void measure(const ModelSource& source) {
    const TriangleMesh mesh = load(source);
    for (const std::size_t faces : options_.hull_faces) measure(source.name, mesh, faces);
  }

  int publish_all(const std::vector<Refused>& refused) const {
    const std::string text =
        fmt::format("# Tight hulls\n\n{}; {} seeds, from 1 on; processor seconds of one thread.\n\n{}{}", machine(),
                    options_.seeds, table_.markdown(), listed(refused));
    publish(options_.out, "tight", text, table_.csv());
    return all_enclose_ ? kDone : kAnswerIsNo;
  }

 private:
  void measure(const std::string& name, const TriangleMesh& mesh, std::size_t faces) {
    std::vector<double> voids, seconds;
    std::size_t most_faces = 0;
    bool encloses = true;
    for (std::size_t seed = 1; seed <= options_.seeds; ++seed) {
      const double begin = processor_seconds();
      const TriangleMesh hull =
          build_tight_hull(
              mesh, {.target_faces = faces, .side = options_.side, .relax_guards = true, .seed = seed, .threads = 1})
              .mesh;
      seconds.push_back(processor_seconds() - begin);
      voids.push_back(100 * std::abs(signed_volume(hull) / signed_volume(mesh) - 1));
      most_faces = std::max(most_faces, hull.face_count());
      const bool outer = options_.side == HullSide::Outer;
      encloses = encloses && (outer ? verify_enclosure(mesh, hull) : verify_enclosure(hull, mesh)).encloses;
    }
    all_enclose_ = all_enclose_ && encloses;
    const auto [least, greatest] = std::ranges::minmax(voids);
    table_.add({as_cell(name), fmt::to_string(faces), fmt::to_string(most_faces), number(median(voids), 2),
                number(least, 2), number(greatest, 2), number(median(seconds), 2), encloses ? "yes" : "NO"});
    fmt::print(stderr, "{}, {} faces: {:.2f} % ({:.2f} to {:.2f}), {:.2f} s{}\n", name, faces, median(voids), least,
               greatest, median(seconds), encloses ? "" : ", DOES NOT ENCLOSE");
  }

  const TightOptions& options_;
  Table table_{{"mesh", "faces", "most_faces", "void_percent", "least", "greatest", "seconds", "encloses"}};
  bool all_enclose_ = true;
};

int run_tight(const TightOptions& options) {
  TightBench bench(options);
  const auto refused = measure_each(options.models, [&](const ModelSource& source) { bench.measure(source); });
  return bench.publish_all(refused);
}

}  // namespace

void add_tight(CLI::App& app, Run& run) {
  const auto options = std::make_shared<TightOptions>();
  CLI::App& command = *app.add_subcommand("tight", "Void of tight hulls, median of several seeds");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  command.add_option("--seeds", options->seeds, "Hulls of each size")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command.add_flag_callback(
      "--inner", [options] { options->side = HullSide::Inner; }, "Inner hulls");
  add_out_option(command, options->out, "tight.md and tight.csv");
  command.callback([options, &run] { run = [options] { return run_tight(*options); }; });
}

}  // namespace prohull::bench
