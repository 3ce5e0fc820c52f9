#include "enclose/offset_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/finite.h"
#include "repair/steps.h"

namespace prohull {
namespace {

constexpr double kJoined = 1e-2;  // of the distance: nearer vertices become one

/// Without faces that vanish, and with each vertex in place of those near to it. Faces agree about their sides, if they
/// can.
TriangleMesh with_joined_vertices(const TriangleMesh& mesh, double distance) {
  constexpr Vec3 kAlong{0.4, 0.52, 0.75};  // shorter than 1; few flat faces are at right angles to it
  const auto& at = mesh.positions;
  std::vector<std::pair<double, VertexId>> places;
  for (const VertexId v : at.ids()) places.emplace_back(dot(kAlong, at[v]), v);
  std::ranges::stable_sort(places, {}, [](const auto& place) { return place.first; });
  DisjointSets joined(mesh.vertex_count());
  for (auto a = places.begin(); a != places.end(); ++a)
    for (auto b = a + 1; b != places.end() && b->first - a->first <= distance; ++b)
      if (norm(at[b->second] - at[a->second]) <= distance)
        joined.join(std::uint32_t(a->second), std::uint32_t(b->second));
  TriangleMesh made{mesh.positions, {}};
  for (std::array<VertexId, 3> corners : mesh.triangles) {
    for (VertexId& v : corners) v = VertexId{joined.find(std::uint32_t(v))};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      made.triangles.push_back(corners);
  }
  Repairs repairs;
  drop_duplicate_faces(made, repairs);
  turn_single_faces(made, repairs);
  return made;
}

/// The shortest vector whose product with each direction is at least 1, about: that to the point of their convex hull
/// that is nearest to the origin (Gilbert's algorithm), divided by its squared length. At sharp vertices it is shorter,
/// so that it stays within a bound. None if no vector has positive products.
std::optional<Vec3> common_step(const std::vector<Vec3>& directions) {
  constexpr int kMostSteps = 200;
  constexpr double kLongest = 6;
  if (directions.empty()) return std::nullopt;
  Vec3 nearest = directions.front();
  const auto lowest = [&] {
    return *std::ranges::min_element(directions, {}, [&](const Vec3& d) { return dot(nearest, d); });
  };
  for (int i = 0; i < kMostSteps; ++i) {
    const Vec3 step = lowest() - nearest;
    const double gain = -dot(nearest, step);
    if (!(gain > 1e-9 * squared_norm(nearest))) break;
    nearest = nearest + step * std::min(1.0, gain / squared_norm(step));
  }
  const double least = dot(nearest, lowest());
  if (!(least > 0)) return std::nullopt;
  return nearest / std::max(least, norm(nearest) / kLongest);
}

class Offset {
 public:
  Offset(const TriangleMesh& mesh, double distance)
      : mesh_(mesh),
        distance_(distance),
        twins_(3 * mesh.face_count(), kNone),
        is_gone_(mesh.face_count()),
        fans_(3 * mesh.face_count()) {}

  std::optional<TriangleMesh> made() {
    if (mesh_.face_count() == 0 || !find_twins()) return std::nullopt;
    const bool is_closed = std::ranges::find(twins_, kNone) == twins_.end();
    if (!put_vertices(is_closed).empty()) return std::nullopt;
    put_faces(is_closed);
    return std::move(made_);
  }

  TriangleMesh sheets() {
    find_twins();
    for (Corner c = 0; c < corners(); ++c)
      if (twins_[c] != kNone && turns_far(c)) cut(c);
    for (auto stuck = put_vertices(false); !stuck.empty(); stuck = put_vertices(false)) make_room(stuck);
    put_faces(false);
    return std::move(made_);
  }

 private:
  using Corner = std::uint32_t;  // 3 f + i, and the half-edge that leaves it
  static constexpr Corner kNone = 0xFFFFFFFF;

  static Corner next(Corner c) { return c % 3 == 2 ? c - 2 : c + 1; }
  VertexId vertex(Corner c) const { return mesh_.triangles[FaceId{c / 3}][c % 3]; }
  const Vec3& at(Corner c) const { return mesh_.positions[vertex(c)]; }
  Corner corners() const { return static_cast<Corner>(twins_.size()); }

  /// False if half-edges have no single twin; these have none then.
  bool find_twins() {
    std::unordered_map<std::uint64_t, Corner> by_ends;
    const auto key = [](VertexId a, VertexId b) { return std::uint64_t(index(a)) << 32 | index(b); };
    bool is_single = true;
    for (Corner c = 0; c < corners(); ++c)
      if (const auto [known, is_new] = by_ends.emplace(key(vertex(c), vertex(next(c))), c); !is_new)
        known->second = kNone, is_single = false;
    const auto at_ends = [&](VertexId a, VertexId b) {
      const auto found = by_ends.find(key(a, b));
      return found == by_ends.end() ? kNone : found->second;
    };
    for (Corner c = 0; c < corners(); ++c)
      if (at_ends(vertex(c), vertex(next(c))) == c) twins_[c] = at_ends(vertex(next(c)), vertex(c));
    return is_single;
  }

