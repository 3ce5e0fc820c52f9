#include "robot/hulls/link_hulls.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "prohull/convex_cover.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/sphere_cover.h"
#include "robot/form_measures.h"
#include "robot/hulls/cache.h"
#include "robot/hulls/verdict.h"
#include "robot/side_by_side.h"

namespace prohull::robot {
namespace {

/// What is done with one link.
struct Plan {
  std::size_t link = 0;
  Budget budget;
  std::vector<Shape> hulled = {};         ///< shapes that the hull encloses
  std::vector<std::size_t> numbers = {};  ///< where each of `hulled` is among the shapes of the link
  std::uintmax_t bytes = 0;               ///< total size of the mesh files of `hulled`
  CurvedParts curved = {};                ///< of `hulled`
  std::string key = {};                   ///< key_of its triangles

  /// The budget of hulls of the triangles, which have meshes around curved forms.
  Budget budget_of_triangles() const {
    Budget narrowed = budget;
    if (budget.max_distance > 0)
      narrowed.max_distance = distance_left(budget, curved.around).value_or(budget.max_distance);
    return narrowed;
  }
  JudgedGeometry geometry(const TriangleMesh& triangles, const RepairedMesh& input) const {
    return {triangles, input, curved};
  }
};

void require_links(const Robot& robot, const LinkHullOptions& options) {
  for (const auto& [name, budget] : options.budgets)
    if (std::ranges::find(robot.links, name, &Link::name) == robot.links.end())
      refuse(fmt::format("a budget is for the link '{}', which {} does not have", name, robot.name));
}

/// `of` says which links have the budget.
void require_possible(const std::string& of, const Budget& budget) {
  if (budget.max_distance > 0 && budget.max_distance <= budget.padding)
    refuse(
        fmt::format("{}a hull that keeps a gap of {:g} is farther than {:g} from its link: the largest distance must "
                    "be greater than the gap",
                    of, budget.padding, budget.max_distance));
  if (budget.collision == Collision::Spheres && budget.spheres > kMostCoverBalls)
    refuse(
        fmt::format("{}there are at most {} spheres of a link, not {}", of, grouped(kMostCoverBalls), budget.spheres));
  if (budget.collision == Collision::Hull) return;
  const std::string where = fmt::format("{}collision '{}'", of, prohull::name_of(collision_names(), budget.collision));
  if (budget.padding > 0) refuse(where + " takes no gap; use hulls, or let the planner add it");
  if (budget.faces.size() > 1) refuse(where + " comes in one set; say one number of faces, or use hulls");
}

Plan plan_of(const Robot& robot, std::size_t link, const LinkHullOptions& options, LinkHulls& result) {
  Plan plan{.link = link, .budget = options.budget_of(robot.links[link].name)};
  const std::vector<Shape>& all = shapes(robot.links[link], options.from);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_covered(all[i], plan.budget)) {
      plan.hulled.push_back(all[i]), plan.numbers.push_back(i);
      std::error_code unknown;
      if (const MeshFile* const mesh = all[i].mesh()) plan.bytes += std::filesystem::file_size(mesh->path, unknown);
    } else if (!std::holds_alternative<OtherForm>(all[i].form)) {
      result.primitives.push_back(i);
    }
  }
  result.link = link;
  result.collision = plan.budget.collision;
  // Spheres have no use for a rotation: in the frame of the link nothing is rounded on their way into files.
  if (plan.budget.collision != Collision::Spheres) result.frame = common_frame(plan.hulled);
  if (std::optional<std::size_t>& same = result.frame.same_origin_as) same = plan.numbers[*same];
  result.status = !plan.hulled.empty()        ? LinkStatus::Hulled
                  : result.primitives.empty() ? LinkStatus::Empty
                                              : LinkStatus::Primitives;
  return plan;
}

/// The first mesh whose file was not found; nullptr if all files were found.
const MeshFile* missing_mesh(const Plan& plan) {
  for (const Shape& shape : plan.hulled)
    if (const MeshFile* const mesh = shape.mesh(); mesh && mesh->path.empty()) return mesh;
  return nullptr;
}

const OtherForm* unread_form(std::span<const Shape> all) {
  for (const Shape& shape : all)
    if (const auto* const form = std::get_if<OtherForm>(&shape.form)) return form;
  return nullptr;
}

void leave_as_it_is(LinkHulls& result, LinkStatus status, std::string why) {
  result.status = status;
  result.why = std::move(why);
  result.primitives.clear();
}

