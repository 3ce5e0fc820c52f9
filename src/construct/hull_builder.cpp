#include "prohull/hull_builder.h"

#include <fmt/format.h>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <thread>

#include "construct/best_of.h"
#include "construct/placement.h"
#include "construct/progressive/cells.h"
#include "construct/progressive/collapse_loop.h"
#include "construct/turned.h"
#include "parallel/arena.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

/// Adds up what all threads do, and tells the caller's function, on the caller's thread.
class SharedProgress {
 public:
  SharedProgress(const HullOptions& options, std::size_t faces) : options_(options), original_(faces), faces_(faces) {}

  bool cancelled(std::size_t removed_faces) {
    faces_ -= removed_faces;
    if (!cancelled_ && options_.progress && std::this_thread::get_id() == caller_ &&
        !options_.progress({faces_, original_, options_.target_faces}))
      cancelled_ = true;
    return cancelled_;
  }
  bool cancelled() const { return cancelled_; }
  void set_faces(std::size_t faces) { faces_ = faces; }

 private:
  const HullOptions& options_;
  const std::thread::id caller_ = std::this_thread::get_id();
  const std::size_t original_;
  std::atomic<std::size_t> faces_;
  std::atomic<bool> cancelled_ = false;
};

/// Other seeds for each cell of each round.
std::uint64_t seed_of(const HullOptions& options, std::uint32_t time, FaceId first_face) {
  return options.seed == 0 ? 0 : options.seed * 0x9e3779b97f4a7c15 + (std::uint64_t{time} << 32 | index(first_face));
}

/// The numbers in a patch of what it has, one for each thread; none between patches.
struct LocalNumbers {
  PerVertex<VertexId> vertices;
  PerFace<std::uint32_t> faces;
  static constexpr std::uint32_t kNoFace = 0xffffffff;
};

void require_closed_manifold(const MeshReport& report) {
  if (!report.is_closed_manifold()) throw InputError(report.worst_defect, report.first_defect);
}

/// A hull under construction. First in rounds: space is split into cells, each is simplified by itself, up to a key
/// that is the same for all; the next round has other cells. All cells of a round are independent of each other, so
/// that their threads never meet, and each fits into the cache. What is left, mostly the last sixteen thousand faces,
/// is simplified as a whole.
///
/// Faces and vertices are numbered along a curve. The vertex that a collapse makes takes the place of one that it
/// removes, so that what lies together in space does so in memory; `names_` tells which vertex is at a place now.
class HullBuilder {
 public:
  HullBuilder(const TriangleMesh& mesh, const HullOptions& options) : HullBuilder(mesh, options, bounding_box(mesh)) {}

  HullResult run() {
    std::size_t round = 0;
    while (options_.strategy == Strategy::Lazy && is_worth_a_round() && run_round(round++)) continue;
    RefusalCounts blocked = simplify_whole();
    for (const RelaxedGuards& guards : kRelaxedGuards) {
      if (!options_.relax_guards || faces_.size() <= options_.target_faces || progress_.cancelled()) break;
      relax(guards);
      blocked = simplify_whole();
    }
    const Stopped stopped = faces_.size() <= options_.target_faces ? Stopped::TargetReached
                            : progress_.cancelled()                ? Stopped::Cancelled
                                                                   : Stopped::NoLegalCollapse;
    std::vector<VertexId> corners(corners_.size(), kNoVertex);
    for (const FaceId f : faces_)
      for (std::uint32_t c = 0; c < 3; ++c)
        corners[given_corner(3 * index(f) + c)] = names_[corners_[3 * index(f) + c]];
    return {{options_.side, positions_.size(), std::move(made_), std::move(corners), std::move(record_)},
            stopped,
            refused_,
            blocked,
            linear_programs_,
            relaxed_};
  }

 private:
  /// A patch, and what its elements are in the whole.
  struct Work {
    Patch patch;
    std::vector<FaceId> faces;
    std::vector<VertexId> vertices;

