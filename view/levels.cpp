#include "view/levels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "view/heat.h"

namespace prohull::view {
namespace {

using Corner = std::uint32_t;  // 3 face + corner; faces in the order in which they come

Corner following(Corner c) { return c % 3 == 2 ? c - 2 : c + 1; }
Corner preceding(Corner c) { return c % 3 == 0 ? c + 2 : c - 1; }

}  // namespace

/// The faces as they are now, and for each vertex a list of its corners.
class Replay {
 public:
  explicit Replay(const ProgressiveHull& hull) : hull_(hull), corners_of_(hull.positions().size()) {
    const std::vector<VertexId>& base = hull.base_corners();
    for (std::size_t c = 0; c < base.size(); c += 3)
      if (base[c] != ProgressiveHull::kAbsent) add({base[c], base[c + 1], base[c + 2]});
  }

  const std::vector<VertexId>& vertices() const { return vertices_; }  ///< of all corners

  void append_faces_around(VertexId v, PerFace<std::array<VertexId, 3>>& faces) const {
    for (const Corner c : corners_of_[v])
      faces.push_back({vertices_[c], vertices_[following(c)], vertices_[preceding(c)]});
  }

  /// Six times the signed volume between the faces around a vertex and `center`.
  double volume_around(VertexId v, const Vec3& center) const {
    double sum = 0;
    for (const Corner c : corners_of_[v]) sum += volume_at(c, center);
    return sum;
  }
  /// Six times the signed volume between the two faces that came last and `center`.
  double volume_of_newest(const Vec3& center) const {
    const Corner end = static_cast<Corner>(vertices_.size());
    return volume_at(end - 6, center) + volume_at(end - 3, center);
  }

  /// Makes the split of s. Returns for each corner of s whether d gets it.
  std::vector<bool> split(VertexId s, const VertexSplit& record) {
    const std::vector<Corner> star = std::exchange(corners_of_[s], {});
    const std::vector<bool> moves = goes_to_d(star, record);
    for (std::size_t i = 0; i < star.size(); ++i) {
      const VertexId v = moves[i] ? record.d : record.o;
      vertices_[star[i]] = v;
      corners_of_[v].push_back(star[i]);
    }
    add(turned({record.o, record.d, record.l}, record.od));
    add(turned({record.d, record.o, record.r}, record.do_));
    return moves;
  }

 private:
  /// The face whose first vertex stands at this corner.
  static std::array<VertexId, 3> turned(std::array<VertexId, 3> face, std::uint32_t corner) {
    std::rotate(face.begin(), face.begin() + (3 - corner % 3) % 3, face.end());
    return face;
  }

  void add(const std::array<VertexId, 3>& face) {
    for (const VertexId v : face) {
      corners_of_[v].push_back(static_cast<Corner>(vertices_.size()));
      vertices_.push_back(v);
    }
  }

  double volume_at(Corner c, const Vec3& center) const {
    const auto at = [&](Corner corner) { return hull_.positions()[vertices_[corner]] - center; };
    return dot(at(c), cross(at(following(c)), at(preceding(c))));
  }

  /// Counter-clockwise, the faces from l to r stay with o.
  std::vector<bool> goes_to_d(const std::vector<Corner>& star, const VertexSplit& record) const {
    std::vector<bool> moves(star.size(), true);
    for (VertexId at = record.l; at != record.r;) {
      const auto next = std::ranges::find(star, at, [&](Corner c) { return vertices_[following(c)]; }) - star.begin();
      moves[static_cast<std::size_t>(next)] = false;
      at = vertices_[preceding(star[static_cast<std::size_t>(next)])];
    }
    return moves;
  }

  const ProgressiveHull& hull_;
  std::vector<VertexId> vertices_;
  PerVertex<std::vector<Corner>> corners_of_;
};

namespace {

/// Calls `see(made vertex, split)` from the base mesh to the original.
template <class See>
void each_split(const ProgressiveHull& hull, See see) {
  for (std::size_t i = hull.splits().size(); i-- > 0;) see(hull.made_vertex(i), hull.splits()[i]);
}

/// The numbers that a page gives vertices: base vertices in ascending order, then as they come. o keeps that of s.
class Slots {
 public:
  explicit Slots(const ProgressiveHull& hull) : slots_(hull.positions().size(), kNone) {
    for (const VertexId v : hull.base_corners())
      if (v != ProgressiveHull::kAbsent) slots_[v] = 0;
    for (const VertexId v : slots_.ids())
      if (slots_[v] != kNone) slots_[v] = add(v);
  }

