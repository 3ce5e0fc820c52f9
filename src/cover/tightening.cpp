#include "cover/tightening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "cover/polytope.h"
#include "geometry/no_index.h"

namespace prohull::cover {
namespace {

/// A point of the target that a face has to stay outside of.
struct Contact {
  std::uint32_t face, point;
  std::uint32_t next;             ///< contact of the same face, or kNone
  std::array<double, 3> weights;  ///< barycentric: how far the plane moves at the point when a corner moves by 1
  double shortfall;               ///< how far the point is outside of the plane; less than 0 if it is inside
  double correction = 0;          ///< of the shortfall, in this step: what the linear planes have missed
  double multiplier = 0;          ///< by how much volume it grows if the plane moves by 1
  double give = 0;                ///< how far a push of 1 moves the plane
};

struct Facet {
  Vec3 normal;  ///< of length 1
  double area = 0, offset = 0;
  std::uint32_t contacts = kNone;              ///< the first
  std::uint32_t near_begin = 0, near_end = 0;  ///< of State::near
};

/// A polytope and what its faces touch.
struct State {
  TriangleMesh polytope;
  double merit = std::numeric_limits<double>::infinity();
  std::vector<Facet> facets;
  std::vector<std::uint32_t> near;  ///< points near to the planes, or outside
  std::vector<Contact> contacts;
};

/// Of length 1, or 0 for a triangle without area.
Vec3 unit_normal(const Triangle& t) {
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const double size = norm(n);
  return size > 0 ? n / size : Vec3{};
}

/// Sequential programming: each round takes the planes as linear in the vertices, and lets steps cost their squared
/// length. So a round is a quadratic program, which is solved by its multipliers: at first the areas of the faces, for
/// which the vertices stay where every face touches the target in its centroid.
class Tightening {
 public:
  explicit Tightening(const Target& target) : target_(target) {}

  TriangleMesh run(TriangleMesh polytope) {
    const std::size_t rounds = kRounds + kRoundsOfAllVertices / std::max<std::size_t>(polytope.vertex_count(), 1);
    State state = state_of(std::move(polytope));
    double checkpoint = state.merit;
    for (std::size_t round = 1; round <= rounds && radius_ > kLeastRadius; ++round) {
      State next = state_of(convex_hull_of(step_from(state, Pull::Inwards)));
      adapt_radius(next.merit < state.merit);
      if (next.merit < state.merit) state = std::move(next);
      if (round % kCheckEvery != 0) continue;
      if (!(state.merit < checkpoint * (1 - kLeastGain))) break;
      checkpoint = state.merit;
    }
    for (int round = 0; round < kRepairs; ++round) state = state_of(convex_hull_of(step_from(state, Pull::None)));
    return std::move(state.polytope);
  }

 private:
  // Lengths are of the target's size, which is about 2. Measured on convex hulls of 4 models, whole and cut: twice or
  // half of each changes the added volume by less than a tenth.
  static constexpr double kFirstRadius = 0.3, kLeastRadius = 1e-4;
  static constexpr double kReach = 1;         ///< how near points are that may be touched after a step; radii
  static constexpr double kTolerance = 0.02;  ///< how far points may be outside after a step; radii
  static constexpr double kLeastGain = 1e-4;  ///< of the volume
  static constexpr double kPenalty = 1.5;     ///< to move a plane of area 1 by 1 costs 1
  static constexpr double kLeastArea = 1e-12;
  static constexpr std::size_t kRounds = 24, kRoundsOfAllVertices = 512, kCheckEvery = 8;
  static constexpr int kRepairs = 2, kCorrections = 2, kSweeps = 6;
  enum class Pull { Inwards, None };

  void adapt_radius(bool is_better) {
    if (!is_better)
      radius_ *= 0.5;
    else if (was_better_)
      radius_ = std::min(radius_ * 1.5, kFirstRadius);
    was_better_ = is_better;
  }

  State state_of(TriangleMesh polytope) {
    State state;
    state.polytope = std::move(polytope);
    if (state.polytope.face_count() == 0) return state;
    // The volume, and a penalty for what is outside: more than it costs to move the planes.
    state.merit = signed_volume(state.polytope);
    for (const FaceId f : state.polytope.triangles.ids()) {
      const double outside = add_facet(state, state.polytope.triangle(f));
      state.merit += kPenalty * state.facets.back().area * std::max(0.0, outside);
    }
    for (std::uint32_t f = 0; f < state.facets.size(); ++f) add_first_contacts(state, f);
    return state;
  }

