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
        hull_(std::move(hull)) {
    options_.target_faces = hull_.face_count();
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
      failures = keep_if_better(trial_hull()) ? 0 : failures + 1;
    }
    meter_.at(1);
    return std::move(hull_);
  }

 private:
  static constexpr double kLeastGain = 1e-9;  ///< of the volume

  TriangleMesh trial_hull() {
    TriangleMesh hull = hull_;
    for (std::size_t left = 1 + below(env("NEWV", 2)); left > 0; --left) insert_vertex(hull);
    HalfEdgeMesh mesh(hull);
    const std::size_t vertices = mesh.positions().size();
    Contacts contacts(vertices);
    collapse_tightly(mesh, original_, options_, contacts);
    tighten_from(vertices, mesh, contacts);
    return mesh.triangle_mesh();
  }

  /// On any edge; and moves it to where it removes most.
  void insert_vertex(TriangleMesh& hull) {
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
    HalfEdgeMesh grown(hull);
    Contacts contacts(grown.positions().size());
    tighten_from(index(s), grown, contacts);
    hull = grown.triangle_mesh();
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

  bool keep_if_better(TriangleMesh hull) {
    const double volume = signed_volume(hull);
    if (!(volume < volume_ - kLeastGain * std::abs(volume_)) || hull.face_count() > options_.target_faces) return false;
    if (!contains(allowed_, bounding_box(hull))) return false;
    volume_ = volume;
    hull_ = std::move(hull);
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
  TriangleMesh hull_;
};

TriangleMesh searched(TriangleMesh hull, const Original& original, const HullOptions& options, std::size_t trials) {
  return Search(std::move(hull), original, options).run(trials);
}

class SeveralStarts {
 public:
  SeveralStarts(const Original& original, const TriangleMesh& mesh, const HullOptions& options, const BuildTight& build)
      : original_(original),
        options_(options),
        build_(build),
        meter_(options.progress, "tighten"),
        is_inner_(options.side == HullSide::Inner),
        coarse_mesh_(build_hull(mesh, coarse_options(0, 0.05)).hull.base()),
        coarse_(Original::closed(turned_if_inner(coarse_mesh_), options.side)) {
    options_.guards.max_overhang =
        overhang_left(bounding_box(coarse_mesh_), bounding_box(mesh), options.guards.max_overhang);
  }

  /// The hulls are turned inside out if they are inner ones.
  TriangleMesh run(TriangleMesh best) {
    const HullOptions last = part(0.8, 1);
    const TriangleMesh found = tightened(searched(best_start(), coarse_, part(0.6, 0.8), env("T2", 300)), original_, last);
    if (std::getenv("V")) std::fprintf(stderr, "plain %g found %g, ", signed_volume(best) / signed_volume(original_.mesh()) - 1, signed_volume(found) / signed_volume(original_.mesh()) - 1);
    if (found.face_count() <= best.face_count() && signed_volume(found) < signed_volume(best)) best = found;
    best = searched(std::move(best), original_, last, env("T3", 60));
    if (std::getenv("V")) std::fprintf(stderr, "last %g\n", signed_volume(best) / signed_volume(original_.mesh()) - 1);
    return best;
  }

 private:
  TriangleMesh turned_if_inner(const TriangleMesh& mesh) const { return is_inner_ ? turned(mesh) : mesh; }

  HullOptions part(double from, double to) {
    HullOptions one = options_;
    one.progress = meter_.part(from, to);
    return one;
  }

  HullOptions coarse_options(double from, double to) {
    HullOptions one = part(from, to);
    one.target_faces = env("COARSE", 3000);
    one.self_intersections = SelfIntersections::Refused;
    return one;
  }

  TriangleMesh best_start() {
    const TriangleMesh convex = is_inner_ ? TriangleMesh{} : convex_hull(coarse_mesh_);
    std::vector<TriangleMesh> found;
    const unsigned starts = env("STARTS", 4);
    for (unsigned i = 0; i <= starts; ++i) {
      const TriangleMesh& from = i == starts ? convex : coarse_mesh_;
      if (from.face_count() == 0) continue;
      const auto at = [&](double step) { return 0.05 + 0.55 * (i + step) / (starts + 1); };
      HullOptions one = part(at(0), at(0.3));
      one.seed = one.seed * starts + i % starts;
      TriangleMesh start = turned_if_inner(build_(coarse_, from, one));
      const double before = signed_volume(start);
      found.push_back(searched(std::move(start), coarse_, part(at(0.3), at(1)), env("T1", 120)));
      if (std::getenv("V")) std::fprintf(stderr, "start %u: %g -> %g, ", i, before / signed_volume(original_.mesh()) - 1, signed_volume(found.back()) / signed_volume(original_.mesh()) - 1);
    }
    return *std::ranges::min_element(found, {}, [&](const TriangleMesh& hull) {
      return std::pair(std::max(hull.face_count(), options_.target_faces), signed_volume(hull));
    });
  }

  static TriangleMesh tightened(const TriangleMesh& hull, const Original& original, const HullOptions& options) {
    HalfEdgeMesh mesh(hull);
    tighten(
        mesh, original,
        {.guards = options.guards, .float32_coordinates = options.float32_coordinates, .progress = options.progress});
    return mesh.triangle_mesh();
  }

  const Original& original_;
  HullOptions options_;
  const BuildTight& build_;
  ProgressMeter meter_;
  const bool is_inner_;
  const TriangleMesh coarse_mesh_;
  const Original coarse_;
};

}  // namespace

TriangleMesh with_less_volume(const TriangleMesh& tight, const Original& original, const TriangleMesh& mesh,
                              const HullOptions& options, const BuildTight& build) {
  const bool is_inner = options.side == HullSide::Inner;
  TriangleMesh best = is_inner ? turned(tight) : tight;
  constexpr std::size_t kTrialsOfTriangles = 200;
  best = original.is_closed() ? SeveralStarts(original, mesh, options, build).run(std::move(best))
                              : searched(std::move(best), original, options, kTrialsOfTriangles);
  return is_inner ? turned(best) : best;
}

}  // namespace prohull
