#include "paper/refinement_engine.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/triangle_intersection.h"
#include "paper/balls.h"
#include "paper/box_line.h"
#include "paper/line_sieve.h"
#include "paper/refined_hull.h"
#include "prohull/detail/refuse.h"

namespace prohull {
namespace {

// What a query is to faces and boxes: may_meet is false only if they certainly have no point in common.

class LineProbe {
 public:
  LineProbe(const DirectedLine& line, const Box& frame) : line_(line), box_line_(line), sieve_(line, frame) {}
  bool may_meet(const Triangle& face) const { return !sieve_.passes(face) && prohull::may_meet(line_, face); }
  bool may_meet(const Box& box) const { return prohull::may_meet(box_line_, box, line_.t_end); }
  void mark(const Balls& balls, std::span<std::uint8_t> marks) const { balls.mark(line_, marks); }

 private:
  const DirectedLine& line_;
  BoxLine box_line_;
  LineSieve sieve_;
};

class TriangleProbe {
 public:
  explicit TriangleProbe(const Triangle& triangle) : triangle_(triangle), box_(box_of(triangle)) {}
  bool may_meet(const Triangle& face) const { return box_.overlaps(box_of(face)) && !certainly_apart(triangle_, face); }
  bool may_meet(const Box& box) const { return box_.overlaps(box); }
  void mark(const Balls& balls, std::span<std::uint8_t> marks) const { balls.mark(box_, marks); }

 private:
  const Triangle& triangle_;
  Box box_;
};

std::vector<FaceId> base_faces_of(const ProgressiveHull& hull) {
  std::vector<FaceId> faces;
  for (std::uint32_t f = 0; f < hull.original_face_count(); ++f)
    if (hull.base_corners()[3 * std::size_t{f}] != ProgressiveHull::kAbsent) faces.push_back(FaceId(f));
  return faces;
}

/// All that a query must meet to have anything to do with a face of the base mesh: the face itself, or the original
/// faces below its corners.
std::vector<Vec3> reach_of(const RefinedHull& base, FaceId face, Refine refine) {
  const Triangle t = base.triangle(face);
  if (refine == Refine::WhereFacesMeet || base.is_original(face)) return {t.a, t.b, t.c};
  Box box;
  for (const VertexId v : base.corners(face))
    if (base.refinable().is_made(v)) box.extend(base.refinable().bounds(v));
  std::vector<Vec3> corners;
  for (const double x : {box.min.x, box.max.x})
    for (const double y : {box.min.y, box.max.y})
      for (const double z : {box.min.z, box.max.z}) corners.push_back({x, y, z});
  return corners;
}

/// What all threads share.
struct RefinementData {
  RefinementData(const ProgressiveHull& progressive, Refine what, const RefinementOptions& between_queries)
      : hull(std::make_shared<const RefinableHull>(progressive)),
        refine(what),
        options(between_queries),
        base_faces(base_faces_of(progressive)) {
    const RefinedHull base(hull);
    std::vector<std::vector<Vec3>> reaches;
    for (const FaceId f : base_faces)
      for (const Vec3& p : reaches.emplace_back(reach_of(base, f, refine))) box.extend(p);
    balls = Balls(box);
    for (const Vec3& p : hull->positions()) frame.extend(p);
    for (const auto& reach : reaches) balls.add(reach);
  }

  std::size_t memory_bytes() const {
    return sizeof(*this) + hull->memory_bytes() + base_faces.capacity() * sizeof(FaceId) + balls.memory_bytes();
  }

  std::shared_ptr<const RefinableHull> hull;
  Refine refine;
  RefinementOptions options;
  std::vector<FaceId> base_faces;
  Box box;             ///< a query that misses it meets nothing
  Box frame;           ///< of all positions
  Balls balls{Box{}};  ///< of each base face: a query that misses it need not look at the face
};

/// The list of candidate faces, first in first out, without duplicates (P&T 3.2.1). Faces of the base mesh come first,
/// in their order; those of which it is known that the query misses them are passed over, but counted.
class Candidates {
 public:
  /// Uses the tags of the hull's faces.
  Candidates(const RefinementData& shared, RefinedHull& hull)
      : shared_(shared),
        hull_(hull),
        base_size_(static_cast<std::uint32_t>(shared.base_faces.size())),
        marks_(1 + base_size_),
        queue_(2 * (base_size_ + 2 * shared.hull->hull().splits().size())) {
    for (std::uint32_t i = 0; i < base_size_; ++i) hull_.tag(shared.base_faces[i]) = tag(1 + i);
  }

