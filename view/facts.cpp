#include "view/facts.h"

#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull::view {
namespace {

constexpr std::size_t kMostOffenders = 20;

nlohmann::json facts_of(const Vec3& p) { return {p.x, p.y, p.z}; }

nlohmann::json facts_of(const std::vector<Offender>& worst) {
  nlohmann::json all = nlohmann::json::array();
  for (const Offender& o : worst)
    all.push_back({{"face", index(o.face)}, {"point", facts_of(o.point)}, {"distance", o.distance}});
  return all;
}

Verification verify(const Shown& hull, const TriangleMesh& original, const PageOptions& options) {
  const VerificationOptions how{
      .solid_only = options.solid_only, .max_offenders = kMostOffenders, .progress = options.progress};
  const auto* const levels = std::get_if<ProgressiveHull>(&hull.shape);
  return levels ? verify_hull(*levels, original, how)
                : verify_hull(std::get<TriangleMesh>(hull.shape), original, options.side, how);
}

nlohmann::json facts_of(const Verification& found) {
  return {{"encloses", found.encloses},
          {"proof", std::string(found.proof)},
          {"side", std::string(name_of(hull_side_names(), found.side))},
          {"original_closed", found.original_closed},
          {"every_triangle", found.every_triangle},
          {"why_not", found.why_not},
          {"splits", found.splits},
          {"signs", found.signs},
          {"faces_outside", found.faces_outside},
          {"worst", facts_of(found.worst)},
          {"faces_beside_solid", found.faces_beside_solid},
          {"hull_volume", found.hull_volume},
          {"original_volume", found.original_volume},
          {"void_ratio", found.void_ratio},
          {"self_intersections", found.self_intersections},
          {"notes", found.notes}};
}

}  // namespace

nlohmann::json verification_facts(const Shown& hull, const TriangleMesh& original, const PageOptions& options) {
  try {
    return facts_of(verify(hull, original, options));
  } catch (const InputError& error) {
    return {{"refused", error.what()}};
  }
}

nlohmann::json distance_facts(const TriangleMesh& from, const TriangleMesh& to, const PageOptions& options) {
  const DistanceBounds bounds =
      distance_bounds(from, to, {.relative_gap = 0.02, .max_cells = 300'000, .progress = options.progress});
  return {{"lower", bounds.lower}, {"upper", bounds.upper}, {"farthest", facts_of(bounds.farthest)}};
}

nlohmann::json mesh_facts(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  nlohmann::json defects = nlohmann::json::array();
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0) defects.push_back({{"what", std::string(defect.description)}, {"count", defect.count}});
  return {
      {"faces", report.faces},
      {"vertices", report.vertices},
      {"components", report.components},
      {"watertight", report.is_watertight()},
      {"volume", report.is_watertight() ? nlohmann::json(report.volume) : nlohmann::json()},
      {"size",
       {report.box.max.x - report.box.min.x, report.box.max.y - report.box.min.y, report.box.max.z - report.box.min.z}},
      {"defects", defects},
      {"first_defect", report.first_defect}};
}

}  // namespace prohull::view
