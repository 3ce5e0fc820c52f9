#include "construct/tight/few_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "construct/best_of.h"
#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/tight/tight_collapses.h"
#include "construct/tight/tightening.h"
#include "construct/turned.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "mesh/half_edge_mesh.h"
#include "parallel/progress_meter.h"
#include "prohull/convex_hull.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

long env(const char* n, long d) { const char* s = std::getenv(n); return s ? std::atol(s) : d; }

bool contains(const Box& box, const Box& other) {
  for (int axis = 0; axis < 3; ++axis)
    if (other.min[axis] < box.min[axis] || other.max[axis] > box.max[axis]) return false;
  return true;
}

/// In the middle of the edge a-b, or a hair outside: never inside of the faces (a, b, l) and (b, a, r), exactly. Such a
/// vertex takes nothing from what the hull encloses.
std::optional<Vec3> outside_of_edge(const Vec3& a, const Vec3& b, const Vec3& l, const Vec3& r, double rounding,
                                    bool float32_coordinates) {
  const Vec3 middle = a * 0.5 + b * 0.5;
  const auto unit = [](const Vec3& v) { return norm(v) > 0 ? v / norm(v) : Vec3{}; };
  const Vec3 away = unit(unit(cross(b - a, l - a)) + unit(cross(a - b, r - b)));
  for (const double roundings : {0.0, 2.0, 16.0, 128.0}) {
    const Vec3 exact = middle + away * (roundings * rounding);
    const Vec3 p = float32_coordinates ? nearest_float32(exact) : exact;
    if (is_finite(p) && side(a, b, l, p) != Side::Inside && side(b, a, r, p) != Side::Inside) return p;
  }
  return std::nullopt;
}

class Search {
 public:
  Search(TriangleMesh hull, const Original& original, const HullOptions& options)
      : original_(original),
        options_(options),
        moves_{.guards = options.guards, .float32_coordinates = options.float32_coordinates, .threads = 1},
        random_(options.seed),
        meter_(options.progress, "tighten"),
        rounding_(storage_rounding(original.bounds(), options.float32_coordinates)),
        allowed_(bounding_box(hull)),
        volume_(signed_volume(hull)),
        least_(volume_),
        now_{std::move(hull), Contacts(0)}, best_(now_) {
    now_.contacts = Contacts(now_.hull.positions.size());
    options_.target_faces = now_.hull.face_count();
    options_.threads = 1;
    // Trials ask whether to go on; how much is done only this search can say.
    options_.progress = moves_.progress = [this](std::string_view, double) {
      meter_.go_on();
      return true;
    };
    const Box& bounds = original.bounds();
    const double overhang = options.guards.max_overhang * bounds.diagonal();
    const Vec3 reach{overhang, overhang, overhang};
    allowed_.extend(bounds.min - reach);
    allowed_.extend(bounds.max + reach);
  }

  TriangleMesh run(std::size_t trials) {
    std::size_t failures = 0;
    const std::size_t patience = env("PAT", 150);
    for (std::size_t trial = 0; trial < trials && failures < patience; ++trial) {
      meter_.at(trial, trials);
      const double left = 1 - double(trial) / double(trials);
      slack_ = env("TEMP", 0) * 1e-5 * left * left;
      failures = keep_if_better(trial_hull()) ? 0 : failures + 1;
    }
    now_ = best_;
    meter_.at(1);
    return std::move(now_.hull);
  }

 private:
  static constexpr double kLeastGain = 1e-9;  ///< of the volume

  struct State {
    TriangleMesh hull;
    Contacts contacts;
  };

  State trial_hull() {
    State trial = now_;
    const std::size_t before = trial.hull.positions.size();
    for (std::size_t left = 1 + below(env("NEWV", 2)); left > 0; --left) insert_vertex(trial);
    HalfEdgeMesh mesh(trial.hull);
    moves_.max_rounds = env("R1", 2);
    tighten_from(before, mesh, trial.contacts);
    const std::size_t vertices = mesh.positions().size();
    moves_.max_rounds = env("R2", 12);
    const double slack = 1 + 1e-3 * env("ABORT", 100000);
    collapse_tightly(mesh, original_, options_, trial.contacts);
    if (signed_volume(mesh.triangle_mesh()) <= volume_ * slack) tighten_from(vertices, mesh, trial.contacts);
    return {mesh.triangle_mesh(), trial.contacts.renumbered(mesh)};
  }

