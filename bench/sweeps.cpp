#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "command.h"
#include "geometry/bvh.h"
#include "geometry/predicates.h"
#include "machine.h"
#include "prohull/closed_solid.h"
#include "prohull/mesh_query.h"
#include "prohull/sweep.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Zones around the quarter turns of links: random points of what turns, which must be inside, and volumes.

constexpr double kAngle = std::numbers::pi / 2;

struct SweepsOptions {
  LinkSources links;
  std::size_t pieces = 16;
  std::size_t points = 100'000;       ///< of the surface of each link, at random moments
  std::size_t volume_points = 2'000;  ///< in each zone
  std::filesystem::path out;
};

/// About the z axis, by its own formula.
Vec3 turned(const Vec3& p, double angle) {
  const long double c = std::cos(static_cast<long double>(angle)), s = std::sin(static_cast<long double>(angle));
  return {static_cast<double>(c * p.x - s * p.y), static_cast<double>(s * p.x + c * p.y), p.z};
}

/// Convex pieces that are asked whether one holds a point.
class Zone {
 public:
  explicit Zone(const Sweep& sweep) : pieces_(sweep.pieces), tree_(boxes_of(pieces_)) {
    for (const TriangleMesh& piece : pieces_) box_.extend(bounding_box(piece));
  }

  const Box& box() const { return box_; }

  /// Exactly.
  bool contains(const Vec3& p) const {
    bool found = false;
    tree_.visit([&](const Box& box) { return !found && box.contains(p); },
                [&](std::uint32_t i) { found = found || is_inside(p, pieces_[i]); });
    return found;
  }

 private:
  static std::vector<Box> boxes_of(const std::vector<TriangleMesh>& pieces) {
    std::vector<Box> boxes;
    for (const TriangleMesh& piece : pieces) boxes.push_back(bounding_box(piece));
    return boxes;
  }

  static bool is_inside(const Vec3& p, const TriangleMesh& polytope) {
    for (const FaceId f : polytope.triangles.ids()) {
      const auto [a, b, c] = polytope.triangle(f);
      if (side(a, b, c, p) == Side::Outside) return false;
    }
    return true;
  }

  const std::vector<TriangleMesh>& pieces_;
  const Bvh tree_;
  Box box_;
};

using Numbers = std::mt19937_64;

double number_below(Numbers& random, double limit) { return std::uniform_real_distribution<double>(0, limit)(random); }

/// Of random faces, each as likely as any other.
Vec3 point_of_surface(const TriangleMesh& mesh, Numbers& random) {
  const auto [a, b, c] = mesh.triangle(FaceId(random() % mesh.face_count()));
  const double root = std::sqrt(number_below(random, 1)), along = number_below(random, 1);
  return a * (1 - root) + b * (root * (1 - along)) + c * (root * along);
}

std::size_t points_outside(const TriangleMesh& mesh, const Zone& zone, std::size_t count) {
  Numbers random(1);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; ++i)
    outside += !zone.contains(turned(point_of_surface(mesh, random), number_below(random, kAngle)));
  return outside;
}

/// The zone's volume by that of the union of a thousand positions of the solid: by random points of the zone.
double volume_by_union(const TriangleMesh& solid, const Zone& zone, std::size_t count) {
  constexpr int kPositions = 1000;
  const QueryIndex index(solid);
  MeshQuery query(index);
  Numbers random(1);
  const Box& box = zone.box();
  std::size_t in_zone = 0, in_union = 0;
  while (in_zone < count) {
    const Vec3 size = box.max - box.min;
    const Vec3 p =
        box.min + Vec3{number_below(random, size.x), number_below(random, size.y), number_below(random, size.z)};
    if (!zone.contains(p)) continue;
    ++in_zone;
    bool found = false;
    for (int i = 0; i <= kPositions && !found; ++i) found = query.contains(turned(p, -kAngle * i / kPositions));
    in_union += found;
  }
  return static_cast<double>(in_zone) / static_cast<double>(in_union);
}

struct Found {
  Table table{{"robot", "link", "asked_pieces", "faces", "pieces", "seconds", "points", "outside", "volume_by_union"}};
  std::vector<double> seconds, volumes;
  std::size_t points = 0, outside = 0;
};

void add(const VisualLink& link, const SweepsOptions& options, Found& found) {
  const RigidMotion motion{.axis = {0, 0, 1}, .angle = kAngle};
  Sweep made;
  found.seconds.push_back(
      seconds_of([&] { made = sweep(link.mesh, {{motion}}, {.max_pieces = options.pieces, .threads = 1}); }));
  const Zone zone(made);
  const std::size_t outside = points_outside(link.mesh, zone, options.points);
  found.points += options.points, found.outside += outside;
  double volume = kUnknown;
  if (made.verdict.encloses_solid == Answer::Yes)
    if (const ClosedSolid solid = closed_solid(link.mesh); solid.source == Source::Mesh)
      volume = volume_by_union(solid.mesh, zone, options.volume_points);
  found.volumes.push_back(volume);
  found.table.add({as_cell(link.robot), as_cell(link.name), fmt::to_string(options.pieces),
                   fmt::to_string(link.mesh.face_count()), fmt::to_string(made.pieces.size()),
                   number(found.seconds.back(), 2), fmt::to_string(options.points), fmt::to_string(outside),
                   number(found.volumes.back(), 3)});
}

int run_sweeps(const SweepsOptions& options) {
  Found found;
  visit_visual_links(options.links, [&](const VisualLink& link) { add(link, options, found); });
  publish(
      options.out, "sweeps",
      fmt::format("Quarter turns of links about the z axis of their frames, each covered by {} convex pieces; "
                  "processor time. {}\n\n{}\n"
                  "Outside of the zones: {} of {} random points. Medians: {:.2f} s of one core; volume {:.3f} of the "
                  "union of a thousand positions.\n",
                  options.pieces, machine(), found.table.markdown(), found.outside, found.points, median(found.seconds),
                  median(found.volumes)),
      found.table.csv());
  return found.outside == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

void add_sweeps(CLI::App& app, Run& run) {
  const auto options = std::make_shared<SweepsOptions>();
  CLI::App& command = *app.add_subcommand("sweeps", "Zones around quarter turns of all links of robots");
  add_link_options(command, options->links);
  command.add_option("--pieces", options->pieces, "Convex pieces of a link")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--points", options->points, "Random points of each link")->capture_default_str();
  command.add_option("--volume-points", options->volume_points, "Random points of each zone")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  add_out_option(command, options->out, "sweeps.md and sweeps.csv");
  command.callback([options, &run] { run = [options] { return run_sweeps(*options); }; });
}

}  // namespace prohull::bench
