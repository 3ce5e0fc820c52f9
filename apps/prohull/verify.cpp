#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "command.h"
#include "prohull/detail/closed_original.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/verification.h"
#include "recenter.h"
#include "several.h"
#include "verdict.h"
#include "verify_union.h"

namespace prohull::cli {
namespace {

/// Of faces nearer than the gap; where rounding hides by how much, that they are. No less than it is.
std::string distance_text(double distance, double gap, int digits) {
  constexpr int kMost = 17;
  if (distance == gap) return fmt::format("less than {:.17g}", gap);
  while (digits < kMost && rounded_up(distance, digits) >= gap) ++digits;
  return fmt::format("{:.{}g}", rounded_up(distance, digits), digits);
}

void print_near_faces(const Verification& found, const std::string& hull, double gap) {
  if (found.faces_too_near > 0)
    say("  {} of {} {} too near; the nearest:\n", counted(found.faces_too_near, "face"), hull,
        found.faces_too_near == 1 ? "is" : "are");
  for (const NearFace& near : found.nearest)
    say("    face {} at {}, {} from face {} of the mesh\n", index(near.face), text_of_point(near.point),
        distance_text(near.distance, gap, 6), index(near.original_face));
}

HullSide side_of(const MeshOrHull& hull, const VerifyOptions& options) {
  const auto* const levels = std::get_if<ProgressiveHull>(&hull);
  return levels ? levels->side() : options.side;
}

Verification verify(const VerifyOptions& options, const MeshOrHull& hull, const TriangleMesh& original, double gap) {
  ProgressLine line;
  try {
    const std::optional<ClosedMesh> closed = closed_original(original, side_of(hull, options), options.open_shells);
    const VerificationOptions how{.solid_only = options.solid_only,
                                  .gap = gap,
                                  .finite_only = options.finite_only,
                                  .closed = closed ? &closed->mesh : nullptr,
                                  .max_steps = options.max_steps,
                                  .progress = std::ref(line)};
    const auto* const levels = std::get_if<ProgressiveHull>(&hull);
    return levels ? verify_hull(*levels, original, how)
                  : verify_hull(std::get<TriangleMesh>(hull), original, options.side, how);
  } catch (const InputError& error) {
    throw InputError(error.defect(), fmt::format("{} and {}: {}", input_name(options.hull),
                                                 input_name(options.original), error.what()));
  }
}

/// "yes: hull.stl encloses part.stl", or why not.
std::string verdict(const Verification& found, const SizeComparison& sizes, const VerifyOptions& options, double gap) {
  const std::string hull = input_name(options.hull), original = input_name(options.original);
  const std::string what = claim(found, hull, original);
  if (has_failed_replay(found)) return fmt::format("NO: {}: {}", what, found.why_not);
  if (!found.encloses && !(found.is_undecided() && found.faces_too_near > 0))
    return fmt::format("{}: {}{}: {}", found.is_undecided() ? "UNDECIDED" : "NO", what,
                       found.is_yes() ? ", but there is more" : "", found.why_not);
  if (found.is_gap_undecided())
    return fmt::format("UNDECIDED: {}, and may keep the gap of {:.9g}: {}", what, gap, found.why_not);
  if (!found.keeps_gap)
    return fmt::format("NO: {}, but {} does not keep the gap of {:.{}g}: {}", what, hull, gap,
                       digits_apart(gap, found.least_distance, 9), found.why_not);
  std::string how = ", exactly";
  if (found.proof == "replay")
    how = fmt::format("; {} splits replayed, {} signs exact", grouped(found.splits), grouped(found.signs));
  if (gap > 0) how = fmt::format(" and keeps a gap of {:.9g}", rounded_down(gap, 9)) + how;
  if (sizes.is_doubtful() && !options.any_scale) return fmt::format("UNITS: {}{}, but {}", what, how, sizes.doubt());
  return fmt::format("yes: {}{}", what, how);
}

void print_summary(const VerifyOptions& options, const Verification& found, const SizeComparison& sizes, double gap,
                   double seconds) {
  const std::string hull = input_name(options.hull), original = input_name(options.original);
  say("{}, {:.2f} s\n", verdict(found, sizes, options, gap), seconds);
  print_worst(found.faces_outside, found.side == HullSide::Outer ? original : hull, found.worst);
  print_near_faces(found, hull, gap);
  if (found.cavities > 0 && found.faces_outside == 0)
    say("  {} of {} {}, and that is not covered\n", counted(found.cavities, "part"),
        found.side == HullSide::Outer ? hull : original,
        found.cavities == 1 ? "leaves a hole in its solid" : "leave holes in its solid");
  for (const std::string& note : found.notes) say("  {}\n", note);
  if (has_failed_replay(found)) return;
  if (!std::isnan(found.hull_volume))
    say("  hull: volume {:.9g}{}\n", found.hull_volume, text_of_void(found.void_ratio));
  if (gap > 0 && !std::isnan(found.least_distance)) {
    const bool is_hidden = !found.keeps_gap && found.least_distance == gap;  // then it is less
    say("  least distance: {}{}\n", is_hidden ? "" : "at most ",
        found.keeps_gap ? fmt::format("{:.9g}", rounded_up(found.least_distance, 9))
                        : distance_text(found.least_distance, gap, 9));
  }
  say("  {} intersects itself in {}\n", hull, counted(found.self_intersections, "pair of faces", "pairs of faces"));
}

nlohmann::json near_facts(const NearFace& near) {
  return {{"face", index(near.face)},
          {"original_face", index(near.original_face)},
          {"point", near.point},
          {"distance", near.distance}};
}

nlohmann::json report_of(const VerifyOptions& options, const Verification& found, double gap, double seconds) {
  nlohmann::json json = {{"hull", options.hull.string()},
                         {"original", options.original.string()},
                         {"verdict", facts(static_cast<const Verdict&>(found))},
                         {"splits", found.splits},
                         {"signs", found.signs},
                         {"faces_outside", found.faces_outside},
                         {"worst", found.worst},
                         {"cavities", found.cavities},
                         {"faces_undecided", found.faces_undecided},
                         {"faces_beside_solid", found.faces_beside_solid},
                         {"original_volume", finite_or_null(found.original_volume)},
                         {"void_ratio", finite_or_null(found.void_ratio)},
                         {"notes", found.notes},
                         {"seconds", seconds}};
  if (gap > 0) {
    json["gap_asked"] = gap;
    json["keeps_gap"] = found.is_gap_undecided() ? nlohmann::json() : nlohmann::json(found.keeps_gap);
    json["least_distance"] = finite_or_null(found.least_distance);
    json["faces_too_near"] = found.faces_too_near;
    json["nearest"] = json_list(found.nearest, near_facts);
  }
  if (has_failed_replay(found)) return json;
  json["self_intersections"] = found.self_intersections;
  json["inverted_hull_faces"] = found.inverted_hull_faces;
  json["turned_original_faces"] = found.turned_original_faces;
  json["hull_volume"] = finite_or_null(found.hull_volume);
  return json;
}

std::size_t face_count(const MeshOrHull& hull) {
  const auto* const levels = std::get_if<ProgressiveHull>(&hull);
  return levels ? levels->base_face_count() : std::get<TriangleMesh>(hull).face_count();
}

Box box_of(const MeshOrHull& hull) {
  const auto* const levels = std::get_if<ProgressiveHull>(&hull);
  return levels ? finite_bounding_box(levels->base()) : finite_bounding_box(std::get<TriangleMesh>(hull));
}

struct Judged {
  Verification found;
  SizeComparison sizes;
  std::size_t hull_faces = 0, original_faces = 0;
  double gap = 0, read_seconds = 0, seconds = 0;

