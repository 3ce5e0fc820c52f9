#include "paper/walk_engine.h"

#include <oneapi/tbb/task_arena.h>

#include <array>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/bvh.h"
#include "hull/void_complex.h"
#include "paper/line_sieve.h"
#include "query/some_faces.h"

// Why no walk ends too early, and none goes on for ever
//
// Seen along the moved line, the line is a point, and it lies on no line through two corners (line.h, MeshQuery). Of
// four points in the plane, each three span a triangle, and a point on none of their lines lies in none of the four
// triangles or in two: this holds in general position, and moving the four points there, by less than the point is away
// from their lines, changes nothing. So the line pierces none or two of the faces of a tetrahedron, flat or not, and
// which ones follows from the signs of its edges alone. Each face of the complex belongs to two tetrahedra, or to one
// and the border. So the pierced tetrahedra form paths, which end in border faces, and closed loops; a walk that starts
// at a border face is on a path. It never comes to a tetrahedron again, and ends at another border face.
//
// Why it finds every crossing
//
// With the complexes of an outer and an inner hull the original faces are within, and the border consists of the two
// base meshes. A walk passes the faces of a path in the order in which the line does: no tetrahedron is turned inside
// out, so the line passes each in its direction, and flat ones at one point. Hence a closed loop has only flat
// tetrahedra, and the original faces on it are among sheets_without_thickness, which are tested one by one. All others
// are on paths, each of which has one first border face: an outer one that the line enters, or an inner one that it
// leaves.

namespace prohull {
namespace {

/// One hull, its void and its base mesh.
struct Layer {
  explicit Layer(const ProgressiveHull& hull)
      : complex(hull), base(hull.base()), tree(make_bvh_engine(base)), boxes(base) {}

  std::size_t memory_bytes() const {
    return sizeof(*this) + complex.memory_bytes() + base.positions.size() * sizeof(Vec3) +
           base.face_count() * (sizeof(base.triangles[FaceId{}]) + 2 * sizeof(Box)) + tree->memory_bytes();
  }

  VoidComplex complex;
  TriangleMesh base;
  std::unique_ptr<QueryEngine> tree;  ///< for segments and rays that begin or end outside of the frame
  Bvh boxes;                          ///< for the whole lines of others
};

std::vector<std::unique_ptr<Layer>> layers_of(const ProgressiveHull& outer, const ProgressiveHull* inner) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(std::make_unique<Layer>(outer));
  if (inner) layers.push_back(std::make_unique<Layer>(*inner));
  return layers;
}

/// What all threads share.
struct WalkData {
  WalkData(const TriangleMesh& original, const ProgressiveHull& outer, const ProgressiveHull* inner)
      : mesh(original), layers(layers_of(outer, inner)), sheets(mesh, sheets_without_thickness(layers[0]->complex)) {
    for (const auto& layer : layers) frame.extend(layer->complex.box());
  }

  bool is_outside(const Vec3& p) const { return !frame.overlaps({p, p}); }

  std::size_t memory_bytes() const {
    std::size_t bytes = sizeof(*this) + sheets.memory_bytes();
    for (const auto& layer : layers) bytes += layer->memory_bytes();
    return bytes;
  }

  const QueryEngine& tree_of_original() const {
    // Isolated: a thread that waits for parts of the tree must not take another query, which would wait for the tree.
    std::call_once(tree_is_made_,
                   [&] { oneapi::tbb::this_task_arena::isolate([&] { tree_of_original_ = make_bvh_engine(mesh); }); });
    return *tree_of_original_;
  }

  const TriangleMesh& mesh;
  std::vector<std::unique_ptr<Layer>> layers;  ///< outer, and inner if there is one
  SomeFaces sheets;
  Box frame;  ///< of all positions: outside of it there is no void

