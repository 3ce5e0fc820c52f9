#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/largest_coordinate.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/openings.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/repair.h"
#include "repair/steps.h"

namespace prohull {
namespace {

constexpr std::array<std::pair<std::string_view, OpenShells>, 2> kOpenShellsNames{
    {{"close", OpenShells::Close}, {"keep", OpenShells::Keep}}};

std::string why_not_closed(const MeshReport& report) {
  if (report.faces == 0) return "no face has three different corners";
  std::string counts;
  for (const DefectCount& defect : defect_counts(report))
    if (defect.count > 0 && !defect.allowed)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", grouped(defect.count), defect.description);
  return fmt::format("{} (in all: {})", report.first_defect, counts);
}

void require_faces(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces: nothing to enclose");
  constexpr std::size_t kMostFaces = 0xffffffff / 3;
  if (mesh.face_count() >= kMostFaces)
    refuse(fmt::format("{} faces; at most {} are supported", grouped(mesh.face_count()), grouped(kMostFaces)));
}

void face_outwards(ClosedMesh& closed, bool fill_crossing) {
  turn_outwards(closed.mesh, closed.report.components, fill_crossing, closed.repairs);
  closed.report.volume = signed_volume(closed.mesh);
  if (!(closed.report.volume > 0)) throw InputError(Defect::NoVolume, "the mesh encloses no volume");
}

// One step after another, until the mesh is closed.
void close(ClosedMesh& closed) {
  if (closed.report.is_closed_manifold()) return;
  weld(closed.mesh, closed.repairs);
  closed.report = inspect(closed.mesh);
  if (closed.report.is_closed_manifold()) return;
  drop_duplicate_faces(closed.mesh, closed.repairs);
  turn_single_faces(closed.mesh, closed.repairs);
  const ClosedMesh before = closed;
  for (const FansAlong along : {FansAlong::EdgesOfTwo, FansAlong::Wedges}) {
    if (along == FansAlong::Wedges) closed = before;
    split_vertices(closed.mesh, along, closed.repairs);
    closed.report = inspect(closed.mesh);
    if (closed.report.is_closed_manifold()) return;
  }
  if (!closed.report.is_closed_manifold()) throw InputError(closed.report.worst_defect, why_not_closed(closed.report));
}

void drop_nested(ClosedMesh& closed) {
  drop_nested_components(closed.mesh, closed.report.components, closed.repairs);
  if (closed.repairs.dropped_components > 0) closed.report = inspect(closed.mesh);
}

// The triangles of `mesh` that `other`, which has no others, has not, in either orientation.
TriangleMesh without(const TriangleMesh& mesh, const TriangleMesh& other) {
  using Corner = std::array<double, 3>;
  const auto corners = [](const TriangleMesh& m, FaceId f) {
    const Triangle t = m.triangle(f);
    std::array sorted{Corner{t.a.x, t.a.y, t.a.z}, Corner{t.b.x, t.b.y, t.b.z}, Corner{t.c.x, t.c.y, t.c.z}};
    std::ranges::sort(sorted);
    return sorted;
  };
  const auto all_are_there = [&] {
    for (const FaceId f : mesh.triangles.ids())
      if (corners(mesh, f) != corners(other, f)) return false;
    return true;
  };
  if (mesh.face_count() == other.face_count() && all_are_there()) return {};
  std::vector<std::array<Corner, 3>> kept;
  kept.reserve(other.face_count());
  for (const FaceId f : other.triangles.ids()) kept.push_back(corners(other, f));
  std::ranges::sort(kept);
  TriangleMesh rest{mesh.positions, {}};
  for (const FaceId f : mesh.triangles.ids())
    if (!std::ranges::binary_search(kept, corners(mesh, f))) rest.triangles.push_back(mesh.triangles[f]);
  return rest;
}

void try_to_close(ClosedMesh& closed, const RepairOptions& options, RepairedMesh& result) {
  try {
    close(closed);
    face_outwards(closed, options.fill_crossing && !is_closed(result.original));
    if (!options.keep_cavities) drop_nested(closed);
    result.dropped = without(result.original, closed.mesh);
    result.repairs = closed.repairs;
    result.closed = std::move(closed);
    result.obstacle.clear();
  } catch (const InputError& error) {
    result.repairs = closed.repairs;
    result.obstacle = error.what();
  }
}

/// Twice the area vector of a closed line: twice the area, if it is planar.
Vec3 doubled_area(const TriangleMesh& mesh, const std::vector<VertexId>& loop) {
  const Vec3& origin = mesh.positions[loop.front()];
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += cross(mesh.positions[loop[i]] - origin, mesh.positions[loop[i + 1]] - origin);
  return sum;
}

/// All but those of a sheet.
std::vector<Opening> openings_to_close(const TriangleMesh& mesh) {
  constexpr double kSheet = 0.75;    // of a component's area
  constexpr double kMainPart = 0.5;  // of the area of all: small parts are closed whatever they are
  TriangleMesh welded = mesh;
  Repairs ignored;
  weld(welded, ignored);
  DisjointSets connected(welded.vertex_count());
  for (const auto& t : welded.triangles)
    for (const VertexId v : {t[1], t[2]}) connected.join(index(t[0]), index(v));
  std::vector<double> walls(welded.vertex_count()), caps(welded.vertex_count());
  for (const FaceId f : welded.triangles.ids()) {
    const Triangle t = welded.triangle(f);
    walls[connected.find(index(welded.triangles[f][0]))] += norm(cross(t.b - t.a, t.c - t.a));
  }
  const double all = std::accumulate(walls.begin(), walls.end(), 0.0);
  std::vector<Opening> openings = find_openings(welded);
  const auto component = [&](const Opening& opening) { return connected.find(index(opening.loop.front())); };
  for (const Opening& opening : openings) caps[component(opening)] += norm(doubled_area(welded, opening.loop));
  std::erase_if(openings, [&](const Opening& opening) {
    const double area = walls[component(opening)];
    return area > kMainPart * all && caps[component(opening)] > kSheet * area;
  });
  return openings;
}

}  // namespace

void require_usable_size(const Box& box) {
  constexpr double kSmallest = 1e-100;
  if (box.is_empty()) return;
  require_usable_reach(box, "coordinates");
  if (box.min == box.max)
    throw InputError(
        Defect::NoVolume,
        fmt::format("all points of the mesh are one, ({:g}, {:g}, {:g}): there is nothing to enclose but a point; look "
                    "at where the mesh comes from",
                    box.min.x, box.min.y, box.min.z));
  const Vec3 d = box.max - box.min;
  if (const double size = std::hypot(d.x, d.y, d.z); size < kSmallest)
    throw InputError(
        Defect::NoVolume,
        fmt::format("the mesh is only {:g} across; below {:g} volumes vanish: scale the mesh", size, kSmallest));
}

std::vector<std::string> describe(const Repairs& repairs) {
  std::vector<std::string> phrases;
  const auto say = [&](std::size_t count, const char* before, const char* one, const char* many) {
    if (count > 0) phrases.push_back(fmt::format("{} {}", before, counted(count, one, many)));
  };
  say(repairs.dropped_non_finite_faces, "dropped", "face with a corner that is not finite",
      "faces with a corner that is not finite");
  say(repairs.welded_vertices, "welded", "vertex at the position of another", "vertices at equal positions");
  say(repairs.dropped_faces, "dropped", "face that had the same vertex twice", "faces that had the same vertex twice");
  say(repairs.dropped_duplicate_faces, "dropped", "face that was there already", "faces that were there already");
  say(repairs.turned_single_faces, "turned", "face that disagreed with its neighbours",
      "faces that disagreed with their neighbours");
  say(repairs.split_vertices, "split", "vertex in which two parts met", "vertices in which parts met");
  if (repairs.closed_openings > 0)
    phrases.push_back(fmt::format("closed {}, {}{:.4g} across", counted(repairs.closed_openings, "opening"),
                                  repairs.closed_openings > 1 ? "the largest " : "", repairs.largest_opening));
  if (repairs.turned_components > 0)
    phrases.push_back(fmt::format("turned {} inside out ({} faces)",
                                  counted(repairs.turned_components, "component that was", "components that were"),
                                  grouped(repairs.turned_faces)));
  if (repairs.crossing_components > 0)
    phrases.push_back(fmt::format("counted {} inside out and {} or {} others as solid ({} faces)",
                                  counted(repairs.crossing_components, "component that is", "components that are"),
                                  repairs.crossing_components == 1 ? "crosses" : "cross",
                                  repairs.crossing_components == 1 ? "repeats" : "repeat",
                                  grouped(repairs.crossing_faces)));
  if (repairs.dropped_components > 0)
    phrases.push_back(fmt::format("dropped {} inside of others ({} faces)",
                                  counted(repairs.dropped_components, "component"),
                                  grouped(repairs.dropped_component_faces)));
  return phrases;
}

ClosedMesh closed_mesh(TriangleMesh mesh) {
  require_faces(mesh);
  ClosedMesh closed{std::move(mesh), {}, {}};
  closed.report = closed.found = inspect(closed.mesh);
  if (!closed.report.is_closed_manifold() && closed.report.non_finite_vertices == 0) {
    weld(closed.mesh, closed.repairs);
    closed.report = inspect(closed.mesh);
  }
  if (closed.report.faces == 0)
    throw InputError(Defect::EmptyMesh, "no face has three different corners: nothing to enclose");
  if (!closed.report.is_closed_manifold())
    throw InputError(closed.report.worst_defect,
                     why_not_closed(closed.report) +
                         "; a hull needs a closed 2-manifold: close holes and separate parts "
                         "that meet in an edge or vertex first");
  require_usable_size(closed.report.box);
  face_outwards(closed, /*fill_crossing=*/false);
  return closed;
}

Names<OpenShells> open_shells_names() { return kOpenShellsNames; }

TriangleMesh RepairedMesh::with_caps() const {
  TriangleMesh all = original;
  append(all, caps);
  return all;
}

RepairedMesh repaired_mesh(TriangleMesh mesh, const RepairOptions& options) {
  require_faces(mesh);
  RepairedMesh result;
  MeshReport report = result.found = inspect(mesh);
  if (!std::ranges::all_of(mesh.positions, is_finite)) {  // what no face uses, too
    drop_non_finite_faces(mesh, result.repairs);
    if (mesh.face_count() == 0)
      throw InputError(Defect::NonFiniteCoordinate, "no face has finite corners: nothing to enclose");
    mesh = without_unused_vertices(std::move(mesh));
    report = inspect(mesh);
  }
  require_usable_size(report.box);
  result.original = std::move(mesh);
  ClosedMesh closed{result.original, result.repairs, std::move(report)};
  try_to_close(closed, options, result);
  if (result.closed || options.open_shells == OpenShells::Keep) return result;
  const std::vector<Opening> openings = openings_to_close(result.original);
  if (openings.empty()) return result;
  TriangleMesh capped = with_caps(result.original, openings);
  result.caps.positions = capped.positions;
  for (std::uint32_t f = static_cast<std::uint32_t>(result.original.face_count()); f < capped.face_count(); ++f)
    result.caps.triangles.push_back(capped.triangles[FaceId{f}]);
  Repairs repairs;
  repairs.dropped_non_finite_faces = result.found.faces - result.original.face_count();
  repairs.closed_openings = openings.size();
  repairs.largest_opening = openings.front().diameter;
  closed = {std::move(capped), repairs, {}};
  closed.report = inspect(closed.mesh);
  try_to_close(closed, options, result);
  return result;
}

}  // namespace prohull
