#include "prohull/detail/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prohull/detail/rounded.h"
#include "prohull/detail/symmetry.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

constexpr double kRadiansOfDegree = std::numbers::pi / 180;

/// What makes a solid of an original that is not closed; empty if it is closed.
std::string caps_of(const Verdict& verdict) {
  if (verdict.original_closed) return "";
  if (verdict.cap_faces == 0) return " after repairs";
  return fmt::format(" with its openings closed by {}", counted(verdict.cap_faces, "face", "faces"));
}

std::string described(const MeshQuality& quality) {
  return fmt::format(
      "median compactness {:.2f}, worst {:.2g}; {} of {} edges sharp, worst dihedral angle {:.3g} degrees",
      quality.compactness.median, quality.compactness.worst, grouped(quality.sharp_edges), grouped(quality.edges),
      quality.dihedral_angle.worst / kRadiansOfDegree);
}

/// Not what it is made of: repairs change the mesh, and the convex hull may have become a slab, or a polytope of fewer
/// faces around it.
std::string solid_name(const ToldHull& told, const Solid& solid) {
  if (solid.source == Source::ConvexHull) return "the convex solid that it is built from";
  const bool is_changed = told.made.input.repairs.any() || solid.folds.faces > 0;
  return solid.source == Source::Mesh && is_changed ? "the repaired mesh" : source_of(solid);
}

/// A closed mesh has none: wraps close passages between its parts.
const char* openings_of(const ToldHull& told) {
  const RepairedMesh& input = told.made.input;
  return input.closed && input.caps.face_count() == 0 ? "passages that the wrap closed" : "its openings";
}

std::string described_self_intersections(const ToldHull& told) {
  const std::size_t input = told.input_self_intersections, own = told.hull.self_intersections;
  const Solid& first = told.made.solids.front();  // what was looked at, if it is of the mesh
  const std::string mesh = first.source == Source::Mesh ? solid_name(told, first) : "the mesh";
  if (own == 0)
    return input == 0 ? "none" : fmt::format("none ({}: {})", mesh, counted(input, "pair of faces", "pairs of faces"));
  return fmt::format("{} ({}: {}; added: {})", counted(own, "pair of faces", "pairs of faces"), mesh, grouped(input),
                     grouped(told.added_self_intersections()));
}

// What no collapse changes. A closed surface with h handles has an Euler characteristic of 2 - 2 h.
std::string described_topology(const TriangleMesh& hull) {
  const MeshReport report = inspect(hull);
  const auto handles = static_cast<std::size_t>(static_cast<long>(report.components) - report.euler_characteristic / 2);
  return fmt::format("{} and {}", counted(report.components, "component", "components"),
                     counted(handles, "handle", "handles"));
}

std::string described_guards(const EnclosingHull& hull) {
  const ShapeGuards& guards = kRelaxedGuards[hull.relaxed_guards - 1];
  return fmt::format(
      "shape guards relaxed{}: normals may turn by {:.0f} degrees{}, step {} of {}",
      hull.mesh.face_count() <= hull.target_faces ? " to reach it" : "", guards.max_normal_deviation / kRadiansOfDegree,
      std::isfinite(guards.max_overhang) ? "" : " and spikes are allowed", hull.relaxed_guards, kRelaxedGuards.size());
}

/// Of several bounds that which is missed by most, and what to do.
std::string missed_bound(const ToldHull& told) {
  constexpr double kRounding = 1e-9;
  const HullBounds& bounds = told.options.bounds;
  const bool is_of_distance = std::isfinite(bounds.max_distance), is_of_added = std::isfinite(bounds.max_added_volume),
             is_of_void = std::isfinite(bounds.max_void_ratio);
  const double used_of_void = std::abs(told.hull.void_ratio) / bounds.max_void_ratio;
  if (is_of_distance + is_of_added + is_of_void == 1)
    return fmt::format("{}; allow that much", is_of_distance ? "distance" : is_of_added ? "added volume" : "void");
  const bool is_void_known = !is_of_void || !std::isnan(used_of_void);
  return fmt::format("{}; allow at least that much", used_of_void >= (1 - kRounding) * told.hull.excess ? "void"
                                                     : is_void_known && !is_of_added                    ? "distance"
                                                     : is_void_known && !is_of_distance                 ? "added volume"
                                                                                        : "value of one of them");
}

