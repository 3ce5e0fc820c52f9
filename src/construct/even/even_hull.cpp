#include "construct/even/even_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "construct/tight/tight_placement.h"
#include "construct/tight/tightening.h"
#include "geometry/compactness.h"
#include "geometry/directions.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/progress_meter.h"

namespace prohull {
namespace {

constexpr double kGain = 1.02;  ///< of the least compactness, by which a change has to be better
constexpr double kMostTurn = std::numbers::pi / 3;
const double kLeastCosine = std::cos(kMostTurn);

Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

double compactness_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  double unit = 0;
  for (int i = 0; i < 3; ++i) unit = std::max({unit, std::abs(u[i]), std::abs(v[i])});
  if (!(unit > 0)) return 0;
  return compactness(norm(cross(u / unit, v / unit)), squared_edges({}, u / unit, v / unit));
}

double least_compactness(const TriangleMesh& mesh) {
  double least = 1;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    least = std::min(least, compactness_of(t.a, t.b, t.c));
  }
  return least;
}

bool turns_little(const Vec3& before, const Vec3& after) {
  return dot(before, after) >= kLeastCosine * norm(before) * norm(after);
}

class Evener {
 public:
  /// No collapse adds more than this volume.
  Evener(HalfEdgeMesh& mesh, const Original& original, const EvenOptions& options, double most_added)
      : mesh_(mesh),
        original_(original),
        options_(options),
        most_added_(most_added),
        guard_(mesh, faces_along_curve(mesh)),
        placement_(original, options.float32_coordinates) {}

  /// Vertices move towards the middle of their link where that takes volume away: the shape stays good, or gets better.
  void flatten() {
    for (std::uint32_t v = 0; v < mesh_.positions().size(); ++v)
      if (mesh_.has(VertexId{v})) flatten(VertexId{v});
  }