    std::uint32_t whole_corner(std::uint32_t corner) const { return 3 * index(faces[corner / 3]) + corner % 3; }
    /// Where the facts of an edge are kept.
    std::uint32_t place(HalfEdgeId h) const {
      return std::min(whole_corner(index(h)), whole_corner(index(patch.mesh.twin(h))));
    }
    bool is_free(HalfEdgeId h) const {
      return patch.vertices[patch.mesh.tail(h)].is_free && patch.vertices[patch.mesh.tip(h)].is_free;
    }
  };

  /// The collapses of a patch. Vertices that it made are numbered from names.size() on.
  struct Collapses {
    std::vector<VertexId> names;  ///< of the vertices that it began with
    std::vector<VertexId> places;
    std::vector<VertexSplit> record;
    std::vector<double> keys;
    std::vector<Vec3> apexes;
    RefusalCounts refused;
    std::size_t linear_programs;
    std::uint32_t time;
  };

  HullBuilder(const TriangleMesh& mesh, const HullOptions& options, const Box& bounds)
      : options_(options),
        unit_cube_(bounds),
        progress_(options, mesh.face_count()),
        rules_{options_, unit_cube_, storage_rounding(bounds, options.float32_coordinates),
               [this](std::size_t removed_faces) { return progress_.cancelled(removed_faces); }} {
    number_along_curve(mesh);
    find_twins(mesh);
    changed_.assign(positions_.size(), 1);
    edges_.resize(corners_.size());
    made_.reserve(mesh.vertex_count() + (mesh.face_count() - std::min(mesh.face_count(), options.target_faces)) / 2);
    for (const Vec3& p : mesh.positions) made_.push_back(p);
  }

