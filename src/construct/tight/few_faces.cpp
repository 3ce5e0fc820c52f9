#include "construct/tight/few_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "construct/placement.h"
#include "construct/tight/contacts.h"
#include "construct/tight/tight_collapses.h"
#include "construct/tight/tightening.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "geometry/triangle_intersection.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

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

std::size_t intersecting_pairs(const TriangleMesh& mesh) {
  std::vector<Triangle> faces;
  std::vector<Box> boxes;
  for (const FaceId f : mesh.triangles.ids()) {
    faces.push_back(mesh.triangle(f));
    boxes.push_back(box_of(faces.back()));
  }
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs += boxes[i].overlaps(boxes[j]) && triangles_intersect(faces[i], faces[j]);
  return pairs;
}

/// Where vertices may be: not farther outside of the original than the guards allow, or than the hull is.
Box allowed_box(const TriangleMesh& hull, const Original& original, const ShapeGuards& guards) {
  Box box = original.allowed(guards.max_overhang);
  box.extend(bounding_box(hull));
  return box;
}

struct Hull {
  TriangleMesh mesh;
  Contacts contacts;
  double volume;
};

class Search {
 public:
  Search(const TriangleMesh& hull, const Original& original, const HullOptions& options)
      : original_(original),
        options_(options),
        moves_{.guards = options.guards, .float32_coordinates = options.float32_coordinates, .threads = 1},
        random_(options.seed),
        meter_(options.progress, "tighten"),
        rounding_(storage_rounding(original.bounds(), options.float32_coordinates)),
        intersecting_pairs_(intersecting_pairs(hull)),
        allowed_(allowed_box(hull, original, options.guards)),
        hull_{hull, Contacts(hull.positions.size()), signed_volume(hull)},
        best_(hull_),
        first_volume_(hull_.volume),
        most_gain_(original.clearance() > 0 ? 0 : first_volume_ - signed_volume(original.mesh())) {
    options_.threads = 1;
    // A trial only asks whether to go on: how much is done is known here.
    options_.progress = moves_.progress = [this](std::string_view, double) {
      meter_.go_on();
      return true;
    };
  }

  TriangleMesh run(const std::size_t trials) {
    std::size_t all = trials;
    for (std::size_t i = 0; i < all; ++i) {
      meter_.at(i, all);
      const double left = 1 - double(i) / double(all);
      keep_if_good(trial(), kMostLoss * left * left);
      all = trials + more_trials(trials);
    }
    meter_.at(1);
    return best_.mesh;
  }

 private:
  static constexpr double kMostLoss = 3e-3;  ///< of the volume, that a trial may cost; nothing at the end

  // Where the search gains much of the void, it goes on. Of 27 closed meshes of robots, with all that intersect
  // themselves, the void at 100 faces was 1.8, 4.6 and 5.3 % less with 2, 4 and 8 times the share that is gained than
  // with 0, for 8, 13 and 30 % more time. With 4, one part took 12.1 times as long as without tight; with 3, 10.7.
  std::size_t more_trials(std::size_t trials) const {
    constexpr double kTimesShare = 3;
    if (!(most_gain_ > 0)) return 0;
    const double share = std::clamp((first_volume_ - best_.volume) / most_gain_, 0.0, 1.0);
    return std::min(std::size_t(kTimesShare * share * double(trials)), options_.tight_trials - trials);
  }

  // What the collapses add is mostly less than what the new vertices gain. A trial that is far behind by then is given
  // up.
  Hull trial() {
    constexpr double kHopeless = 1.03;
    constexpr unsigned kRounds = 2;
    Hull result = hull_;
    const std::size_t before = result.mesh.positions.size();
    for (std::size_t left = 1 + below(most_new_vertices()); left > 0; --left) insert_vertex(result);
    HalfEdgeMesh mesh(result.mesh);
    tighten_from(before, mesh, result.contacts, kRounds);
    const std::size_t grown = mesh.positions().size();
    collapse_tightly(mesh, original_, options_, result.contacts);
    if (signed_volume(mesh.triangle_mesh()) < hull_.volume + (kHopeless - 1) * std::abs(hull_.volume))
      tighten_from(grown, mesh, result.contacts, MoveOptions{}.max_rounds);
    result = {mesh.triangle_mesh(), result.contacts.renumbered(mesh), 0};
    result.volume = signed_volume(result.mesh);
    return result;
  }

  std::size_t most_new_vertices() const {
    constexpr std::size_t kLeast = 4, kMost = 12;
    return std::clamp(options_.target_faces / 4, kLeast, kMost);
  }