std::string line_of_missed_bounds(const ToldHull& told) {
  constexpr double kFar = 1e4;
  const double missing = told.hull.excess - 1;
  const bool is_open = !told.made.input.closed || told.measures.has_openings;
  std::string line = "NOT within the bounds asked for: of all that was tried, this hull misses them least";
  line += missing > kFar
              ? fmt::format(", by more than {:.0f} %", 100 * kFar)
              : fmt::format(", by {:.3g} % of the largest {}", rounded_up(100 * missing, 3), missed_bound(told));
  if (is_open || told.input_self_intersections > 0)
    line += fmt::format("{} mend the mesh where it {}", missing > kFar ? ";" : ", or",
                        is_open ? "is open or intersects itself" : "intersects itself");
  return line;
}

std::string certificate_of(const ToldLevel& told) {
  if (!told.found) return "yes, the file as written is the finest level";
  const Verification& found = *told.found;
  const std::string what = claim(found, "the file as written", "the finest level");
  if (found.certified) return "yes, " + what;
  if (found.faces_outside == 0) return fmt::format("no, {}: {}", what, found.why_not);
  return fmt::format("no, {}, of which {} {} not covered, at least in part: {}", what,
                     counted(found.faces_outside, "face"), found.faces_outside == 1 ? "is" : "are", found.why_not);
}

/// What a row of the table has to say behind its yes.
std::string caveats_of(const EnclosingHull& hull, const Verdict& verdict) {
  std::string text;
  if (!hull.within_bounds) text += ", NOT within the bounds";
  if (const std::size_t dropped = verdict.non_finite_faces; dropped > 0)
    text += fmt::format(", of finite triangles ({} {} not)", grouped(dropped), dropped == 1 ? "is" : "are");
  if (verdict.cap_faces > 0 && verdict.distance_to_triangles)
    text += fmt::format(", with openings closed ({:.4g} from the triangles alone)",
                        rounded_up(verdict.distance_to_triangles->upper, 4));
  return text;
}

}  // namespace

std::string claim(const Verdict& verdict, const std::string& subject, const std::string& object) {
  const bool is_yes = verdict.is_yes(), is_open = !is_yes && !verdict.is_any(Answer::No);
  const bool asks_triangles = verdict.covers_triangles != Answer::NotAsked;
  const std::string finite = verdict.non_finite_faces == 0 ? "" : "finite ";
  const std::string of_finite = finite.empty() ? "" : "the finite triangles of ";
  const std::string solid_of = asks_triangles ? "" : "the solid of ";
  if (verdict.side == HullSide::Inner)
    return fmt::format("{}{} {} enclosed by {}{}{}", solid_of, subject,
                       is_yes    ? "is"
                       : is_open ? "may be"
                                 : "is not",
                       of_finite, object, caps_of(verdict));
  const bool asks_solid = verdict.encloses_solid != Answer::NotAsked;
  if (asks_solid && (verdict.original_closed || !asks_triangles))
    return fmt::format("{} {} {}{}{}{}", subject,
                       is_yes    ? "encloses"
                       : is_open ? "may enclose"
                                 : "does not enclose",
                       solid_of, of_finite, object, caps_of(verdict));
  return fmt::format("{} {} every {}triangle of {}{}{}", subject,
                     is_yes    ? "covers"
                     : is_open ? "may cover"
                               : "does not cover",
                     finite, object, asks_solid ? ", and its inside" : "", asks_solid ? caps_of(verdict) : "");
}

std::string claim(const Verification& found, const std::string& hull, const std::string& original) {
  const Verdict& verdict = found;
  if (found.proof != "replay") return claim(verdict, hull, original);
  if (has_failed_replay(found)) return fmt::format("{} proves nothing about {}", hull, original);
  if (is_of_every_level(found)) return claim(verdict, "every level of " + hull, original);
  const bool has_solids = found.encloses && found.encloses_solid != Answer::NotAsked;
  return claim(verdict, "the base mesh of " + hull, original) + (!has_solids ? ""
                                                                 : found.side == HullSide::Inner
                                                                     ? ", and the solid of every level"
                                                                     : ", and every level its solid");
}

