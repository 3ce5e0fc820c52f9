#include "enclose/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/triangle_key.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/tolerances.h"

namespace prohull {
namespace {

bool may_vanish(const Triangle& t) {
  return !is_finite(t.a) || !is_finite(t.b) || !is_finite(t.c) || t.a == t.b || t.b == t.c || t.c == t.a;
}

struct Wanted {
  TriangleKey key;
  double tolerance;
  bool is_found = false;
};

/// The tolerances of the faces of `given` for the faces of `repaired`, which are the same but for repairs: a face has
/// the least tolerance of those at its place. Faces that a repair has added may be at any distance. Throws
/// InputError(InvalidOption) if a face with a tolerance has no counterpart, unless it has no area or is not finite.
PerFace<double> carried_tolerances(const TriangleMesh& given, const PerFace<double>& tolerances,
                                   const TriangleMesh& repaired) {
  std::vector<Wanted> wanted;
  for (const FaceId f : given.triangles.ids())
    if (!(tolerances[f] == std::numeric_limits<double>::infinity()) && !may_vanish(given.triangle(f)))
      wanted.push_back({unoriented_key(given.triangle(f)), tolerances[f]});
  std::ranges::sort(wanted, [](const Wanted& a, const Wanted& b) {
    return a.key != b.key ? a.key < b.key : a.tolerance < b.tolerance;
  });
  PerFace<double> carried(repaired.face_count(), std::numeric_limits<double>::infinity());
  for (const FaceId f : repaired.triangles.ids()) {
    const TriangleKey key = unoriented_key(repaired.triangle(f));
    const auto first = std::ranges::lower_bound(wanted, key, {}, &Wanted::key);
    if (first == wanted.end() || first->key != key) continue;
    carried[f] = first->tolerance;
    for (auto same = first; same != wanted.end() && same->key == key; ++same) same->is_found = true;
  }
  if (const auto lost = static_cast<std::size_t>(std::ranges::count(wanted, false, &Wanted::is_found)); lost > 0)
    refuse(
        fmt::format("{} with a tolerance {} not left after the repair, which drops parts inside of other "
                    "parts; --keep-cavities keeps these",
                    counted(lost, "face"), lost == 1 ? "is" : "are"));
  return carried;
}

/// What to do where a hull was changed after it was built.
std::string why_changed(const EnclosingOptions& options, const char* or_else) {
  if (options.hull.float32_coordinates)
    return "the file has float32 coordinates, which move vertices a little; write a .ply, .obj or .off file, which "
           "keep doubles";
  return std::string(
             "where the mesh intersects itself, vertices of the hull are lifted over its folds: remove the "
             "folds") +
         or_else;
}

}  // namespace

Request::Request(TriangleMesh triangles, std::size_t fewest, const EnclosingOptions& how)
    : options(how), fewest_faces(fewest) {
  const Stopwatch watch;
  ProgressMeter(options.progress, "repair").at(0);
  const TriangleMesh given = has_tolerances() ? triangles : TriangleMesh{};
  input = prepared_for_hulls(std::move(triangles), options);
  const auto require_closed = [&](const char* why) {
    if (!input.closed) throw InputError(Defect::OpenEdge, input.obstacle + "; " + why);
  };
  if (is_symmetric()) require_closed("only a closed mesh has symmetric hulls");
  if (has_tolerances()) {
    require_closed("faces have tolerances, and only a closed mesh still has these faces");
    tolerances = carried_tolerances(given, options.hull.tolerances, input.closed->mesh);
  }
  diagonal = bounding_box(input.original).diagonal();
  if (input.caps.face_count() > 0) with_caps = input.with_caps();
  repair_seconds = watch.seconds();
}

HullOptions Request::hull_options(std::size_t target_faces, std::uint64_t seed) const {
  HullOptions hull = options.hull;
  hull.target_faces = target_faces;
  hull.seed = seed;
  hull.tolerances = tolerances;
  hull.progress = options.progress;
  return hull;
}

MoveOptions Request::move_options(unsigned max_rounds) const {
  const HullOptions& hull = options.hull;
  return {.guards = hull.guards,
          .float32_coordinates = hull.float32_coordinates,
          .max_rounds = max_rounds,
          .padding = aim(),
          .side = hull.side,
          .threads = hull.threads,
          .progress = options.progress};
}

void Request::require_tolerances(const TriangleMesh& hull) const {
  const ToleranceReport found = verify_tolerances(hull, input.closed->mesh, tolerances, options.progress);
  if (found.holds) return;
  const std::string what =
      found.missing_faces > 0
          ? fmt::format("{} that should be kept {} not in the hull", counted(found.missing_faces, "face"),
                        found.missing_faces == 1 ? "is" : "are")
          : fmt::format("{} farther from the hull than allowed", counted(found.far_faces, "face is", "faces are"));
  throw InputError(Defect::NoCertificate, what + ": " + why_changed(options, ", or allow a small distance there"));
}

void Request::require_symmetry(const TriangleMesh& hull) const {
  const SymmetryReport found = inspect_symmetry(hull, *options.hull.mirror);
  if (!found.is_symmetric())
    throw InputError(Defect::NoCertificate,
                     "the hull is not symmetric: " + found.first_defect + "; " + why_changed(options, ""));
}

}  // namespace prohull
