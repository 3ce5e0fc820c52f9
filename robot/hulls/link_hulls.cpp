#include "robot/hulls/link_hulls.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <system_error>
#include <utility>

#include "prohull/convex_hull.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/mesh_io.h"
#include "robot/hulls/cache.h"
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
};

void require_links(const Robot& robot, const LinkHullOptions& options) {
  for (const auto& [name, budget] : options.budgets)
    if (std::ranges::find(robot.links, name, &Link::name) == robot.links.end())
      throw InputError(Defect::InvalidOption,
                       fmt::format("a budget is for the link '{}', which {} does not have", name, robot.name));
}

/// Padded hulls enclose primitives too, which would not be padded themselves.
bool is_hulled(const Shape& shape, const Budget& budget) {
  return shape.mesh() || (budget.padding > 0 && !std::holds_alternative<OtherForm>(shape.form));
}

Plan plan_of(const Robot& robot, std::size_t link, const LinkHullOptions& options, LinkHulls& result) {
  Plan plan{.link = link, .budget = options.budget_of(robot.links[link].name)};
  const std::vector<Shape>& all = shapes(robot.links[link], options.from);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_hulled(all[i], plan.budget)) {
      plan.hulled.push_back(all[i]), plan.numbers.push_back(i);
      std::error_code unknown;
      if (const MeshFile* const mesh = all[i].mesh()) plan.bytes += std::filesystem::file_size(mesh->path, unknown);
    } else if (!std::holds_alternative<OtherForm>(all[i].form)) {
      result.primitives.push_back(i);
    }
  }
  result.link = link;
  result.frame = common_frame(plan.hulled);
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

LinkHull link_hull(const EnclosingHulls& made, const EnclosingHull& hull, const Progress& go_on) {
  LinkHull result;
  result.target_faces = hull.target_faces;
  result.certified = hull.certified;
  result.proof = hull.proof;
  result.target_reached = hull.target_reached, result.within_bounds = hull.within_bounds;
  result.source = prohull::name_of(source_names(), hull.source);
  result.volume = signed_volume(hull.mesh);
  const TriangleMesh& measured_from = made.input.closed ? made.input.closed->mesh : triangles_to_cover(made, hull);
  result.distance = distance_bounds(hull.mesh, measured_from, {.progress = go_on});
  result.padding = hull.padding;
  result.self_intersections = hull.self_intersections;
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
  enclosing.hull.float32_coordinates = stores_float32(mesh_format("hull." + options.format));
  if (budget.max_distance > 0) enclosing.bounds.max_distance = budget.max_distance;
  enclosing.padding = budget.padding;
  enclosing.tight = options.tight;
  enclosing.progress = go_on;
  return enclosing;
}

void build(const Plan& plan, const LinkHullOptions& options, LinkHulls& result, const Progress& go_on) {
  const EnclosingOptions enclosing = enclosing_options(plan.budget, options, go_on);
  if (enclosing.hull.float32_coordinates) check_float32_spacing(result.triangles);
  const EnclosingHulls made = enclosing_hulls(result.triangles, plan.budget.faces, enclosing);
  for (const EnclosingHull& hull : made.hulls) result.hulls.push_back(link_hull(made, hull, go_on));
  result.sealed_volume = made.volume;
  result.convex_volume = signed_volume(convex_hull(made.input.original));
  result.repairs = describe(made.input.repairs);
}

void add_hulls(const Link& link, const Plan& plan, const LinkHullOptions& options, LinkHulls& result,
               const Progress& go_on) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const HullCache cache(options.cache);
    const std::string key = options.cache.empty() ? "" : key_of(link, plan.budget, options);
    result.triangles = link_triangles(plan.hulled, result.frame);
    if (std::optional<LinkHulls> kept = cache.find(key)) {
      result.hulls = std::move(kept->hulls), result.repairs = std::move(kept->repairs);
      result.sealed_volume = kept->sealed_volume, result.convex_volume = kept->convex_volume;
      result.from_cache = true;
    } else {
      build(plan, options, result, go_on);
      cache.keep(key, result);
    }
  } catch (const InputError& error) {
    throw InputError(error.defect(), fmt::format("link {}: {}", link.name, error.what()));
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

const Budget& LinkHullOptions::budget_of(const std::string& link) const {
  const auto own = budgets.find(link);
  return own == budgets.end() ? budget : own->second;
}

std::string_view name_of(LinkStatus status) {
  switch (status) {
    case LinkStatus::Hulled:
      return "hulled";
    case LinkStatus::Primitives:
      return "primitives";
    case LinkStatus::Skipped:
      return "skipped";
    case LinkStatus::Unread:
      return "unread";
    case LinkStatus::Empty:
      return "empty";
  }
  return "";
}

std::vector<LinkHulls> link_hulls(const Robot& robot, const LinkHullOptions& options) {
  require_links(robot, options);
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
      missing += fmt::format("\n  link {}: {}", robot.links[i].name, mesh->why_not);
      leave_as_it_is(results[i], LinkStatus::Skipped, mesh->why_not);
    } else if (results[i].status == LinkStatus::Hulled) {
      plans.push_back(std::move(plan));
    }
  }
  if (!missing.empty() && !options.skip_missing)
    throw InputError(Defect::CannotRead,
                     fmt::format("{}: mesh files were not found:{}\nSay where packages are by --package-path, or leave "
                                 "these links as they are by --skip-missing",
                                 robot.name, missing));
  // The largest first, so that none of them is left alone in the end.
  std::ranges::stable_sort(plans, std::greater(), &Plan::bytes);
  std::vector<std::string> names;
  for (const Plan& plan : plans) names.push_back(robot.links[plan.link].name);
  LinkHullOptions of_each = options;
  of_each.threads = threads_of_each(plans.size(), options.threads);
  side_by_side(names, options.threads, options.progress, [&](std::size_t i, const Progress& go_on) {
    add_hulls(robot.links[plans[i].link], plans[i], of_each, results[plans[i].link], go_on);
  });
  return results;
}

}  // namespace prohull::robot