 private:
  mutable std::once_flag tree_is_made_;
  mutable std::unique_ptr<QueryEngine> tree_of_original_;  ///< for triangles and distances, which no walk can answer
};

/// A border face that the line crosses.
struct Gate {
  std::size_t layer;
  FaceId face;  ///< of the layer's base mesh
  bool entering;
};

/// Boxes that an endless line may meet; false only if it certainly misses them. The line's direction, for a segment,
/// and each plane's t are within 4 eps of the true ones, which moves planes by less than 4 eps of their distance.
class EndlessLine {
 public:
  EndlessLine(const DirectedLine& line, const Box& frame) : line_(line) {
    using line_filter::largest_entry;
    slack_ = 16 * line_filter::kEpsilon *
             std::max(largest_entry(frame.max - line.origin), largest_entry(frame.min - line.origin));
  }

  bool may_meet(const Box& box) const {
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.min[axis] - line_.origin[axis] - slack_;
      const double high = box.max[axis] - line_.origin[axis] + slack_, d = line_.direction[axis];
      if (!(std::abs(d) > 0x1p-900 && std::abs(d) < 0x1p900)) {
        if (d == 0 && (low > 0 || high < 0)) return false;
        continue;
      }
      const double one = low / d, other = high / d;
      from = std::max(from, std::min(one, other));
      to = std::min(to, std::max(one, other));
    }
    return from <= to;
  }

 private:
  const DirectedLine& line_;
  double slack_;
};

/// A line seen along itself.
class Sight {
 public:
  Sight(const DirectedLine& line, const Box& frame) : line_(line), sieve_(line, frame) {}

  struct Corner {
    VertexId id;
    const Vec3* position;
    LineSieve::Projected at;
  };
  Corner corner(const VoidComplex& complex, VertexId v) const {
    const Vec3& p = complex.position(v);
    return {v, &p, sieve_.projected(p)};
  }

  /// As exact_edge_side.
  int edge_sign(const Corner& p, const Corner& q) const {
    if (const int sign = sieve_.edge_sign(p.at, q.at); sign != 0) return sign;
    // An apex often lies all but where a corner of its star was.
    if (const int sign = sieve_.edge_sign(*p.position, *q.position); sign != 0) return sign;
    return exact_edge_side(line_, *p.position, *q.position);
  }

 private:
  const DirectedLine& line_;
  LineSieve sieve_;
};

class WalkWorker final : public QueryWorker {
 public:
  explicit WalkWorker(const WalkData& shared) : shared_(shared), sheets_(shared.sheets) {
    for (const auto& layer : shared.layers) trees_.push_back(layer->tree->worker());
  }

  void collect(const DirectedLine& line, HitCollector& hits) override { walk(line, hits, false); }

  void collect(const Triangle& triangle, FaceCollector& faces) override { tree_of_original().collect(triangle, faces); }
  void collect(ClosestCollector& closest) override { tree_of_original().collect(closest); }

  int winding(const TriangleMesh& mesh, const DirectedLine& line) override {
    return tree_of_original().winding(mesh, line);
  }

  std::optional<Hit> one_hit(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode) override {
    HitCollector hits(mesh, line, mode);
    walk(line, hits, true);
    return hits.best();
  }

 private:
  enum class Direction { Forwards, Backwards };

  QueryWorker& tree_of_original() {
    if (!tree_of_original_) tree_of_original_ = shared_.tree_of_original().worker();
    return *tree_of_original_;
  }

  bool finds_all() const { return shared_.layers.size() == 2; }

