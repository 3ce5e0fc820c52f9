#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "certificate_output.h"
#include "command.h"
#include "engine_rules.h"
#include "prohull/convex_cover.h"
#include "prohull/detail/cover_summary.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/files/piece_files.h"
#include "several.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

using std::filesystem::path;

struct ConvexOptions {
  std::vector<path> meshes;
  path in;  ///< one of them
  path out, certificate, report;
  ConvexCoverOptions cover;
  InputOptions input;
  std::string out_format;
  std::optional<const EngineRules*> engine;
  Length max_distance;
  double max_void_percent = 0;  ///< 0: any
};

std::string engine_name(const ConvexOptions& options) {
  return std::string(name_of(engine_names(), options.engine.value()));
}

OutputKind piece_outputs() {
  OutputKind kind{"convex pieces", written_mesh_extensions()};
  kind.suffixes.insert(kind.suffixes.end(), {".urdf", ".xml"});
  return kind;
}

/// What holds all pieces in one file.
OutputKind whole_outputs() {
  OutputKind kind{"convex pieces", {}};
  for (const std::string& suffix : written_mesh_extensions())
    if (holds_several_meshes(mesh_format("x" + suffix))) kind.suffixes.push_back(suffix);
  return kind;
}

std::string suffix_of(const ConvexOptions& options) {
  OutputKind kind = is_standard_stream(options.out) ? whole_outputs() : piece_outputs();
  if (!options.engine || options.engine.value()->suffixes.empty())
    return output_suffix(options.out, kind, options.out_format);
  const std::vector<std::string>& read = options.engine.value()->suffixes;
  std::erase_if(kind.suffixes,
                [&](const std::string& suffix) { return std::ranges::find(read, suffix) == read.end(); });
  const std::string what = "convex pieces for " + engine_name(options);
  kind.what = what;
  if (kind.suffixes.empty()) refuse(fmt::format("{} are not written to standard output; name a file", what));
  const std::string suffix = output_suffix(options.out, kind, options.out_format);
  if (std::ranges::find(kind.suffixes, suffix) == kind.suffixes.end())
    refuse(fmt::format("{} are not written to {} files; they are written to {}", what, suffix,
                       alternatives(kind.suffixes)));
  return suffix;
}

/// The names of the pieces: that of the mesh or of the output, with a number, between the engine's prefix and suffix.
std::vector<std::string> names_of(const ConvexOptions& options, const std::string& stem) {
  const EngineRules rules = options.engine ? *options.engine.value() : EngineRules{};
  const bool from_mesh = rules.named_as_mesh && !is_standard_stream(options.in);
  const std::string name = std::string(rules.prefix) + (from_mesh ? named_after("{name}", options.in).string() : stem);
  const std::size_t most = options.cover.max_pieces;
  std::vector<std::string> names = most == 1 ? std::vector{name} : robot::piece_names(name, most);
  for (std::string& each : names) each += rules.suffix;
  return names;
}

/// The largest piece in a file; none if the file does not hold the very triangles of the pieces, in their order.
std::optional<PieceSize> written_size(const path& file, std::span<const ConvexPiece> pieces) {
  TriangleMesh all;
  std::vector<std::size_t> faces;
  for (const ConvexPiece& piece : pieces) append(all, piece.mesh), faces.push_back(piece.mesh.face_count());
  if (!holds_triangles_of(file, all)) return std::nullopt;
  return largest_piece(all, faces);
}

/// Which files the pieces go to: one for all, or a file for each, beside a robot file that names them or without it.
class PieceFiles {
 public:
  /// Throws InputError for names and options that contradict each other.
  explicit PieceFiles(const ConvexOptions& options) : out_(options.out), suffix_(suffix_of(options)) {
    stem_ = is_standard_stream(out_) ? "piece" : out_.stem().string();
    names_ = names_of(options, stem_);
    check(options);
  }

