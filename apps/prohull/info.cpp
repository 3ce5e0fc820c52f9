#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "command.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/openings.h"
#include "prohull/detail/rounded.h"
#include "prohull/detail/summary.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "robot/json.h"

namespace prohull::cli {
namespace {

struct InfoOptions {
  std::filesystem::path in, report;
  InputOptions input;
};

template <class... Values>
void say_fact(const char* name, fmt::format_string<Values...> text, Values&&... values) {
  say("  {:<14} {}\n", name, fmt::format(text, std::forward<Values>(values)...));
}

// The genus of all components together; the mesh is a closed manifold.
long genus(const MeshReport& report) { return static_cast<long>(report.components) - report.euler_characteristic / 2; }

void print_defects(const MeshReport& report) {
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0)
      say_fact("", "{} {}{}", grouped(defect.count), defect.description, defect.allowed ? " (allowed)" : "");
  if (!report.first_defect.empty()) say_fact("first", "{}", report.first_defect);
}

void print_quality(const MeshQuality& quality) {
  const auto print = [](const char* name, const Percentiles& p, double unit, const char* unit_name) {
    say_fact(name, "median {:.3g}, 10th percentile {:.3g}, 1st percentile {:.3g}, worst {:.3g}{}", p.median / unit,
             p.p10 / unit, p.p1 / unit, p.worst / unit, unit_name);
  };
  print("compactness", quality.compactness, 1, "");
  if (quality.edges == 0) return;
  print("dihedral angle", quality.dihedral_angle, kDegree, " degrees");
  say_fact("sharp", "{} of {} edges, below {:.0f} degrees", grouped(quality.sharp_edges), grouped(quality.edges),
           kSharpDihedralAngle / kDegree);
}

/// Finite also where its square is not.
double diagonal_of(const Box& box) {
  const Vec3 d = box.is_empty() ? Vec3{} : box.max - box.min;
  return std::hypot(d.x, d.y, d.z);
}

/// How many digits show each side of the box to a thousandth.
int digits_of(const Box& box) {
  constexpr int kUsual = 6, kAll = 17;
  int digits = kUsual;
  for (int axis = 0; axis < 3; ++axis) {
    const double largest = std::max(std::abs(box.min[axis]), std::abs(box.max[axis]));
    const double side = box.max[axis] - box.min[axis];
    if (side > 0) digits = std::max(digits, 3 + static_cast<int>(std::ceil(std::log10(largest / side))));
  }
  return std::min(digits, kAll);
}

void print_box(const Box& box) {
  if (box.is_empty()) return;
  const auto point = [digits = digits_of(box)](const Vec3& p) {
    return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", p.x, digits, p.y, digits, p.z, digits);
  };
  say_fact("box", "{} to {}, diagonal {:.6g}", point(box.min), point(box.max), diagonal_of(box));
}

void add_box(nlohmann::json& json, const Box& box) {
  json["box"] = nullptr, json["diagonal"] = diagonal_of(box);
  if (!box.is_empty()) json["box"] = {{"min", box.min}, {"max", box.max}};
}

void print_report(const MeshReport& report) {
  const Box& box = report.box;
  say_fact("faces", "{}", grouped(report.faces));
  say_fact("vertices", "{}", grouped(report.vertices));
  say_fact("components", "{}", grouped(report.components));
  print_box(box);
  if (report.is_closed_manifold()) {
    say_fact("surface", "closed 2-manifold");
    say_fact("genus", "{}", genus(report));
    say_fact("volume", "{:.9g}{}", report.volume,
             report.volume < 0       ? " (inside out)"
             : report.components > 1 ? " (where components overlap, it counts them all)"
                                     : "");
  } else {
    say_fact("surface", "{}", report.faces == 0 ? "no faces" : "not a closed 2-manifold");
  }
}

nlohmann::json describe_openings(const TriangleMesh& mesh) {
  constexpr std::size_t kMostNamed = 10;
  const std::vector<Opening> openings = find_openings(mesh);
  nlohmann::json largest = nlohmann::json::array();
  std::string diameters;
  for (const Opening& opening : std::span(openings).first(std::min(openings.size(), kMostNamed))) {
    largest.push_back({{"diameter", opening.diameter}, {"edges", opening.loop.size()}});
    diameters += fmt::format("{}{:.3g}", diameters.empty() ? "" : ", ", opening.diameter);
  }
  if (!openings.empty())
    say_fact("openings", "{}: {} across{}", grouped(openings.size()), diameters,
             openings.size() > kMostNamed
                 ? fmt::format(", and {} more, none larger", grouped(openings.size() - kMostNamed))
                 : "");
  return {{"count", openings.size()}, {"largest", largest}};
}

/// What build would do with the mesh, as it is without options: it takes the same first step.
void tell_hull(const TriangleMesh& mesh, nlohmann::json& json) {
  EnclosingOptions as_built;
  try {
    const RepairedMesh prepared = prepared_for_hulls(mesh, as_built);
    const auto repairs = describe(prepared.repairs);
    const bool wrapped = !prepared.closed;
    json["usable"] = true;
    json["hull_from"] = wrapped ? "wrap" : repairs.empty() ? "mesh" : "repaired";
    json["repairs"] = repairs;
    json["obstacle"] = prepared.obstacle;
    if (wrapped) {
      say_fact("hull possible", "yes, but outer hulls only, of a wrap or of the convex hull: {}", prepared.obstacle);
      return;
    }
    say_fact("hull possible", "yes, {}", repairs.empty() ? "of the mesh as it is" : "after these repairs:");
    for (const std::string& repair : repairs) say_fact("", "{}", repair);
    const MeshReport& closed = prepared.closed->report;
    if (!repairs.empty())
      say_fact("then", "{}, {}, genus {}, volume {:.9g}", counted(closed.faces, "face"),
               counted(closed.components, "component"), genus(closed), closed.volume);
    const std::size_t crossings = count_self_intersections(prepared.closed->mesh);
    json["self_intersections"] = crossings;
    if (crossings > 0)
      say_fact("", "or of a wrap: {} {}", counted(crossings, "pair of its faces", "pairs of its faces"),
               crossings == 1 ? "intersects" : "intersect");
  } catch (const InputError& error) {
    json["usable"] = false;
    json["hull_from"] = nullptr;
    json["why_not"] = error.what();
    say_fact("hull possible", "no: {}", error.what());
  }
}

nlohmann::json describe_mesh(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  nlohmann::json json = facts(report);
  add_box(json, report.box);
  print_report(report);
  if (report.is_closed_manifold()) json["genus"] = genus(report);
  stop_if_interrupted();
  if (report.faces > 0 && report.non_finite_vertices == 0) {
    const MeshQuality quality = mesh_quality(mesh);
    json["quality"] = facts(quality);
    print_quality(quality);
  }
  print_defects(report);
  stop_if_interrupted();
  json["openings"] = describe_openings(mesh);
  stop_if_interrupted();
  tell_hull(mesh, json);
  return json;
}

/// The volume that `build` and `verify` give, too: overlaps count once.
double volume_of(const TriangleMesh& level) { return solid_volume(level).value_or(signed_volume(level)); }

nlohmann::json describe_hull(const ProgressiveHull& hull) {
  const std::string side(name_of(hull_side_names(), hull.side()));
  const TriangleMesh finest_mesh = without_unused_vertices(hull.original()), base_mesh = hull.base();
  const double original = volume_of(finest_mesh), base = volume_of(base_mesh);
  say_fact("kind", "{} progressive hull", side);
  const std::string finest = described_finest_level(hull.finest_level());
  say_fact(finest.empty() ? "original" : "finest level", "{}, {}, volume {:.9g}{}",
           counted(finest_mesh.face_count(), "face"), counted(finest_mesh.vertex_count(), "vertex", "vertices"),
           original, finest.empty() ? "" : fmt::format(": {}, not the input itself", finest));
  const Box box = finite_bounding_box(finest_mesh);
  print_box(box);
  say_fact("coarsest", "{}, volume {:.9g}, void {}{}", counted(hull.base_face_count(), "face"), base,
           percent_text(base / original - 1, 3), finest.empty() ? "" : " of the finest level");
  say_fact("splits", "{}", grouped(hull.splits().size()));
  nlohmann::json json{
      {"side", side},
      {"finest_level", name_of(finest_level_names(), hull.finest_level())},
      {"original",
       {{"faces", finest_mesh.face_count()}, {"vertices", finest_mesh.vertex_count()}, {"volume", original}}},
      {"base", {{"faces", hull.base_face_count()}, {"volume", base}, {"void_ratio", base / original - 1}}},
      {"splits", hull.splits().size()}};
  add_box(json, box);
  return json;
}

int run_info(const InfoOptions& options) {
  check_files({options.in}, {options.report});
  const Stopwatch reading;
  const MeshOrHull content = read_mesh_or_hull(options.in, options.input, NonFinite::Keep);
  const double read_seconds = reading.seconds();
  const Stopwatch looking;
  say("{}\n", input_name(options.in));
  const auto* const hull = std::get_if<ProgressiveHull>(&content);
  nlohmann::json json = hull ? describe_hull(*hull) : describe_mesh(std::get<TriangleMesh>(content));
  say_more("  read {:.2f} s, examined {:.2f} s\n", read_seconds, looking.seconds());
  json["path"] = options.in.string();
  Outputs outputs;
  outputs.add_report(options.report, json);
  outputs.commit();
  return kDone;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<InfoOptions>(
      app, run, "info",
      "Tells what a mesh or .phull file holds, how good its triangles are, and what `prohull build` would do with it. "
      "Openings are holes, and the rims of open meshes; their size is the largest distance between two of their "
      "points. "
      "The compactness of a triangle is 1 if its sides are equal and 0 if it has no area; an edge is sharp if its two "
      "faces meet at less than 135 degrees.",
      run_info);
  add_mesh_input(command, options.in, options.input, "Mesh or .phull file.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull info horse.ply", "prohull info horse.phull --report info.json",
                         "prohull info part.stl --unit mm", "curl -s https://example.com/part.stl | prohull info -"});
}

}  // namespace prohull::cli