  // With both hulls it suffices to start where paths begin, or where they end. With one, the original is the end of all
  // paths, so both are needed.
  void walk(const DirectedLine& line, HitCollector& hits, bool one) {
    walks_.clear();  // of a line before, if it was interrupted
    sheets_.collect(line, hits);
    const bool begins_outside = shared_.is_outside(line.origin);
    const bool ends_outside = line.is_ray() || shared_.is_outside(line.end);
    const bool whole = !(finds_all() ? begins_outside || ends_outside : begins_outside && ends_outside);
    find_gates(line, whole);
    const Sight sight(line, shared_.frame);
    for (const Gate& gate : gates_) {
      if (hits.is_complete()) return;
      const bool path_begins = gate.entering == (gate.layer == 0);
      if (finds_all() && path_begins != begins_outside) continue;
      if (one && path_begins && is_beyond(line, gate, hits.limit())) continue;
      walks_.push_back(begin(sight, gate,
                             whole                ? Stop::Never
                             : one && path_begins ? Stop::AfterFirst
                                                  : Stop::AfterRange));
      if (one) go_on(sight, line, hits);
    }
    go_on(sight, line, hits);
  }

  /// All walks to their ends, in turns: while one waits for memory, the others go on.
  void go_on(const Sight& sight, const DirectedLine& line, HitCollector& hits) {
    while (!walks_.empty())
      for (std::size_t i = walks_.size(); i-- > 0;)
        if (!is_going_on(walks_[i], sight, line, hits)) {
          walks_[i] = walks_.back();
          walks_.pop_back();
        }
  }

  /// What ends a walk before it comes to a border.
  enum class Stop {
    Never,
    AfterRange,  ///< an original face that only the endless line crosses: the line ends before
    AfterFirst,  ///< the same, and whatever lies behind the first crossing
  };

  void find_gates(const DirectedLine& line, bool whole) {
    gates_.clear();
    for (std::size_t i = 0; i < shared_.layers.size(); ++i) {
      const Layer& layer = *shared_.layers[i];
      if (whole) {
        find_gates_of_endless_line(line, i);
        continue;
      }
      hits_.clear();
      trees_[i]->all_hits(layer.base, line, hits_);
      for (const Hit& hit : hits_) gates_.push_back({i, hit.face, hit.entering});
    }
  }

  void find_gates_of_endless_line(const DirectedLine& line, std::size_t i) {
    const Layer& layer = *shared_.layers[i];
    const Sight sight(line, shared_.frame);
    const EndlessLine endless(line, shared_.frame);
    layer.boxes.visit(
        [&](const Box& box) { return endless.may_meet(box); },
        [&](std::uint32_t f) {
          const auto face = corners(sight, layer, FaceId(f));
          const int sign = sight.edge_sign(face[0], face[1]);
          if (sign == 0 || sight.edge_sign(face[1], face[2]) != sign || sight.edge_sign(face[2], face[0]) != sign)
            return;
          gates_.push_back({i, FaceId(f), sign < 0});
        });
  }

  bool is_beyond(const DirectedLine& line, const Gate& gate, double limit) const {
    if (limit == line.t_end) return false;
    const Parameter at = parameter(line, shared_.layers[gate.layer]->base.triangle(gate.face));
    return at.t - at.error > limit;
  }

  static std::array<Sight::Corner, 3> corners(const Sight& sight, const Layer& layer, FaceId base_face) {
    const auto [a, b, c] = layer.complex.base_corners()[index(base_face)];
    return {sight.corner(layer.complex, a), sight.corner(layer.complex, b), sight.corner(layer.complex, c)};
  }

  struct Walk {
    std::size_t layer;
    VoidComplex::Neighbour next;
    std::array<Sight::Corner, 3> face;  ///< by which the line comes to `next`
    int sign;                           ///< on which the line passes the edges of this face and of every one to come
    Stop stop;
    bool has_found = false;
  };

  Walk begin(const Sight& sight, const Gate& gate, Stop stop) const {
    const Layer& layer = *shared_.layers[gate.layer];
    return {gate.layer, layer.complex.beyond_base(index(gate.face)), corners(sight, layer, gate.face),
            gate.entering ? -1 : 1, stop};
  }

