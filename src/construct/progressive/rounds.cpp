#include "construct/progressive/rounds.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "construct/placement.h"
#include "construct/progressive/whole_mesh.h"
#include "prohull/detail/progress_meter.h"

namespace prohull {
namespace {

class Rounds {
 public:
  Rounds(const TriangleMesh& mesh, const HullOptions& options, const Box* part, const MayReach& may_reach)
      : options_(options),
        bounds_(bounding_box(mesh)),
        unit_cube_(bounds_),
        meter_(options.progress, "build"),
        excess_(mesh.face_count() - std::min(mesh.face_count(), options.target_faces)),
        whole_(mesh, options_, unit_cube_, part),
        rules_{options_,
               unit_cube_,
               bounds_,
               storage_rounding(bounds_, options.float32_coordinates),
               [this](std::size_t removed_faces) { meter_.at(removed_ += removed_faces, excess_); },
               whole_.mirror(),
               may_reach} {}

  HullResult run() {
    std::size_t round = 0;
    while (options_.strategy == Strategy::Lazy && is_worth_a_round() && run_round(round++)) continue;
    RefusalCounts blocked = simplify_whole();
    unsigned relaxed = 0;
    for (const ShapeGuards& guards : kRelaxedGuards) {
      if (!options_.relax_guards || whole_.face_count() <= options_.target_faces) break;
      options_.guards = weaker(guards, options_.guards);
      whole_.forget_edges();
      ++relaxed;
      blocked = simplify_whole();
    }
    const bool is_reached = whole_.face_count() <= options_.target_faces;
    return {whole_.hull(),    is_reached ? Stopped::TargetReached : Stopped::NoLegalCollapse,
            refusals_,        blocked,
            linear_programs_, relaxed};
  }

 private:
  // Below, a cell would have too much border.
  static constexpr std::size_t kLeastCells = 8, kLeastCellFaces = 2048, kMostCellFaces = 4096;
  static constexpr std::size_t kSample = 8;  // of so many, one tells enough

  bool is_worth_a_round() const {
    // The mirror image of a cell is in another cell, or across the border between two.
    return !options_.mirror && whole_.face_count() >= kLeastCells * kLeastCellFaces &&
           whole_.face_count() / 5 > options_.target_faces / 4;
  }

  /// The part of its faces that each cell may at most remove, so that the target is not missed.
  double most_removed(const std::vector<Cell>& cells) const {
    std::size_t with_shared = 0;
    for (const Cell& cell : cells) with_shared += cell.faces.size();
    const double too_many =
        static_cast<double>(whole_.face_count() - std::min(whole_.face_count(), options_.target_faces));
    return std::min(0.45, too_many / static_cast<double>(with_shared));
  }

  /// False if it did not help.
  bool run_round(std::size_t round) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const std::size_t before = whole_.face_count();
    const std::size_t cell_faces = std::clamp(before / (2 * kLeastCells), kLeastCellFaces, kMostCellFaces);
    std::vector<Cell> cells = split_into_cells(whole_.boxed_faces(), cell_faces,
                                               std::fmod(static_cast<double>(round) * kGoldenRatio, 1), whole_.box());
    if (cells.size() < kLeastCells / 2) return false;  // they would gain nothing
    const double max_priority = priority_for_a_round(cells), most = most_removed(cells);
    std::vector<WholeMesh::Collapses> collapses(cells.size());
    oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      const std::size_t size = cells[i].faces.size();
      const auto most_collapses = static_cast<std::size_t>(most * static_cast<double>(size) / 2);
      WholeMesh::Cut cut = whole_.cut(std::move(cells[i]), size - 2 * most_collapses, max_priority);
      simplify(cut.patch);
      collapses[i] = whole_.put_back(std::move(cut));
    });
    add(collapses);
    return whole_.face_count() < before - before / 16;
  }

  /// Why the edges that are left were refused.
  RefusalCounts simplify_whole() {
    WholeMesh::Cut everything = whole_.cut_everything(options_.target_faces);
    simplify(everything.patch);
    const RefusalCounts blocked = refusals_of_what_is_left(everything.patch);
    add({whole_.put_back(std::move(everything))});
    return blocked;
  }

  void simplify(Patch& patch) {
    estimate_priorities(patch, rules_);
    run_collapse_loop(patch, rules_);
  }

  /// The priority up to which edges are collapsed.
  double priority_for_a_round(const std::vector<Cell>& cells) {
    constexpr double kPartOfEdges = 0.5;
    std::vector<double> priorities = whole_.known_priorities(kSample);
    if (priorities.empty()) {  // The first round has no priorities yet.
      std::vector<PerEdge<EdgeFacts>> samples((cells.size() + kSample - 1) / kSample);
      oneapi::tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        WholeMesh::Cut cut = whole_.cut(cells[kSample * i], 0, 0);
        estimate_priorities(cut.patch, rules_);
        samples[i] = std::move(cut.patch.edges);
      });
      for (const PerEdge<EdgeFacts>& edges : samples)
        for (const EdgeFacts& edge : edges)
          if (edge.priority != EdgeFacts::kUnknown && !edge.is_refused) priorities.push_back(edge.priority);
    }
    if (priorities.empty()) return std::numeric_limits<double>::infinity();
    const auto place =
        priorities.begin() + static_cast<std::ptrdiff_t>(kPartOfEdges * static_cast<double>(priorities.size() - 1));
    std::ranges::nth_element(priorities, place);
    return *place;
  }

  void add(const std::vector<WholeMesh::Collapses>& patches) {
    for (const WholeMesh::Collapses& patch : patches) {
      refusals_ += patch.refusals;
      linear_programs_ += patch.linear_programs;
    }
    whole_.add(patches);
  }

  static RefusalCounts refusals_of_what_is_left(const Patch& patch) {
    RefusalCounts blocked;
    for (const EdgeId e : patch.edges.ids())
      if (patch.mesh.has(e)) {
        const HalfEdgeId h = patch.mesh.half_edge(e);
        if (patch.vertices[patch.mesh.tail(h)].is_kept || patch.vertices[patch.mesh.tip(h)].is_kept)
          blocked.count(Refusal::Tolerance);
        else if (patch.edges[e].is_refused)
          blocked.count(patch.edges[e].last_refusal);
      }
    return blocked;
  }

  HullOptions options_;  ///< the guards relax in the end
  const Box bounds_;
  const UnitCube unit_cube_;
  ProgressMeter meter_;
  const std::size_t excess_;  ///< faces above the target
  std::atomic<std::size_t> removed_ = 0;
  WholeMesh whole_;
  const CollapseRules rules_;
  RefusalCounts refusals_;
  std::size_t linear_programs_ = 0;
};

}  // namespace

HullResult simplify_in_rounds(const TriangleMesh& mesh, const HullOptions& options, const Box* part,
                              const MayReach& may_reach) {
  return Rounds(mesh, options, part, may_reach).run();
}

}  // namespace prohull