  /// All faces of the base mesh; requires an empty list.
  template <class Probe>
  void start(const Probe& probe) {
    probe.mark(shared_.balls, std::span(marks_).last(base_size_));
    last_taken_ = 0;
  }

  /// The faces that the split of a vertex changed or brought forth: the stars of o and d.
  void add_faces_of(VertexId made) {
    const auto star = shared_.hull->star(made);
    const auto new_faces = shared_.hull->new_faces(made);
    make_room(star.size() + new_faces.size());
    // Without branches, for which faces are new to the list cannot be foretold; and by copies, which no store changes.
    FaceId* end = queue_.data() + added_;
    std::uint8_t* marks = marks_.data();
    std::uint32_t* tags = &hull_.tag(FaceId{0});
    const std::uint32_t last_tag = tag(last_taken_) | kWaiting;
    const auto add = [&](std::uint32_t face) {
      const std::uint32_t old = tags[4 * face];
      const bool had_turn = old <= last_tag;
      marks[had_turn ? kNobody : place(old)] = 1;
      *end = FaceId(face);
      end += had_turn & ~old & kWaiting;
      tags[4 * face] = old | (had_turn ? kWaiting : 0);
    };
    for (const std::uint32_t corner : star) add(corner / 4);
    for (const FaceId face : new_faces) add(index(face));
    added_ = static_cast<std::size_t>(end - queue_.data());
  }

  /// Adds to `passed` the number of candidates taken from the list, the one returned included.
  std::optional<FaceId> take(std::size_t& passed) {
    if (last_taken_ < base_size_) {
      const std::uint8_t* rest = marks_.data() + last_taken_ + 1;
      const auto* mark = static_cast<const std::uint8_t*>(std::memchr(rest, 1, base_size_ - last_taken_));
      const auto next = mark ? static_cast<std::uint32_t>(mark - marks_.data()) : base_size_;
      passed += next - last_taken_;
      last_taken_ = next;
      if (mark) return shared_.base_faces[next - 1];
    }
    if (taken_ == added_) return std::nullopt;
    ++passed;
    const FaceId face = queue_[taken_++];
    hull_.tag(face) &= ~kWaiting;
    return face;
  }

  void clear() {
    while (taken_ < added_) hull_.tag(queue_[taken_++]) &= ~kWaiting;
    taken_ = added_ = 0;
  }

  std::size_t memory_bytes() const { return marks_.capacity() + queue_.capacity() * sizeof(FaceId); }

 private:
  // No face waits twice, so what waits and what comes fit into twice the number of faces.
  void make_room(std::size_t count) {
    if (added_ + count <= queue_.size()) return;
    std::copy(queue_.begin() + static_cast<std::ptrdiff_t>(taken_),
              queue_.begin() + static_cast<std::ptrdiff_t>(added_), queue_.begin());
    added_ -= std::exchange(taken_, 0);
  }

  // Tags: the place of a face among those of the base mesh, counted from 1, and 0 for others; whether it is in queue_.
  static constexpr std::uint32_t kWaiting = 1, kNobody = 0;
  static std::uint32_t tag(std::uint32_t place) { return 2 * place; }
  static std::uint32_t place(std::uint32_t tag) { return tag / 2; }

  const RefinementData& shared_;
  RefinedHull& hull_;
  std::uint32_t base_size_;
  std::vector<std::uint8_t> marks_;  // by place: to be looked at
  std::uint32_t last_taken_ = 0;     // place of the last face of the base mesh that had its turn
  std::vector<FaceId> queue_;        // from taken_ to added_
  std::size_t taken_ = 0, added_ = 0;
};

class RefinementWorker final : public QueryWorker {
 public:
  explicit RefinementWorker(const RefinementData& shared)
      : shared_(shared), hull_(shared.hull), candidates_(shared, hull_) {}

