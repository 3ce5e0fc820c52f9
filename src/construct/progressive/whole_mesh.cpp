#include "construct/progressive/whole_mesh.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "construct/closed_manifold.h"
#include "mesh/half_edges_by_tail.h"
#include "mesh/mirror_images.h"
#include "prohull/detail/text.h"

namespace prohull {
namespace {

/// Other seeds for each cell of each round.
std::uint64_t seed_of(const HullOptions& options, std::uint32_t time, FaceId first_face) {
  return options.seed == 0 ? 0 : options.seed * 0x9e3779b97f4a7c15 + (std::uint64_t{time} << 32 | index(first_face));
}

void require_symmetry(const TriangleMesh& mesh, Axis mirror) {
  const SymmetryReport found = inspect_symmetry(mesh, mirror);
  if (found.is_symmetric()) return;
  const std::string lacking = found.vertices_without_image > 0
                                  ? counted(found.vertices_without_image, "vertex has", "vertices have")
                                  : counted(found.faces_without_image, "face has", "faces have");
  throw InputError(
      Defect::NotSymmetric,
      fmt::format("the mesh is not exactly symmetric: {}; in all, {} none. Make one half of it the mirror image of the "
                  "other, for instance by Blender's Symmetrize, with the plane between them at {} = 0: elsewhere files "
                  "round the coordinates of the two halves differently",
                  found.first_defect, lacking, name_of(axis_names(), mirror)));
}

/// Of a mesh that is no closed manifold: says where.
[[noreturn]] void refuse(const TriangleMesh& mesh) {
  require_closed_manifold(mesh);
  throw std::logic_error("a closed manifold has a twin for each half-edge and one fan of faces around each vertex");
}

}  // namespace

WholeMesh::WholeMesh(const TriangleMesh& mesh, const HullOptions& options, const UnitCube& unit_cube, const Box* part)
    : options_(options), unit_cube_(unit_cube), box_(part ? unit_cube.at(*part) : everywhere()) {
  number_along_curve(mesh);
  if (part)
    find_twins_of_part();
  else
    find_twins(mesh);
  if (options.mirror) find_images(mesh);
  set_tolerances(options);
  changed_.assign(positions_.size(), 1);
  edges_.resize(corners_.size());
  const std::size_t most_collapses = (mesh.face_count() - std::min(mesh.face_count(), options.target_faces)) / 2;
  made_.reserve(mesh.vertex_count() + most_collapses);
  record_.reserve(most_collapses);
  for (const Vec3& p : mesh.positions) made_.push_back(p);
}

void WholeMesh::number_along_curve(const TriangleMesh& mesh) {
  std::vector<BoxedFace> faces;
  faces.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) {
    const auto& [a, b, c] = mesh.triangles[f];
    faces.push_back({f, unit_cube_.at(Triangle{mesh.positions[a], mesh.positions[b], mesh.positions[c]})});
  }
  PerVertex<VertexId> place(mesh.vertex_count(), kNoVertex);
  positions_.reserve(mesh.vertex_count()), names_.reserve(mesh.vertex_count());
  corners_.reserve(3 * mesh.face_count()), faces_.reserve(mesh.face_count()), given_.reserve(mesh.face_count());
  const auto number = [&](VertexId v) {
    if (place[v] == kNoVertex) {
      place[v] = positions_.push_back(mesh.positions[v]);
      names_.push_back(v);
    }
    return place[v];
  };
  for (const FaceId face : along_curve(faces)) {
    faces_.push_back(given_.push_back(face));
    for (const VertexId v : mesh.triangles[face]) corners_.push_back(number(v));
  }
  for (const VertexId v : mesh.positions.ids()) number(v);
}

void WholeMesh::find_twins_of_part() {
  const HalfEdgeMesh part(positions_, corners_);
  require_whole_stars(part);
  twins_.reserve(corners_.size());
  for (std::uint32_t c = 0; c < corners_.size(); ++c) twins_.push_back(part.twin(HalfEdgeId{c}));
}

void WholeMesh::find_images(const TriangleMesh& mesh) {
  require_symmetry(mesh, *options_.mirror);
  mirror_ = mirror_plane_of(bounding_box(mesh), *options_.mirror);
  auto images = mirror_images(HalfEdgeMesh(positions_, corners_), *mirror_);
  if (!images)
    throw InputError(Defect::InvalidOption,
                     fmt::format("the mesh lies symmetric along {}, but where its parts touch they are joined in other "
                                 "ways than their mirror images: join or separate them on both sides alike",
                                 name_of(axis_names(), *options_.mirror)));
  images_ = std::move(*images);
}

