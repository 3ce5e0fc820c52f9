#include <fmt/format.h>

#include "command.h"
#include "prohull/error.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path in, report;
};

// Of all components together; of a closed manifold.
long genus(const MeshReport& report) { return static_cast<long>(report.components) - report.euler_characteristic / 2; }

void print_defects(const MeshReport& report) {
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0)
      fmt::print("  {:<14} {} {}{}\n", "", grouped(defect.count), defect.description,
                 defect.allowed ? " (allowed)" : "");
  if (!report.first_defect.empty()) fmt::print("  {:<14} {}\n", "first", report.first_defect);
}

void print_quality(const MeshQuality& quality) {
  const auto print = [](const char* name, const Percentiles& p, double unit, const char* unit_name) {
    fmt::print("  {:<14} median {:.3g}, 10 % below {:.3g}, 1 % below {:.3g}, worst {:.3g}{}\n", name, p.median / unit,
               p.p10 / unit, p.p1 / unit, p.worst / unit, unit_name);
  };
  print("compactness", quality.compactness, 1, "");
  print("dihedral angle", quality.dihedral_angle, kDegree, " degrees");
  fmt::print("  {:<14} {} of {} edges, below {:.0f} degrees\n", "sharp", grouped(quality.sharp_edges),
             grouped(quality.edges), kSharpDihedralAngle / kDegree);
}

int describe_mesh(const Options& options, const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  nlohmann::json json = facts(report);
  json["path"] = options.in.string();
  const Box& box = report.box;
  fmt::print("{}\n", options.in.string());
  fmt::print("  {:<14} {}\n", "faces", grouped(report.faces));
  fmt::print("  {:<14} {}\n", "vertices", grouped(report.vertices));
  fmt::print("  {:<14} {}\n", "components", grouped(report.components));
  if (!box.is_empty())
    fmt::print("  {:<14} ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}), diagonal {:.6g}\n", "box", box.min.x,
               box.min.y, box.min.z, box.max.x, box.max.y, box.max.z, box.diagonal());
  if (report.is_closed_manifold()) {
    json["genus"] = genus(report);
    fmt::print("  {:<14} {}\n", "surface", "closed 2-manifold");
    fmt::print("  {:<14} {}\n", "genus", genus(report));
    fmt::print("  {:<14} {:.9g}{}\n", "volume", report.volume, report.volume < 0 ? " (inside out)" : "");
  } else {
    fmt::print("  {:<14} {}\n", "surface", report.faces == 0 ? "no faces" : "not a closed 2-manifold");
  }
  if (report.faces > 0 && report.non_finite_vertices == 0) {
    const MeshQuality quality = mesh_quality(mesh);
    json["quality"] = facts(quality);
    print_quality(quality);
  }
  print_defects(report);
  try {
    const ClosedMesh closed = closed_mesh(mesh);
    const auto repairs = describe(closed.repairs);
    json["usable"] = true;
    json["repairs"] = repairs;
    fmt::print("  {:<14} yes{}\n", "hull possible", repairs.empty() ? "" : ", after these repairs:");
    for (const std::string& repair : repairs) fmt::print("  {:<14} {}\n", "", repair);
    if (!repairs.empty())
      fmt::print("  {:<14} {} faces, {} components, genus {}, volume {:.9g}\n", "then", grouped(closed.report.faces),
                 grouped(closed.report.components), genus(closed.report), closed.report.volume);
  } catch (const InputError& error) {
    json["usable"] = false;
    json["why_not"] = error.what();
    fmt::print("  {:<14} no: {}\n", "hull possible", error.what());
  }
  write_report(options.report, json);
  return kDone;
}

int describe_hull(const Options& options, const ProgressiveHull& hull) {
  const double original = signed_volume(hull.original()), base = signed_volume(hull.base());
  fmt::print("{}\n", options.in.string());
  fmt::print("  {:<14} {} progressive hull\n", "kind", hull.side() == HullSide::Outer ? "outer" : "inner");
  fmt::print("  {:<14} {} faces, {} vertices, volume {:.9g}\n", "original", grouped(hull.original_face_count()),
             grouped(hull.original_vertex_count()), original);
  fmt::print("  {:<14} {} faces, volume {:.9g}, void {:.3f} %\n", "base", grouped(hull.base_face_count()), base,
             100 * (base / original - 1));
  fmt::print("  {:<14} {}\n", "splits", grouped(hull.splits().size()));
  write_report(options.report,
               {{"path", options.in.string()},
                {"side", hull.side() == HullSide::Outer ? "outer" : "inner"},
                {"original", {{"faces", hull.original_face_count()}, {"volume", original}}},
                {"base", {{"faces", hull.base_face_count()}, {"volume", base}, {"void_ratio", base / original - 1}}},
                {"splits", hull.splits().size()}});
  return kDone;
}

int run_info(const Options& options) {
  const auto content = read_mesh_or_hull(options.in);
  const auto* const hull = std::get_if<ProgressiveHull>(&content);
  return hull ? describe_hull(options, *hull) : describe_mesh(options, std::get<TriangleMesh>(content));
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("info", "Tell what a mesh or .phull file holds, and whether a hull can be built");
  command
      .add_option("in", options->in, "Mesh (PLY, OBJ, OFF, STL, GLB, DAE, 3MF, ...; also .gz or .zip) or .phull file")
      ->required()
      ->type_name("IN");
  add_report_option(command, options->report);
  add_examples(command, {"prohull info horse.ply", "prohull info horse.phull --report info.json"});
  command.callback([options, &run] { run = [options] { return run_info(*options); }; });
}

}  // namespace prohull::cli