/// What the construction says of ConvexCover and SphereCover.
template <class Cover>
LinkHull constructed(const Cover& cover) {
  LinkHull result;
  result.target_reached = true, result.within_bounds = cover.within_bounds;
  result.notes = cover.notes;
  return result;
}

LinkHull link_hull(const ConvexCover& cover) {
  LinkHull result = constructed(cover);
  for (const ConvexPiece& piece : cover.pieces) result.pieces.push_back(piece.mesh);
  return result;
}

LinkHull link_hull(const SphereCover& cover) {
  LinkHull result = constructed(cover);
  result.balls = cover.balls;
  return result;
}

LinkHull link_hull(const EnclosingHull& hull) {
  LinkHull result;
  result.target_faces = hull.target_faces;
  result.target_reached = hull.target_reached, result.within_bounds = hull.within_bounds;
  result.source = prohull::name_of(source_names(), hull.source);
  result.padding = hull.padding;
  result.notes = hull.notes;
  result.mesh = hull.mesh;
  return result;
}

/// What is left for each of the links that are worked on at once; 0 stays: they share all cores then.
unsigned threads_of_each(std::size_t links, unsigned threads) {
  if (links == 0) return threads;
  return threads == 0 ? 0 : std::max(1U, threads / static_cast<unsigned>(workers_for(links, threads)));
}

EnclosingOptions enclosing_options(const Budget& budget, const LinkHullOptions& options, const Progress& go_on) {
  EnclosingOptions enclosing;
  enclosing.hull.relax_guards = true;
  enclosing.hull.threads = options.threads;
  enclosing.hull.float32_coordinates = true;
  if (budget.max_distance > 0) enclosing.bounds.max_distance = budget.max_distance;
  enclosing.padding = budget.padding;
  enclosing.tight = options.tight;
  enclosing.progress = go_on;
  return enclosing;
}

double convex_volume(const JudgedGeometry& geometry) {
  const SolidPieces& parts = geometry.curved.parts;
  const auto of_original = [](const RepairedMesh& input) {
    constexpr double kFlat = 1e-4;  // of the diagonal, as in convex_cover.cpp
    const double volume = signed_volume(convex_hull(input.original));
    return std::cbrt(volume) < kFlat * bounding_box(input.original).diagonal() ? 0 : volume;
  };
  return of_original(parts.empty() ? geometry.input : prepared_for_hulls(with_same_volume(parts)));
}

/// What is told of the geometry within the judged hulls. An exact volume of the triangles may be known from this run's
/// construction.
void describe_input(const JudgedGeometry& geometry, LinkHulls& result, const Progress& go_on) {
  const RepairedMesh& input = geometry.input;
  if (!(result.sealed_volume > 0) || !geometry.curved.parts.empty() || input.repairs.dropped_components > 0) {
    const InsideVolume sealed = sealed_volume(geometry, result.hulls, go_on);
    result.sealed_volume = sealed.volume, result.is_estimated = sealed.is_estimated;
  }
  result.non_finite_faces = input.repairs.dropped_non_finite_faces;
  result.convex_volume = convex_volume(geometry);
  result.repairs = describe(input.repairs);
}

/// They return the repaired geometry.
RepairedMesh build_hulls(const Budget& budget, const LinkHullOptions& options, LinkHulls& result,
                         const Progress& go_on) {
  const EnclosingOptions enclosing = enclosing_options(budget, options, go_on);
  check_float32_spacing(result.triangles);
  EnclosingHulls made = enclosing_hulls(result.triangles, budget.faces, enclosing);
  for (const EnclosingHull& hull : made.hulls) result.hulls.push_back(link_hull(hull));
  if (!made.is_estimated) result.sealed_volume = made.volume;
  return std::move(made.input);
}

ConvexCover pieces_around(const TriangleMesh& triangles, const Budget& budget, const LinkHullOptions& options,
                          const Progress& go_on) {
  ConvexCoverOptions how{.max_pieces = budget.pieces, .max_vertices = budget.vertices};
  if (budget.max_distance > 0) how.bounds.max_distance = budget.max_distance;
  how.float32_coordinates = true;
  how.threads = options.threads, how.progress = go_on;
  return convex_cover(triangles, how);
}

