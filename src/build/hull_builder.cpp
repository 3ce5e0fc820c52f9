#include "prohull/hull_builder.h"

#include <fmt/format.h>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_for_each.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <thread>

#include "build/best_of.h"
#include "build/cells.h"
#include "build/collapse_loop.h"
#include "build/threads.h"
#include "build/turned.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

double largest_coordinate(const Box& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                   std::abs(box.max.y), std::abs(box.max.z)});
}

/// Adds up what all threads do, and tells the caller's function, on the caller's thread.
class SharedProgress {
 public:
  SharedProgress(const HullOptions& options, std::size_t faces) : options_(options), original_(faces), faces_(faces) {}

  bool cancelled(std::size_t removed_faces) {
    faces_ -= removed_faces;
    if (options_.progress && std::this_thread::get_id() == caller_ &&
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

/// The new numbers of what a patch has, one for each thread; all kNoVertex between patches.
using LocalNumbers = oneapi::tbb::enumerable_thread_specific<PerVertex<VertexId>>;

/// A hull under construction. First in rounds: space is split into cells, each is simplified by itself, up to a key
/// that is the same for all; the next round has other cells. All cells of a round are independent of each other, so
/// that their threads never meet, and each fits into the cache. The last few thousand faces are simplified as a whole.
class HullBuilder {
 public:
  HullBuilder(const TriangleMesh& mesh, const HullOptions& options)
      : options_(options),
        original_vertices_(mesh.vertex_count()),
        positions_(mesh.positions),
        changed_(mesh.vertex_count(), 1),
        progress_(options, mesh.face_count()),
        rules_{options_, UnitCube(bounding_box(mesh)),
               largest_coordinate(bounding_box(mesh)) * (options.float32_coordinates ? 0x1p-23 : 0x1p-52),
               [this](std::size_t removed_faces) { return progress_.cancelled(removed_faces); }} {
    corners_.reserve(3 * mesh.face_count());
    for (const auto& triangle : mesh.triangles) corners_.insert(corners_.end(), triangle.begin(), triangle.end());
    faces_.reserve(mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) faces_.push_back(f);
    std::vector<BoxedFace> faces = boxed();
    sort_along_curve(faces);
    std::ranges::transform(faces, faces_.begin(), &BoxedFace::face);
    edges_.resize(corners_.size());
  }

  HullResult run() {
    arena_of(options_.threads).execute([&] {
      std::size_t round = 0;
      while (options_.strategy == Strategy::Lazy && is_worth_a_round() && run_round(round++)) continue;
    });
    Work whole = cut({everywhere(), faces_}, options_.target_faces, std::numeric_limits<double>::infinity());
    estimate_keys(whole.patch, rules_);
    run_collapse_loop(whole.patch, rules_);
    const RefusalCounts blocked = refusals_of_what_is_left(whole.patch);
    std::vector<Work> all;
    all.push_back(std::move(whole));
    put_back(all);
    const Stopped stopped = faces_.size() <= options_.target_faces ? Stopped::TargetReached
                            : progress_.cancelled()                ? Stopped::Cancelled
                                                                   : Stopped::NoLegalCollapse;
    return {{options_.side, original_vertices_, std::move(positions_), std::move(corners_), std::move(record_)},
            stopped,
            refused_,
            blocked,
            linear_programs_};
  }

 private:
  /// A patch, and what its elements are in the whole.
  struct Work {
    Patch patch;
    std::vector<FaceId> faces;
    std::vector<VertexId> vertices;  ///< those of the cut first, then those that are made

    VertexId whole(VertexId v) const { return vertices[index(v)]; }
    std::uint32_t whole_corner(std::uint32_t corner) const { return 3 * index(faces[corner / 3]) + corner % 3; }
    /// Where the facts of an edge are kept.
    std::uint32_t place(HalfEdgeId h) const {
      return std::min(whole_corner(index(h)), whole_corner(index(patch.mesh.twin(h))));
    }
  };

  // Below, a cell would have too much border.
  static constexpr std::size_t kLeastCells = 8, kLeastCellFaces = 1536, kMostCellFaces = 4096;

  bool is_worth_a_round() const {
    return faces_.size() >= kLeastCells * kLeastCellFaces && 4 * faces_.size() > 5 * options_.target_faces &&
           !progress_.cancelled();
  }

  /// The part of the faces that a round may at most remove.
  double most_removed() const {
    return std::min(0.5, 1 - static_cast<double>(options_.target_faces) / static_cast<double>(faces_.size()));
  }

  /// False if it did not help.
  bool run_round(std::size_t round) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const std::size_t before = faces_.size();
    const std::size_t cell_faces = std::clamp(before / (2 * kLeastCells), kLeastCellFaces, kMostCellFaces);
    std::vector<Cell> cells =
        split_into_cells(boxed(), cell_faces, std::fmod(static_cast<double>(round) * kGoldenRatio, 1));
    const double max_key = key_for_a_round(cells);
    std::vector<std::optional<Work>> works(cells.size());
    oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      if (progress_.cancelled()) return;
      const double size = static_cast<double>(cells[i].faces.size());
      works[i].emplace(cut(std::move(cells[i]), static_cast<std::size_t>(size * (1 - most_removed())), max_key));
      estimate_keys(works[i]->patch, rules_);
      run_collapse_loop(works[i]->patch, rules_);
    });
    std::vector<Work> done;
    for (auto& work : works)
      if (work) done.push_back(std::move(*work));
    put_back(done);
    return faces_.size() < before - before / 16;
  }