  /// Returns how far the target reaches out of it.
  double add_facet(State& state, const Triangle& t) {
    Facet facet;
    facet.normal = unit_normal(t);
    facet.area = 0.5 * dot(cross(t.b - t.a, t.c - t.a), facet.normal);
    facet.offset = dot(facet.normal, t.a) - target_.allowance(facet.normal);
    const double most = target_.greatest_product(facet.normal, products_);
    facet.near_begin = static_cast<std::uint32_t>(state.near.size());
    for (std::uint32_t i = 0; i < products_.size(); ++i)
      if (products_[i] >= most - kReach * radius_) state.near.push_back(i);
    facet.near_end = static_cast<std::uint32_t>(state.near.size());
    state.facets.push_back(facet);
    return most - facet.offset;
  }

  /// Of the points near to a face, the one that measures most.
  template <class Measure>
  std::uint32_t most_of(const State& state, const Facet& facet, Measure&& measure) const {
    std::uint32_t best = state.near[facet.near_begin];
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = facet.near_begin; i < facet.near_end; ++i)
      if (const double x = measure(target_.points()[state.near[i]]); x > most) most = x, best = state.near[i];
    return best;
  }

  /// The point that is farthest outside, and the ends of the region near to the plane.
  void add_first_contacts(State& state, std::uint32_t f) const {
    const Facet facet = state.facets[f];
    if (!(facet.area > kLeastArea)) return;
    const auto& points = target_.points();
    const std::uint32_t p = most_of(state, facet, [&](const Vec3& x) { return dot(facet.normal, x); });
    const std::uint32_t q = most_of(state, facet, [&](const Vec3& x) { return squared_norm(x - points[p]); });
    const Vec3 across = cross(facet.normal, points[q] - points[p]);
    const std::uint32_t left = most_of(state, facet, [&](const Vec3& x) { return dot(across, x); });
    const std::uint32_t right = most_of(state, facet, [&](const Vec3& x) { return -dot(across, x); });
    const std::size_t first = state.contacts.size();
    for (const std::uint32_t point : {p, q, left, right})
      if (!contact_of(state, f, point)) add_contact(state, f, point);
    const auto count = static_cast<double>(state.contacts.size() - first);
    for (std::size_t i = first; i < state.contacts.size(); ++i) state.contacts[i].multiplier = facet.area / count;
  }

  static Contact* contact_of(State& state, std::uint32_t f, std::uint32_t point) {
    for (std::uint32_t i = state.facets[f].contacts; i != kNone; i = state.contacts[i].next)
      if (state.contacts[i].point == point) return &state.contacts[i];
    return nullptr;
  }

  void add_contact(State& state, std::uint32_t f, std::uint32_t point) const {
    Facet& facet = state.facets[f];
    const Vec3 p = target_.points()[point];
    const Triangle t = state.polytope.triangle(FaceId{f});
    const double b = dot(cross(p - t.a, t.c - t.a), facet.normal) / (2 * facet.area);
    const double c = dot(cross(t.b - t.a, p - t.a), facet.normal) / (2 * facet.area);
    const double shortfall = dot(facet.normal, p) - facet.offset;
    state.contacts.push_back({f, point, facet.contacts, {1 - b - c, b, c}, shortfall});
    facet.contacts = static_cast<std::uint32_t>(state.contacts.size() - 1);
  }

  /// Where the vertices go.
  std::vector<Vec3> step_from(State& state, Pull pull) {
    for (Contact& c : state.contacts) {
      c.correction = 0;
      if (pull == Pull::None) c.multiplier = 0;
    }
    std::vector<Vec3> moved = solve(state, pull);
    for (int i = 0; i < kCorrections && correct(state, moved); ++i) moved = solve(state, pull);
    return moved;
  }

  /// Points that are outside after the step become contacts; where they are, the contact asks for that much more.
  /// Whether there are any.
  bool correct(State& state, const std::vector<Vec3>& moved) const {
    bool any = false;
    for (std::uint32_t f = 0; f < state.facets.size(); ++f) {
      const Facet facet = state.facets[f];
      if (facet.contacts == kNone) continue;
      const auto& [a, b, c] = state.polytope.triangles[FaceId{f}];
      const Vec3 normal = unit_normal({moved[index(a)], moved[index(b)], moved[index(c)]});
      const std::uint32_t p = most_of(state, facet, [&](const Vec3& x) { return dot(normal, x); });
      const double outside = dot(normal, target_.points()[p] - moved[index(a)]) + target_.allowance(normal);
      if (!(outside > kTolerance * radius_)) continue;
      any = true;
      if (Contact* known = contact_of(state, f, p))
        known->correction += outside;
      else
        add_contact(state, f, p);
    }
    return any;
  }

