#include "references.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include "alpha_wrap.h"
#include "io/file.h"
#include "peers.h"
#include "prohull/detail/openings.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/repair.h"
#include "repair/steps.h"

namespace prohull::bench {
namespace {

constexpr std::array kColumns{
    "file",     "faces",           "components", "closed", "self_intersections", "capped_self_intersections",
    "openings", "largest_opening", "diagonal",   "volume", "convex_volume"};

double wrapped_volume(const TriangleMesh& mesh) {
  const double diagonal = bounding_box(mesh).diagonal();
  const auto wrap = alpha_wrap(mesh, diagonal / 200, diagonal / 2000, std::chrono::minutes(2));
  return wrap ? signed_volume(*wrap) : kUnknown;
}

std::string exact(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  cells.resize(kColumns.size());  // a last cell that is empty is none to getline
  return cells;
}

std::size_t count_of(const std::string& cell) { return std::strtoull(cell.c_str(), nullptr, 10); }
double value_of(const std::string& cell) { return cell.empty() ? kUnknown : std::strtod(cell.c_str(), nullptr); }

}  // namespace

TriangleMesh finite_part(const TriangleMesh& mesh) {
  TriangleMesh result;
  PerVertex<VertexId> name(mesh.vertex_count(), VertexId(0xffffffff));
  for (std::array<VertexId, 3> t : mesh.triangles) {
    if (!(is_finite(mesh.positions[t[0]]) && is_finite(mesh.positions[t[1]]) && is_finite(mesh.positions[t[2]])))
      continue;
    for (VertexId& v : t) {
      if (name[v] == VertexId(0xffffffff)) name[v] = result.positions.push_back(mesh.positions[v]);
      v = name[v];
    }
    result.triangles.push_back(t);
  }
  return result;
}

double convex_volume(const TriangleMesh& mesh) {
  const auto hull = run_convex_hull(mesh);
  const double volume = hull ? signed_volume(hull->mesh) : 0;
  return volume > 0 ? volume : kUnknown;
}

Reference reference_of(const TriangleMesh& mesh) {
  const std::vector<Opening> openings = find_openings(mesh);
  const TriangleMesh capped = with_caps(mesh, openings);
  TriangleMesh joined = mesh;
  Repairs ignored;
  weld(joined, ignored);
  const RepairedMesh as_is = repaired_mesh(mesh, {.open_shells = OpenShells::Keep}), closed = repaired_mesh(capped);
  Reference reference;
  reference.faces = mesh.face_count();
  reference.components = inspect(joined).components;
  reference.closed = as_is.closed ? "yes" : closed.closed ? "capped" : "no";
  reference.self_intersections = count_self_intersections(mesh);
  reference.capped_self_intersections =
      openings.empty() ? reference.self_intersections : count_self_intersections(capped);
  reference.openings = openings.size();
  if (!openings.empty()) reference.largest_opening = openings.front().diameter;
  reference.diagonal = bounding_box(mesh).diagonal();
  reference.volume = closed.closed && count_self_intersections(closed.closed->mesh) == 0 ? closed.closed->report.volume
                                                                                         : wrapped_volume(capped);
  reference.convex_volume = convex_volume(mesh);
  return reference;
}

References::References(std::filesystem::path path) : path_(std::move(path)) {
  if (!exists(path_)) return;
  std::istringstream lines(read_file(path_));
  std::string line;
  std::getline(lines, line);
  if (line != fmt::format("{}", fmt::join(kColumns, ",")))
    throw InputError(Defect::CannotRead, fmt::format("{} is no file of references", path_.string()));
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    known_[cells[0]] = {count_of(cells[1]), count_of(cells[2]), cells[3],           count_of(cells[4]),
                        count_of(cells[5]), count_of(cells[6]), value_of(cells[7]), value_of(cells[8]),
                        value_of(cells[9]), value_of(cells[10])};
  }
}

Reference References::of(const std::string& name, const TriangleMesh& mesh) {
  const std::string key = as_cell(name);
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
  }
  const Reference reference = reference_of(mesh);
  const std::lock_guard lock(mutex_);
  known_[key] = reference;
  write();
  return reference;
}

void References::write() const {
  Table table({kColumns.begin(), kColumns.end()});
  for (const auto& [name, r] : known_)
    table.add({name, fmt::to_string(r.faces), fmt::to_string(r.components), r.closed,
               fmt::to_string(r.self_intersections), fmt::to_string(r.capped_self_intersections),
               fmt::to_string(r.openings), exact(r.largest_opening), exact(r.diagonal), exact(r.volume),
               exact(r.convex_volume)});
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path());
  write_file(path_, table.csv());
}

}  // namespace prohull::bench
