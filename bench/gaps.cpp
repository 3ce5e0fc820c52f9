#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "prohull/verification.h"
#include "robot/files/robot_file.h"
#include "robot/link_triangles.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Do hulls keep the gap that they were asked for, as the verifier has it, and how much more void do they have than any
// hull with that gap must have: that between the mesh and its offset surface?

struct GapsOptions {
  ModelOptions models;
  std::vector<std::filesystem::path> robots, package_paths;
  std::size_t hull_faces = 2000;
  double gap_percent = 0.5;
  std::size_t samples = 200000;
  std::filesystem::path out;
};

struct GapKind {
  std::string_view name;
  HullSide side;
  bool tight;
};
constexpr std::array kGapKinds{GapKind{"outer", HullSide::Outer, false}, GapKind{"outer tight", HullSide::Outer, true},
                               GapKind{"inner", HullSide::Inner, false}};

/// How much of the box around it lies within `gap` of a mesh, and on which side.
struct Volumes {
  double outside = 0, inside = 0;
};

// One random point in each cell of a grid: of the share of the layer, 200,000 points are wrong by some 0.5 %.
Volumes layer_volumes(const TriangleMesh& mesh, double gap, std::size_t samples) {
  Box box = bounding_box(mesh);
  box = {box.min - Vec3{gap, gap, gap}, box.max + Vec3{gap, gap, gap}};
  const Vec3 size = box.max - box.min;
  const double volume = size.x * size.y * size.z, cell = std::cbrt(volume / double(samples));
  const auto cells = [&](double length) { return std::max(1.0, std::round(length / cell)); };
  const Vec3 count{cells(size.x), cells(size.y), cells(size.z)};
  MeshQuery query((QueryIndex(mesh)));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(0, 1);
  std::size_t outside = 0, inside = 0;
  for (double z = 0; z < count.z; ++z)
    for (double y = 0; y < count.y; ++y)
      for (double x = 0; x < count.x; ++x) {
        const Vec3 at{(x + within(random)) / count.x, (y + within(random)) / count.y, (z + within(random)) / count.z};
        const Vec3 p{box.min.x + at.x * size.x, box.min.y + at.y * size.y, box.min.z + at.z * size.z};
        if (!query.closest_point(p, gap)) continue;
        ++(query.contains(p) ? inside : outside);
      }
  const double of_one = volume / (count.x * count.y * count.z);
  return {double(outside) * of_one, double(inside) * of_one};
}

class GapBench {
 public:
  explicit GapBench(const GapsOptions& options) : options_(options) {}

  void measure(const std::string& name, const TriangleMesh& mesh) {
    const double gap = options_.gap_percent / 100 * diagonal_of(mesh);
    std::optional<Volumes> least;
    for (const GapKind& kind : kGapKinds) try {
        EnclosingHulls made;
        const double seconds = seconds_of([&] { made = built(mesh, kind, gap); });
        const EnclosingHull& hull = made.hulls.front();
        const Verification found = verify_hull(hull.mesh, mesh, kind.side, {.gap = gap});
        const bool is_clean = made.input.closed && count_self_intersections(made.input.closed->mesh) == 0;
        if (is_clean && !least) least = layer_volumes(made.input.closed->mesh, gap, options_.samples);
        const double least_void = !least                         ? kUnknown
                                  : kind.side == HullSide::Outer ? least->outside / made.volume
                                                                 : least->inside / made.volume;
        add(name, mesh, kind, hull, found, least_void, seconds);
      } catch (const InputError& error) {
        refuse(fmt::format("{}, {}", name, kind.name), error);
      }
  }

  // Robots are shipped without some of their meshes.
  void measure(const std::string& robot, const robot::Link& link) {
    const std::string name = robot + " " + link.name;
    try {
      const TriangleMesh mesh = robot::link_triangles(link.visual, robot::common_frame(link.visual));
      if (mesh.face_count() > 0) measure(name, mesh);
    } catch (const InputError& error) {
      refuse(name, error);
    }
  }