  void number_along_curve(const TriangleMesh& mesh) {
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

  /// Throws unless the mesh is a closed 2-manifold.
  void find_twins(const TriangleMesh& mesh) {
    const HalfEdgeMesh whole(positions_, corners_);
    if (first_defect(whole)) require_closed_manifold(inspect(mesh));  // says which, in the mesh's own numbers
    twins_.reserve(corners_.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) twins_.push_back(whole.twin(HalfEdgeId{c}));
  }

  std::uint32_t given_corner(std::uint32_t corner) const { return 3 * index(given_[FaceId{corner / 3}]) + corner % 3; }

  // Below, a cell would have too much border.
  static constexpr std::size_t kLeastCells = 8, kLeastCellFaces = 2048, kMostCellFaces = 4096;

  bool is_worth_a_round() const {
    return faces_.size() >= kLeastCells * kLeastCellFaces && faces_.size() / 5 > options_.target_faces / 4 &&
           !progress_.cancelled();
  }

  /// The part of its faces that each cell may at most remove, so that the target is not missed.
  double most_removed(const std::vector<Cell>& cells) const {
    std::size_t with_shared = 0;
    for (const Cell& cell : cells) with_shared += cell.faces.size();
    const double too_many = static_cast<double>(faces_.size() - std::min(faces_.size(), options_.target_faces));
    return std::min(0.45, too_many / static_cast<double>(with_shared));
  }

  /// False if it did not help.
  bool run_round(std::size_t round) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const std::size_t before = faces_.size();
    const std::size_t cell_faces = std::clamp(before / (2 * kLeastCells), kLeastCellFaces, kMostCellFaces);
    std::vector<Cell> cells =
        split_into_cells(boxed(), cell_faces, std::fmod(static_cast<double>(round) * kGoldenRatio, 1));
    if (cells.size() < kLeastCells / 2) return false;  // they would gain nothing
    const double max_key = key_for_a_round(cells), most = most_removed(cells);
    std::vector<std::optional<Collapses>> results(cells.size());
    oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      if (progress_.cancelled()) return;
      const std::size_t size = cells[i].faces.size();
      const auto collapses = static_cast<std::size_t>(most * static_cast<double>(size) / 2);
      Work work = cut(std::move(cells[i]), size - 2 * collapses, max_key);
      simplify(work);
      results[i] = put_back(std::move(work));
    });
    std::vector<Collapses> all;
    for (auto& result : results)
      if (result) all.push_back(std::move(*result));
    add(all);
    return faces_.size() < before - before / 16;
  }

  /// Why the edges that are left were refused.
  RefusalCounts simplify_whole() {
    Work whole = cut({everywhere(), faces_}, options_.target_faces, std::numeric_limits<double>::infinity());
    simplify(whole);
    const RefusalCounts blocked = refusals_of_what_is_left(whole.patch);
    add({put_back(std::move(whole))});
    return blocked;
  }

  /// For what is still to be collapsed: edges that were refused are looked at again.
  void relax(const RelaxedGuards& guards) {
    options_.max_normal_deviation = std::max(options_.max_normal_deviation, guards.normal_deviation);
    options_.min_compactness_ratio = std::min(options_.min_compactness_ratio, guards.compactness_ratio);
    options_.sufficient_compactness = std::min(options_.sufficient_compactness, guards.sufficient_compactness);
    options_.max_valence = std::max(options_.max_valence, guards.valence);
    std::ranges::fill(edges_, EdgeFacts{});
    ++relaxed_;
  }

  void simplify(Work& work) {
    if (progress_.cancelled()) return;
    estimate_keys(work.patch, rules_);
    if (progress_.cancelled()) return;
    run_collapse_loop(work.patch, rules_);
  }

  /// The key up to which edges are collapsed.
  double key_for_a_round(const std::vector<Cell>& cells) {
    constexpr double kPartOfEdges = 0.5;
    std::vector<double> keys;
    const auto add_key = [&](const EdgeFacts& edge) {
      if (edge.key != EdgeFacts::kUnknown && !edge.is_refused) keys.push_back(edge.key);
    };
    for (std::size_t i = 0; i < faces_.size(); i += kSample)
      for (std::uint32_t c = 0; c < 3; ++c) add_key(edges_[3 * index(faces_[i]) + c]);
    if (keys.empty()) {  // The first round has no keys yet.
      std::vector<PerEdge<EdgeFacts>> samples((cells.size() + kSample - 1) / kSample);
      oneapi::tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        Work work = cut(cells[kSample * i], 0, 0);
        estimate_keys(work.patch, rules_);
        samples[i] = std::move(work.patch.edges);
      });
      for (const PerEdge<EdgeFacts>& edges : samples) std::ranges::for_each(edges, add_key);
    }
    if (keys.empty()) return std::numeric_limits<double>::infinity();
    const auto place = keys.begin() + static_cast<std::ptrdiff_t>(kPartOfEdges * static_cast<double>(keys.size() - 1));
    std::ranges::nth_element(keys, place);
    return *place;
  }

  std::vector<BoxedFace> boxed() const {
    std::vector<BoxedFace> boxes(faces_.size());
    oneapi::tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t i) {
      const VertexId* corners = &corners_[3 * index(faces_[i])];
      boxes[i] = {faces_[i],
                  unit_cube_.at(Triangle{positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]})};
    });
    return boxes;
  }

  /// Reads only what no other patch of the round writes.
  Work cut(Cell cell, std::size_t target_faces, double max_key) {
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
        const std::uint32_t twin = index(twins_[corner]), face = local.faces[FaceId{twin / 3}];
        twins.push_back(face == LocalNumbers::kNoFace ? kNoHalfEdge : HalfEdgeId{3 * face + twin % 3});
      }
    for (const VertexId v : vertices) local.vertices[v] = kNoVertex;
    for (const FaceId f : cell.faces) local.faces[f] = LocalNumbers::kNoFace;
    Work work{{.mesh = HalfEdgeMesh(std::move(positions), corners, twins),
               .edges = {},
               .vertices = std::move(facts),
               .inside = cell.box,
               .target_faces = target_faces,
               .max_key = max_key,
               .time = time_,
               .seed = seed_of(options_, time_, cell.faces.front())},
              std::move(cell.faces),
              std::move(vertices)};
    work.patch.edges.resize(work.patch.mesh.edge_id_count());
    for (const EdgeId e : work.patch.edges.ids())
      if (const HalfEdgeId h = work.patch.mesh.half_edge(e); work.is_free(h))
        work.patch.edges[e] = edges_[work.place(h)];
    return work;
  }

  /// Writes only what no other patch of the round reads or writes.
  Collapses put_back(Work work) {
    const Patch& patch = work.patch;
    Collapses result{.names = {},
                     .places = {},
                     .record = std::move(work.patch.record),
                     .keys = std::move(work.patch.keys),
                     .apexes = {},
                     .refused = patch.refused,
                     .linear_programs = patch.linear_programs,
                     .time = patch.time};
    result.names.reserve(work.vertices.size());
    for (const VertexId v : work.vertices) result.names.push_back(names_[v]);
    for (VertexSplit& split : result.record) {
      split.od = given_corner(work.whole_corner(split.od)), split.do_ = given_corner(work.whole_corner(split.do_));
      result.apexes.push_back(patch.mesh.position(VertexId{static_cast<std::uint32_t>(work.vertices.size())}));
      result.places.push_back(work.vertices[index(split.o)]);
      work.vertices.push_back(work.vertices[index(split.o)]);
    }
    for (const VertexId v : patch.vertices.ids()) {
      if (!patch.mesh.has(v) || !patch.vertices[v].is_free) continue;
      const bool is_new = index(v) >= result.names.size();
      if (is_new) positions_[work.vertices[index(v)]] = patch.mesh.position(v);
      changed_[work.vertices[index(v)]] = patch.vertices[v].changed;
    }
    for (std::uint32_t c = 0; c < 3 * work.faces.size(); ++c) {
      const VertexId v = patch.mesh.tail(HalfEdgeId{c});
      const VertexId is = v == kNoVertex ? v : work.vertices[index(v)];
      if (VertexId& was = corners_[work.whole_corner(c)]; was != is) was = is;
      const HalfEdgeId g = patch.mesh.twin(HalfEdgeId{c});
      if (v == kNoVertex || g == kNoHalfEdge) continue;
      const HalfEdgeId twin{work.whole_corner(index(g))};
      if (HalfEdgeId& was = twins_[work.whole_corner(c)]; was != twin) was = twin;
    }
    for (const EdgeId e : patch.edges.ids())
      if (patch.mesh.has(e))
        if (const HalfEdgeId h = patch.mesh.half_edge(e); work.is_free(h)) edges_[work.place(h)] = patch.edges[e];
    return result;
  }

  /// Those of different patches are ordered by their keys, as if there had been one queue.
  void add(const std::vector<Collapses>& patches) {
    struct Collapse {
      double key;
      std::uint32_t patch, i;
    };
    std::vector<Collapse> order;
    std::vector<std::vector<VertexId>> made(patches.size());
    for (std::uint32_t p = 0; p < patches.size(); ++p) {
      for (std::uint32_t i = 0; i < patches[p].keys.size(); ++i) order.push_back({patches[p].keys[i], p, i});
      made[p].resize(patches[p].keys.size());
      refused_ += patches[p].refused;
      linear_programs_ += patches[p].linear_programs;
      time_ = std::max(time_, patches[p].time);
    }
    std::ranges::stable_sort(order, {}, &Collapse::key);
    for (const auto& [key, p, i] : order) {
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
    progress_.set_faces(faces_.size());
  }

  static RefusalCounts refusals_of_what_is_left(const Patch& patch) {
    RefusalCounts blocked;
    for (const EdgeId e : patch.edges.ids())
      if (patch.mesh.has(e) && patch.edges[e].is_refused) blocked.count(patch.edges[e].last_refusal);
    return blocked;
  }

  static constexpr std::size_t kSample = 8;  // of so many, one tells enough

  HullOptions options_;  ///< the guards relax in the end
  const UnitCube unit_cube_;
  SharedProgress progress_;
  const CollapseRules rules_;

  PerFace<FaceId> given_;          ///< the number of a face in the input
  std::vector<VertexId> corners_;  ///< kNoVertex where a face has gone
  std::vector<HalfEdgeId> twins_;  ///< of the half-edge that starts at a corner
  std::vector<FaceId> faces_;      ///< those that are left
  std::vector<EdgeFacts> edges_;   ///< by one of an edge's two corners
  PerVertex<Vec3> positions_;
  PerVertex<std::uint32_t> changed_;
  PerVertex<VertexId> names_;  ///< as in the result
  std::uint32_t time_ = 1;

  PerVertex<Vec3> made_;  ///< by name: the vertices of the input, then one for each collapse
  std::vector<VertexSplit> record_;
  RefusalCounts refused_;
  std::size_t linear_programs_ = 0;
  unsigned relaxed_ = 0;
  oneapi::tbb::enumerable_thread_specific<LocalNumbers> local_numbers_;
};

