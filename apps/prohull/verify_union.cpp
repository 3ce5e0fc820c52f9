#include "verify_union.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "command.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/union_verification.h"
#include "recenter.h"
#include "union_files.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

UnionVerification verify(const Union& all, TriangleMesh original, const VerifyOptions& options) {
  ProgressLine line;
  const VerificationOptions how{.solid_only = options.solid_only,
                                .finite_only = options.finite_only,
                                .max_steps = options.max_steps,
                                .progress = std::ref(line)};
  return all.balls.empty() ? verify_union(all.pieces, std::move(original), how)
                           : verify_union(all.balls, std::move(original), options.inside, how);
}

DistanceBounds reach_of(const Union& all, const TriangleMesh& original) {
  ProgressLine line;
  const DistanceOptions how{.progress = std::ref(line)};
  return all.balls.empty() ? union_reach(all.pieces, original, how) : union_reach(all.balls, original, how);
}

/// The faces of the pieces. Balls count as the finest meshes.
std::size_t face_count(const Union& all) {
  std::size_t faces = all.balls.empty() ? 0 : std::numeric_limits<std::size_t>::max();
  for (const TriangleMesh& piece : all.pieces) faces += piece.face_count();
  return faces;
}

Box box_of(const Union& all) {
  Box box;
  for (const TriangleMesh& piece : all.pieces)
    for (const Vec3& p : piece.positions) box.extend(p);
  for (const auto& [center, radius] : all.balls) {
    const Vec3 reach{radius, radius, radius};
    box.extend(center - reach), box.extend(center + reach);
  }
  return box;
}

std::string verdict(const Union& all, const VerifyOptions& options, const UnionVerification& found,
                    const SizeComparison& sizes, const std::string& original) {
  const std::string what = claim(found, "the union of " + all.description(), original);
  if (found.certified && sizes.is_doubtful() && !options.any_scale)
    return fmt::format("UNITS: {}, exactly, but {}", what, sizes.doubt());
  if (found.certified) return fmt::format("yes: {}, exactly", what);
  if (found.is_undecided()) return "UNDECIDED: " + found.why_not;
  return fmt::format("NO: {}{}: {}", what, found.is_yes() ? ", but there is more" : "", found.why_not);
}

void print_offenders(const UnionVerification& found, const std::string& original) {
  print_worst(found.faces_outside, original, found.worst);
  if (found.faces_undecided > 0)
    say("  {} of {} {} undecided{}\n", counted(found.faces_undecided, "face"), original,
        found.faces_undecided == 1 ? "is" : "are", found.undecided.empty() ? "" : ":");
  for (const Offender& o : found.undecided) say("    face {} at {}, in doubt\n", index(o.face), text_of_point(o.point));
  if (found.inside_undecided) say("  the inside is undecided\n");
}

void print_summary(const Union& all, const UnionVerification& found) {
  const DistanceBounds& reach = found.distance();
  if (found.turned_pieces > 0)
    say("  {} inwards and count{} as turned\n", counted(found.turned_pieces, "piece looks", "pieces look"),
        found.turned_pieces == 1 ? "s" : "");
  for (const auto* notes : {&all.notes, &found.notes})
    for (const std::string& note : *notes) say("  {}\n", note);
  if (!std::isnan(found.union_volume))
    say("  union: volume {:.6g}{}\n", found.union_volume, text_of_void(found.void_ratio));
  if (reach.lower > 0)
    say("  it reaches out by {:.6g} to {:.6g}, at {}\n", rounded_down(reach.lower, 6), rounded_up(reach.upper, 6),
        text_of_point(reach.farthest));
  else
    say("  it reaches out by at most {:.6g}\n", rounded_up(reach.upper, 6));
}

nlohmann::json point_or_null(const std::optional<PointOfFace>& point) {
  if (!point) return {};
  return {{"face", index(point->face)}, {"weights", point->weights}};
}

nlohmann::json report_of(const std::vector<std::filesystem::path>& files, const Union& all,
                         const UnionVerification& found) {
  std::vector<std::string> notes = all.notes;
  notes.insert(notes.end(), found.notes.begin(), found.notes.end());
  return {{"union", json_list(files, [](const auto& file) { return file.string(); })},
          {"pieces", all.pieces.size()},
          {"spheres", all.balls.size()},
          {"verdict", facts(static_cast<const Verdict&>(found))},
          {"faces_outside", found.faces_outside},
          {"worst", found.worst},
          {"point_outside", point_or_null(found.point_outside)},
          {"faces_undecided", found.faces_undecided},
          {"undecided", found.undecided},
          {"inside_undecided", found.inside_undecided},
          {"holes", found.holes},
          {"turned_pieces", found.turned_pieces},
          {"union_volume", finite_or_null(found.union_volume)},
          {"original_volume", finite_or_null(found.original_volume)},
          {"void_ratio", finite_or_null(found.void_ratio)},
          {"notes", notes}};
}

/// All but the last file, which is the original.
std::vector<std::filesystem::path> files_of_pieces(const VerifyOptions& options) {
  std::vector<std::filesystem::path> files{options.hull};
  if (options.more.empty()) return files;
  files.push_back(options.original);
  files.insert(files.end(), options.more.begin(), options.more.end() - 1);
  return files;
}

}  // namespace

int run_verify_union(const VerifyOptions& options) {
  if (options.side != HullSide::Outer) refuse("--union asks whether pieces cover ORIGINAL: leave out --side");
  const std::vector<std::filesystem::path> files = files_of_pieces(options);
  const std::filesystem::path last = options.more.empty() ? options.original : options.more.back();
  std::vector<std::filesystem::path> inputs = files;
  inputs.push_back(last);
  check_files(inputs, {options.report});
  const Vec3 offset = vector_of(options.offset, "offset");
  const Union all = read_union(files, options.hull_input, options.link);
  const TriangleMesh original = minus(read_input(last, options.original_input, NonFinite::Keep), offset);
  const Stopwatch verifying;
  UnionVerification found = verify(all, original, options);
  const double seconds = verifying.seconds();
  found.distance_to_triangles = reach_of(all, finite_part(original));
  if (found.original_closed) found.distance_to_solid = found.distance_to_triangles;
  const SizeComparison sizes(box_of(all), face_count(all), finite_bounding_box(original), HullSide::Outer);
  nlohmann::json report = report_of(files, all, found);
  report["original"] = last.string();
  report["offset"] = offset;
  report.update(sizes.facts());
  report["link"] = options.link.empty() ? nlohmann::json() : nlohmann::json(options.link);
  report["seconds"] = seconds;
  Outputs outputs;
  outputs.add_report(options.report, report);
  outputs.commit();
  say("{}, {:.2f} s\n", verdict(all, options, found, sizes, input_name(last)), seconds);
  print_offenders(found, input_name(last));
  print_summary(all, found);
  return exit_code_of(found, options.any_scale || !sizes.is_doubtful());
}

}  // namespace prohull::cli