  /// On any edge, but of a component of two faces, which would meet in more edges than one then.
  void insert_vertex(Hull& hull) {
    TriangleMesh& mesh = hull.mesh;
    const HalfEdgeMesh edges(mesh);
    const HalfEdgeId h{static_cast<std::uint32_t>(below(3 * mesh.face_count()))}, g = edges.twin(h);
    const VertexId a = edges.tail(h), b = edges.tail(g);
    const VertexId l = edges.tail(edges.previous(h)), r = edges.tail(edges.previous(g));
    if (l == r) return;
    const auto position = outside_of_edge(mesh.positions[a], mesh.positions[b], mesh.positions[l], mesh.positions[r],
                                          rounding_, options_.float32_coordinates);
    if (!position) return;
    const VertexId s = mesh.positions.push_back(*position);
    hull.contacts.join(a, b);
    mesh.triangles[FaceId{index(h) / 3}] = {a, s, l};
    mesh.triangles[FaceId{index(g) / 3}] = {b, s, r};
    mesh.triangles.push_back({s, b, l});
    mesh.triangles.push_back({s, a, r});
  }

  /// Around the vertices that are new.
  void tighten_from(std::size_t first, HalfEdgeMesh& mesh, Contacts& contacts, unsigned max_rounds) {
    std::vector<VertexId> changed;
    for (const VertexId v : mesh.positions().ids()) {
      if (index(v) < first || !mesh.has(v)) continue;
      changed.push_back(v);
      for (const HalfEdgeId h : mesh.around(v)) changed.push_back(mesh.tip(h));
    }
    moves_.max_rounds = max_rounds;
    tighten_around(changed, mesh, original_, moves_, contacts);
  }

  void keep_if_good(Hull hull, double most_loss) {
    if (!is_better(hull, hull_, most_loss * std::abs(hull_.volume))) return;
    const Box box = bounding_box(hull.mesh);
    if (!allowed_.contains(box.min) || !allowed_.contains(box.max)) return;
    if (intersecting_pairs(hull.mesh) > intersecting_pairs_) return;
    hull_ = std::move(hull);
    if (is_better(hull_, best_, 0)) best_ = hull_;
  }

  bool is_better(const Hull& hull, const Hull& than, double most_loss) const {
    const auto excess = [&](const Hull& h) { return std::max(h.mesh.face_count(), options_.target_faces); };
    if (excess(hull) != excess(than)) return excess(hull) < excess(than);
    return hull.volume < than.volume + most_loss;
  }

  std::size_t below(std::size_t count) { return random_() % count; }

  const Original& original_;
  HullOptions options_;
  MoveOptions moves_;
  std::mt19937_64 random_;
  ProgressMeter meter_;
  const double rounding_;
  const std::size_t intersecting_pairs_;
  const Box allowed_;
  Hull hull_, best_;
  const double first_volume_, most_gain_;  ///< the void; 0 at triangles that are not closed, which have no volume
};

// A trial at a closed mesh takes time with the faces of the hull, about 2 ms with 100, and at triangles 10 to 40 ms. Of
// 63 meshes of robots, `build --tight --faces 100` takes 2.6 times as long as without in the median, and 10.5 times at
// most. Without the most, the horse at 200 faces took 5.2 s in place of 2.5, for 0.5 % less volume.
std::size_t affordable_trials(std::size_t most, const Original& original, std::size_t target_faces) {
  constexpr std::size_t kFewestFaces = 48, kLeast = 8, kMost = 200, kAtTriangles = 32;
  if (original.clearance() > 0) return std::min(most, kAtTriangles);
  const std::size_t affordable = original.mesh().face_count() / std::max(target_faces, kFewestFaces);
  return std::min(most, std::clamp(affordable, kLeast, kMost));
}

/// Whether the hull has the faces asked for and no void but what rounding is: nothing is left to gain. A volume that
/// counts overlaps of the original twice is greater, and so not near.
bool is_tightest(const TriangleMesh& hull, const TriangleMesh& original, std::size_t target_faces) {
  constexpr double kRounding = 1e-12;
  const double volume = signed_volume(original);
  return hull.face_count() <= target_faces && std::abs(signed_volume(hull) - volume) <= kRounding * std::abs(volume);
}

}  // namespace

TriangleMesh with_less_volume(const TriangleMesh& hull, const Original& original, const HullOptions& options) {
  if (is_tightest(hull, original.mesh(), options.target_faces)) return hull;
  return Search(hull, original, options).run(affordable_trials(options.tight_trials, original, options.target_faces));
}

}  // namespace prohull
