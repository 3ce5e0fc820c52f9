// What the page app.html asks for beside what index.d.ts lists (view/web/app).
#include <emscripten/bind.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calls.h"
#include "levels.h"
#include "prohull/certificate.h"
#include "prohull/length.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "robot/files/sphere_file.h"
#include "view/robot.h"
#include "view/scene.h"

namespace prohull::view {

// Robots are shown by the program only; here none is ever given.
nlohmann::json joint_facts(const robot::Robot&) { return {}; }
nlohmann::json disabled_facts(const ShownRobot&, unsigned) { return {}; }
Box drawn_box(const ShownRobot&) { return {}; }
nlohmann::json motion_facts(const ShownMotion&) { return {}; }

}  // namespace prohull::view

namespace prohull::js {
namespace {

view::Pieces pieces_of(const val& meshes) {
  view::Pieces pieces;
  for (const val& mesh : emscripten::vecFromJSArray<val>(meshes)) pieces.push_back(mesh_of(mesh, "pieces"));
  return pieces;
}

view::Balls balls_of(const val& array) {
  const std::vector<double> numbers = numbers_of(array, "balls");
  view::Balls balls;
  for (std::size_t i = 0; i + 4 <= numbers.size(); i += 4)
    balls.push_back({{numbers[i], numbers[i + 1], numbers[i + 2]}, numbers[i + 3]});
  const auto is_ball = [](const Ball& b) { return is_finite(b.center) && std::isfinite(b.radius) && b.radius >= 0; };
  if (numbers.size() % 4 != 0 || !std::all_of(balls.begin(), balls.end(), is_ball))
    throw InputError(Defect::NonFiniteCoordinate,
                     "balls: expected finite numbers, four for each, of which the last is at least 0");
  return balls;
}

/// Of {name} and one of `levels`, `pieces`, `balls`, `vertices` and `faces`.
view::Shown shown_of(const val& hull) {
  const std::string name = hull["name"].as<std::string>();
  if (!hull["levels"].isUndefined()) return {name, levels_of(hull["levels"])};
  if (!hull["pieces"].isUndefined()) return {name, pieces_of(hull["pieces"])};
  if (!hull["balls"].isUndefined()) return {name, balls_of(hull["balls"])};
  return {name, mesh_of(hull, name)};
}

/// What view.js of the page of `prohull view` shows: a hull and the mesh that it is a hull of, or one of them.
val scene(const val& hull, const val& original, const val& given, const val& progress) {
  const auto options = options_of(given, progress, [](const Given& named) {
    view::PageOptions read{.version = PROHULL_VERSION, .measures_levels = false};
    named.choice("side", hull_side_names(), read.side);
    return read;
  });
  std::vector<view::Shown> shown;
  std::optional<view::Original> other;
  if (!original.isNull()) other = {original["name"].as<std::string>(), mesh_of(original, "original")};
  if (!hull.isNull()) shown.push_back(shown_of(hull));
  if (shown.empty() && other) {
    shown.push_back({other->name, std::move(other->mesh)});
    other.reset();
  }
  const view::Scene made = view::scene_of(shown, other, options);
  val object = val::object();
  const std::string& bytes = made.blocks.bytes();
  object.set("facts", made.facts_as_text());
  object.set("blocks", array_of(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  return object;
}

/// As `prohull convex` writes them to one file.
val write_several(const val& meshes, const val& names, const std::string& file) {
  std::vector<TriangleMesh> all;
  if (meshes["length"].as<unsigned>() == 0) throw InputError(Defect::EmptyMesh, "meshes: there is none");
  for (const val& mesh : emscripten::vecFromJSArray<val>(meshes)) all.push_back(mesh_of(mesh, "meshes"));
  return object_of_file(meshes_content(file, all, emscripten::vecFromJSArray<std::string>(names)));
}

/// As `prohull spheres` writes them.
val spheres_json(const val& balls, const std::string& link) {
  return object_of_file(robot::sphere_json({link, balls_of(balls)}));
}

/// `metres`: of the unit of the file, of which the mesh is converted to metres; else 1.
CertifiedOriginal original_of(const val& bytes, const std::string& name, bool is_stl, double metres) {
  const auto content = emscripten::convertJSArrayToNumberVector<unsigned char>(bytes);
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  CertifiedOriginal original{read_mesh(text, name, {.non_finite = NonFinite::Keep, .scale = metres}), metres};
  if (!is_stl) read_mesh(text, name, {.non_finite = NonFinite::Keep, .divided = &original.divided});
  return original;
}

/// As `prohull build --certificate` writes it, of the bytes of the original's file.
val certificate(const val& hull, const val& bytes, const std::string& name, const val& given) {
  double gap = 0, distance = std::numeric_limits<double>::infinity(), asked = distance, proven_gap = 0, metres = 1;
  bool is_stl = false;
  HullClaims claims;
  const Given named(given);
  named.choice("side", hull_side_names(), claims.side);
  named.flag("is_stl", is_stl);
  named.choice("unit", length_units(), metres);
  named.not_negative("gap", gap);
  named.not_negative("proven_gap", proven_gap);
  named.not_negative("max_distance", asked);
  named.not_negative("distance", distance);
  named.refuse_others();
  claims.gap = claimed_gap(gap, proven_gap);
  claims.distance = claimed_distance(asked, distance);
  const Certificate made = hull_certificate(mesh_of(hull, "hull"), original_of(bytes, name, is_stl, metres), claims);
  return object_of_file(made.bytes);
}

constexpr double kMostSampleFaces = 2e7;  // these take up to 171 bytes each, of the 4 GB that there are

val sample(const std::string& name, double faces) {
  check_whole(faces, "faces", 4, kMostSampleFaces);
  return object_of_mesh(make_sample(name, static_cast<std::size_t>(faces)));
}

/// Of "0.5" or "1%", in the unit of the mesh, as the options of the command line read it; where that is the metre, of
/// "5mm", too.
val length(const std::string& text, const val& mesh, const val& given) {
  bool in_metres = false;
  const Given named(given);
  named.flag("in_metres", in_metres);
  named.refuse_others();
  const std::optional<Length> found = length_of(text);
  if (!found || (found->needs_metres() && !in_metres))
    throw InputError(Defect::InvalidOption,
                     text + ": expected a number in the unit of the mesh, or a share of its diagonal, as 0.5%" +
                         (in_metres ? ", or a length with its unit, as 5mm" : ""));
  val object = val::object();
  object.set("length", found->of(finite_bounding_box(mesh_of(mesh, "mesh")).diagonal()));
  return object;
}

}  // namespace

EMSCRIPTEN_BINDINGS(prohull_page) {
  using emscripten::function;
  function("scene", &Guarded<scene>::call);
  function("certificate", &Guarded<certificate>::call);
  function("sample", &Guarded<sample>::call);
  function("writeSeveral", &Guarded<write_several>::call);
  function("spheresJson", &Guarded<spheres_json>::call);
  function("length", &Guarded<length>::call);
}

}  // namespace prohull::js