void WholeMesh::require_whole_stars(const HalfEdgeMesh& part) const {
  PerVertex<VertexId> met_from(positions_.size(), kNoVertex);
  const auto is_one_disk = [&](VertexId v) {
    std::uint32_t faces = 0;
    HalfEdgeId h = part.out(v);
    do {
      if (part.twin(h) == kNoHalfEdge || part.twin(part.twin(h)) != h || part.tail(h) != v) return false;
      const VertexId tip = part.tip(h);
      if (tip == v || met_from[tip] == v) return false;
      met_from[tip] = v;
      ++faces;
      h = part.rotated(h);
    } while (h != part.out(v) && h != kNoHalfEdge);
    return h != kNoHalfEdge && faces == part.valence(v);
  };
  for (const VertexId v : positions_.ids())
    if (part.has(v) && box_.has_inside(unit_cube_.at(positions_[v])) && !is_one_disk(v))
      throw InputError(Defect::NonManifoldVertex,
                       fmt::format("vertex {} lies inside of the box of the part, but the faces around it are not one "
                                   "disk: a part has all faces of a closed mesh that reach into its box",
                                   index(names_[v])));
}

// What HalfEdgeMesh does, without the memory that it takes for huge meshes.
void WholeMesh::find_twins(const TriangleMesh& mesh) {
  const auto tail = [this](HalfEdgeId h) { return corners_[index(h)]; };
  const auto tip = [&](HalfEdgeId h) { return tail(HalfEdgeMesh::next(h)); };
  const HalfEdgesByTail by_tail(positions_.size(), corners_.size(), tail);
  twins_.assign(corners_.size(), kNoHalfEdge);
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    const HalfEdgeId h{c};
    if (twins_[c] != kNoHalfEdge) continue;
    const HalfEdgeId twin = by_tail.between(tip(h), tail(h));
    if (twin == kNoHalfEdge || twins_[index(twin)] != kNoHalfEdge) refuse(mesh);
    twins_[c] = twin, twins_[index(twin)] = h;
  }
  // Once around each vertex, its faces must all have been met, and no edge twice.
  PerVertex<VertexId> met_from(positions_.size(), kNoVertex);
  for (const VertexId v : positions_.ids()) {
    const std::size_t faces = by_tail.leaving(v).size();
    if (faces == 0) continue;
    const HalfEdgeId first = by_tail.leaving(v).front();
    HalfEdgeId h = first;
    std::size_t met = 0;
    do {
      if (tip(h) == v || std::exchange(met_from[tip(h)], v) == v) refuse(mesh);
      h = twins_[index(HalfEdgeMesh::previous(h))];
    } while (++met < faces && h != first);
    if (met != faces || h != first) refuse(mesh);
  }
}

void WholeMesh::set_tolerances(const HullOptions& options) {
  if (options.tolerances.empty()) return;
  for (const FaceId f : given_) tolerances_.faces.push_back(options.tolerances[f]);
  tolerances_.deviations.resize(positions_.size());
  if (options.deviations.empty()) return;
  for (const VertexId v : positions_.ids()) tolerances_.deviations[v] = options.deviations[names_[v]];
}

std::vector<BoxedFace> WholeMesh::boxed_faces() const {
  std::vector<BoxedFace> boxes(faces_.size());
  oneapi::tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t i) {
    const VertexId* corners = &corners_[3 * index(faces_[i])];
    boxes[i] = {faces_[i],
                unit_cube_.at(Triangle{positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]})};
  });
  return boxes;
}

