#include "view/facts.h"

#include "prohull/detail/summary.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/union_verification.h"
#include "robot/json.h"

namespace prohull::view {
namespace {

constexpr std::size_t kMostOffenders = 20;

/// The answer in the words of `prohull verify`: `told` is a claim(), and `why_not` follows where it is not yes.
/// `volume` is that of what is shown.
template <class Found>
nlohmann::json facts_of(const Found& found, const std::string& told, double volume) {
  return {{"answer", found.certified        ? "yes"
                     : found.is_undecided() ? "undecided"
                                            : "no"},
          {"told", told + (found.is_yes() && !found.certified ? ", but there is more" : "")},
          {"why_not", found.why_not},
          {"proof", std::string(found.proof)},
          {"encloses", found.certified},
          {"faces_outside", found.faces_outside},
          {"worst", found.worst},
          {"hull_volume", volume},
          {"original_volume", found.original_volume},
          {"void_ratio", found.void_ratio},
          {"notes", found.notes}};
}

/// Verifies whatever is shown.
struct Verify {
  nlohmann::json operator()(const TriangleMesh& hull) const {
    return of_hull(verify_hull(hull, original.mesh, shown.side.value_or(side), how));
  }
  nlohmann::json operator()(const ProgressiveHull& hull) const {
    return of_hull(verify_hull(hull, original.mesh, how));
  }
  nlohmann::json operator()(const Pieces& pieces) const {
    return of_union(verify_union(pieces, original.mesh, how), counted(pieces.size(), "piece"));
  }
  nlohmann::json operator()(const Balls& balls) const {
    return of_union(verify_union(balls, original.mesh, false, how), counted(balls.size(), "sphere"));
  }
  nlohmann::json operator()(const ShownRobot&) const { return {}; }

  nlohmann::json of_hull(const Verification& found) const {
    nlohmann::json facts = facts_of(found, claim(found, shown.name, original.name), found.hull_volume);
    facts.update({{"side", std::string(name_of(hull_side_names(), found.side))},
                  {"every_level", is_of_every_level(found)},
                  {"solid_only", found.covers_triangles == Answer::NotAsked},
                  {"splits", found.splits},
                  {"signs", found.signs}});
    if (has_failed_replay(found))
      facts["answer"] = "no";
    else
      facts["self_intersections"] = found.self_intersections;
    return facts;
  }
  nlohmann::json of_union(const UnionVerification& found, const std::string& parts) const {
    return facts_of(found, claim(found, "the union of " + parts, original.name), found.union_volume);
  }

  const Shown& shown;
  const Original& original;
  HullSide side;
  VerificationOptions how;
};

DistanceOptions distance_options(const PageOptions& options) {
  return {.relative_gap = 0.02, .max_cells = 300'000, .progress = options.progress};
}

/// Overlaps count once; null if that takes too long. Of a mesh that is inside out, its signed volume.
nlohmann::json volume_of(const TriangleMesh& mesh, double signed_volume) {
  if (signed_volume < 0) return signed_volume;
  const auto inside = solid_volume(mesh);
  return inside ? nlohmann::json(*inside) : nlohmann::json();
}

nlohmann::json facts_of(const DistanceBounds& bounds) {
  return {{"lower", bounds.lower}, {"upper", bounds.upper}, {"farthest", bounds.farthest}};
}

}  // namespace

nlohmann::json verification_facts(const Shown& shown, const Original& original, const PageOptions& options) {
  const VerificationOptions how{
      .solid_only = options.solid_only, .max_offenders = kMostOffenders, .progress = options.progress};
  try {
    return std::visit(Verify{shown, original, options.side, how}, shown.shape);
  } catch (const InputError& error) {
    return {{"refused", error.what()}};
  }
}

nlohmann::json distance_facts(const TriangleMesh& from, const TriangleMesh& to, const PageOptions& options) {
  return facts_of(distance_bounds(from, to, distance_options(options)));
}

nlohmann::json distance_facts(const Pieces& from, const TriangleMesh& to, const PageOptions& options) {
  return facts_of(union_reach(from, to, distance_options(options)));
}

nlohmann::json distance_facts(const Balls& from, const TriangleMesh& to, const PageOptions& options) {
  return facts_of(union_reach(from, to, distance_options(options)));
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
      {"volume", report.is_watertight() ? volume_of(mesh, report.volume) : nlohmann::json()},
      {"size",
       {report.box.max.x - report.box.min.x, report.box.max.y - report.box.min.y, report.box.max.z - report.box.min.z}},
      {"defects", defects},
      {"first_defect", report.first_defect}};
}

}  // namespace prohull::view
