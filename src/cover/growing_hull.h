#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "prohull/geometry.h"

namespace prohull::cover {

/// The convex hull of points that are added, in floating point: for the volumes by which cuts are compared.
/// Nothing depends on its exactness. Coordinates should be of the order of 1. Of the points that are added together,
/// the farthest come first, and the others are looked for only beyond the faces that they see (Barber, Dobkin,
/// Huhdanpaa 1996, The quickhull algorithm): so few faces are made that are not of the hull.
class GrowingHull {
 public:
  void clear();
  /// Points that lie within a millionth of the hull are left out.
  void add(std::span<const Vec3> points);
  /// 0 until there are four points that are not in a plane.
  double volume() const { return started_ ? sixfold_volume_ / 6 : 0; }

 private:
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> beyond;  ///< the face beyond the edge from corner i to corner i + 1
    std::uint32_t farthest;               ///< of the waiting points that are kept with it, or none
    double sixfold_volume;                ///< of the tetrahedron with the origin
  };

  /// A point outside, kept with a face that sees it. Those of a face form a list that begins with the farthest.
  struct Waiting {
    Vec3 point;
    double height;
    std::uint32_t next;
  };

  /// Of the horizon: from a to b, and the face beyond it.
  struct Edge {
    std::uint32_t a, b, beyond;
  };

  /// In [-1, 1], the same sequence for every hull.
  struct Random {
    double operator()() {
      state = state * 6364136223846793005u + 1442695040888963407u;
      return static_cast<double>(static_cast<std::int64_t>(state)) * 0x1p-63;
    }
    std::uint64_t state = 1;
  };

  Vec3 shifted(const Vec3& p);
  bool start();
  void insert(std::span<const Vec3> points);
  void keep_where_seen(std::uint32_t waiting);
  void keep_where_fan_sees(std::uint32_t waiting);
  void keep(std::uint32_t waiting, std::uint32_t face, double height);
  void insert_farthest(std::uint32_t face);
  void collect_beyond_visible();
  void find_visible(const Vec3& p, std::uint32_t first);
  bool find_horizon();
  void add_fan();
  std::uint32_t new_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void remove_face(std::uint32_t f);
  double height(std::uint32_t f, const Vec3& p) const {
    return normal_x_[f] * p.x + normal_y_[f] * p.y + normal_z_[f] * p.z - offset_[f];
  }

  bool started_ = false;
  double sixfold_volume_ = 0;
  Vec3 origin_;
  std::vector<Vec3> points_;  // those that are, or were, vertices; all points until it has started
  std::vector<Face> faces_;
  std::vector<double> normal_x_, normal_y_, normal_z_, offset_;  // free faces see no point
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> visible_, fan_;
  std::vector<Edge> horizon_;
  std::vector<Waiting> waiting_;
  std::vector<std::uint32_t> crowded_;  // faces that may have waiting points
  std::vector<std::uint32_t> orphans_;  // waiting points whose face is gone
  std::vector<std::uint32_t> seen_;     // by face: the last point that saw it
  std::vector<std::uint32_t> next_at_;  // by point: the face of the fan whose edge begins there
  std::uint32_t stamp_ = 0;
  Random random_;
};

}  // namespace prohull::cover