WholeMesh::Cut WholeMesh::cut(Cell cell, std::size_t target_faces, double max_priority) {
  LocalNumbers& local = local_numbers_.local();
  local.vertices.resize(positions_.size(), kNoVertex);
  local.faces.resize(given_.size(), LocalNumbers::kNoFace);
  for (std::uint32_t i = 0; i < cell.faces.size(); ++i) local.faces[cell.faces[i]] = i;
  std::vector<VertexId> vertices, corners;
  std::vector<HalfEdgeId> twins;
  PerVertex<Vec3> positions;
  PerVertex<VertexFacts> facts;
  corners.reserve(3 * cell.faces.size()), twins.reserve(3 * cell.faces.size());
  for (const FaceId f : cell.faces)
    for (std::uint32_t corner = 3 * index(f); corner < 3 * index(f) + 3; ++corner) {
      const VertexId v = corners_[corner];
      if (local.vertices[v] == kNoVertex) {
        const bool is_free = cell.box.has_inside(unit_cube_.at(positions_[v]));
        local.vertices[v] = positions.push_back(positions_[v]);
        vertices.push_back(v);
        facts.push_back({.changed = is_free ? changed_[v] : 0, .is_free = is_free});
      }
      corners.push_back(local.vertices[v]);
      const std::uint32_t twin = index(twins_[corner]);
      const std::uint32_t face = twins_[corner] == kNoHalfEdge ? LocalNumbers::kNoFace : local.faces[FaceId{twin / 3}];
      twins.push_back(face == LocalNumbers::kNoFace ? kNoHalfEdge : HalfEdgeId{3 * face + twin % 3});
    }
  PerHalfEdge<HalfEdgeId> images;
  if (mirror_)
    for (const FaceId f : cell.faces)
      for (std::uint32_t corner = 3 * index(f); corner < 3 * index(f) + 3; ++corner) {
        const std::uint32_t image = index(images_[HalfEdgeId{corner}]);
        images.push_back(HalfEdgeId{3 * local.faces[FaceId{image / 3}] + image % 3});
      }
  for (const VertexId v : vertices) local.vertices[v] = kNoVertex;
  for (const FaceId f : cell.faces) local.faces[f] = LocalNumbers::kNoFace;
  Cut cut{{.mesh = HalfEdgeMesh(std::move(positions), corners, twins),
           .edges = {},
           .vertices = std::move(facts),
           .inside = cell.box,
           .target_faces = target_faces,
           .max_priority = max_priority,
           .time = time_,
           .seed = seed_of(options_, time_, cell.faces.front()),
           .images = std::move(images)},
          std::move(cell.faces),
          std::move(vertices)};
  cut.patch.edges.resize(cut.patch.mesh.edge_id_count());
  for (const EdgeId e : cut.patch.edges.ids())
    if (const HalfEdgeId h = cut.patch.mesh.half_edge(e); cut.is_free(h))
      cut.patch.edges[e] = edges_[cut.edge_place(h)];
  if (!tolerances_.empty()) cut_tolerances(cut);
  return cut;
}

void WholeMesh::cut_tolerances(Cut& cut) const {
  Patch& patch = cut.patch;
  for (std::uint32_t f = 0; f < cut.faces.size(); ++f) {
    patch.tolerances.faces.push_back(tolerances_.faces[cut.faces[f]]);
    if (patch.tolerances.faces.back() > 0) continue;
    for (const VertexId v : patch.mesh.corners(FaceId{f})) patch.vertices[v].is_kept = true;
  }
  for (const VertexId v : cut.vertices) patch.tolerances.deviations.push_back(tolerances_.deviations[v]);
}

WholeMesh::Cut WholeMesh::cut_everything(std::size_t target_faces) {
  return cut({box_, faces_}, target_faces, std::numeric_limits<double>::infinity());
}