bool is_of_every_level(const Verification& found) { return found.encloses && found.faces_beside_solid == 0; }

bool has_failed_replay(const Verification& found) {
  return found.proof == "replay" && !found.encloses && std::isnan(found.hull_volume);
}

std::string certificate_of(const Verdict& verdict, const std::string& subject, const std::string& object) {
  if (verdict.certified) return "yes, " + claim(verdict, subject, object);
  return "NO, so nothing was written: " + verdict.why_not;
}

std::string text_of_void(double void_ratio) {
  return std::isnan(void_ratio) ? "" : ", void " + percent_text(void_ratio, 3);
}

std::string described_void(const EnclosingHulls& made, const EnclosingHull& hull) {
  if (std::isnan(hull.void_ratio)) return fmt::format(", volume {:.4g}", volume_of(hull));
  return text_of_void(hull.void_ratio) + (made.is_estimated ? " (estimated)" : "");
}

std::string text_of_openings(bool has_openings, const DistanceBounds& from_triangles, const char* openings) {
  if (!has_openings) return "";
  return fmt::format("; {} count as closed, and from its triangles alone it is at most {:.4g}", openings,
                     rounded_up(from_triangles.upper, 4));
}

Verification of_file(Verification found, const RepairedMesh& input) {
  found.non_finite_faces = input.repairs.dropped_non_finite_faces;
  return found;
}

Verdict as_written(Verdict verdict, bool holds_bits) {
  if (verdict.certified && !holds_bits)
    verdict.certified = false, verdict.why_not = "the file does not keep its coordinates; write .ply, .obj or .off";
  return verdict;
}

std::string described_finest_level(FinestLevel finest_level) {
  switch (finest_level) {
    case FinestLevel::Repaired:
      return "the input after repairs";
    case FinestLevel::ConvexHull:
      return "the convex hull of the input";
    case FinestLevel::Wrap:
      return "a wrap of the input";
    default:
      return "";
  }
}

std::string source_of(const Solid& solid) {
  switch (solid.source) {
    case Source::Mesh:
      return "the mesh";
    case Source::ConvexHull:
      return "a convex solid";
    default:
      return fmt::format("a wrap with a spacing of {:.4g}", solid.wrap_spacing);
  }
}

HullMeasures measures_of(const EnclosingHulls& made, const EnclosingHull& hull, const HullBounds& bounds,
                         const Progress& progress) {
  HullMeasures found;
  const DistanceOptions how{.decides = bounds.max_distance, .progress = progress};
  found.has_openings = made.input.caps.face_count() > 0 || made.solids[hull.solid].doors.face_count() > 0;
  found.verdict = hull.verdict;
  found.verdict.certified = hull.certified;
  found.verdict.distance_to_triangles = distance_bounds(hull.mesh, made.input.original, how);
  if (found.has_openings)
    found.verdict.distance_to_solid = distance_bounds(hull.mesh, triangles_to_cover(made, hull), how);
  else if (made.input.closed)
    found.verdict.distance_to_solid = found.verdict.distance_to_triangles;
  found.quality = mesh_quality(hull.mesh);
  return found;
}

std::size_t self_intersections_of_input(const EnclosingHulls& made) {
  const Solid& first = made.solids.front();
  return first.source == Source::Mesh ? first.self_intersections : count_self_intersections(made.input.original);
}

std::size_t ToldHull::added_self_intersections() const {
  return hull.self_intersections - std::min(hull.self_intersections, input_self_intersections);
}

std::string line_of_input(const std::string& name, const RepairedMesh& input) {
  return fmt::format("{}: {}, {}", name, counted(input.found.faces, "face", "faces"),
                     counted(input.found.components, "component", "components"));
}

std::vector<std::string> lines_of_repairs(const RepairedMesh& input) {
  std::vector<std::string> lines = describe(input.repairs);
  if (!input.closed) lines.push_back("bounds no solid: " + input.obstacle);
  return lines;
}

