#include "enclose/request.h"

#include <fmt/format.h>

#include <utility>

#include "enclose/tolerances.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/tolerances.h"

namespace prohull {

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
  if (input.caps.face_count() > 0) {
    with_caps = input.original;
    append(with_caps, input.caps);
  }
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

namespace {

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
