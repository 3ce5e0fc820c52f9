// What JavaScript calls (js/prohull/engine.js). Each function takes and gives plain objects. What goes wrong is an
// object with `error` and its name, as no exception of C++ may reach JavaScript.
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <algorithm>
#include <new>
#include <utility>
#include <variant>

#include "prohull/convex_cover.h"
#include "prohull/detail/given_options.h"
#include "prohull/detail/told_notes.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/progressive_hull.h"
#include "prohull/verification.h"
#include "values.h"

namespace prohull::js {
namespace {

/// progress(stage, fraction); the work is stopped where that returns false.
Progress progress_of(const val& progress) {
  if (progress.isUndefined()) return {};
  return
      [progress](std::string_view stage, double fraction) { return !progress(std::string(stage), fraction).isFalse(); };
}

/// Those that `read` takes from what is given; no others may be.
template <class Read>
auto options_of(const val& given, const val& progress, Read read) {
  const Given named(given);
  auto options = read(named);
  named.refuse_others();
  options.progress = progress_of(progress);
  return options;
}

val failure(const char* name, const std::string& message) {
  val object = val::object();
  object.set("error", message);
  object.set("name", std::string(name));
  return object;
}

template <class Work>
val guarded(Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    return failure("InputError", error.what());
  } catch (const Cancelled&) {
    return failure("AbortError", "cancelled");
  } catch (const std::bad_alloc&) {
    return failure("RangeError", "the memory does not do: of WebAssembly's, 4 GB, or of this page's");
  } catch (const std::exception& error) {
    return failure("Error", error.what());
  }
}

template <class Id>
val array_of_ids(const std::vector<Id>& ids) {
  return array_of(reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size());
}

/// Six numbers for each split: o, d, l, r, od, do.
val object_of(const ProgressiveHull& hull) {
  std::vector<std::uint32_t> splits;
  splits.reserve(6 * hull.splits().size());
  for (const VertexSplit& s : hull.splits())
    splits.insert(splits.end(), {index(s.o), index(s.d), index(s.l), index(s.r), s.od, s.do_});
  val object = val::object();
  object.set("side", std::string(name_of(hull_side_names(), hull.side())));
  object.set("originalVertices", hull.original_vertex_count());
  object.set("positions",
             array_of(reinterpret_cast<const double*>(hull.positions().data()), 3 * hull.positions().size()));
  object.set("baseCorners", array_of_ids(hull.base_corners()));
  object.set("splits", array_of(splits.data(), splits.size()));
  return object;
}

std::vector<std::uint32_t> indices_of(const val& array, const std::string& name) {
  std::vector<std::uint32_t> result;
  for (const double number : numbers_of(array, name)) {
    if (!(number >= 0 && number <= 0xffffffff && number == static_cast<double>(static_cast<std::uint32_t>(number))))
      throw InputError(Defect::Malformed, name + ": expected whole numbers of 32 bits");
    result.push_back(static_cast<std::uint32_t>(number));
  }
  return result;
}

/// Throws InputError if that is no progressive hull.
ProgressiveHull levels_of(const val& levels) {
  if (levels.isUndefined() || levels.isNull())
    throw InputError(Defect::InvalidOption, "levels: there are none; build with levels: true");
  HullSide side = HullSide::Outer;
  std::size_t vertices = 0;
  const Given given(levels);
  given.choice("side", hull_side_names(), side);
  given.count("original_vertices", vertices);
  const std::vector<double> numbers = numbers_of(levels["positions"], "levels.positions");
  std::vector<Vec3> positions(numbers.size() / 3);
  for (std::size_t i = 0; i < 3 * positions.size(); ++i) positions[i / 3][static_cast<int>(i % 3)] = numbers[i];
  std::vector<VertexId> corners;
  for (const std::uint32_t corner : indices_of(levels["baseCorners"], "levels.baseCorners"))
    corners.push_back(VertexId(corner));
  const std::vector<std::uint32_t> fields = indices_of(levels["splits"], "levels.splits");
  std::vector<VertexSplit> splits(fields.size() / 6);
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const std::uint32_t* const f = &fields[6 * i];
    splits[i] = {VertexId(f[0]), VertexId(f[1]), VertexId(f[2]), VertexId(f[3]), f[4], f[5]};
  }
  if (positions.size() != vertices + splits.size() || corners.size() % 3 != 0 || 2 * splits.size() > corners.size() / 3)
    throw InputError(Defect::Malformed, "levels: its arrays do not belong together");
  ProgressiveHull hull(side, vertices, PerVertex<Vec3>(std::move(positions)), std::move(corners), std::move(splits));
  if (const auto defect = first_defect(hull)) throw InputError(Defect::Malformed, "levels: " + *defect);
  return hull;
}

val object_of(const EnclosingHull& hull, const EnclosingHulls& made) {
  val object = object_of_mesh(hull.mesh);
  object.set("certified", hull.certified);
  object.set("proof", std::string(hull.proof));
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
  if (hull.levels) object.set("levels", object_of(*hull.levels));
  return object;
}