SphereCover balls_around(const TriangleMesh& triangles, const Budget& budget, const LinkHullOptions& options,
                         const Progress& go_on) {
  SphereCoverOptions how{.max_balls = budget.spheres};
  if (budget.max_distance > 0) how.max_distance = budget.max_distance;
  how.threads = options.threads, how.progress = go_on;
  return sphere_cover(triangles, how);
}

template <class Cover>
void take_cover(const Cover& cover, LinkHulls& result) {
  result.hulls.push_back(link_hull(cover));
  if (!cover.is_estimated) result.sealed_volume = cover.original_volume;
}

/// Constructs the hulls, which are not judged yet, and returns the repaired geometry.
RepairedMesh build(const Plan& plan, const LinkHullOptions& options, LinkHulls& result, const Progress& go_on) {
  const Budget budget = plan.budget_of_triangles();
  switch (budget.collision) {
    case Collision::Hull:
      return build_hulls(budget, options, result, go_on);
    case Collision::Convex:
      take_cover(pieces_around(result.triangles, budget, options, go_on), result);
      break;
    case Collision::Spheres:
      take_cover(balls_around(result.triangles, budget, options, go_on), result);
      break;
  }
  return prepared_for_hulls(result.triangles);
}

/// Whether hulls of the cache pass as those of this link.
bool take_proposal(std::vector<LinkHull> proposal, const Plan& plan, LinkHulls& result, const Progress& go_on) {
  const RepairedMesh input = prepared_for_hulls(result.triangles);
  const JudgedGeometry geometry = plan.geometry(result.triangles, input);
  auto hulls = verified(std::move(proposal), geometry, plan.budget, go_on);
  if (!hulls) return false;
  result.hulls = *std::move(hulls);
  describe_input(geometry, result, go_on);
  return true;
}

/// Takes the hulls of a link with the same triangles and budget.
void share_hulls(const LinkHulls& of, LinkHulls& result) {
  result.hulls = of.hulls, result.repairs = of.repairs;
  result.non_finite_faces = of.non_finite_faces;
  result.sealed_volume = of.sealed_volume, result.is_estimated = of.is_estimated;
  result.convex_volume = of.convex_volume;
  result.from_cache = of.from_cache;
}

template <typename Work>
void name_link_in_errors(const Link& link, const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError(error.defect(), fmt::format("link {}: {}", link.name, error.what()));
  }
}