  /// The quadratic program, by Gauss-Seidel sweeps over the multipliers, as engines of rigid bodies solve contacts.
  std::vector<Vec3> solve(State& state, Pull pull) {
    begin_step(state, pull);
    for (Contact& c : state.contacts) push(state, c, c.multiplier);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t k = 0; k < state.contacts.size(); ++k) relax(state, state.contacts[k]);
      for (std::size_t k = state.contacts.size(); k-- > 0;) relax(state, state.contacts[k]);
    }
    std::vector<Vec3> moved(state.polytope.positions.begin(), state.polytope.positions.end());
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += step_[v];
    return moved;
  }

  /// Where the gradient of the volume pulls the vertices, if nothing holds them.
  void begin_step(State& state, Pull pull) {
    const TriangleMesh& mesh = state.polytope;
    step_.assign(mesh.vertex_count(), {});
    compliance_.assign(mesh.vertex_count(), 0);
    for (std::uint32_t f = 0; f < state.facets.size(); ++f)
      for (const VertexId v : mesh.triangles[FaceId{f}]) {
        step_[index(v)] += state.facets[f].normal * (state.facets[f].area / 3);
        compliance_[index(v)] += state.facets[f].area / 3;
      }
    for (std::size_t v = 0; v < step_.size(); ++v) {
      compliance_[v] = radius_ / std::max(compliance_[v], kLeastArea);
      step_[v] = pull == Pull::Inwards ? step_[v] * -compliance_[v] : Vec3{};
    }
    for (Contact& c : state.contacts) {
      c.give = 0;
      const auto& corners = mesh.triangles[FaceId{c.face}];
      for (std::size_t i = 0; i < 3; ++i) c.give += c.weights[i] * c.weights[i] * compliance_[index(corners[i])];
    }
  }

  void push(const State& state, const Contact& c, double by) {
    const auto& corners = state.polytope.triangles[FaceId{c.face}];
    for (std::size_t i = 0; i < 3; ++i)
      step_[index(corners[i])] += state.facets[c.face].normal * (by * c.weights[i] * compliance_[index(corners[i])]);
  }

  /// Pushes until the plane is where the point asks for it, or no longer at all.
  void relax(const State& state, Contact& c) {
    const auto& corners = state.polytope.triangles[FaceId{c.face}];
    Vec3 motion;
    for (std::size_t i = 0; i < 3; ++i) motion += step_[index(corners[i])] * c.weights[i];
    const double lacks = c.shortfall + c.correction - dot(motion, state.facets[c.face].normal);
    const double multiplier = std::max(0.0, c.multiplier + lacks / c.give);
    if (multiplier == c.multiplier) return;
    push(state, c, multiplier - c.multiplier);
    c.multiplier = multiplier;
  }

  const Target& target_;
  double radius_ = kFirstRadius;  ///< how far a vertex moves if nothing holds it
  bool was_better_ = true;
  std::vector<double> products_;    ///< of the target's points with a normal
  std::vector<Vec3> step_;          ///< of the vertices
  std::vector<double> compliance_;  ///< how far a push of 1 moves a vertex
};

}  // namespace

Target::Target(const TriangleMesh& polytope, double rounding) : frame_(polytope, rounding), rounding_(rounding) {
  for (const Vec3& p : polytope.positions) points_.push_back(frame_.to_local(p));
  for (const Vec3& p : points_) x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
}

double Target::greatest_product(const Vec3& normal, std::vector<double>& products) const {
  const std::size_t count = points_.size();
  products.resize(count);
  for (std::size_t i = 0; i < count; ++i) products[i] = normal.x * x_[i] + normal.y * y_[i] + normal.z * z_[i];
  // Four at a time: a single chain of comparisons would wait for each.
  std::array<double, 4> most;
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) most[k] = products[i + k] > most[k] ? products[i + k] : most[k];
  for (std::size_t i = count / 4 * 4; i < count; ++i) most[0] = std::max(most[0], products[i]);
  return std::max({most[0], most[1], most[2], most[3]});
}

std::optional<TriangleMesh> scaled_around(TriangleMesh polytope, const Target& target) {
  double scale = 0;
  std::vector<double> products;
  for (const FaceId f : polytope.triangles.ids()) {
    const Triangle t = polytope.triangle(f);
    const Vec3 normal = unit_normal(t);
    const double offset = dot(normal, t.a);
    if (!(offset > 0)) return std::nullopt;
    scale = std::max(scale, (target.greatest_product(normal, products) + target.allowance(normal)) / offset);
  }
  if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
  for (Vec3& p : polytope.positions) p = p * scale;
  return polytope;
}

TriangleMesh tightened(TriangleMesh polytope, const Target& target) {
  return Tightening(target).run(std::move(polytope));
}

}  // namespace prohull::cover
