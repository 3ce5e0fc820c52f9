#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "machine.h"
#include "prohull/convex_cover.h"
#include "prohull/convex_hull.h"
#include "prohull/sphere_cover.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Convex pieces and spheres that cover the visual geometry of all links of robots.

struct LinkCoversOptions {
  LinkSources links;
  std::size_t pieces = 8, balls = 64;
  std::filesystem::path out;
};

struct Tables {
  Table links{{"robot", "link", "faces", "pieces", "excess_percent", "convex_excess_percent", "excess_by_convex",
               "pieces_reach_percent", "pieces_certified", "pieces_seconds", "spheres", "spheres_reach_percent",
               "spheres_certified", "spheres_seconds"}};
  std::vector<double> excess, convex_excess, by_convex, spheres_reach;
  std::size_t uncertified = 0;
};

double excess_percent(double volume, double original_volume) {
  return original_volume > 0 ? 100 * (volume / original_volume - 1) : kUnknown;
}

std::string yes_or_no(bool certified, Tables& tables) {
  tables.uncertified += !certified;
  return certified ? "yes" : "NO";
}

void add_link(const VisualLink& link, const LinkCoversOptions& options, Tables& tables) {
  const TriangleMesh& mesh = link.mesh;
  ConvexCover pieces;
  const double pieces_seconds =
      elapsed_seconds_of([&] { pieces = convex_cover(mesh, {.max_pieces = options.pieces}); });
  SphereCover spheres;
  const double spheres_seconds =
      elapsed_seconds_of([&] { spheres = sphere_cover(mesh, {.max_balls = options.balls}); });
  const double excess = excess_percent(pieces.volume, pieces.original_volume);
  const double convex_excess = excess_percent(signed_volume(convex_hull(mesh)), pieces.original_volume);
  const double percent = 100 / bounding_box(mesh).diagonal();
  tables.excess.push_back(excess), tables.convex_excess.push_back(convex_excess);
  const bool has_ratio = convex_excess > 0.01;  // of nearly convex links, and of parts that overlap, it means nothing
  if (has_ratio) tables.by_convex.push_back(excess / convex_excess);
  tables.spheres_reach.push_back(percent * spheres.verdict.distance().upper);
  tables.links.add({as_cell(link.robot), as_cell(link.name), fmt::to_string(mesh.face_count()),
                    fmt::to_string(pieces.pieces.size()), number(excess, 3), number(convex_excess, 3),
                    has_ratio ? number(excess / convex_excess, 3) : "",
                    number(percent * pieces.verdict.distance().upper, 3), yes_or_no(pieces.verdict.certified, tables),
                    number(pieces_seconds, 2), fmt::to_string(spheres.balls.size()),
                    number(percent * spheres.verdict.distance().upper, 3), yes_or_no(spheres.verdict.certified, tables),
                    number(spheres_seconds, 2)});
}

int run_link_covers(const LinkCoversOptions& options) {
  Tables tables;
  visit_visual_links(options.links, [&](const VisualLink& link) { add_link(link, options, tables); });
  publish(options.out, "link_covers",
          fmt::format(
              "At most {} convex pieces, and at most {} spheres, of each link. {}\n\n{}\n"
              "Medians: excess of the pieces {:.1f} %, of the convex hull {:.1f} %, the one by the other {:.3f}; "
              "reach of the spheres {:.2f} % of the diagonal. Not certified: {}.\n",
              options.pieces, options.balls, machine(), tables.links.markdown(), median(tables.excess),
              median(tables.convex_excess), median(tables.by_convex), median(tables.spheres_reach), tables.uncertified),
          tables.links.csv());
  return tables.uncertified == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

void add_link_covers(CLI::App& app, Run& run) {
  const auto options = std::make_shared<LinkCoversOptions>();
  CLI::App& command = *app.add_subcommand("link-covers", "Convex pieces and spheres of all links of robots");
  add_link_options(command, options->links);
  command.add_option("--pieces", options->pieces, "Number of convex pieces")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--spheres", options->balls, "Number of spheres")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_out_option(command, options->out, "link_covers.md and link_covers.csv");
  command.callback([options, &run] { run = [options] { return run_link_covers(*options); }; });
}

}  // namespace prohull::bench