void check(const HullOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(Defect::InvalidOption, what);
  };
  require(options.target_faces >= 4, "target_faces must be at least 4, the faces of a tetrahedron");
  require(options.max_valence >= 3, "max_valence must be at least 3");
  require(options.min_compactness_ratio >= 0 && options.min_compactness_ratio <= 1,
          "min_compactness_ratio must be in [0, 1]");
  require(options.best_of >= 1, "best_of must be at least 1");
  require(options.sufficient_compactness >= 0 && options.sufficient_compactness <= 1,
          "sufficient_compactness must be in [0, 1]");
  require(options.max_normal_deviation >= 0 && options.max_normal_deviation <= std::numbers::pi / 2,
          "max_normal_deviation must be in [0, pi/2] radians");
}

// Every face with its corners 1 and 2 exchanged: o and d exchange their roles, l and r their sides.
HullResult turned(HullResult result) {
  const auto corner = [](std::uint32_t c) { return c % 3 == 0 ? c : c / 3 * 3 + 3 - c % 3; };
  const ProgressiveHull& hull = result.hull;
  std::vector<VertexId> corners(hull.base_corners().size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) corners[corner(c)] = hull.base_corners()[c];
  std::vector<VertexSplit> splits = hull.splits();
  // (o, d, l) has become (o, l, d), that is (d, o, l): now on the right of o-d.
  for (VertexSplit& split : splits) {
    const auto second = [&](std::uint32_t od) { return corner(od % 3 == 2 ? od - 2 : od + 1); };
    split = {split.o, split.d, split.r, split.l, second(split.do_), second(split.od)};
  }
  result.hull = ProgressiveHull(hull.side(), hull.original_vertex_count(), hull.positions(), std::move(corners),
                                std::move(splits));
  return result;
}

}  // namespace

HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options) {
  check(options);
  if (options.best_of > 1)
    return best_of(
        options, [&](const HullOptions& one) { return build_hull(mesh, one); },
        [](const HullResult& result) { return result.hull.base(); });
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces");
  if (!std::ranges::all_of(mesh.positions, is_finite)) require_closed_manifold(inspect(mesh));
  return arena_of(options.threads).execute([&] {
    const auto build = [&](const TriangleMesh& outer) {
      HullBuilder builder(outer, options);
      if (!(signed_volume(mesh) > 0))
        throw InputError(Defect::NoVolume, "the mesh is inside out or encloses nothing; closed_mesh turns what it can");
      return builder.run();
    };
    // An inner hull is the outer hull of the mesh turned inside out: what was inside of a face is then outside.
    return options.side == HullSide::Outer ? build(mesh) : turned(build(turned(mesh)));
  });
}

}  // namespace prohull