  void run() {
    constexpr int kPasses = 4;
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::size_t before = changes_;
      flip_edges();
      collapse_edges();
      move_vertices();
      if (changes_ == before) break;
    }
  }

 private:
  Vec3 at(VertexId v) const { return mesh_.position(v); }
  double compactness_of_face(HalfEdgeId h) const {
    return compactness_of(at(mesh_.tail(h)), at(mesh_.tip(h)), at(mesh_.tail(mesh_.previous(h))));
  }

  void flip_edges() {
    for (std::uint32_t e = 0; e < mesh_.edge_id_count(); ++e)
      if (mesh_.has(EdgeId{e})) changes_ += flip(mesh_.half_edge(EdgeId{e}));
  }

  // Where the hull is convex over the edge, the tetrahedron of both faces is removed, and elsewhere added.
  bool flip(HalfEdgeId h) {
    const HalfEdgeId g = mesh_.twin(h);
    const double before = std::min(compactness_of_face(h), compactness_of_face(g));
    if (before >= options_.compactness) return false;
    const VertexId vl = mesh_.tail(mesh_.previous(h)), vr = mesh_.tail(mesh_.previous(g));
    const Vec3 o = at(mesh_.tail(h)), d = at(mesh_.tip(h)), l = at(vl), r = at(vr);
    if (std::min(compactness_of(r, l, o), compactness_of(l, r, d)) < kGain * before) return false;
    const Vec3 sum = normal(o, d, l) + normal(d, o, r);
    if (!turns_little(sum, normal(r, l, o)) || !turns_little(sum, normal(l, r, d))) return false;
    if (!mesh_.can_flip(h) || std::max(mesh_.valence(vl), mesh_.valence(vr)) >= kMostValence) return false;
    if (side(o, d, l, r) == Side::Inside && !original_.lies_outside_of({o, d, l, r})) return false;
    if (!original_.keeps_padding({r, l, o}) || !original_.keeps_padding({l, r, d})) return false;
    if (guard_.would_add_intersections(mesh_, h)) return false;
    mesh_.flip(h);
    guard_.changed(mesh_, vl);
    return true;
  }

  // The shortest edge of a thin face.
  void collapse_edges() {
    for (std::uint32_t f = 0; f < mesh_.face_id_count(); ++f) {
      if (!mesh_.has(FaceId{f})) continue;
      const HalfEdgeId first{3 * f};
      if (compactness_of_face(first) >= options_.compactness) continue;
      std::array<HalfEdgeId, 3> sides{first, mesh_.next(first), mesh_.previous(first)};
      std::ranges::stable_sort(sides, {}, [&](HalfEdgeId h) { return norm(at(mesh_.tip(h)) - at(mesh_.tail(h))); });
      changes_ += collapse(mesh_.edge(sides[0])) || collapse(mesh_.edge(sides[1]));
    }
  }

  bool collapse(EdgeId e) {
    gather_star(mesh_, e, star_);
    if (mesh_.face_count() <= 4 || !satisfies_link_condition(star_) || star_.valence() > kMostValence) return false;
    measure_star(mesh_, star_);
    const auto outside = place_outside(star_, placement_margin(star_, placement_.rounding()));
    if (!outside) return false;
    const Vec3 from = placement_.as_stored(star_.to_input(outside->local));
    if (!is_finite(from) || !is_outside(mesh_, star_, from)) return false;
    const HullOptions shape{.guards = {kMostValence, 1, options_.compactness, kMostTurn}};
    const auto is_accepted = [&](const Vec3& to) {
      const Vec3 local = star_.to_local(to);
      return added_volume(star_, local) <= most_added_ && !refused_shape(star_, local, shape) &&
             !guard_.would_add_intersections(mesh_, star_, to);
    };
    placement_.set(from, mesh_, star_.link);
    std::optional<Vec3> to = placement_.first(is_accepted);
    if (!to && is_accepted(from) && placement_.keeps_enclosing(from)) to = from;
    if (!to) return false;
    guard_.collapsed(mesh_, mesh_.collapse(mesh_.half_edge(e), *to));
    return true;
  }

  void move_vertices() {
    for (std::uint32_t v = 0; v < mesh_.positions().size(); ++v)
      if (mesh_.has(VertexId{v})) changes_ += move(VertexId{v});
  }

  void gather_link(VertexId v) {
    link_.clear();
    for (const HalfEdgeId h : mesh_.around(v)) link_.push_back(mesh_.tip(h));
  }

  void flatten(VertexId v) {
    gather_link(v);
    const Vec3 from = at(v);
    Vec3 middle;
    for (const VertexId u : link_) middle += (at(u) - from) / double(link_.size());
    if (!(dot(middle, mean_normal(v)) < 0)) return;
    const double least = std::min(least_with(from), options_.compactness);
    placement_.set(from, mesh_, link_);
    for (const double step : {1.0, 0.5, 0.25, 0.1})
      if (const Vec3 to = placement_.as_stored(from + middle * step);
          placement_.keeps_enclosing(to) && is_better(v, to, least)) {
        mesh_.move(v, to);
        guard_.changed(mesh_, v);
        return;
      }
  }

  bool move(VertexId v) {
    gather_link(v);
    const double before = least_with(at(v));
    if (before >= options_.compactness) return false;
    placement_.set(at(v), mesh_, link_);
    for (const Vec3& aim : better_places(v, kGain * before))
      if (const auto to = lifted(v, aim); to && is_better(v, *to, kGain * before)) {
        mesh_.move(v, *to);
        guard_.changed(mesh_, v);
        return true;
      }
    return false;
  }

  VertexId after(std::size_t i) const { return link_[i + 1 == link_.size() ? 0 : i + 1]; }

  double least_with(const Vec3& apex) const {
    double least = 1;
    for (std::size_t i = 0; i < link_.size(); ++i)
      least = std::min(least, compactness_of(apex, at(link_[i]), at(after(i))));
    return least;
  }

  Vec3 mean_normal(VertexId v) const {
    Vec3 sum;
    for (std::size_t i = 0; i < link_.size(); ++i) sum += normal(at(v), at(link_[i]), at(after(i)));
    const double length = norm(sum);
    return length > 0 ? sum / length : Vec3{};
  }

  // Beside the vertex along the surface, the best first: towards the middle of the link, and in eight directions.
  std::vector<Vec3> better_places(VertexId v, double least) const {
    constexpr int kDirections = 8;
    const Vec3 up = mean_normal(v), from = at(v);
    Vec3 middle;
    double size = 0;
    for (const VertexId u : link_)
      middle += (at(u) - from) / double(link_.size()), size += norm(at(u) - from) / double(link_.size());
    middle = middle - up * dot(middle, up);
    const Vec3 e1 = norm(up) > 0 ? any_normal(up) : Vec3{}, e2 = cross(up, e1);
    std::vector<std::pair<double, Vec3>> places;
    const auto consider = [&](const Vec3& p) {
      if (const double q = least_with(p); q >= least) places.emplace_back(-q, p);
    };
    for (const double part : {1.0, 0.5, 0.2}) consider(from + middle * part);
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      for (const double step : {0.5, 0.2, 0.05})
        consider(from + (e1 * std::cos(angle) + e2 * std::sin(angle)) * (step * size));
    }
    for (const double step : {0.3, 0.1, -0.1, -0.3}) consider(from + up * (step * size));
    std::ranges::stable_sort(places, {}, [](const auto& place) { return place.first; });
    constexpr std::size_t kMostTries = 8;
    if (places.size() > kMostTries) places.resize(kMostTries);
    std::vector<Vec3> result;
    for (const auto& [q, p] : places) result.push_back(p);
    return result;
  }

  // As high above the place as the hull needs to stay one: at most beyond all faces of the star.
  std::optional<Vec3> lifted(VertexId v, const Vec3& place) {
    constexpr int kSteps = 4;
    const Vec3 up = mean_normal(v), from = at(v);
    double size = 0, most = 0;
    for (std::size_t i = 0; i < link_.size(); ++i) {
      const Vec3 n = normal(from, at(link_[i]), at(after(i)));
      const double slope = dot(n, up), length = norm(n);
      size = std::max(size, norm(at(link_[i]) - from));
      if (!(length > 0)) continue;
      if (!(slope > 0.1 * length)) return std::nullopt;
      most = std::max(most, (4 * placement_.rounding() * length - dot(n, place - from)) / slope);
    }
    if (!(most <= size)) return std::nullopt;
    const auto keeps = [&](double height) {
      return placement_.keeps_enclosing(placement_.as_stored(place + up * height));
    };
    if (keeps(0)) return placement_.as_stored(place);
    if (!keeps(most)) return std::nullopt;
    double low = 0, high = most;
    for (int i = 0; i < kSteps; ++i) {
      const double middle = (low + high) / 2;
      (keeps(middle) ? high : low) = middle;
    }
    return placement_.as_stored(place + up * high);
  }

  bool is_better(VertexId v, const Vec3& to, double least) {
    if (!is_finite(to) || least_with(to) < least) return false;
    for (std::size_t i = 0; i < link_.size(); ++i)
      if (!turns_little(normal(at(v), at(link_[i]), at(after(i))), normal(to, at(link_[i]), at(after(i)))))
        return false;
    return !guard_.would_add_intersections(mesh_, v, link_, to);
  }

  static constexpr unsigned kMostValence = 12;

  HalfEdgeMesh& mesh_;
  const Original& original_;
  const EvenOptions& options_;
  const double most_added_;
  SelfIntersectionGuard guard_;
  TightPlacement placement_;
  Star star_;
  std::vector<VertexId> link_;
  std::size_t changes_ = 0;
};