val build(const val& mesh, const val& targets, const val& given, const val& progress) {
  return guarded([&] {
    const EnclosingOptions options = options_of(given, progress, enclosing_options<Given>);
    std::vector<std::size_t> faces;
    for (const std::uint32_t target : indices_of(targets, "targetFaces")) faces.push_back(target);
    const EnclosingHulls made = enclosing_hulls(mesh_of(mesh, "mesh"), faces, options);
    val hulls = val::array();
    for (const EnclosingHull& hull : made.hulls) hulls.call<void>("push", object_of(hull, made));
    return hulls;
  });
}

val level(const val& levels, double faces) {
  return guarded([&] {
    if (!(faces >= 0)) throw InputError(Defect::InvalidOption, "faces: expected a number, at least 0");
    const ProgressiveHull hull = levels_of(levels);
    return object_of_mesh(hull.level(static_cast<std::size_t>(std::min<double>(faces, 0xffffffff))));
  });
}

val object_of(const Verification& found) {
  val object = val::object();
  object.set("holds", found.holds());
  object.set("encloses", found.encloses);
  object.set("keepsGap", found.keeps_gap);
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
  return guarded([&] {
    HullSide side = HullSide::Outer;
    const auto options = options_of(given, progress, [&](const Given& named) {
      VerificationOptions read;
      named.choice("side", hull_side_names(), side);
      named.flag("solid_only", read.solid_only);
      named.flag("finite_only", read.finite_only);
      named.not_negative("gap", read.gap);
      return read;
    });
    return object_of(verify_hull(mesh_of(hull, "hull"), mesh_of(original, "original"), side, options));
  });
}

val distance(const val& from, const val& to, const val& given, const val& progress) {
  return guarded([&] {
    const auto options = options_of(given, progress, [](const Given& named) {
      DistanceOptions read;
      named.not_negative("relative_gap", read.relative_gap);
      return read;
    });
    const DistanceBounds bounds = distance_bounds(mesh_of(from, "from"), mesh_of(to, "to"), options);
    val object = val::object();
    object.set("lower", bounds.lower);
    object.set("upper", bounds.upper);
    object.set("farthest", array_of(bounds.farthest));
    return object;
  });
}

template <class Cover>
val object_of_cover(const Cover& cover) {
  val object = val::object();
  object.set("certified", cover.certified);
  object.set("coversInside", cover.covers_inside);
  object.set("volume", cover.volume);
  object.set("originalVolume", cover.original_volume);
  object.set("withinBounds", cover.within_bounds);
  object.set("reach", cover.reach.upper);
  object.set("notes", strings_of(told_notes(cover)));
  return object;
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

val convex_pieces(const val& mesh, const val& given, const val& progress) {
  return guarded([&] {
    const ConvexCoverOptions options = options_of(given, progress, convex_cover_options<Given>);
    const ConvexCover cover = convex_cover(mesh_of(mesh, "mesh"), options);
    val object = object_of_cover(cover), pieces = val::array();
    for (const ConvexPiece& piece : cover.pieces) {
      val one = object_of_mesh(piece.mesh);
      std::visit(SetPrimitive{one}, piece.primitive);
      pieces.call<void>("push", one);
    }
    object.set("pieces", pieces);
    return object;
  });
}

val spheres(const val& mesh, const val& given, const val& progress) {
  return guarded([&] {
    const SphereCoverOptions options = options_of(given, progress, sphere_cover_options<Given>);
    const SphereCover cover = sphere_cover(mesh_of(mesh, "mesh"), options);
    val object = object_of_cover(cover);
    object.set("balls", array_of(reinterpret_cast<const double*>(cover.balls.data()), 4 * cover.balls.size()));
    return object;
  });
}

val repair(const val& mesh, const val& given, const val& progress) {
  return guarded([&] {
    const ClosedSolidOptions options = options_of(given, progress, closed_solid_options<Given>);
    const ClosedSolid made = closed_solid(mesh_of(mesh, "mesh"), options);
    val object = object_of_mesh(made.mesh);
    object.set("certified", made.verdict.holds());
    object.set("whyNot", made.verdict.why_not);
    object.set("source", std::string(name_of(source_names(), made.source)));
    object.set("repairs", strings_of(describe(made.input.repairs)));
    object.set("obstacle", made.input.obstacle);
    return object;
  });
}

val inspect_mesh(const val& mesh) {
  return guarded([&] {
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
    object.set("defects", defects);
    return object;
  });
}

val read(const val& bytes, const std::string& name) {
  return guarded([&] {
    const std::vector<unsigned char> content = emscripten::convertJSArrayToNumberVector<unsigned char>(bytes);
    const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
    return object_of_mesh(read_mesh(text, name, {.non_finite = NonFinite::Keep}));
  });
}

val write(const val& mesh, const std::string& name) {
  return guarded([&] {
    const std::string content = mesh_content(name, mesh_of(mesh, "mesh"));
    val object = val::object();
    object.set("bytes", array_of(reinterpret_cast<const unsigned char*>(content.data()), content.size()));
    return object;
  });
}

double memory() { return static_cast<double>(emscripten_get_heap_size()); }

}  // namespace

EMSCRIPTEN_BINDINGS(prohull) {
  using emscripten::function;
  function("build", &build);
  function("level", &level);
  function("verify", &verify);
  function("distance", &distance);
  function("convexPieces", &convex_pieces);
  function("spheres", &spheres);
  function("repair", &repair);
  function("inspect", &inspect_mesh);
  function("read", &read);
  function("write", &write);
  function("memory", &memory);
}

}  // namespace prohull::js