  bool is_robot() const { return suffix_ == ".urdf" || suffix_ == ".xml"; }
  bool is_one() const { return !is_robot() && holds_several_meshes(mesh_format("x" + suffix_)); }
  std::string mesh_suffix() const { return is_robot() ? ".stl" : suffix_; }
  bool has_float32() const { return stores_float32(mesh_format("x" + mesh_suffix())); }
  const std::string& name(std::size_t piece) const { return names_[piece]; }
  path path_of(std::size_t piece) const { return path(out_).replace_filename(names_[piece] + mesh_suffix()); }

  /// All files of these pieces.
  std::vector<path> written(const std::vector<ConvexPiece>& pieces) const {
    std::vector<path> files;
    if (is_one() || is_robot()) files.push_back(out_);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (has_file(pieces[i])) files.push_back(path_of(i));
    return files;
  }

  /// Returns the largest piece in the files; none if they do not hold the very bits of the pieces.
  std::optional<PieceSize> add_to(Outputs& outputs, const std::vector<ConvexPiece>& pieces) const {
    if (is_one()) return add_file(outputs, out_, pieces);
    PieceSize largest;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (!has_file(pieces[i])) continue;
      const auto size = add_file(outputs, path_of(i), {&pieces[i], 1});
      if (!size) return std::nullopt;
      largest = {std::max(largest.vertices, size->vertices), std::max(largest.polygons, size->polygons)};
    }
    if (is_robot()) outputs.add(out_, robot_file(pieces));
    return largest;
  }

  /// The files of these pieces that hold meshes, in the order of the pieces.
  std::vector<path> meshes(const std::vector<ConvexPiece>& pieces) const {
    std::vector<path> files = written(pieces);
    if (is_robot()) files.erase(files.begin());
    return files;
  }

  /// Names of files beside those of the pieces that look as if they held pieces too.
  std::vector<std::string> others(const std::vector<ConvexPiece>& pieces) const {
    std::set<std::string> own;
    for (const path& file : written(pieces)) own.insert(file.filename().string());
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry :
         std::filesystem::directory_iterator(out_.has_parent_path() ? out_.parent_path() : ".", error)) {
      const std::string name = entry.path().filename().string();
      if (!is_one() && is_numbered(name) && !own.contains(name)) found.push_back(name);
    }
    std::ranges::sort(found);
    return found;
  }

  /// Of these no more is decided than that polytopes inside of them cover the mesh: robot files are not read again.
  bool has_shapes(const std::vector<ConvexPiece>& pieces) const {
    return is_robot() && !std::ranges::all_of(pieces, is_mesh);
  }

  static bool is_mesh(const ConvexPiece& piece) { return std::holds_alternative<std::monostate>(piece.primitive); }

 private:
  void check(const ConvexOptions& options) const {
    if (is_standard_stream(out_) && !is_one())
      refuse("standard output (-) takes one file only; write .obj or .glb, or name the file");
    if (!is_robot() && (options.cover.shape == PieceShape::Capsule || options.cover.shape == PieceShape::Ball))
      refuse(fmt::format("{}: mesh files hold no {}; write .urdf or .xml", output_name(out_),
                         options.cover.shape == PieceShape::Ball ? "spheres" : "capsules"));
    check_certified(options.certificate, options.in, mesh_suffix());
    if (!options.certificate.empty() && is_robot() && options.cover.shape != PieceShape::Polytope)
      refuse("--certificate: prohull_check reads the mesh files of pieces only; leave --shape out");
    std::vector<path> files = written(std::vector<ConvexPiece>(options.cover.max_pieces));
    files.insert(files.end(), {options.certificate, options.report});
    check_files({options.in}, files);
    if (is_robot()) robot::urdf_of(stem_, {});  // refuses its name before any work
  }

  bool has_file(const ConvexPiece& piece) const { return !is_one() && (!is_robot() || is_mesh(piece)); }

  /// Returns the largest piece in the file, as add_to does.
  std::optional<PieceSize> add_file(Outputs& outputs, const path& target, std::span<const ConvexPiece> pieces) const {
    std::vector<TriangleMesh> meshes;
    for (const ConvexPiece& piece : pieces) meshes.push_back(piece.mesh);
    std::optional<PieceSize> size;
    outputs.add(target, mesh_suffix(), [&](const path& file) {
      is_one() ? write_meshes(file, meshes, std::span(names_).first(pieces.size())) : write_mesh(file, meshes.front());
      size = written_size(file, pieces);
      return size.has_value();
    });
    return size;
  }

  std::string robot_file(const std::vector<ConvexPiece>& pieces) const {
    std::vector<robot::NamedPiece> named;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      named.push_back({pieces[i].primitive, has_file(pieces[i]) ? path_of(i).filename().string() : ""});
    return suffix_ == ".urdf" ? robot::urdf_of(stem_, named) : robot::mjcf_of(stem_, named);
  }

  /// Whether it is the name of a piece with some number.
  bool is_numbered(const std::string& name) const {
    const std::string begin = stem_ + "_", end = mesh_suffix();
    if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return false;
    return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(begin.size()),
                       name.end() - static_cast<std::ptrdiff_t>(end.size()),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  }

  path out_;
  std::string suffix_, stem_;
  std::vector<std::string> names_;
};