/// Splits the longest edges of thin faces.
class Splitter {
 public:
  Splitter(const TriangleMesh& hull, const Original& original, const EvenOptions& options)
      : result_(hull),
        mesh_(hull),
        original_(original),
        options_(options),
        rounding_(storage_rounding(original.bounds(), options.float32_coordinates)) {}

  TriangleMesh run() {
    for (const EdgeId e : longest_edges()) {
      if (result_.face_count() + 2 > options_.max_faces) break;
      if (const auto middle = middle_of(e)) split(e, *middle);
    }
    return std::move(result_);
  }

 private:
  double length(HalfEdgeId h) const { return norm(mesh_.position(mesh_.tip(h)) - mesh_.position(mesh_.tail(h))); }

  HalfEdgeId longest_side(HalfEdgeId h) const {
    for (const HalfEdgeId other : {mesh_.next(h), mesh_.previous(h)})
      if (length(other) > length(h)) h = other;
    return h;
  }

  // From each thin face over its longest side to the next one, until a side is the longest of both its faces (Rivara
  // 1997). No two are of one face, the thinnest first.
  std::vector<EdgeId> longest_edges() const {
    std::vector<std::pair<double, EdgeId>> found;
    for (std::uint32_t f = 0; f < mesh_.face_id_count(); ++f) {
      const Triangle t = result_.triangle(FaceId{f});
      const double thin = compactness_of(t.a, t.b, t.c);
      if (thin >= options_.compactness) continue;
      HalfEdgeId h = longest_side(HalfEdgeId{3 * f});
      for (HalfEdgeId next = longest_side(mesh_.twin(h)); length(next) > length(h); next = longest_side(mesh_.twin(h)))
        h = next;
      found.emplace_back(thin, mesh_.edge(h));
    }
    std::ranges::sort(found, {}, [](const auto& entry) { return std::pair(entry.first, index(entry.second)); });
    std::vector<char> taken(mesh_.face_id_count(), 0);
    std::vector<EdgeId> edges;
    for (const auto& [thin, e] : found) {
      const HalfEdgeId h = mesh_.half_edge(e);
      const std::size_t f = index(h) / 3, g = index(mesh_.twin(h)) / 3;
      if (taken[f] || taken[g]) continue;
      taken[f] = taken[g] = 1;
      edges.push_back(e);
    }
    return edges;
  }