  int publish_all() const {
    const std::string text = fmt::format(
        "# Hulls that keep a gap\n\n{}; a gap of {:g} % of the diagonal, {} faces, one thread. The least void is that "
        "between the mesh and its offset surface. Of meshes that are not closed or intersect themselves it is not "
        "known. `verify_hull` says yes to {} of {} hulls.\n\n{}{}",
        machine(), options_.gap_percent, options_.hull_faces, kept_, built_, table_.markdown(),
        refused_.empty() ? "" : "\n## No hull\n\n" + refused_);
    publish(options_.out, "gaps", text, table_.csv());
    return kept_ == built_ ? kDone : kAnswerIsNo;
  }

 private:
  static double diagonal_of(const TriangleMesh& mesh) {
    Box box;
    for (const FaceId f : mesh.triangles.ids())
      if (const Triangle t = mesh.triangle(f); is_finite(t.a) && is_finite(t.b) && is_finite(t.c))
        for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
    return box.diagonal();
  }

  void refuse(const std::string& what, const InputError& error) {
    refused_ += fmt::format("- {}: {}\n", what, error.what());
    fmt::print(stderr, "{}: refused, {}\n", what, error.what());
  }

  EnclosingHulls built(const TriangleMesh& mesh, const GapKind& kind, double gap) const {
    EnclosingOptions options{.tight = kind.tight, .padding = gap};
    options.hull.side = kind.side, options.hull.threads = 1, options.hull.relax_guards = true;
    return enclosing_hulls(mesh, {&options_.hull_faces, 1}, options);
  }

  void add(const std::string& name, const TriangleMesh& mesh, const GapKind& kind, const EnclosingHull& hull,
           const Verification& found, double least_void, double seconds) {
    ++built_, kept_ += found.certified;
    const double hull_void = std::abs(hull.void_ratio), ratio = hull_void / least_void;
    table_.add({as_cell(name), fmt::to_string(mesh.face_count()), std::string(kind.name),
                fmt::to_string(hull.mesh.face_count()), std::string(name_of(source_names(), hull.source)),
                found.certified ? "yes" : "NO", number(100 * hull_void, 2), number(100 * least_void, 2),
                number(ratio, 3), fmt::to_string(hull.self_intersections), number(seconds, 2)});
    fmt::print(stderr, "{}, {}: {}, void {} %, {}{:.1f} s\n", name, kind.name,
               found.certified ? "kept" : "NOT KEPT: " + found.why_not, number(100 * hull_void, 2),
               std::isnan(ratio) ? "" : number(ratio, 3) + " times the least, ", seconds);
  }

  const GapsOptions& options_;
  Table table_{{"mesh", "faces", "hull", "hull_faces", "source", "keeps_gap", "void_percent", "least_void_percent",
                "void_by_least", "self_intersections", "seconds"}};
  std::string refused_;
  std::size_t built_ = 0, kept_ = 0;
};

int run_gaps(const GapsOptions& options) {
  GapBench bench(options);
  for (const ModelSource& source : model_sources(options.models))
    bench.measure(source.name,
                  source.path.empty() ? make_sample(source.sample, source.sample_faces) : read_mesh(source.path));
  for (const std::filesystem::path& path : options.robots) {
    const robot::RobotFile file = robot::read_robot(path, {.package_paths = options.package_paths});
    for (const robot::Link& link : file.robot.links) bench.measure(path.stem().string(), link);
  }
  return bench.publish_all();
}

}  // namespace

void add_gaps(CLI::App& app, Run& run) {
  const auto options = std::make_shared<GapsOptions>();
  CLI::App& command = *app.add_subcommand(
      "gaps", "Hulls that keep a gap: whether they do, and their void by that of the offset surface");
  add_model_options(command, options->models);
  command.add_option("--robots", options->robots, "Measure the links of these robots too")->check(CLI::ExistingFile);
  command.add_option("--package-path", options->package_paths, "Folders in which packages are looked for");
  add_faces_option(command, options->hull_faces);
  command.add_option("--gap", options->gap_percent, "Gap, in per cent of the diagonal")->capture_default_str();
  command.add_option("--points", options->samples, "Points by which the void of the offset surface is estimated")
      ->capture_default_str();
  add_out_option(command, options->out, "gaps.md and gaps.csv");
  command.callback([options, &run] { run = [options] { return run_gaps(*options); }; });
}

}  // namespace prohull::bench