struct Outcome {
  MeshReport input;
  double diagonal = 0;
  ConvexCover cover;          ///< its verdict is about the files
  PieceSize largest;          ///< in the files; zeros if none is a mesh
  bool within_limits = true;  ///< of the engine
  Certificate certificate;
  std::vector<std::string> others;
  double read_seconds = 0, write_seconds = 0;

  bool certified() const { return cover.verdict.certified; }
  int exit_code() const { return certified() && cover.within_bounds && within_limits ? kDone : kAnswerIsNo; }
};

Certificate certificate_of(const ConvexCover& cover, const CertifiedOriginal& original) {
  std::vector<TriangleMesh> meshes;
  for (const ConvexPiece& piece : cover.pieces) meshes.push_back(piece.mesh);
  return pieces_certificate(meshes, original);
}

// Summary and report

std::string_view shape_name(const ConvexPiece& piece) { return name_of(piece_shape_names(), shape_of(piece)); }

/// "24 vertices (limit 64)"
std::string described_limit(std::size_t number, const char* what, std::size_t limit) {
  return fmt::format("{} {}{}", number, what, limit == 0 ? "" : fmt::format(" (limit {})", limit));
}

void print_limits(const ConvexOptions& options, const Outcome& outcome) {
  const EngineRules& rules = *options.engine.value();
  say("  {}for {}: pieces as written have at most {} and {}\n", outcome.within_limits ? "" : "NOT ",
      engine_name(options), described_limit(outcome.largest.vertices, "vertices", rules.vertices),
      described_limit(outcome.largest.polygons, "polygons", rules.polygons));
}

/// What keeps the pieces from the bounds. A piece may be left with a few vertices less than its limit.
std::string what_to_allow(const ConvexOptions& options, const ConvexCover& cover) {
  constexpr double kFull = 0.9;
  const bool has_full = std::ranges::any_of(cover.pieces, [&](const ConvexPiece& piece) {
    return double(piece.mesh.vertex_count()) >= kFull * double(options.cover.max_vertices);
  });
  const bool may_be_cut = !has_full || cover.pieces.size() == options.cover.max_pieces;
  return fmt::format("{}{}", may_be_cut ? "more --pieces, or " : "",
                     has_full ? fmt::format("more than {} --vertices, or ", options.cover.max_vertices) : "");
}