WholeMesh::Collapses WholeMesh::put_back(Cut cut) {
  const Patch& patch = cut.patch;
  Collapses result{.names = {},
                   .places = {},
                   .record = std::move(cut.patch.record),
                   .priorities = std::move(cut.patch.priorities),
                   .apexes = {},
                   .refusals = patch.refusals,
                   .linear_programs = patch.linear_programs,
                   .time = patch.time};
  result.names.reserve(cut.vertices.size());
  for (const VertexId v : cut.vertices) result.names.push_back(names_[v]);
  for (VertexSplit& split : result.record) {
    split.od = given_corner(cut.corner_place(split.od)), split.do_ = given_corner(cut.corner_place(split.do_));
    result.apexes.push_back(patch.mesh.position(VertexId{static_cast<std::uint32_t>(cut.vertices.size())}));
    result.places.push_back(cut.vertices[index(split.o)]);
    cut.vertices.push_back(cut.vertices[index(split.o)]);
  }
  for (const VertexId v : patch.vertices.ids()) {
    if (!patch.mesh.has(v) || !patch.vertices[v].is_free) continue;
    const bool is_new = index(v) >= result.names.size();
    if (is_new) positions_[cut.vertices[index(v)]] = patch.mesh.position(v);
    changed_[cut.vertices[index(v)]] = patch.vertices[v].changed;
  }
  for (std::uint32_t c = 0; c < 3 * cut.faces.size(); ++c) {
    const VertexId v = patch.mesh.tail(HalfEdgeId{c});
    const VertexId is = v == kNoVertex ? v : cut.vertices[index(v)];
    if (VertexId& was = corners_[cut.corner_place(c)]; was != is) was = is;
    const HalfEdgeId g = patch.mesh.twin(HalfEdgeId{c});
    if (v == kNoVertex || g == kNoHalfEdge) continue;
    const HalfEdgeId twin{cut.corner_place(index(g))};
    if (HalfEdgeId& was = twins_[cut.corner_place(c)]; was != twin) was = twin;
  }
  for (const EdgeId e : patch.edges.ids())
    if (patch.mesh.has(e))
      if (const HalfEdgeId h = patch.mesh.half_edge(e); cut.is_free(h)) edges_[cut.edge_place(h)] = patch.edges[e];
  if (!tolerances_.empty()) put_back_tolerances(cut);
  return result;
}

void WholeMesh::put_back_tolerances(const Cut& cut) {
  const Patch& patch = cut.patch;
  for (std::uint32_t f = 0; f < cut.faces.size(); ++f)
    if (double& was = tolerances_.faces[cut.faces[f]]; was != patch.tolerances.faces[FaceId{f}])
      was = patch.tolerances.faces[FaceId{f}];
  for (const VertexId v : patch.vertices.ids())
    if (patch.mesh.has(v) && patch.vertices[v].is_free)
      tolerances_.deviations[cut.vertices[index(v)]] = patch.tolerances.deviations[v];
}

void WholeMesh::add(const std::vector<Collapses>& patches) {
  struct Collapse {
    double priority;
    std::uint32_t patch, i;
  };
  std::vector<Collapse> order;
  std::vector<std::vector<VertexId>> made(patches.size());
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    for (std::uint32_t i = 0; i < patches[p].priorities.size(); ++i) order.push_back({patches[p].priorities[i], p, i});
    made[p].resize(patches[p].priorities.size());
    time_ = std::max(time_, patches[p].time);
  }
  std::ranges::stable_sort(order, {}, &Collapse::priority);
  for (const auto& [priority, p, i] : order) {
    const Collapses& patch = patches[p];
    std::vector<VertexId>& made_here = made[p];
    const auto name = [&](VertexId v) {
      const std::size_t n = patch.names.size();
      return index(v) < n ? patch.names[index(v)] : made_here[index(v) - n];
    };
    made_here[i] = names_[patch.places[i]] = made_.push_back(patch.apexes[i]);
    const auto& [o, d, l, r, od, do_] = patch.record[i];
    record_.push_back({name(o), name(d), name(l), name(r), od, do_});
  }
  std::erase_if(faces_, [&](FaceId f) { return corners_[3 * index(f)] == kNoVertex; });
}

std::vector<double> WholeMesh::known_priorities(std::size_t n) const {
  std::vector<double> priorities;
  for (std::size_t i = 0; i < faces_.size(); i += n)
    for (std::uint32_t c = 0; c < 3; ++c) {
      const EdgeFacts& edge = edges_[3 * index(faces_[i]) + c];
      if (edge.priority != EdgeFacts::kUnknown && !edge.is_refused) priorities.push_back(edge.priority);
    }
  return priorities;
}

void WholeMesh::forget_edges() { std::ranges::fill(edges_, EdgeFacts{}); }

ProgressiveHull WholeMesh::hull() {
  edges_ = {}, twins_ = {}, changed_ = {};
  std::vector<VertexId> corners(corners_.size(), kNoVertex);
  for (const FaceId f : faces_)
    for (std::uint32_t c = 0; c < 3; ++c) corners[given_corner(3 * index(f) + c)] = names_[corners_[3 * index(f) + c]];
  return {options_.side, positions_.size(), std::move(made_), std::move(corners), std::move(record_)};
}

}  // namespace prohull