  void collect(const DirectedLine& line, HitCollector& hits) override { answer(LineProbe(line, shared_.frame), hits); }
  void collect(const Triangle& triangle, FaceCollector& faces) override { answer(TriangleProbe(triangle), faces); }

  int winding(const TriangleMesh& mesh, const DirectedLine& line) override {
    if (shared_.refine == Refine::WhereFacesMeet)
      refuse(
          "the engine paper-refinement may miss crossings, so that it cannot tell what is inside; take "
          "another one, such as auto");
    return QueryWorker::winding(mesh, line);
  }

  void forget() override {
    hull_.roll_back();
    queries_ = 0;
  }
  QueryCounts counts() const override { return counts_; }
  std::size_t memory_bytes() const override {
    return sizeof(*this) + hull_.memory_bytes() + candidates_.memory_bytes();
  }

 private:
  template <class Probe, class Collector>
  void answer(const Probe& probe, Collector& found) {
    if (shared_.options.between == BetweenQueries::Coarsen)
      counts_.coarsenings += hull_.coarsen([&](VertexId made) { return !is_wanted(probe, made); });
    if (probe.may_meet(shared_.box)) refine(probe, found);
    if (shared_.options.between == BetweenQueries::RollBack && ++queries_ >= shared_.options.queries_per_roll_back)
      forget();
  }

  // P&T 3.2.1.
  template <class Probe, class Collector>
  void refine(const Probe& probe, Collector& found) {
    candidates_.start(probe);
    for (const VertexId made : hull_.splits()) candidates_.add_faces_of(made);
    while (!found.is_complete()) {
      const auto face = candidates_.take(counts_.tests);
      if (!face) break;
      if (shared_.refine == Refine::WhereFacesMeet || hull_.is_original(*face))
        if (!probe.may_meet(hull_.triangle(*face))) continue;
      if (hull_.is_original(*face))
        found.offer(*face);
      else
        split_corners(*face, probe);
    }
    candidates_.clear();
  }

  template <class Probe>
  void split_corners(FaceId face, const Probe& probe) {
    const auto corners = hull_.corners(face);
    for (const VertexId v : corners)
      if (shared_.hull->is_made(v)) shared_.hull->prefetch(v);
    for (const VertexId v : corners) {
      if (!shared_.hull->is_made(v)) continue;
      if (shared_.refine == Refine::WhereBoundsMeet && !probe.may_meet(shared_.hull->bounds(v))) continue;
      const std::size_t count = hull_.split(v);
      counts_.splits += count;
      for (const VertexId made : hull_.splits().last(count)) candidates_.add_faces_of(made);
    }
  }

  // P&T 3.2.2: whether the query meets what the hull would be without the split, so that it would be made again.
  template <class Probe>
  bool is_wanted(const Probe& probe, VertexId made) const {
    if (shared_.refine == Refine::WhereBoundsMeet) return probe.may_meet(shared_.hull->bounds(made));
    for (const std::uint32_t corner : shared_.hull->star(made)) {
      Triangle t = hull_.triangle(FaceId(corner / 4));
      (corner % 4 == 0 ? t.a : corner % 4 == 1 ? t.b : t.c) = shared_.hull->positions()[made];
      if (probe.may_meet(t)) return true;
    }
    return false;
  }

  const RefinementData& shared_;
  RefinedHull hull_;
  Candidates candidates_;
  QueryCounts counts_;
  unsigned queries_ = 0;  // since the last roll back
};

class RefinementEngine final : public QueryEngine {
 public:
  RefinementEngine(const ProgressiveHull& hull, Refine refine, const RefinementOptions& options)
      : shared_(hull, refine, options) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<RefinementWorker>(shared_); }
  std::size_t memory_bytes() const override { return shared_.memory_bytes(); }

 private:
  RefinementData shared_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_refinement_engine(const ProgressiveHull& hull, Refine refine,
                                                    const RefinementOptions& options) {
  return std::make_unique<RefinementEngine>(hull, refine, options);
}

}  // namespace prohull