void print_summary(const ConvexOptions& options, const PieceFiles& files, const Outcome& outcome) {
  const ConvexCover& cover = outcome.cover;
  say("{}: {}, {}\n", input_name(options.in), counted(outcome.input.faces, "face"),
      counted(outcome.input.components, "component"));
  for (const std::string& note : cover.notes) say("  {}\n", note);
  say("{}\n", line_of_cover(output_name(options.out), cover, outcome.diagonal));
  say("  {}\n",
      files.has_shapes(cover.pieces)
          ? line_of_proof(cover, "the union of polytopes, which lie in the shapes as written by construction,")
          : line_of_proof(cover));
  if (options.engine && outcome.largest.vertices > 0) print_limits(options, outcome);
  const auto in_shape = static_cast<std::size_t>(std::ranges::count(cover.pieces, options.cover.shape, shape_of));
  if (in_shape < cover.pieces.size())
    say("  {} of {} pieces have the shape asked for; no more were found to keep the bounds\n", in_shape,
        cover.pieces.size());
  if (!cover.within_bounds)
    say("  NOT within the bounds asked for; allow {}larger bounds\n", what_to_allow(options, cover));
  if (outcome.certified() && !options.certificate.empty())
    print_certificate(options.certificate, outcome.certificate, files.meshes(cover.pieces), options.in);
  if (!outcome.others.empty())
    say("  also there, but not of this run: {}; remove them if they are pieces of an earlier one\n",
        fmt::join(outcome.others, ", "));
  say("  read {:.2f} s, cover {:.2f} s, write {:.2f} s, verify {:.2f} s\n", outcome.read_seconds, cover.seconds,
      outcome.write_seconds, cover.verify_seconds);
  for (std::size_t i = 0; i < cover.pieces.size(); ++i)
    say_more("  {}: {}, {} vertices, volume {:.4g}\n", files.name(i), shape_name(cover.pieces[i]),
             cover.pieces[i].mesh.vertex_count(), signed_volume(cover.pieces[i].mesh));
}

nlohmann::json facts_of(const ConvexPiece& piece, const std::string& name) {
  const PieceShape shape = shape_of(piece);
  const bool is_round = shape == PieceShape::Capsule || shape == PieceShape::Ball;
  return {{"name", name},
          {"shape", shape_name(piece)},
          {"vertices", is_round ? nlohmann::json() : nlohmann::json(piece.mesh.vertex_count())},
          {"faces", is_round ? nlohmann::json() : nlohmann::json(piece.mesh.face_count())},
          {"volume", volume_of(piece)}};
}

nlohmann::json options_report(const ConvexOptions& options) {
  const ConvexCoverOptions& cover = options.cover;
  return {
      {"for", options.engine ? nlohmann::json(engine_name(options)) : nlohmann::json()},
      {"pieces", cover.max_pieces},
      {"vertices", cover.max_vertices},
      {"scale", options.input.factor()},
      {"max_distance", finite_or_null(cover.bounds.max_distance)},
      {"max_void_percent", options.max_void_percent > 0 ? nlohmann::json(options.max_void_percent) : nlohmann::json()},
      {"shape", name_of(piece_shape_names(), cover.shape)},
      {"float32_coordinates", cover.float32_coordinates}};
}

nlohmann::json report_of(const ConvexOptions& options, const PieceFiles& files, const Outcome& outcome) {
  const ConvexCover& cover = outcome.cover;
  nlohmann::json in = facts(outcome.input), pieces = nlohmann::json::array(), paths = pieces;
  in["path"] = options.in.string();
  in["diagonal"] = outcome.diagonal;
  for (std::size_t i = 0; i < cover.pieces.size(); ++i) pieces.push_back(facts_of(cover.pieces[i], files.name(i)));
  if (outcome.certified())
    for (const path& file : files.written(cover.pieces)) paths.push_back(file.string());
  return {{"input", in},
          {"paths", paths},
          {"pieces", pieces},
          {"verdict", facts(cover.verdict)},
          {"shapes_by_construction", files.has_shapes(cover.pieces)},
          {"volume", finite_or_null(cover.volume)},
          {"volume_is_bound", cover.volume_is_bound},
          {"original_volume", finite_or_null(cover.original_volume)},
          {"void_ratio", cover.original_volume > 0 ? finite_or_null(cover.void_ratio) : nlohmann::json()},
          {"void_is_estimated", cover.is_estimated},
          {"within_bounds", cover.within_bounds},
          {"largest_piece", {{"vertices", outcome.largest.vertices}, {"polygons", outcome.largest.polygons}}},
          {"within_limits", outcome.within_limits},
          {"notes", cover.notes},
          {"other_files", outcome.others},
          {"seconds",
           {{"read", outcome.read_seconds},
            {"cover", cover.seconds},
            {"write", outcome.write_seconds},
            {"verify", cover.verify_seconds}}},
          {"options", options_report(options)}};
}