std::string line_of_hull(const std::string& name, const ToldHull& told) {
  const EnclosingHull& hull = told.hull;
  return fmt::format(
      "{}: {} hull of {}{}{}, at most {:.4g} from the mesh{}", name, name_of(hull_side_names(), told.options.hull.side),
      counted(hull.mesh.face_count(), "face", "faces"),
      hull.source == Source::Mesh ? "" : fmt::format(", of {}", source_of(told.solid())),
      described_void(told.made, hull), rounded_up(told.measures.verdict.distance().upper, 4),
      text_of_openings(told.measures.has_openings, *told.measures.verdict.distance_to_triangles, openings_of(told)));
}

std::vector<std::string> lines_of_shape(const ToldHull& told) {
  const EnclosingHull& hull = told.hull;
  std::vector<std::string> lines{"self-intersections: " + described_self_intersections(told),
                                 "triangles: " + described(told.measures.quality)};
  const TriangleMesh& solid = told.solid().mesh;
  if (hull.mesh.face_count() == solid.face_count() && hull.mesh.face_count() <= hull.target_faces) {
    const std::string name = solid_name(told, told.solid());
    lines.push_back(fmt::format("{} has no more faces than were asked for: the hull is {}", name,
                                hull.source == Source::Mesh && has_triangles_of(hull.mesh, solid)
                                    ? name + " itself"
                                    : "simplified no further"));
  }
  return lines;
}

std::vector<std::string> lines_of_limits(const ToldHull& told) {
  const EnclosingHull& hull = told.hull;
  std::vector<std::string> lines;
  if (const auto axis = told.options.hull.mirror)
    lines.push_back(fmt::format("symmetric: exactly its own mirror image in the plane {} = {:g}",
                                name_of(axis_names(), *axis), inspect_symmetry(hull.mesh, *axis).plane));
  if (hull.rounded_vertices > 0)
    lines.push_back(fmt::format("moved {} to coordinates that the file keeps",
                                counted(hull.rounded_vertices, "vertex", "vertices")));
  if (hull.relaxed_guards > 0) lines.push_back(described_guards(hull));
  if (!hull.target_reached)
    lines.push_back(fmt::format("no legal collapse is left above the {} faces asked for: {}; of the {} edges left{}",
                                grouped(hull.target_faces), described_topology(hull.mesh),
                                grouped(3 * hull.mesh.face_count() / 2), describe_refusals(hull.blocked, ", ")));
  if (!hull.within_bounds) lines.push_back(line_of_missed_bounds(told));
  return lines;
}

std::vector<std::string> lines_of_proof(const Verdict& verdict) {
  std::vector<std::string> lines{"certified: " + certificate_of(verdict)};
  if (verdict.certified && verdict.gap)
    lines.push_back(fmt::format("gap: the least distance from the mesh is at least {:.6g}, proven{}",
                                rounded_down(*verdict.gap, 6),
                                verdict.side == HullSide::Outer ? "; all points within it are inside" : ""));
  return lines;
}

std::array<std::string, kTableHead.size()> cells_of_hull(const ToldHull& told, const Verdict& verdict) {
  const EnclosingHull& hull = told.hull;
  return {grouped(told.made.input.found.faces), grouped(hull.mesh.face_count()),
          std::isnan(hull.void_ratio) ? "" : percent_text(hull.void_ratio, 2),
          fmt::format("{:.4g}", rounded_up(verdict.distance().upper, 4)),
          verdict.certified ? "yes" + caveats_of(hull, verdict) : "NO"};
}

std::vector<std::string> lines_of_level(const std::string& name, const ToldLevel& told) {
  std::vector<std::string> lines{fmt::format(
      "{}: {} of {}{}", name, counted(told.faces, "face"), grouped(told.hull.original_face_count()),
      told.target_faces != 0 && told.faces > told.target_faces ? ", which is the coarsest level of the file" : "")};
  if (const std::string finest = described_finest_level(told.hull.finest_level()); !finest.empty())
    lines.push_back(fmt::format("the finest level of the file is {}, not the input itself", finest));
  lines.push_back("certified: " + certificate_of(told));
  return lines;
}

}  // namespace prohull
