#include <fmt/format.h>

#include "command.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/verification.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path hull, original, report;
  InputOptions hull_input, original_input;
  HullSide side = HullSide::Outer;
  bool every_triangle = false;
};

std::string text(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

void print_offenders(const Verification& found, const std::string& mesh) {
  if (found.faces_outside > 0)
    say("  {} faces of {} lie outside, at least in part; the farthest:\n", grouped(found.faces_outside), mesh);
  for (const Offender& o : found.worst)
    say("    face {} at {}, {:.6g} outside\n", index(o.face), text(o.point), o.distance);
}

nlohmann::json facts(const std::vector<Offender>& worst) {
  nlohmann::json all = nlohmann::json::array();
  for (const Offender& o : worst)
    all.push_back({{"face", index(o.face)}, {"point", {o.point.x, o.point.y, o.point.z}}, {"distance", o.distance}});
  return all;
}

Verification verify(const Options& options, const MeshOrHull& hull, TriangleMesh original) {
  ProgressLine line;
  const VerificationOptions how{.every_triangle = options.every_triangle, .progress = std::ref(line)};
  try {
    const auto* const levels = std::get_if<ProgressiveHull>(&hull);
    return levels ? verify_hull(*levels, std::move(original), how)
                  : verify_hull(std::get<TriangleMesh>(hull), std::move(original), options.side, how);
  } catch (const InputError& error) {
    throw InputError(error.defect(), fmt::format("{} and {}: {}", input_name(options.hull),
                                                 input_name(options.original), error.what()));
  }
}

/// "yes: hull.stl encloses part.stl", or why not.
std::string verdict(const Verification& found, const std::string& hull, const std::string& original) {
  const bool inner = found.side == HullSide::Inner, replayed = found.proof == "replay";
  if (replayed && !found.why_not.empty())
    return fmt::format("NO: {} proves nothing about {}: {}", hull, original, found.why_not);
  if (replayed && !found.encloses)
    return fmt::format("NO: the finest level of {} does not cover every triangle of {}", hull, original);
  const std::string subject = inner ? original : replayed ? "every level of " + hull : hull;
  const std::string object = !inner ? original : replayed ? "every level of " + hull : hull;
  const char* does = !found.original_closed ? "covers every triangle of"
                     : found.every_triangle ? "encloses, and covers every triangle of,"
                                            : "encloses";
  const char* does_not = !found.original_closed ? "does not cover every triangle of"
                         : found.every_triangle ? "does not enclose, or not cover every triangle of,"
                                                : "does not enclose";
  if (!found.encloses) return fmt::format("NO: {} {} {}", subject, does_not, object);
  const std::string how =
      replayed ? fmt::format("; {} splits replayed, {} signs exact", grouped(found.splits), grouped(found.signs))
               : ", exactly";
  return fmt::format("yes: {} {} {}{}", subject, does, object, how);
}

void print_summary(const Options& options, const Verification& found, double seconds) {
  const std::string hull = input_name(options.hull), original = input_name(options.original);
  say("{}, {:.2f} s\n", verdict(found, hull, original), seconds);
  print_offenders(found, found.side == HullSide::Outer ? original : hull);
  if (found.cavities > 0 && found.faces_outside == 0)
    say("  {} cavities inside it are not covered\n", grouped(found.cavities));
  for (const std::string& note : found.notes) say("  {}\n", note);
  if (!found.why_not.empty()) return;
  say("  hull: volume {:.9g}{}\n", found.hull_volume,
      found.original_closed ? fmt::format(", void {:.3f} %", 100 * found.void_ratio) : "");
  say("  {} intersects itself in {} pairs of faces\n", hull, grouped(found.self_intersections));
}

nlohmann::json report_of(const Options& options, const Verification& found, double seconds) {
  nlohmann::json json = {{"hull", options.hull.string()},
                         {"original", options.original.string()},
                         {"original_closed", found.original_closed},
                         {"every_triangle", found.every_triangle},
                         {"side", std::string(name_of(hull_side_names(), found.side))},
                         {"encloses", found.encloses},
                         {"proof", std::string(found.proof)},
                         {"why_not", found.why_not},
                         {"splits", found.splits},
                         {"signs", found.signs},
                         {"faces_outside", found.faces_outside},
                         {"worst", facts(found.worst)},
                         {"cavities", found.cavities},
                         {"notes", found.notes},
                         {"seconds", seconds}};
  if (!found.why_not.empty()) return json;
  json["self_intersections"] = found.self_intersections;
  json["turned_hull_faces"] = found.turned_hull_faces;
  json["turned_original_faces"] = found.turned_original_faces;
  json["hull_volume"] = found.hull_volume;
  json["original_volume"] = found.original_closed ? nlohmann::json(found.original_volume) : nlohmann::json();
  json["void_ratio"] = found.original_closed ? nlohmann::json(found.void_ratio) : nlohmann::json();
  return json;
}

std::size_t face_count(const MeshOrHull& hull) {
  const auto* const levels = std::get_if<ProgressiveHull>(&hull);
  return levels ? levels->base_face_count() : std::get<TriangleMesh>(hull).face_count();
}

int run_verify(const Options& options) {
  check_files({options.hull, options.original}, {options.report});
  const Stopwatch reading;
  const MeshOrHull hull = read_mesh_or_hull(options.hull, options.hull_input);
  TriangleMesh original = read_input(options.original, options.original_input, NonFinite::Keep);
  const double read_seconds = reading.seconds();
  const std::size_t original_faces = original.face_count();
  stop_if_interrupted();
  const Stopwatch verifying;
  const Verification found = verify(options, hull, std::move(original));
  const double seconds = verifying.seconds();
  Outputs outputs;
  outputs.add_report(options.report, report_of(options, found, seconds));
  outputs.commit();
  print_summary(options, found, seconds);
  say_more("  hull of {}, original of {}; proof by {}; read {:.2f} s\n", counted(face_count(hull), "face", "faces"),
           counted(original_faces, "face", "faces"), found.proof, read_seconds);
  return found.encloses ? kDone : kAnswerIsNo;
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "verify",
      "Decides exactly whether a hull encloses a mesh, and exits with code 1 if it does not. It shares no code with "
      "the "
      "construction of hulls. Two mesh files are compared; a .phull file is a proof, which is replayed. Of an original "
      "that is not closed, every triangle must be covered.");
  command.add_option("hull", options->hull, std::string("Mesh or .phull file. ") + kMeshFiles)
      ->required()
      ->type_name("HULL");
  command.add_option("original", options->original, "Mesh that the hull should enclose, in any of these formats.")
      ->required()
      ->type_name("ORIGINAL");
  add_format_option(command, options->original_input);
  add_unit_options(command, options->original_input, "ORIGINAL (the same as `prohull build` was given for it)");
  add_choice(command, "--side", options->side, hull_side_names(),
             "Side on which the hull lies. With inner it is decided whether ORIGINAL encloses HULL. A .phull file "
             "knows its side.");
  command.add_flag("--every-triangle", options->every_triangle,
                   "Also of a closed original, every triangle must be covered, even those of folds and of parts that "
                   "are inside out, which bound no part of the solid.");
  add_report_option(command, options->report);
  add_examples(command, {"prohull verify hull.stl horse.ply", "prohull verify horse.phull horse.ply",
                         "prohull verify occluder.obj rock.obj --side inner", "prohull verify hull.stl soup.stl",
                         "prohull verify arm_collision.stl arm.stl --unit mm"});
  command.callback([options, &run] {
    options->hull_input.format = options->original_input.format;  // one of them may be standard input
    run = [options] { return run_verify(*options); };
  });
}

}  // namespace prohull::cli