Outcome cover_and_write(ConvexOptions options, const PieceFiles& files) {
  options.cover.boxes_as_meshes = !files.is_robot();
  if (options.engine)
    options.cover.max_vertices = std::min(options.cover.max_vertices, most_vertices(*options.engine.value()));
  if (options.max_void_percent > 0) options.cover.bounds.max_void_ratio = options.max_void_percent / 100;
  Outcome outcome;
  InputMesh in = read_given(options.in, options.input);
  outcome.read_seconds = in.seconds;
  outcome.input = inspect(in.mesh);
  outcome.diagonal = finite_bounding_box(in.mesh).diagonal();
  in.unit.set(options.cover.bounds.max_distance, options.max_distance, "--max-distance");
  const bool may_write_meshes =
      !files.is_robot() || options.cover.shape == PieceShape::Polytope || options.cover.bounds.any();
  options.cover.float32_coordinates =  // engines read OBJ as float32, too
      may_write_meshes && (files.has_float32() || options.engine);
  const CertifiedOriginal original = certified_original(options.certificate, in.mesh, options.in, options.input);
  outcome.cover = naming(options.in, options.cover,
                         [&](const ConvexCoverOptions& how) { return convex_cover(std::move(in.mesh), how); });
  Outputs pieces, report;
  const Stopwatch writing;
  Verdict& verdict = outcome.cover.verdict;
  const auto size = verdict.certified ? files.add_to(pieces, outcome.cover.pieces) : std::nullopt;
  verdict = as_written(std::move(verdict), size.has_value());
  if (size) {
    outcome.largest = *size;
    outcome.within_limits = !options.engine || is_within(*size, *options.engine.value());
  }
  outcome.write_seconds = writing.seconds();
  outcome.others = files.others(outcome.cover.pieces);
  if (outcome.certified() && !options.certificate.empty()) {
    outcome.certificate = certificate_of(outcome.cover, original);
    pieces.add(options.certificate, outcome.certificate.bytes);
  }
  report.add_report(options.report, report_of(options, files, outcome));
  if (outcome.certified()) pieces.commit();
  report.commit();
  return outcome;
}

/// The options with the names of what is written for this mesh.
ConvexOptions for_mesh(ConvexOptions options, const path& in) {
  options.in = in;
  const bool has_first = options.engine && !options.engine.value()->suffixes.empty();
  const std::string usual = has_first ? options.engine.value()->suffixes.front() : ".obj";
  options.out = pattern_of(options.out, options.out_format.empty() ? usual : "." + options.out_format);
  for (auto* const file : {&options.out, &options.certificate, &options.report}) *file = named_after(*file, in);
  return options;
}

std::string table_row(const Outcome& outcome) {
  const ConvexCover& cover = outcome.cover;
  const bool has_void = cover.verdict.encloses_solid == Answer::Yes && cover.original_volume > 0;
  return fmt::format("{:>11}  {:>6}  {:>8}  {:>9.4g}  {}{}", grouped(outcome.input.faces), cover.pieces.size(),
                     has_void ? (cover.is_estimated ? "~" : "") + percent_text(std::max(0.0, cover.void_ratio), 2) : "",
                     rounded_up(cover.verdict.distance().upper, 4), outcome.certified() ? "yes" : "NO",
                     !outcome.certified() || outcome.exit_code() == kDone ? "" : ", but not within what was asked");
}

int run_convex(const ConvexOptions& options) {
  const std::vector<path> meshes = mesh_files(options.meshes);
  Outputs folders;
  if (!options.out.has_filename()) folders.add_folder(options.out);
  if (meshes.size() == 1) {
    const ConvexOptions one = for_mesh(options, meshes.front());
    const PieceFiles files(one);
    const Outcome outcome = cover_and_write(one, files);
    print_summary(one, files, outcome);
    return outcome.exit_code();
  }
  check_outputs(meshes, [&](const path& mesh) {
    const ConvexOptions one = for_mesh(options, mesh);
    return NamedOutputs{{"-o", one.out}, {"--certificate", one.certificate}, {"--report", one.report}};
  });
  return run_each(meshes,
                  fmt::format("{:>11}  {:>6}  {:>8}  {:>9}  {}", "faces", "pieces", "void", "distance", "certified"),
                  [&](const path& mesh) {
                    const ConvexOptions one = for_mesh(options, mesh);
                    const Outcome outcome = cover_and_write(one, PieceFiles(one));
                    return MeshOutcome{outcome.exit_code(), {table_row(outcome)}, outcome.exit_code() == kDone};
                  });
}

}  // namespace