  /// On any edge; and moves it to where it removes most.
  void insert_vertex(State& state) {
    TriangleMesh& hull = state.hull;
    const FaceId f{static_cast<std::uint32_t>(below(hull.face_count()))};
    const HalfEdgeMesh mesh(hull);
    const HalfEdgeId h{static_cast<std::uint32_t>(3 * index(f) + below(3))}, g = mesh.twin(h);
    const VertexId a = mesh.tail(h), b = mesh.tail(g);
    const VertexId l = mesh.tail(mesh.previous(h)), r = mesh.tail(mesh.previous(g));
    const auto position = outside_of_edge(mesh.position(a), mesh.position(b), mesh.position(l), mesh.position(r),
                                          rounding_, options_.float32_coordinates);
    if (!position) return;
    const VertexId s = hull.positions.push_back(*position);
    hull.triangles[f] = {a, s, l};
    hull.triangles[FaceId{index(g) / 3}] = {b, s, r};
    hull.triangles.push_back({s, b, l});
    hull.triangles.push_back({s, a, r});
    state.contacts.join(a, b);
  }

  /// Around the vertices that are new.
  void tighten_from(std::size_t first, HalfEdgeMesh& mesh, Contacts& contacts) const {
    std::vector<VertexId> changed;
    for (const VertexId v : mesh.positions().ids()) {
      if (index(v) < first || !mesh.has(v)) continue;
      changed.push_back(v);
      for (const HalfEdgeId h : mesh.around(v)) changed.push_back(mesh.tip(h));
    }
    tighten_around(changed, mesh, original_, moves_, contacts);
  }

  bool keep_if_better(State trial) {
    const TriangleMesh& hull = trial.hull;
    const double volume = signed_volume(hull);
    if (!(volume < volume_ + (slack_ - kLeastGain) * std::abs(volume_)) || hull.face_count() > options_.target_faces) return false;
    if (!contains(allowed_, bounding_box(hull))) return false;
    volume_ = volume;
    now_ = std::move(trial);
    if (volume < least_) best_ = now_, least_ = volume;
    return true;
  }

  std::size_t below(std::size_t count) { return random_() % count; }

  const Original& original_;
  HullOptions options_;
  MoveOptions moves_;
  std::mt19937_64 random_;
  ProgressMeter meter_;
  const double rounding_;
  Box allowed_;  ///< where vertices may be
  double volume_;
  double least_, slack_ = 0;
  State now_, best_;
};

TriangleMesh searched(TriangleMesh hull, const Original& original, const HullOptions& options, std::size_t trials) {
  return Search(std::move(hull), original, options).run(trials);
}

TriangleMesh tightened(const TriangleMesh& hull, const Original& original, const HullOptions& options) {
  HalfEdgeMesh mesh(hull);
  tighten(mesh, original,
          {.guards = options.guards,
           .float32_coordinates = options.float32_coordinates,
           .threads = options.threads,
           .progress = options.progress});
  return mesh.triangle_mesh();
}

}  // namespace

TriangleMesh with_less_volume(TriangleMesh tight, const Original& original, const TriangleMesh& coarse_mesh,
                              const HullOptions& options) {
  ProgressMeter meter(options.progress, "tighten");
  const auto part = [&](double from, double to) {
    HullOptions one = options;
    one.side = HullSide::Outer;
    one.progress = meter.part(from, to);
    return one;
  };
  const std::size_t trials = env("T2", 1000);
  if (original.is_closed() && coarse_mesh.face_count() > 0 && !env("ORIG", 0)) {
    const Original coarse = Original::closed(coarse_mesh, options.side);
    HullOptions several = part(0, 0.7);
    several.best_of = env("STARTS", 2);
    several.seed *= several.best_of;
    const TriangleMesh start = tight;
    TriangleMesh found = best_of(
        several, "tighten", [&](const HullOptions& one) { return searched(start, coarse, one, trials); },
        [](const TriangleMesh& mesh) -> const TriangleMesh& { return mesh; });
    found = tightened(found, original, part(0.7, 0.75));
    if (signed_volume(found) < signed_volume(tight)) tight = found;
  }
  return searched(std::move(tight), original, part(0.75, 1), env("T3", 60));
}

}  // namespace prohull
