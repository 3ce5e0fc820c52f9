#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "build_summary.h"
#include "certificate_output.h"
#include "command.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/memory.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"
#include "prohull/tolerances.h"
#include "recenter.h"
#include "robot/files/region_file.h"
#include "several.h"

namespace prohull::cli {

namespace {

void require_faces_in_name(const BuildOptions& options, const std::filesystem::path& file, const std::string& format) {
  if (options.faces.size() <= 1 || file.empty() || path_for(file, 0) != file) return;
  const auto named = is_standard_stream(file) ? std::filesystem::path("hull." + format) : file;
  refuse(fmt::format(
      "{}: --faces asks for {} hulls, which need names of their own; put {{faces}} where the number of faces goes, as "
      "in {}",
      output_name(file), options.faces.size(),
      (named.parent_path() / (named.stem().string() + "_{faces}" + named.extension().string())).string()));
}

/// What the names of the outputs end in; refuses options that contradict each other.
std::string check_options(const BuildOptions& options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  if (!options.hierarchy.empty())
    output_suffix(options.hierarchy, {"hierarchies", {".phull"}}, is_standard_stream(options.hierarchy) ? "phull" : "");
  require_faces_in_name(options, options.out, options.out_format);
  if (options.faces.size() > 1 && !options.hierarchy.empty())
    refuse("--hierarchy is for one number of --faces only; its file holds all finer levels anyway");
  if (options.enclosing.hull.self_intersections == SelfIntersections::Allowed &&
      (options.enclosing.tight || !options.is_outer()))
    refuse(
        "--self-intersections allowed is for outer hulls without --tight; all others refuse collapses that make them "
        "intersect themselves");
  check_certified(options.certificate, options.in, suffix);
  require_faces_in_name(options, options.certificate, "phcert");
  std::vector<std::filesystem::path> files{options.hierarchy, options.report};
  for (const std::size_t faces : options.faces)
    for (const auto& pattern : {options.out, options.certificate}) files.push_back(path_for(pattern, faces));
  std::vector<std::filesystem::path> inputs{options.in};
  if (!options.tolerance.empty()) inputs.push_back(options.tolerance);
  check_files(inputs, files);
  return suffix;
}

EnclosingHulls build(TriangleMesh mesh, const BuildOptions& options) {
  return naming(options.in, options.enclosing, [&](const EnclosingOptions& enclosing) {
    if (enclosing.hull.float32_coordinates) check_float32_spacing(mesh);
    return enclosing_hulls(std::move(mesh), options.faces, enclosing);
  });
}

void write_certificate(Written& written, const CertifiedOriginal& original, const BuildOptions& options,
                       Outputs& outputs) {
  const EnclosingHull& hull = written.hull;
  written.certificate_path = path_for(options.certificate, hull.target_faces);
  written.certificate =
      hull_certificate(hull.mesh, original,
                       {.side = options.enclosing.hull.side,
                        .gap = claimed_gap(options.enclosing.padding, hull.padding),
                        .distance = claimed_distance(options.enclosing.bounds.max_distance,
                                                     written.measures.verdict.distance_to_triangles->upper)});
  outputs.add(written.certificate_path, written.certificate.bytes);
}

Written write_certified(EnclosingHull hull, FinestLevel finest, const BuildOptions& options, const std::string& suffix,
                        Outputs& outputs) {
  Written written;
  written.hull = std::move(hull);
  written.path = path_for(options.out, written.hull.target_faces);
  if (!written.hull.certified) return written;
  Stopwatch writing;
  written.holds_bits = outputs.add(written.path, suffix, written.hull.mesh);
  if (written.holds_bits)
    outputs.add(options.hierarchy, ".phull", [&](const auto& file) {
      return save_hull(file, written.hull.levels->with_finest_level(finest)), true;
    });
  written.write_seconds = writing.seconds();
  return written;
}

/// How far the faces of a region are from the hull. The search for a bound may end above what the region allows, which
/// then has a proof of its own.
DistanceBounds distance_of_region(const TriangleMesh& faces, const TriangleMesh& hull, double allowed,
                                  const Progress& progress) {
  if (faces.face_count() == 0) return {};
  DistanceBounds bounds = distance_bounds(
      faces, hull, {.max_cells = DistanceOptions{}.max_cells + 2 * faces.face_count(), .progress = progress});
  if (bounds.upper > allowed &&
      verify_tolerances(hull, faces, PerFace<double>(faces.face_count(), allowed), progress).holds)
    bounds.upper = allowed, bounds.lower = std::min(bounds.lower, allowed);
  return bounds;
}

void measure(BuildOutcome& outcome, const HullBounds& bounds) {
  outcome.input_self_intersections = self_intersections_of_input(outcome.made);
  ProgressLine line;
  for (Written& written : outcome.written) {
    written.measures = measures_of(outcome.made, written.hull, bounds, std::ref(line));
    written.measures.verdict = as_written(std::move(written.measures.verdict), written.holds_bits);
    for (std::size_t i = 0; i < outcome.regions.all.size(); ++i)
      written.regions.push_back(distance_of_region(outcome.regions.faces[i], written.hull.mesh,
                                                   outcome.regions.all[i].max_distance, std::ref(line)));
  }
}

// A face whose corners are not three different ones has no place in a hull.
bool can_be_kept(const Triangle& t) {
  return is_finite(t.a) && is_finite(t.b) && is_finite(t.c) && t.a != t.b && t.b != t.c && t.c != t.a;
}

void set_regions(BuildOptions& options, BuildOutcome& outcome, const TriangleMesh& mesh, const MeshMarks& marks,
                 const MeshUnit& unit) {
  Regions& regions = outcome.regions;
  regions.all = robot::read_region_file(read_bytes(options.tolerance), input_name(options.tolerance),
                                        [&](const Length& length) { return unit.number_of(length, "max_distance"); });
  const PerFace<std::uint32_t> region_of =
      naming(options.tolerance, [&] { return regions_of_faces(mesh, marks, regions.all); });
  options.enclosing.hull.tolerances = tolerances_of(region_of, regions.all);
  const TriangleMesh placed = minus(mesh, outcome.offset);
  regions.faces.assign(regions.all.size(), {placed.positions, {}});
  for (const FaceId f : region_of.ids())
    if (region_of[f] < regions.all.size() && can_be_kept(placed.triangle(f)))
      regions.faces[region_of[f]].triangles.push_back(placed.triangles[f]);
}

void set_lengths(BuildOptions& options, const MeshUnit& unit) {
  EnclosingOptions& enclosing = options.enclosing;
  enclosing.padding = unit.number_of(options.gap, "--gap");
  enclosing.seal_holes = unit.number_of(options.seal_holes, "--seal-holes");
  unit.set(enclosing.bounds.max_distance, options.max_distance, "--max-distance");
}

/// What the library is asked for, where options say it in other units or words.
void complete(BuildOptions& options, const std::string& suffix) {
  HullOptions& hull = options.enclosing.hull;
  hull.float32_coordinates = stores_float32(mesh_format("hull" + suffix));
  hull.guards.max_normal_deviation = options.normal_deviation_degrees * kDegree;
  if (options.max_void_percent > 0) options.enclosing.bounds.max_void_ratio = options.max_void_percent / 100;
  options.enclosing.levels = !options.hierarchy.empty();
}

/// Completes the options, too: lengths may be in units of the mesh.
BuildOutcome build_and_write(BuildOptions& options) {
  const std::string suffix = check_options(options);
  complete(options, suffix);
  BuildOutcome outcome;
  if (!is_standard_stream(options.in)) require_memory(options.in, kHullBytesPerFace);
  MeshMarks marks;
  InputMesh in = read_given(options.in, options.input, options.tolerance.empty() ? nullptr : &marks);
  outcome.read_seconds = in.seconds;
  set_lengths(options, in.unit);
  if (options.recenter) outcome.offset = recentering_offset(in.mesh);
  if (!options.tolerance.empty()) set_regions(options, outcome, in.mesh, marks, in.unit);
  if (!options.certificate.empty())
    naming(options.in, [&] { require_certifiable(in.mesh, options.enclosing.hull.side); });
  const CertifiedOriginal original = certified_original(options.certificate, in.mesh, options.in, options.input);
  outcome.made = build(minus(std::move(in.mesh), outcome.offset), options);
  Outputs outputs;
  for (EnclosingHull& made : outcome.made.hulls) {
    const FinestLevel finest = finest_level(outcome.made, made);
    outcome.written.push_back(write_certified(std::move(made), finest, options, suffix, outputs));
  }
  measure(outcome, options.enclosing.bounds);
  if (!options.certificate.empty())
    for (Written& written : outcome.written)
      if (written.certified()) write_certificate(written, original, options, outputs);
  if (!options.report.empty()) outputs.add_report(options.report, report_of(options, outcome));
  outputs.commit();
  return outcome;
}

bool is_as_asked(const BuildOutcome& outcome) { return std::ranges::all_of(outcome.written, &Written::is_as_asked); }

int exit_code(const BuildOptions& options, const BuildOutcome& outcome) {
  const bool all_certified = std::ranges::all_of(outcome.written, &Written::certified);
  const bool all_within_bounds =
      std::ranges::all_of(outcome.written, [](const Written& written) { return written.hull.within_bounds; });
  return !all_certified || !all_within_bounds || (options.strict && !is_as_asked(outcome)) ? kAnswerIsNo : kDone;
}

/// The options with the names of what is written for this mesh. A hull that goes into a folder has the format of its
/// mesh, if hulls are written in that format.
BuildOptions for_mesh(BuildOptions options, const std::filesystem::path& in) {
  const std::vector<std::string> formats = mesh_outputs().suffixes;
  const bool is_written = std::ranges::find(formats, lower_case_extension(without_gz(in))) != formats.end();
  const std::string suffix = options.out_format.empty() ? is_written ? lower_case_extension(without_gz(in)) : ".stl"
                                                        : "." + options.out_format;
  options.in = in;
  options.out = pattern_of(options.out, (options.faces.size() > 1 ? "_{faces}" : "") + suffix);
  for (auto* const file : {&options.out, &options.hierarchy, &options.certificate, &options.report})
    *file = named_after(*file, in);
  return options;
}

/// Before any work: refuses options as for one mesh, and files that would be written twice.
void check_several(const BuildOptions& options, const std::vector<std::filesystem::path>& meshes) {
  check_outputs(meshes, [&](const std::filesystem::path& mesh) {
    const BuildOptions one = for_mesh(options, mesh);
    return NamedOutputs{
        {"-o", one.out}, {"--hierarchy", one.hierarchy}, {"--certificate", one.certificate}, {"--report", one.report}};
  });
  BuildOptions of_all = for_mesh(options, "{name}.stl");  // names stay patterns
  of_all.in = meshes.front();
  check_options(of_all);
}

int run_build(const BuildOptions& options) {
  const std::vector<std::filesystem::path> meshes = mesh_files(options.meshes);
  Outputs folders;
  if (!options.out.has_filename()) folders.add_folder(options.out);
  if (meshes.size() > 1) {
    check_several(options, meshes);
    return run_each(meshes, table_head(), [&](const std::filesystem::path& mesh) {
      BuildOptions one = for_mesh(options, mesh);
      const BuildOutcome outcome = build_and_write(one);
      return MeshOutcome{exit_code(one, outcome), table_rows(one, outcome), is_as_asked(outcome)};
    });
  }
  BuildOptions one = for_mesh(options, meshes.front());
  const BuildOutcome outcome = build_and_write(one);
  print_summary(one, outcome);
  return exit_code(one, outcome);
}

void add_guards(CLI::App& command, BuildOptions& options) {
  HullOptions& hull = options.enclosing.hull;
  command.add_flag("!--keep-guards", hull.relax_guards,
                   "Keep the limits of the shape that follow. Otherwise they are relaxed in four steps where the "
                   "number of faces cannot be reached.");
  add_number(command, "--max-valence", hull.guards.max_valence, {3, 1000},
             "Largest valence of a new vertex. The valence of a vertex is the number of faces around it.");
  add_number(command, "--min-compactness-ratio", hull.guards.min_compactness_ratio, {0, 1},
             "Least compactness of the worst face that a collapse leaves, divided by that of the worst face before, 0 "
             "to 1. The compactness of a triangle is 1 if its sides are equal, and 0 if it has no area.")
      ->type_name("RATIO");
  add_number(command, "--sufficient-compactness", hull.guards.sufficient_compactness, {0, 1},
             "Compactness, 0 to 1, that is enough for a face whatever it was before. For the strategy lazy only.")
      ->type_name("COMPACTNESS");
  add_number(command, "--max-normal-deviation", options.normal_deviation_degrees, {0, 90},
             "Largest angle by which a collapse may turn a face, in degrees, 0 to 90.")
      ->type_name("DEGREES");
  add_number(command, "--max-overhang", hull.guards.max_overhang, {0, 10},
             "How far a new vertex may lie outside of the bounding box of the mesh, along each axis, divided by the "
             "diagonal of the box, 0 to 10.")
      ->type_name("RATIO");
}

void add_bounds(CLI::App& command, BuildOptions& options) {
  add_length(command, "--max-distance", options.max_distance,
             "Largest allowed distance of any point of the hull from the mesh, greater than 0. What closes openings of "
             "the mesh counts as mesh. The hull has the fewest faces, at least --faces, with which one was found that "
             "provably keeps it; the exit code is 1 if none was found. With --tight, some ten hulls are built to find "
             "it.");
  add_optional_number(command, "--max-void", options.max_void_percent, kPercent,
                      "Largest allowed void, in per cent. The void is how much more volume the hull has than the mesh, "
                      "caps on its openings and cavities that are filled included (an inner hull: how much less).")
      ->type_name("PERCENT");
}

/// What `help build` leaves out, under the headings of `help build --all`.
void group_options(CLI::App& command) {
  const std::pair<const char*, std::vector<const char*>> groups[] = {
      {"More about files", {"--in-format", "--scale", "--recenter", "--out-format", "--certificate", "--threads"}},
      {"More about bounds", {"--max-void", "--tolerance", "--strict"}},
      {"More about repairs", {"--open-shells", "--keep-cavities", "--seal-holes"}},
      {"More about hulls", {"--mirror", "--best-of", "--seed"}},
      {"More for research",
       {"--strategy", "--self-intersections", "--keep-guards", "--max-valence", "--min-compactness-ratio",
        "--sufficient-compactness", "--max-normal-deviation", "--max-overhang"}}};
  for (const auto& [heading, names] : groups)
    for (const char* const name : names) command.get_option(name)->group(heading);
}

}  // namespace

void add_build(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<BuildOptions>(
      app, run, "build",
      "Builds a hull of a mesh: a mesh of fewer faces that provably encloses it. Any triangles will do; what is not "
      "closed is repaired or wrapped. Building repeats one step, the collapse: the two ends of an edge become one new "
      "vertex, and two faces vanish. The file that was written is read again and certified by exact arithmetic.",
      run_build);
  EnclosingOptions& enclosing = options.enclosing;
  HullOptions& hull = enclosing.hull;
  hull.relax_guards = true;
  add_mesh_inputs(command, options.meshes, options.input, "Mesh to build a hull of.");
  CLI::Option* const recenter = command.add_flag(
      "--recenter", options.recenter,
      "Subtract a round offset near the middle of the mesh from all coordinates, where the mesh is far from the "
      "origin. STL and GLB files keep too few digits there. The offset stands in the summary and in the report; add it "
      "to place the hull, and give it to `prohull verify --offset`.");
  add_mesh_output_options(command, options.out, options.out_format,
                          "the hull, in whose name {faces} becomes the number of faces asked for, and {name} that of "
                          "the mesh's file; or a folder, whose name ends in /");
  add_number(
      command, "--faces", options.faces, {4, 1e9},
      "Number of faces that the hull should have, at least 4. Several numbers, as in 1000,100, make a hull each.")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("N[,N...]");
  add_bounds(command, options);
  add_choice(command, "--side", hull.side, hull_side_names(),
             "Side of the mesh's surface on which the hull lies: an outer hull encloses the mesh, an inner hull is "
             "enclosed by it.");
  CLI::Option* const tight = command.add_flag(
      "--tight", enclosing.tight,
      "Also move vertices towards the mesh between collapses. Such a hull has the least void, but takes some 4 times "
      "as long to build: 1.5 to 14 times at 100 faces. It does not intersect itself unless the mesh does, as it is or "
      "with its openings closed; the summary counts the pairs of faces.");
  CLI::Option* const gap =
      add_length(command, "--gap", options.gap,
                 "Least distance between hull and mesh. It is proven. All points within this distance of the mesh are "
                 "inside of an outer hull. An inner hull leaves out what is thinner than two gaps. --max-distance must "
                 "be greater. Use --tight for the least void.");
  CLI::Option* const tolerance =
      add_value(
          command, "--tolerance", options.tolerance, "FILE",
          "YAML file of regions of the mesh: for each a box, color, group, or numbers of faces or vertices, and how "
          "far its faces may be from the hull, or that they are kept as they are. See docs/guides/regions.md.")
          ->excludes(tight)
          ->excludes(gap);
  add_choice(
      command, "--mirror", hull.mirror, axis_names(),
      "Build a symmetric hull: it is exactly its own mirror image in the plane through the middle of the bounding box "
      "that is perpendicular to this axis. The mesh must be symmetric too, bit for bit. See docs/guides/symmetry.md.")
      ->excludes(tight)
      ->excludes(gap)
      ->excludes(tolerance);
  add_choice(command, "--repair", enclosing.repair, repair_names(),
             "What to do with a mesh that is not clean. auto repairs it, builds hulls of the mesh, of its convex hull "
             "and of a wrap, a new closed surface around it, and takes the best; none refuses what is not closed; wrap "
             "does without the mesh itself.");
  add_choice(command, "--open-shells", enclosing.open_shells, open_shells_names(),
             "What to do with openings. close gives them caps, so that what they lead into is inside; keep encloses "
             "the triangles only, as those of a thin shell. A leaf or a bedsheet always stays a sheet.");
  command.add_flag("--keep-cavities", enclosing.keep_cavities,
                   "Keep parts of the mesh that lie inside of other parts. An outer hull encloses them also if they "
                   "are dropped; an inner hull always keeps them.");
  add_length(command, "--seal-holes", options.seal_holes,
             "Close openings up to this diameter where the mesh is wrapped.");
  add_choice(command, "--strategy", hull.strategy, strategy_names(),
             "Order in which edges collapse. lazy is the tightest and fastest; paper1 and paper2 are those of Platis "
             "and Theoharis (2003).");
  add_value(command, "--hierarchy", options.hierarchy, "H.phull",
            "Also write all levels between hull and mesh to this file, for lod, verify, query and render. The hull is "
            "then the coarsest of these levels: collapses alone make it, and with few faces it may be much larger than "
            "without this option.")
      ->excludes(tight)
      ->excludes(gap);
  add_certificate_option(command, options.certificate, "the hull",
                         " There is none of an inner hull of a mesh that is not closed.")
      ->excludes(recenter);
  add_choice(command, "--self-intersections", hull.self_intersections, self_intersections_names(),
             "Whether collapses may make an outer hull intersect itself, which is faster. by-strategy allows it for "
             "the strategies paper1 and paper2 only.");
  add_number(command, "--best-of", enclosing.best_of, {1, 1e6},
             "Build this many hulls, with a seed each, and keep the one of least void.");
  add_number(command, "--seed", hull.seed, kSeed,
             "Number that varies the order of collapses a little, and so the hull; the first seed of --best-of.");
  add_threads_option(command, hull.threads, "The hull is the same for any number.");
  command.add_flag("--strict", options.strict,
                   "Exit with code 1 if the number of faces is not reached and no bound asks for more; a bound that is "
                   "missed always does so.");
  add_report_option(command, options.report);
  add_guards(command, options);
  group_options(command);
  add_examples(command, {"prohull build horse.ply --faces 2000 -o hull.ply",
                         "prohull build arm.stl --unit mm --faces 500 -o arm_collision.stl --report arm.json",
                         "prohull build arm.stl --faces 200 --tight -o arm_collision.stl",
                         "prohull build arm.stl --faces 200 --tight --best-of 9 -o arm_collision.stl",
                         "prohull build arm.stl --faces 50 --tight --max-distance 2 -o arm_collision.stl",
                         "prohull build arm.stl --unit mm --faces 300 --gap 5mm -o arm_collision.stl",
                         "prohull build parts/*.stl --faces 300 -o hulls/",
                         "prohull build horse.ply --faces 300 --tight --gap 0.5% -o cage.obj",
                         "prohull build horse.ply --faces 300 --gap 0.5% --side inner -o core.obj",
                         "prohull build arm.obj --faces 800 --tolerance regions.yaml -o arm_collision.obj",
                         "prohull build horse.ply --faces 400 --mirror x -o hull.ply",
                         "prohull build arm.dae --faces 1000,300,100 -o arm_{faces}.stl",
                         "prohull build open_scan.obj --faces 500 --seal-holes 0.02 -o scan.glb",
                         "prohull build house_utm.ply --recenter --faces 200 -o house.glb --report house.json",
                         "prohull build rock.obj --side inner --faces 300 -o occluder.obj",
                         "prohull build horse.ply --faces 200 -o hull.ply --hierarchy horse.phull",
                         "prohull build arm.stl --faces 200 -o arm_collision.stl --certificate arm.phcert",
                         "prohull build - --in-format stl -o - --out-format ply <part.stl >hull.ply"});
}

}  // namespace prohull::cli