void add_convex(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<ConvexOptions>(
      app, run, "convex",
      "Covers a mesh by a few convex pieces, as physics engines take them. Together the pieces provably cover every "
      "triangle, and the inside too where the mesh is a solid. Any triangles will do. The files that were written are "
      "read again, and what they hold is certified by exact arithmetic. Of boxes, capsules and spheres in robot files, "
      "polytopes are certified that lie in them by construction.",
      run_convex);
  ConvexCoverOptions& cover = options.cover;
  add_mesh_inputs(command, options.meshes, options.input, "Mesh to cover.");
  add_value(command, "-o,--out", options.out, "PIECES",
            "File for the pieces. .obj and .glb hold all of them, each with a name. For .stl, .ply and .off each piece "
            "has a file: OUT_01.stl and so on. .urdf and .xml (MJCF) become a file of one link or body with all "
            "pieces, to be copied into a robot, with STL files beside it. With - it goes to standard output. {name} "
            "becomes the name of the mesh's file; a folder, whose name ends in /, gets an .obj file of each mesh, or "
            "what --for takes.")
      ->required();
  add_out_format_option(command, options.out_format, piece_outputs());
  add_choice(command, "--for", options.engine, engine_names(),
             "Engine that takes the pieces: keeps its limits of vertices and polygons, which are counted in the files "
             "as written, refuses formats that it does not read, and names pieces as it knows them. Coordinates stay "
             "those of the mesh (docs/guides/covers.md).");
  add_certificate_option(command, options.certificate, "the pieces");
  add_number(command, "--pieces", cover.max_pieces, {1, 1000},
             "Largest number of pieces. With 1, the file of the piece has the name OUT, without a number.");
  add_number(command, "--vertices", cover.max_vertices, {4, 1e6}, "Largest number of vertices of a piece, at least 4.");
  add_length(command, "--max-distance", options.max_distance,
             "Largest allowed distance that the pieces may reach out of the mesh. Points of a piece that lie in other "
             "pieces, or in the solid of the mesh, do not count. What closes openings of the mesh counts as mesh. With "
             "such a bound there are as few pieces as are found to keep it.");
  add_optional_number(command, "--max-void", options.max_void_percent, kPercent,
                      "Largest allowed void, in per cent. The void is how much more volume the pieces have together "
                      "than the mesh. With such a bound there are as few pieces as are found to keep it.")
      ->type_name("PERCENT");
  add_choice(command, "--shape", cover.shape, piece_shape_names(),
             "Shape of the pieces. With a bound, a piece has this shape only where the bound allows it, and is a "
             "polytope elsewhere. Mesh files hold polytopes and boxes only.");
  add_threads_option(command, cover.threads, "The pieces are the same for any number.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull convex horse.ply -o horse_pieces.obj",
                         "prohull convex arm.stl --unit mm --pieces 8 --vertices 32 -o arm_collision.glb",
                         "prohull convex arm.stl --for godot -o arm_collision.glb",
                         "prohull convex arm.stl --max-distance 2 --pieces 64 -o arm_piece.stl --report arm.json",
                         "prohull convex arm.stl --unit mm --pieces 8 -o arm_pieces.urdf",
                         "prohull convex arm.stl --unit mm --shape capsule --max-void 60 -o arm_pieces.xml",
                         "prohull convex parts/ --pieces 8 -o pieces/",
                         "prohull convex pump.stl --pieces 1 --vertices 16 -o pump_polytope.stl"});
}

}  // namespace prohull::cli
