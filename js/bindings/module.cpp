// What JavaScript calls (js/prohull/engine.js). Each function takes and gives plain objects. What goes wrong is an
// object with `error` and its name, as no exception of C++ may reach JavaScript.
#include <emscripten/bind.h>
#include <emscripten/heap.h>
#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "calls.h"
#include "levels.h"
#include "prohull/convex_cover.h"
#include "prohull/detail/cover_summary.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/given_options.h"
#include "prohull/detail/summary.h"
#include "prohull/detail/told_notes.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/hull_file.h"
#include "prohull/length.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/progressive_hull.h"
#include "prohull/verification.h"

namespace prohull::js {
namespace {

/// As Verdict has them: the upper bounds, which are proven.
void add_distances(val& object, const Verdict& verdict) {
  if (verdict.distance_to_triangles) object.set("distanceToTriangles", verdict.distance_to_triangles->upper);
  if (verdict.distance_to_solid) object.set("distanceToSolid", verdict.distance_to_solid->upper);
}

val object_of(const EnclosingHull& hull, const EnclosingHulls& made) {
  val object = object_of_mesh(hull.mesh);
  object.set("certified", hull.certified);
  object.set("proof", std::string(hull.certified ? hull.verdict.proof : ""));
  object.set("gap", hull.padding);
  object.set("targetReached", hull.target_reached);
  object.set("withinBounds", hull.within_bounds);
  object.set("voidRatio", hull.void_ratio);
  object.set("source", std::string(name_of(source_names(), hull.source)));
  object.set("selfIntersections", hull.self_intersections);
  object.set("repairs", strings_of(describe(made.input.repairs)));
  object.set("notes", strings_of(told_notes(hull, made)));
  object.set("buildSeconds", hull.build_seconds);
  object.set("verifySeconds", hull.verify_seconds);
  return object;
}

/// The lines that `prohull build` prints of a hull, written to a file of that name.
void add_summary(val& object, const std::string& file, const EnclosingHull& hull, const EnclosingHulls& made,
                 const EnclosingOptions& options) {
  const HullMeasures measures = measures_of(made, hull, options.bounds, options.progress);
  const ToldHull told{made, hull, options, measures, self_intersections_of_input(made)};
  std::vector<std::string> lines = lines_of_repairs(made.input);
  lines.insert(lines.end(), hull.notes.begin(), hull.notes.end());
  lines.push_back(line_of_hull(file, told));
  const std::string content = hull.certified ? mesh_content(file, hull.mesh) : "";
  const bool written = hull.certified && has_triangles_of(read_mesh(std::string_view(content), file), hull.mesh);
  const Verdict verdict = as_written(measures.verdict, written);
  for (const auto& more : {lines_of_shape(told), lines_of_limits(told), lines_of_proof(verdict)})
    lines.insert(lines.end(), more.begin(), more.end());
  object.set("summary", strings_of(lines));
  object.set("certified", verdict.certified);
  const auto cells = cells_of_hull(told, verdict);
  object.set("tableRow", strings_of({cells.begin(), cells.end()}));
  add_distances(object, measures.verdict);
}

val build(const val& mesh, const val& targets, const val& given, const val& progress) {
  std::string file;
  const EnclosingOptions options = options_of(given, progress, [&](const Given& named) {
    named.text("summary_of", file);
    return enclosing_options(named);
  });
  std::vector<std::size_t> faces;
  for (const double target : numbers_of(targets, "targetFaces")) {
    check_whole(target, "targetFaces", 4);
    faces.push_back(static_cast<std::size_t>(target));
  }
  const EnclosingHulls made = enclosing_hulls(mesh_of(mesh, "mesh"), faces, options);
  val hulls = val::array();
  for (const EnclosingHull& hull : made.hulls) {
    val object = object_of(hull, made);
    if (options.levels && hull.levels)
      object.set("levels", object_of_levels(hull.levels->with_finest_level(finest_level(made, hull))));
    if (!file.empty()) add_summary(object, file, hull, made, options);
    hulls.call<void>("push", object);
  }
  return hulls;
}

/// As `prohull lod` extracts it for a file, and what that prints of it, if there is a name for the file.
val level(const val& levels, double faces, const val& given, const val& progress) {
  bool float32 = false;
  std::string file;
  const auto options = options_of(given, progress, [&](const Given& named) {
    named.flag("float32_coordinates", float32);
    named.text("summary_of", file);
    return VerificationOptions{};
  });
  if (!(faces >= 0)) throw InputError(Defect::InvalidOption, "faces: expected a number, at least 0");
  const ProgressiveHull hull = levels_of(levels);
  if (faces != 0 && faces < static_cast<double>(hull.base_face_count()))
    throw InputError(Defect::InvalidOption,
                     fmt::format("faces={:.17g}: the coarsest level has {} faces", faces, hull.base_face_count()));
  const auto target = static_cast<std::size_t>(std::min<double>(faces, 0xffffffff));
  TriangleMesh found = hull.level(target);
  if (float32) found = float32_level(hull, found);
  val object = object_of_mesh(found);
  if (file.empty()) return object;
  const TriangleMesh written = read_mesh(std::string_view(mesh_content(file, found)), file), finest = hull.original();
  std::optional<Verification> verdict;
  if (!has_triangles_of(written, finest)) verdict = verify_hull(written, finest, hull.side(), options);
  object.set("certified", !verdict || verdict->certified);
  object.set("summary", strings_of(lines_of_level(file, {hull, target, found.face_count(), verdict})));
  return object;
}

/// Of the bytes of a .phull file.
val read_levels(const val& bytes, const std::string& name) {
  const auto content = emscripten::convertJSArrayToNumberVector<unsigned char>(bytes);
  return object_of_levels(
      load_hull(std::string_view(reinterpret_cast<const char*>(content.data()), content.size()), name));
}

/// The bytes of a .phull file.
val write_levels(const val& levels) { return object_of_file(hull_content(levels_of(levels))); }

val object_of(const Verification& found, double gap) {
  val object = val::object();
  object.set("holds", found.certified);
  object.set("encloses", found.encloses);
  object.set("keepsGap", gap > 0 && !found.is_gap_undecided() ? val(found.keeps_gap) : val::null());
  object.set("proof", std::string(found.proof));
  object.set("originalClosed", found.original_closed);
  object.set("whyNot", found.why_not);
  object.set("facesOutside", found.faces_outside);
  object.set("facesTooNear", found.faces_too_near);
  object.set("facesUndecided", found.faces_undecided);
  object.set("selfIntersections", found.self_intersections);
  object.set("leastDistance", found.least_distance);
  object.set("originalVolume", found.original_volume);
  object.set("voidRatio", found.void_ratio);
  object.set("notes", strings_of(found.notes));
  val worst = val::array();
  for (const Offender& offender : found.worst) {
    val one = val::object();
    one.set("face", index(offender.face));
    one.set("point", array_of(offender.point));
    one.set("distance", offender.distance);
    worst.call<void>("push", one);
  }
  object.set("worst", worst);
  return object;
}

val verify(const val& hull, const val& original, const val& given, const val& progress) {
  HullSide side = HullSide::Outer;
  const auto options = options_of(given, progress, [&](const Given& named) {
    VerificationOptions read;
    named.choice("side", hull_side_names(), side);
    named.flag("solid_only", read.solid_only);
    named.flag("finite_only", read.finite_only);
    named.not_negative("gap", read.gap);
    return read;
  });
  return object_of(verify_hull(mesh_of(hull, "hull"), mesh_of(original, "original"), side, options), options.gap);
}

val distance(const val& from, const val& to, const val& given, const val& progress) {
  bool finite_only = false;
  const auto options = options_of(given, progress, [&](const Given& named) {
    DistanceOptions read;
    named.not_negative("relative_gap", read.relative_gap);
    named.flag("finite_only", finite_only);
    return read;
  });
  TriangleMesh target = mesh_of(to, "to");
  if (finite_only) target = with_finite_faces(std::move(target));
  const DistanceBounds bounds = distance_bounds(mesh_of(from, "from"), target, options);
  val object = val::object();
  object.set("lower", bounds.lower);
  object.set("upper", bounds.upper);
  object.set("farthest", array_of(bounds.farthest));
  return object;
}

template <class Cover>
val object_of_cover(const Cover& cover) {
  val object = val::object();
  object.set("certified", cover.verdict.certified);
  object.set("coversInside", cover.verdict.encloses_solid == Answer::Yes);
  object.set("volume", cover.volume);
  object.set("originalVolume", cover.original_volume);
  object.set("withinBounds", cover.within_bounds);
  add_distances(object, cover.verdict);
  object.set("notes", strings_of(told_notes(cover)));
  return object;
}

/// The lines that `prohull convex` prints of the pieces, written to a file of that name.
std::vector<std::string> summary_of(const std::string& file, const ConvexCover& cover, const TriangleMesh& mesh) {
  std::vector<std::string> lines = cover.notes;
  lines.push_back(line_of_cover(file, cover, finite_bounding_box(mesh).diagonal()));
  lines.push_back(line_of_proof(cover));
  return lines;
}

/// As `prohull spheres` prints them.
std::vector<std::string> summary_of(const std::string& file, const SphereCover& cover, const TriangleMesh& mesh) {
  std::vector<std::string> lines{line_of_cover(file, cover, mesh.face_count(), finite_bounding_box(mesh).diagonal())};
  if (const std::string volume = line_of_volume(cover); !volume.empty()) lines.push_back(volume);
  lines.insert(lines.end(), cover.notes.begin(), cover.notes.end());
  lines.push_back(line_of_proof(cover));
  return lines;
}

struct SetPrimitive {
  val& object;