  /// The key up to which edges are collapsed: that of a quarter of them.
  double key_for_a_round(const std::vector<Cell>& cells) {
    std::vector<double> keys;
    const auto add = [&](const EdgeFacts& edge) {
      if (edge.key != EdgeFacts::kUnknown && !edge.is_refused) keys.push_back(edge.key);
    };
    for (const FaceId f : faces_)
      for (std::uint32_t c = 0; c < 3; ++c) add(edges_[3 * index(f) + c]);
    if (keys.empty()) {  // The first round has no keys yet; those of some cells tell enough.
      constexpr std::size_t kStep = 8;
      std::vector<std::optional<Work>> some((cells.size() + kStep - 1) / kStep);
      oneapi::tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t i) {
        some[i].emplace(cut(cells[kStep * i], 0, 0));
        estimate_keys(some[i]->patch, rules_);
      });
      for (const auto& work : some) std::ranges::for_each(work->patch.edges, add);
    }
    if (keys.empty()) return std::numeric_limits<double>::infinity();
    const auto place = keys.begin() + static_cast<std::ptrdiff_t>(kRoundFraction * double(keys.size() - 1));
    std::ranges::nth_element(keys, place);
    return *place;
  }

  std::vector<BoxedFace> boxed() const {
    std::vector<BoxedFace> boxes;
    boxes.reserve(faces_.size());
    for (const FaceId f : faces_) {
      const VertexId* corners = &corners_[3 * index(f)];
      boxes.push_back(
          {f, rules_.unit_cube.at(Triangle{positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]})});
    }
    return boxes;
  }

  Work cut(Cell cell, std::size_t target_faces, double max_key) {
    PerVertex<VertexId>& local = local_numbers_.local();
    local.resize(positions_.size(), kNoVertex);
    std::vector<VertexId> vertices, corners;
    PerVertex<Vec3> positions;
    PerVertex<VertexFacts> facts;
    corners.reserve(3 * cell.faces.size());
    for (const FaceId f : cell.faces)
      for (std::uint32_t c = 0; c < 3; ++c) {
        const VertexId v = corners_[3 * index(f) + c];
        if (local[v] == kNoVertex) {
          local[v] = positions.push_back(positions_[v]);
          vertices.push_back(v);
          facts.push_back({.changed = changed_[v], .is_free = cell.box.has_inside(rules_.unit_cube.at(positions_[v]))});
        }
        corners.push_back(local[v]);
      }
    for (const VertexId v : vertices) local[v] = kNoVertex;
    Work work{{.mesh = HalfEdgeMesh(std::move(positions), corners),
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
      work.patch.edges[e] = edges_[work.place(work.patch.mesh.half_edge(e))];
    return work;
  }

  /// Collapses of different patches are ordered by their keys, as if there had been one queue.
  void put_back(std::vector<Work>& works) {
    struct Collapse {
      double key;
      std::uint32_t work, i;
    };
    std::vector<Collapse> order;
    for (std::uint32_t w = 0; w < works.size(); ++w)
      for (std::uint32_t i = 0; i < works[w].patch.keys.size(); ++i) order.push_back({works[w].patch.keys[i], w, i});
    std::ranges::stable_sort(order, {}, &Collapse::key);
    for (Work& work : works) {
      work.vertices.resize(work.patch.mesh.positions().size());
      refused_ += work.patch.refused;
      linear_programs_ += work.patch.linear_programs;
      time_ = std::max(time_, work.patch.time);
    }
    for (const auto& [key, w, i] : order) {
      Work& work = works[w];
      const VertexId made{static_cast<std::uint32_t>(work.vertices.size() - work.patch.record.size()) + i};
      work.vertices[index(made)] = positions_.push_back(work.patch.mesh.position(made));
      const auto& [o, d, l, r, od, do_] = work.patch.record[i];
      record_.push_back(
          {work.whole(o), work.whole(d), work.whole(l), work.whole(r), work.whole_corner(od), work.whole_corner(do_)});
    }
    changed_.resize(positions_.size());
    oneapi::tbb::parallel_for_each(works, [&](const Work& work) { put_back(work); });
    std::erase_if(faces_, [&](FaceId f) { return corners_[3 * index(f)] == kNoVertex; });
    progress_.set_faces(faces_.size());
  }

  /// Writes only what no other patch does.
  void put_back(const Work& work) {
    const Patch& patch = work.patch;
    for (const VertexId v : patch.vertices.ids())
      if (patch.mesh.has(v) && patch.vertices[v].is_free) changed_[work.whole(v)] = patch.vertices[v].changed;
    for (std::uint32_t c = 0; c < 3 * work.faces.size(); ++c) {
      const VertexId v = patch.mesh.tail(HalfEdgeId{c});
      const VertexId is = v == kNoVertex ? v : work.whole(v);
      if (VertexId& was = corners_[work.whole_corner(c)]; was != is) was = is;
    }
    for (const EdgeId e : patch.edges.ids()) {
      if (!patch.mesh.has(e)) continue;
      const HalfEdgeId h = patch.mesh.half_edge(e);
      if (patch.vertices[patch.mesh.tail(h)].is_free && patch.vertices[patch.mesh.tip(h)].is_free)
        edges_[work.place(h)] = patch.edges[e];
    }
  }

  static RefusalCounts refusals_of_what_is_left(const Patch& patch) {
    RefusalCounts blocked;
    for (const EdgeId e : patch.edges.ids())
      if (patch.mesh.has(e) && patch.edges[e].is_refused) blocked.count(patch.edges[e].last_refusal);
    return blocked;
  }

  static constexpr double kRoundFraction = 0.25;

  const HullOptions options_;
  const std::size_t original_vertices_;
  PerVertex<Vec3> positions_;      ///< of all vertices ever made
  std::vector<VertexId> corners_;  ///< of the faces of the input; kNoVertex where a face has gone
  std::vector<FaceId> faces_;      ///< those that are left, along a curve
  std::vector<EdgeFacts> edges_;   ///< by one of an edge's two corners
  PerVertex<std::uint32_t> changed_;
  std::vector<VertexSplit> record_;
  std::uint32_t time_ = 1;
  RefusalCounts refused_;
  std::size_t linear_programs_ = 0;
  SharedProgress progress_;
  const CollapseRules rules_;
  LocalNumbers local_numbers_;
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

std::string_view name(Refusal refusal) {
  constexpr std::array<std::string_view, kRefusalKinds> kNames = {"link_condition",   "valence",     "no_room_outside",
                                                                  "certificate",      "compactness", "normal_deviation",
                                                                  "self_intersection"};
  return kNames[static_cast<std::size_t>(refusal)];
}

HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options) {
  check(options);
  if (options.best_of > 1)
    return best_of(
        options, [&](const HullOptions& one) { return build_hull(mesh, one); },
        [](const HullResult& result) { return result.hull.base(); });
  const MeshReport report = inspect(mesh);
  if (report.faces == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces");
  if (!report.is_closed_manifold()) throw InputError(report.worst_defect, report.first_defect);
  if (!(report.volume > 0))
    throw InputError(Defect::NoVolume, "the mesh is inside out or encloses nothing; closed_mesh turns what it can");
  if (options.side == HullSide::Outer) return HullBuilder(mesh, options).run();
  // An inner hull is the outer hull of the mesh turned inside out: what was inside of a face is then outside.
  return turned(HullBuilder(turned(mesh), options).run());
}

}  // namespace prohull