  int exit_code(const VerifyOptions& options) const {
    if (has_failed_replay(found) || found.faces_too_near > 0) return kAnswerIsNo;
    if (found.encloses && found.is_gap_undecided()) return kUndecided;
    return exit_code_of(found, options.any_scale || !sizes.is_doubtful());
  }
};

/// Also writes the report.
Judged judge(const VerifyOptions& options) {
  check_files({options.hull, options.original}, {options.report});
  const Vec3 offset = vector_of(options.offset, "offset");
  const Stopwatch reading;
  const MeshOrHull hull = read_mesh_or_hull(options.hull, options.hull_input);
  FileUnit unit;
  const TriangleMesh original =
      minus(read_input(options.original, options.original_input, NonFinite::Keep, nullptr, &unit), offset);
  const double read_seconds = reading.seconds();
  const double gap = MeshUnit(original, options.original, options.original_input, unit).number_of(options.gap, "--gap");
  stop_if_interrupted();
  const Stopwatch verifying;
  Verification found = verify(options, hull, original, gap);
  const double seconds = verifying.seconds();
  const SizeComparison sizes(box_of(hull), face_count(hull), finite_bounding_box(original), found.side);
  Outputs outputs;
  nlohmann::json report = report_of(options, found, gap, seconds);
  report["offset"] = offset;
  report.update(sizes.facts());
  outputs.add_report(options.report, report);
  outputs.commit();
  return {std::move(found), sizes, face_count(hull), original.face_count(), gap, read_seconds, seconds};
}

std::string table_row(const Judged& judged, int exit_code) {
  const Verification& found = judged.found;
  const bool has_void = found.is_yes() && !std::isnan(found.void_ratio);
  const char* const answer = exit_code == kDone        ? "yes"
                             : exit_code == kUndecided ? "UNDECIDED"
                             : found.certified         ? "UNITS: "
                                                       : "NO: ";
  return fmt::format("{:>11}  {:>9}  {:>8}  {}{}", grouped(judged.original_faces), grouped(judged.hull_faces),
                     has_void ? percent_text(found.void_ratio, 2) : "", answer,
                     exit_code != kAnswerIsNo ? ""
                     : found.certified        ? judged.sizes.doubt()
                                              : found.why_not);
}

using Paths = std::vector<std::filesystem::path>;

/// Takes out of `hulls` those of each mesh: of its name with the suffix, or without, if no other mesh wants them.
std::map<std::filesystem::path, Paths> taken_by_mesh(const Paths& meshes, Paths& hulls) {
  std::map<std::filesystem::path, Paths> taken;
  const auto take = [&](const auto& name_of) {
    std::map<std::filesystem::path, std::size_t> wanting;
    for (const auto& mesh : meshes) wanting[name_of(mesh)] += taken[mesh].empty() ? 1 : 0;
    for (const auto& mesh : meshes)
      if (Paths& of_mesh = taken[mesh]; of_mesh.empty() && wanting[name_of(mesh)] == 1) {
        const auto is_other = [&](const auto& hull) { return name_of(hull) != name_of(mesh); };
        const auto its = std::stable_partition(hulls.begin(), hulls.end(), is_other);
        of_mesh.assign(its, hulls.end());
        hulls.erase(its, hulls.end());
      }
  };
  take([](const auto& path) { return without_gz(path).filename(); });
  take([](const auto& path) { return named_after("{name}", path); });
  return taken;
}

std::filesystem::path only_hull_of(const std::filesystem::path& mesh, const Paths& hulls,
                                   const std::filesystem::path& folder) {
  if (hulls.size() == 1) return hulls.front();
  throw InputError(Defect::CannotRead,
                   fmt::format("{}: {} has {}; give the two files{}", mesh.string(), folder.string(),
                               hulls.empty() ? "no mesh file of this name, or only one that may be another mesh's"
                                             : fmt::format("several mesh files of this name, {} and {}",
                                                           hulls[0].filename().string(), hulls[1].filename().string()),
                               hulls.empty() ? ", as for .phull files" : ""));
}

/// Each mesh of one folder by the hull of the same name in the other. A hull without a mesh is an error, too.
int run_verify_folders(const VerifyOptions& options) {
  const Paths meshes = mesh_files({options.original});
  Paths hulls = mesh_files({options.hull});
  const auto taken = taken_by_mesh(meshes, hulls);
  check_outputs(meshes, [&](const auto& mesh) {
    return NamedOutputs{{"--report", named_after(options.report, mesh)}};
  });
  const int exit_code = run_each(meshes, fmt::format("{:>11}  {:>9}  {:>8}  {}", "faces", "hull", "void", "enclosed"),
                                 [&](const std::filesystem::path& mesh) {
                                   VerifyOptions of_mesh = options;
                                   of_mesh.hull = only_hull_of(mesh, taken.at(mesh), options.hull);
                                   of_mesh.original = mesh, of_mesh.report = named_after(options.report, mesh);
                                   const Judged judged = judge(of_mesh);
                                   const int code = judged.exit_code(of_mesh);
                                   return MeshOutcome{code, {table_row(judged, code)}, code == kDone};
                                 });
  for (const auto& hull : hulls)
    tell_error(fmt::format("{}: {} has no mesh of this name that has no other hull", hull.string(),
                           options.original.string()));
  return hulls.empty() ? exit_code : kBadInput;
}

int run_verify(const VerifyOptions& options) {
  if (!options.more.empty())
    refuse("these are more than two files: with --union the last one is ORIGINAL, and all others are pieces");
  if (!options.link.empty()) refuse("--link picks a link of files of pieces: use it with --union");
  if (options.inside) refuse("--inside is for spheres: use it with --union");
  if (std::filesystem::is_directory(options.hull) && std::filesystem::is_directory(options.original))
    return run_verify_folders(options);
  const Judged judged = judge(options);
  print_summary(options, judged.found, judged.sizes, judged.gap, judged.seconds);
  say_more("  hull of {}, original of {}; proof by {}; read {:.2f} s\n", counted(judged.hull_faces, "face"),
           counted(judged.original_faces, "face"), judged.found.proof, judged.read_seconds);
  return judged.exit_code(options);
}

}  // namespace

std::string text_of_point(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

void print_worst(std::size_t faces_outside, const std::string& mesh, const std::vector<Offender>& worst) {
  if (faces_outside > 0)
    say("  {} of {} {} outside, at least in part; the farthest:\n", counted(faces_outside, "face"), mesh,
        faces_outside == 1 ? "lies" : "lie");
  for (const Offender& o : worst)
    say("    face {} at {}, {}\n", index(o.face), text_of_point(o.point),
        o.distance > 0 ? fmt::format("{:.6g} outside", o.distance) : "outside by less than rounding lets tell");
}

void add_verify(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<VerifyOptions>(
      app, run, "verify",
      "Decides exactly whether a hull encloses a mesh, and exits with code 1 if it does not. It shares no code with "
      "the construction of hulls. Two mesh files are compared; a .phull file is a proof, which is replayed. The solid "
      "of the mesh must be enclosed, and every triangle covered. Of a mesh that is not closed, only the latter is "
      "asked, unless --open-shells closes it. A hull whose faces look inwards is refused.\n"
      "With --union it is decided whether convex pieces together, or spheres together, cover a mesh.",
      [](VerifyOptions chosen) {
        chosen.hull_input.format = chosen.original_input.format;  // one of them may be standard input
        return chosen.is_union ? run_verify_union(chosen) : run_verify(chosen);
      });
  add_value(command, "hull", options.hull, "HULL",
            std::string("Mesh or .phull file; with --union a file of pieces. ") + kMeshFiles)
      ->required();
  add_value(command, "original", options.original, "ORIGINAL",
            "Mesh that the hull should enclose, in any of these formats. Of two folders, each mesh of ORIGINAL is "
            "compared with the mesh of the same name in HULL.")
      ->required();
  add_value(command, "more", options.more, "MORE", "With --union: more files of pieces. The last file is ORIGINAL.");
  CLI::Option* const is_union = command.add_flag(
      "--union", options.is_union,
      "Decide whether the union of pieces covers every triangle of ORIGINAL and, if that is closed, its inside. Pieces "
      "may touch and overlap. Each connected component of a mesh file is a piece; STL joins those that share corners. "
      "Of a robot (.urdf, .sdf, .xml) the pieces are the collision geometry of a link: meshes, boxes and spheres. A "
      ".yaml file of collision spheres, as cuRobo reads it, and the .json file of `prohull spheres` hold spheres.");
  add_value(command, "--link", options.link, "NAME",
            "With --union: the link whose pieces are meant, where a robot or a file of spheres has several.");
  command.add_flag("--inside", options.inside,
                   "With --union and spheres: the inside of ORIGINAL must be covered too, not only its triangles.");
  add_format_option(command, options.original_input);
  add_unit_options(command, options.original_input, "ORIGINAL (the same as `prohull build` was given for it)");
  add_value(command, "--offset", options.offset, "X,Y,Z",
            "Subtract these three numbers from the coordinates of ORIGINAL, after --unit or --scale: the offset that "
            "`prohull build --recenter` has told.");
  add_choice(command, "--side", options.side, hull_side_names(),
             "Side on which the hull lies. With inner it is decided whether ORIGINAL encloses HULL. A .phull file "
             "knows its side.");
  add_choice(
      command, "--open-shells", options.open_shells, open_shells_names(),
      "What to do with openings of ORIGINAL. close gives them caps, as `prohull build` does, so that what they lead "
      "into must be enclosed too, and so that an inner hull has an inside to lie in; keep asks for the triangles only.")
      ->excludes(is_union);
  command.add_flag("--solid-only", options.solid_only,
                   "Ask only for the solid that a closed mesh bounds. Triangles of folds and of parts that are inside "
                   "out bound no part of it, and may stick out.");
  command.add_flag("--finite-only", options.finite_only,
                   "Leave out triangles of ORIGINAL with a coordinate that is NaN or infinite. Without this option the "
                   "answer is no if there are any.");
  command.add_flag("--any-scale", options.any_scale,
                   "Also say yes where the outer one of the two is 9 times as large as the other or more, along each "
                   "axis (20 times, if the hull has fewer than 12 faces or is an inner one). Without this option the "
                   "exit code is then 1: their units seem to differ.");
  add_length(command, "--gap", options.gap,
             "Also decide whether the hull keeps this distance from ORIGINAL everywhere, at least. Not for .phull "
             "files, whose levels touch.",
             "ORIGINAL")
      ->excludes(is_union);
  add_optional_number(
      command, "--steps", options.max_steps, {1, 1e15},
      "Largest number of steps of each search for parts that lie outside, for holes, and for faces nearer than the "
      "gap: "
      "what is left then is undecided, and the exit code is 4 if nothing else says no. Without this option it is two "
      "billion and 2,000 for each face of ORIGINAL, which take some minutes.");
  add_report_option(command, options.report);
  add_examples(
      command,
      {"prohull verify hull.stl horse.ply", "prohull verify horse.phull horse.ply",
       "prohull verify occluder.obj rock.obj --side inner", "prohull verify hull.stl bucket.stl --open-shells close",
       "prohull verify hull.stl soup.stl", "prohull verify cage.obj horse.ply --gap 0.5%",
       "prohull verify arm_collision.stl arm.stl --unit mm", "prohull verify hulls/ parts/",
       "prohull verify house.glb house_utm.ply --offset 500010,5400000,0", "prohull verify --union pieces.obj part.stl",
       "prohull verify --union a.stl b.stl c.stl part.stl", "prohull verify --union spheres.yaml part.stl --inside",
       "prohull verify --union arm_pieces.urdf arm.stl",
       "prohull verify --union robot_spheres.yaml forearm.stl --link forearm"});
}

}  // namespace prohull::cli