  const std::vector<VertexId>& base() const { return base_; }
  std::uint32_t operator[](VertexId v) const { return slots_[v]; }
  void split(VertexId s, const VertexSplit& record) {
    slots_[record.o] = slots_[s];
    slots_[record.d] = count_++;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t add(VertexId v) {
    base_.push_back(v);
    return count_++;
  }

  PerVertex<std::uint32_t> slots_;
  std::vector<VertexId> base_;
  std::uint32_t count_ = 0;
};

}  // namespace

nlohmann::json levels_facts(const ProgressiveHull& hull, const PerVertex<double>& distances, const Grid& grid,
                            Blocks& blocks) {
  Replay replay(hull);
  Slots slots(hull);
  const double greatest = distances.empty() ? 0 : *std::ranges::max_element(distances);
  std::vector<std::uint32_t> positions, triangles, heat;
  for (const VertexId v : slots.base()) {
    for (const std::uint32_t q : grid(hull.positions()[v])) positions.push_back(q);
    heat.push_back(scaled(distances[v], greatest));
  }
  for (const VertexId v : replay.vertices()) triangles.push_back(slots[v]);

  std::vector<std::uint32_t> split_slots, turns, bits, split_heat;
  std::vector<std::int32_t> moves;
  std::size_t bit = 0;
  each_split(hull, [&](VertexId s, const VertexSplit& record) {
    split_slots.push_back(slots[s]);
    turns.push_back(record.od % 3 + 3 * (record.do_ % 3));
    slots.split(s, record);
    const auto from = grid(hull.positions()[s]);
    for (const VertexId v : {record.o, record.d}) {
      const auto to = grid(hull.positions()[v]);
      for (std::size_t k = 0; k < 3; ++k) moves.push_back(static_cast<std::int32_t>(to[k] - from[k]));
      split_heat.push_back(scaled(distances[v], greatest));
    }
    for (const bool goes : replay.split(s, record)) {
      if (bit % 8 == 0) bits.push_back(0);
      bits.back() |= std::uint32_t{goes} << bit % 8;
      ++bit;
    }
  });
  return {{"positions", blocks.running(positions, 3)},
          {"triangles", blocks.running(triangles, 1)},
          {"heat", blocks.running(heat, 1)},
          {"heat_max", greatest},
          {"splits", split_slots.size()},
          {"split_vertices", blocks.plain(split_slots)},
          {"split_moves", blocks.differences(moves)},
          {"split_heat", blocks.plain(split_heat)},
          {"split_turns", blocks.plain(turns)},
          {"split_bits", blocks.plain(bits)}};
}

MadeFaces::MadeFaces(const ProgressiveHull& hull) : hull_(hull), replay_(std::make_unique<Replay>(hull)) {}
MadeFaces::~MadeFaces() = default;

TriangleMesh MadeFaces::until(std::size_t splits) {
  TriangleMesh faces{hull_.positions(), {}};
  for (; made_ < splits; ++made_) {
    const std::size_t i = hull_.splits().size() - 1 - made_;
    const VertexSplit& record = hull_.splits()[i];
    replay_->split(hull_.made_vertex(i), record);
    for (const VertexId v : {record.o, record.d}) replay_->append_faces_around(v, faces.triangles);
  }
  return faces;
}

std::vector<double> volumes_of_levels(const ProgressiveHull& hull) {
  Replay replay(hull);
  const TriangleMesh base = hull.base();
  const Vec3 center = bounding_box(base).center();
  double six_volumes = 6 * signed_volume(base);
  std::vector<double> volumes{six_volumes / 6};
  each_split(hull, [&](VertexId s, const VertexSplit& record) {
    six_volumes -= replay.volume_around(s, center);
    replay.split(s, record);
    six_volumes += replay.volume_around(record.o, center) + replay.volume_around(record.d, center);
    six_volumes -= replay.volume_of_newest(center);  // its two faces are around both
    volumes.push_back(six_volumes / 6);
  });
  return volumes;
}

}  // namespace prohull::view