  void operator()(std::monostate) const {}
  void operator()(const OrientedBox& box) const {
    val shape = named("box");
    shape.set("center", array_of(box.center));
    shape.set("axes", array_of(&box.axes[0].x, 9));
    shape.set("halfSizes", array_of(box.half_sizes));
  }
  void operator()(const Capsule& capsule) const {
    val shape = named("capsule");
    shape.set("a", array_of(capsule.a));
    shape.set("b", array_of(capsule.b));
    shape.set("radius", capsule.radius);
  }
  void operator()(const Ball& ball) const {
    val shape = named("sphere");
    shape.set("center", array_of(ball.center));
    shape.set("radius", ball.radius);
  }

 private:
  val named(const char* kind) const {
    val shape = val::object();
    shape.set("kind", std::string(kind));
    object.set("primitive", shape);
    return shape;
  }
};

void add_parts(val& object, const ConvexCover& cover) {
  val pieces = val::array();
  for (const ConvexPiece& piece : cover.pieces) {
    val one = object_of_mesh(piece.mesh);
    std::visit(SetPrimitive{one}, piece.primitive);
    pieces.call<void>("push", one);
  }
  object.set("pieces", pieces);
}

void add_parts(val& object, const SphereCover& cover) {
  object.set("balls", array_of(reinterpret_cast<const double*>(cover.balls.data()), 4 * cover.balls.size()));
}

template <class Read, class Make>
val covered(const val& given_mesh, const val& given, const val& progress, Read read, Make make) {
  std::string file;
  const auto options = options_of(given, progress, [&](const Given& named) {
    named.text("summary_of", file);
    return read(named);
  });
  const TriangleMesh mesh = mesh_of(given_mesh, "mesh");
  const auto cover = make(mesh, options);
  val object = object_of_cover(cover);
  if (!file.empty()) object.set("summary", strings_of(summary_of(file, cover, mesh)));
  add_parts(object, cover);
  return object;
}

val convex_pieces(const val& mesh, const val& given, const val& progress) {
  return covered(mesh, given, progress, convex_cover_options<Given>, convex_cover);
}

val spheres(const val& mesh, const val& given, const val& progress) {
  return covered(mesh, given, progress, sphere_cover_options<Given>, sphere_cover);
}

val repair(const val& mesh, const val& given, const val& progress) {
  const ClosedSolidOptions options = options_of(given, progress, closed_solid_options<Given>);
  const ClosedSolid made = closed_solid(mesh_of(mesh, "mesh"), options);
  val object = object_of_mesh(made.mesh);
  object.set("certified", made.verdict.certified);
  object.set("whyNot", made.verdict.why_not);
  object.set("source", std::string(name_of(source_names(), made.source)));
  object.set("repairs", strings_of(describe(made.input.repairs)));
  object.set("obstacle", made.input.obstacle);
  return object;
}

val inspect_mesh(const val& mesh) {
  const TriangleMesh given = mesh_of(mesh, "mesh");
  const MeshReport report = inspect(given);
  val object = val::object(), defects = val::object();
  object.set("faces", report.faces);
  object.set("vertices", report.vertices);
  object.set("components", report.components);
  object.set("closedManifold", report.is_closed_manifold());
  object.set("volume", report.volume);
  object.set("diagonal", finite_bounding_box(given).diagonal());
  object.set("firstDefect", report.first_defect);
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0) defects.set(std::string(defect.description), defect.count);
  if (report.is_closed_manifold() && report.volume < 0) defects.set("mesh inside out", 1);
  object.set("defects", defects);
  return object;
}

val read(const val& bytes, const std::string& name, const val& given) {
  const std::vector<unsigned char> content = emscripten::convertJSArrayToNumberVector<unsigned char>(bytes);
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  FileUnit unit;
  ReadOptions options{.non_finite = NonFinite::Keep, .unit = &unit};
  const Given named(given);
  const bool has_unit = named.choice("unit", length_units(), options.scale);
  named.refuse_others();
  val object = object_of_mesh(read_mesh(text, name, options));
  if (has_unit && unit.is_said && options.scale != unit.metres)
    throw InputError(Defect::InvalidOption,
                     name + ": a unit is for files that do not say theirs; this one is in metres");
  object.set("inMetres", has_unit || unit.metres == 1);
  return object;
}

val write(const val& mesh, const std::string& name) {
  return object_of_file(mesh_content(name, mesh_of(mesh, "mesh")));
}

double memory() { return static_cast<double>(emscripten_get_heap_size()); }

}  // namespace

EMSCRIPTEN_BINDINGS(prohull) {
  using emscripten::function;
  function("build", &Guarded<build>::call);
  function("level", &Guarded<level>::call);
  function("verify", &Guarded<verify>::call);
  function("distance", &Guarded<distance>::call);
  function("convexPieces", &Guarded<convex_pieces>::call);
  function("spheres", &Guarded<spheres>::call);
  function("repair", &Guarded<repair>::call);
  function("inspect", &Guarded<inspect_mesh>::call);
  function("read", &Guarded<read>::call);
  function("readLevels", &Guarded<read_levels>::call);
  function("writeLevels", &Guarded<write_levels>::call);
  function("write", &Guarded<write>::call);
  function("memory", &memory);
}

}  // namespace prohull::js