void add_hulls(const Plan& plan, const LinkHullOptions& options, LinkHulls& result, const Progress& go_on) {
  const auto start = std::chrono::steady_clock::now();
  const HullCache cache(options.cache);
  std::optional<std::vector<LinkHull>> kept = cache.find(plan.key);
  result.from_cache = kept && take_proposal(*std::move(kept), plan, result, go_on);
  if (!result.from_cache) {
    const RepairedMesh input = build(plan, options, result, go_on);
    cache.keep(plan.key, result.hulls);
    const JudgedGeometry geometry = plan.geometry(result.triangles, input);
    for (LinkHull& hull : result.hulls) judge(hull, geometry, plan.budget, go_on);
    describe_input(geometry, result, go_on);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Names<Collision> collision_names() {
  static constexpr std::pair<std::string_view, Collision> kNames[]{
      {"hull", Collision::Hull}, {"convex", Collision::Convex}, {"spheres", Collision::Spheres}};
  return kNames;
}

TriangleMesh mesh_of(std::span<const TriangleMesh> pieces, std::span<const Ball> balls, Curved curved) {
  constexpr std::size_t kSegments = 24;  // the mesh is up to 1.8 % larger than the ball
  TriangleMesh mesh;
  for (const TriangleMesh& piece : pieces) append(mesh, piece);
  for (const Ball& ball : balls) append(mesh, CurvedForm::sphere(ball).mesh(curved, kSegments));
  return mesh;
}

const Budget& LinkHullOptions::budget_of(const std::string& link) const {
  const auto own = budgets.find(link);
  return own == budgets.end() ? budget : own->second;
}

std::string_view name_of(LinkStatus status) {
  constexpr std::string_view kNames[]{"hulled", "primitives", "skipped", "unread", "empty"};
  return kNames[static_cast<std::size_t>(status)];
}

bool is_covered(const Shape& shape, const Budget& budget) {
  if (shape.mesh()) return true;
  if (std::holds_alternative<OtherForm>(shape.form)) return false;
  return budget.padding > 0 ||
         (budget.collision == Collision::Spheres && !std::holds_alternative<SphereForm>(shape.form));
}

std::string_view cover_words(std::span<const LinkHulls> links) {
  const auto is_of = [&](Collision kind) {
    return std::ranges::all_of(links,
                               [&](const LinkHulls& link) { return link.hulls.empty() || link.collision == kind; });
  };
  if (is_of(Collision::Hull)) return "hulls";
  if (is_of(Collision::Convex)) return "convex pieces";
  return is_of(Collision::Spheres) ? "spheres" : "collision geometry";
}

void check_budgets(const Robot& robot, const LinkHullOptions& options) {
  require_links(robot, options);
  bool has_hull = robot.links.empty();
  for (const Link& link : robot.links) {
    const Budget& budget = options.budget_of(link.name);
    has_hull |= budget.collision == Collision::Hull;
    const bool is_own = options.budgets.contains(link.name);
    if (!budget.skip) require_possible(is_own ? fmt::format("link {}: ", link.name) : "", budget);
  }
  if (options.tight && !has_hull) refuse("--tight is about hulls; no link has one");
}

std::vector<LinkHulls> link_hulls(const Robot& robot, const LinkHullOptions& options) {
  check_budgets(robot, options);
  std::vector<LinkHulls> results(robot.links.size());
  std::vector<Plan> plans;
  std::string missing;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    Plan plan = plan_of(robot, i, options, results[i]);
    if (plan.budget.skip) {
      leave_as_it_is(results[i], LinkStatus::Skipped, "as its budget says");
    } else if (const OtherForm* const form = unread_form(shapes(robot.links[i], options.from))) {
      leave_as_it_is(results[i], LinkStatus::Unread, fmt::format("its geometry of type {} is not read", form->what));
    } else if (const MeshFile* const mesh = missing_mesh(plan)) {
      missing += fmt::format("{}link {}: {}", missing.empty() ? "" : "; ", robot.links[i].name, mesh->why_not);
      leave_as_it_is(results[i], LinkStatus::Skipped, mesh->why_not);
    } else if (results[i].status == LinkStatus::Hulled) {
      plans.push_back(std::move(plan));
    }
  }
  if (!missing.empty() && !options.skip_missing)
    throw InputError(
        Defect::CannotRead,
        fmt::format("{}: mesh files were not found: {}; say where packages are by --package-path, or leave "
                    "these links as they are by --skip-missing",
                    robot.name, missing));
  // The largest first, so that none of them is left alone in the end.
  std::ranges::stable_sort(plans, std::greater(), &Plan::bytes);
  const auto names_of = [&](const auto& some) {
    std::vector<std::string> names;
    for (const Plan* plan : some) names.push_back(robot.links[plan->link].name);
    return names;
  };
  std::vector<Plan*> all;
  for (Plan& plan : plans) all.push_back(&plan);
  side_by_side(names_of(all), options.threads, {}, [&](std::size_t i, const Progress&) {
    Plan& plan = *all[i];
    LinkHulls& result = results[plan.link];
    name_link_in_errors(robot.links[plan.link], [&] {
      LinkGeometry geometry = link_geometry(plan.hulled, result.frame);
      result.triangles = std::move(geometry.triangles), plan.curved = std::move(geometry.curved);
    });
    plan.key = key_of(result.triangles, plan.budget_of_triangles(), options);
  });
  // Links with the same geometry, as wheels and fingers are, share their hulls.
  std::map<std::string_view, const Plan*> first;
  std::vector<const Plan*> to_build;
  const auto shares = [&](const Plan& plan) {
    const Plan& other = *first.try_emplace(plan.key, &plan).first->second;
    return &other != &plan && results[other.link].triangles == results[plan.link].triangles &&
           other.curved.parts.curved == plan.curved.parts.curved;
  };
  for (const Plan& plan : plans)
    if (!shares(plan)) to_build.push_back(&plan);
  LinkHullOptions of_each = options;
  of_each.threads = threads_of_each(to_build.size(), options.threads);
  side_by_side(names_of(to_build), options.threads, options.progress, [&](std::size_t i, const Progress& go_on) {
    const Plan& plan = *to_build[i];
    name_link_in_errors(robot.links[plan.link], [&] { add_hulls(plan, of_each, results[plan.link], go_on); });
  });
  for (const Plan& plan : plans)
    if (shares(plan)) share_hulls(results[first.at(plan.key)->link], results[plan.link]);
  return results;
}

}  // namespace prohull::robot