  // The middle of the edge as it is stored, or a hair farther outside.
  std::optional<Vec3> middle_of(EdgeId e) const {
    const HalfEdgeId h = mesh_.half_edge(e), g = mesh_.twin(h);
    const auto at = [&](HalfEdgeId k) { return mesh_.position(mesh_.tail(k)); };
    const Vec3 o = at(h), d = at(g), l = at(mesh_.previous(h)), r = at(mesh_.previous(g));
    const Vec3 sum = normal(o, d, l) + normal(d, o, r);
    const Vec3 up = norm(sum) > 0 ? sum / norm(sum) : Vec3{};
    for (const double lift : {0.0, 8 * rounding_, 64 * rounding_}) {
      const Vec3 exact = o * 0.5 + d * 0.5 + up * lift;
      const Vec3 m = options_.float32_coordinates ? nearest_float32(exact) : exact;
      if (is_finite(m) && keeps(o, d, l, r, m)) return m;
    }
    return std::nullopt;
  }

  bool keeps(const Vec3& o, const Vec3& d, const Vec3& l, const Vec3& r, const Vec3& m) const {
    const auto may_add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      return side(a, b, c, m) != Side::Inside || original_.lies_outside_of({a, b, c, m});
    };
    return may_add(o, d, l) && may_add(d, o, r) && original_.keeps_padding({o, m, l}) &&
           original_.keeps_padding({m, d, l}) && original_.keeps_padding({d, m, r}) &&
           original_.keeps_padding({m, o, r});
  }

  void split(EdgeId e, const Vec3& middle) {
    const VertexId m = result_.positions.push_back(middle);
    const HalfEdgeId h = mesh_.half_edge(e);
    for (const HalfEdgeId k : {h, mesh_.twin(h)}) {  // (a, b, c) becomes (a, m, c) and (m, b, c)
      const FaceId f{static_cast<std::uint32_t>(index(k) / 3)};
      auto second = result_.triangles[f];
      const std::size_t tail = index(k) % 3;
      result_.triangles[f][tail == 2 ? 0 : tail + 1] = m;
      second[tail] = m;
      result_.triangles.push_back(second);
    }
  }

  TriangleMesh result_;
  const HalfEdgeMesh mesh_;
  const Original& original_;
  const EvenOptions& options_;
  const double rounding_;
};

}  // namespace

TriangleMesh even_hull(const TriangleMesh& hull, const Original& original, const EvenOptions& options) {
  constexpr unsigned kRounds = 16, kMoves = 2, kLastMoves = 8;
  constexpr double kLeastAdded = 1e-5;  // by a collapse, of the volume; twice of it in each round
  const auto move_closer = [&](HalfEdgeMesh& mesh, unsigned rounds) {
    const ShapeGuards guards{.min_compactness_ratio = 1, .sufficient_compactness = options.compactness};
    tighten(mesh, original,
            {.guards = guards, .float32_coordinates = options.float32_coordinates, .max_rounds = rounds});
  };
  ProgressMeter meter(options.progress, "even");
  double most_added = kLeastAdded * std::abs(signed_volume(hull));
  TriangleMesh best = hull, now = hull;
  double best_compactness = least_compactness(hull);
  for (unsigned round = 0; round < kRounds && best_compactness < options.compactness; ++round) {
    meter.at(round, kRounds);
    HalfEdgeMesh mesh(Splitter(now, original, options).run());
    Evener(mesh, original, options, most_added).run();
    most_added *= 2;
    move_closer(mesh, kMoves);
    now = mesh.triangle_mesh();
    if (const double least = least_compactness(now); least > best_compactness) best = now, best_compactness = least;
  }
  HalfEdgeMesh mesh(best);
  for (unsigned i = 0; i < kLastMoves; ++i) {
    Evener(mesh, original, options, most_added).flatten();
    move_closer(mesh, 1);
  }
  return mesh.triangle_mesh();
}

}  // namespace prohull