  bool turns_far(Corner c) const {
    const auto here = normal(c), there = normal(twins_[c]);
    return !here || !there || dot(*here, *there) < 0;
  }

  void cut(Corner c) {
    if (const Corner twin = std::exchange(twins_[c], kNone); twin != kNone) twins_[twin] = kNone;
  }

  /// Cuts fans into single corners; a face with a single corner without room is left out.
  void make_room(const std::vector<Corner>& stuck) {
    std::vector<char> is_stuck(corners());
    for (const Corner fan : stuck) is_stuck[fan] = 1;
    for (Corner c = 0; c < corners(); ++c) {
      if (is_gone_[c / 3] || !is_stuck[fan_of(c)]) continue;
      const Corner last = next(next(c));
      is_gone_[c / 3] = twins_[c] == kNone && twins_[last] == kNone;
      if (is_gone_[c / 3]) cut(next(c));
      cut(c), cut(last);
    }
  }

  Corner fan_of(Corner c) { return fans_.find(c); }

  /// The corners of one vertex of the result are those joined by edges.
  void find_fans() {
    fans_ = DisjointSets(corners());
    for (Corner c = 0; c < corners(); ++c)
      if (twins_[c] != kNone) fans_.join(c, next(twins_[c]));
  }

  /// None of a needle: its plane means nothing.
  std::optional<Vec3> normal(Corner c) const {
    const Vec3 a = at(c), u = at(next(c)) - a, v = at(next(next(c))) - a, n = cross(u, v);
    const double longest = std::sqrt(std::max({squared_norm(u), squared_norm(v), squared_norm(u - v)}));
    if (!(norm(n) > kJoined * distance_ * longest)) return std::nullopt;
    return n / norm(n);
  }

  /// At a rim, also away from it. Returns the fans that have no room.
  std::vector<Corner> put_vertices(bool is_closed) {
    find_fans();
    made_ = {};
    std::vector<std::vector<Vec3>> up(corners()), away(corners());
    for (Corner c = 0; c < corners(); ++c) {
      const auto n = normal(c);
      if (!n || is_gone_[c / 3]) continue;
      up[fan_of(c)].push_back(*n);
      if (twins_[c] != kNone) continue;
      const Vec3 edge = at(next(c)) - at(c), outwards = cross(edge, *n);
      for (const Corner end : {c, next(c)}) away[fan_of(end)].push_back(outwards / norm(outwards));
    }
    top_.resize(corners()), bottom_.resize(corners());
    std::vector<Corner> stuck;
    for (Corner c = 0; c < corners(); ++c)
      if (fan_of(c) == c && !is_gone_[c / 3]) {
        std::vector<Vec3> directions = away[c];
        directions.insert(directions.end(), up[c].begin(), up[c].end());
        const bool has_top = put(c, directions, top_);
        for (std::size_t i = away[c].size(); i < directions.size(); ++i) directions[i] = -directions[i];
        if (!has_top || (!is_closed && !put(c, directions, bottom_))) stuck.push_back(c);
      }
    return stuck;
  }

  bool put(Corner c, const std::vector<Vec3>& directions, std::vector<VertexId>& where) {
    const auto step = common_step(directions);
    if (!step) return false;
    where[c] = VertexId(static_cast<std::uint32_t>(made_.vertex_count()));
    made_.positions.push_back(at(c) + *step * distance_);
    return true;
  }

  void put_faces(bool is_closed) {
    const auto top = [this](Corner c) { return top_[fan_of(c)]; };
    const auto bottom = [this](Corner c) { return bottom_[fan_of(c)]; };
    for (Corner c = 0; c < corners(); c += 3)
      if (!is_gone_[c / 3]) made_.triangles.push_back({top(c), top(c + 1), top(c + 2)});
    if (is_closed) return;
    for (Corner c = 0; c < corners(); c += 3)
      if (!is_gone_[c / 3]) made_.triangles.push_back({bottom(c), bottom(c + 2), bottom(c + 1)});
    for (Corner c = 0; c < corners(); ++c)
      if (const Corner n = next(c); twins_[c] == kNone && !is_gone_[c / 3]) {
        made_.triangles.push_back({top(n), top(c), bottom(c)});
        made_.triangles.push_back({top(n), bottom(c), bottom(n)});
      }
  }

  const TriangleMesh& mesh_;
  const double distance_;
  std::vector<Corner> twins_;  ///< the half-edges that go the other way; kNone at a rim
  std::vector<char> is_gone_;  ///< of faces
  DisjointSets fans_;
  std::vector<VertexId> top_, bottom_;  ///< of fans
  TriangleMesh made_;
};

}  // namespace

std::optional<TriangleMesh> offset_surface(const TriangleMesh& mesh, double distance) {
  const TriangleMesh joined = with_joined_vertices(mesh, kJoined * distance);
  return Offset(joined, distance).made();
}

TriangleMesh sheets_around(const TriangleMesh& triangles, double distance) {
  const TriangleMesh joined = with_joined_vertices(without_unused_vertices(triangles), kJoined * distance);
  return Offset(joined, distance).sheets();
}

}  // namespace prohull