  /// Takes one step, unless the walk is at its end.
  bool is_going_on(Walk& walk, const Sight& sight, const DirectedLine& line, HitCollector& hits) const {
    using Kind = VoidComplex::Neighbour::Kind;
    const VoidComplex& complex = shared_.layers[walk.layer]->complex;
    if (walk.next.kind == Kind::BaseFace) return false;
    if (walk.next.kind == Kind::Tetrahedron) {
      if (walk.has_found && walk.stop == Stop::AfterFirst && !complex.is_flat(walk.next.id)) return false;
      walk.next = pass(complex[walk.next], sight, complex, walk.sign, walk.face);
      return true;
    }
    const FaceId original{walk.next.id};
    const bool is_crossed = crossing(line, shared_.mesh.triangle(original)) != Crossing::None;
    if (is_crossed && !shared_.sheets.has(original)) hits.offer(original);
    if (hits.is_complete() || !finds_all() || (walk.stop != Stop::Never && !is_crossed)) return false;
    walk.has_found |= is_crossed;
    walk.layer = 1 - walk.layer;
    const VoidComplex& other = shared_.layers[walk.layer]->complex;
    walk.next = other.beyond_original(original);
    if (walk.next.kind == Kind::Tetrahedron) renumber(walk.face, other, other[walk.next]);
    return true;
  }

  /// A face that the line passes has corners at three positions.
  static void renumber(std::array<Sight::Corner, 3>& face, const VoidComplex& complex,
                       const VoidComplex::Tetrahedron& tetrahedron) {
    for (Sight::Corner& corner : face)
      corner.id = *std::ranges::find(tetrahedron.corners.begin() + 1, tetrahedron.corners.end(), *corner.position,
                                     [&](VertexId v) { return complex.position(v); });
  }

  /// From the face of a tetrahedron by which the line comes in to the one by which it leaves; what lies beyond that.
  static VoidComplex::Neighbour pass(const VoidComplex::Tetrahedron& tetrahedron, const Sight& sight,
                                     const VoidComplex& complex, int sign, std::array<Sight::Corner, 3>& face) {
    const auto& [corners, beyond] = tetrahedron;
    std::uint32_t opposite = 0;  // each other corner counts twice
    for (const VertexId v : corners) opposite ^= index(v);
    for (const Sight::Corner& c : face) opposite ^= index(c.id);
    const Sight::Corner apex = sight.corner(complex, VertexId(opposite));
    // The line leaves by (apex, face[k + 1], face[k + 2]) where it has apex -> face[k + 1] on the side `sign`, and
    // apex -> face[k + 2] on the other. There is one such k, also if the line is parallel to an edge.
    const auto passes = [&](int k) { return sign * sight.edge_sign(apex, face[static_cast<std::size_t>(k)]); };
    const int first = passes(0);
    const std::size_t left = first > 0 ? (passes(1) < 0 ? 2 : 0) : first < 0 ? (passes(2) > 0 ? 1 : 0) : 0;
    const auto place = std::ranges::find(corners, face[left].id) - corners.begin();
    face[left] = apex;
    return beyond[static_cast<std::size_t>(place)];
  }

  const WalkData& shared_;
  SomeFaces::Asker sheets_;
  std::vector<std::unique_ptr<QueryWorker>> trees_;
  std::unique_ptr<QueryWorker> tree_of_original_;
  std::vector<Gate> gates_;
  std::vector<Hit> hits_;
  std::vector<Walk> walks_;
};

class WalkEngine final : public QueryEngine {
 public:
  WalkEngine(const TriangleMesh& mesh, const ProgressiveHull& outer, const ProgressiveHull* inner)
      : shared_(mesh, outer, inner) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<WalkWorker>(shared_); }
  std::size_t memory_bytes() const override { return shared_.memory_bytes(); }

 private:
  WalkData shared_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_walk_engine(const TriangleMesh& mesh, const ProgressiveHull& outer,
                                              const ProgressiveHull* inner) {
  return std::make_unique<WalkEngine>(mesh, outer, inner);
}

}  // namespace prohull
