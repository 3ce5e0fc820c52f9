#include "verify/union_clipping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/triangle_intersection.h"
#include "geometry/triangle_predicates.h"
#include "geometry/vector_of.h"
#include "verify/cell.h"
#include "verify/winding.h"

// Points of the triangle are given by barycentric coordinates, up to a factor. There a plane is a line: its
// coefficients are the heights of the three corners above the plane. Every corner of a cell is the meeting point of two
// lines of the input, so that numbers do not grow. Intervals decide, and rational numbers where intervals do not.

namespace prohull::verify {
namespace {

template <class Field>
Field sum(const VectorOf<Field>& a) {
  return a[0] + a[1] + a[2];
}

/// Positive outside of the plane of h.
template <class Field>
Field height(const Triangle& h, const Vec3& p) {
  return dot(cross(between<Field>(h.a, h.b), between<Field>(h.a, h.c)), between<Field>(h.a, p));
}

/// Which side of a triangle the kernels should hold.
enum class Covering {
  Surface,  ///< the triangle itself
  Beyond,   ///< the points just outside of it
};

/// A plane as a line in the triangle t, positive outside.
class Line {
 public:
  Line(const Triangle& t, const Triangle& plane) : t_(&t), plane_(plane), is_edge_(false) {
    rough = coefficients<Interval>();
  }
  /// The side of t on which barycentric coordinate i is 0.
  explicit Line(int i) : is_edge_(true), edge_(i), rough(coefficients<Interval>()) {}

  const VectorOf<ExactNumber>& exact() const {
    if (!exact_) exact_ = coefficients<ExactNumber>();
    return *exact_;
  }

  template <class Field>
  VectorOf<Field> coefficients() const {
    if (is_edge_) return {Field(edge_ == 0 ? -1 : 0), Field(edge_ == 1 ? -1 : 0), Field(edge_ == 2 ? -1 : 0)};
    return {height<Field>(plane_, t_->a), height<Field>(plane_, t_->b), height<Field>(plane_, t_->c)};
  }

 private:
  const Triangle* t_ = nullptr;
  Triangle plane_;
  bool is_edge_;
  int edge_ = 0;
  mutable std::optional<VectorOf<ExactNumber>> exact_;

 public:
  VectorOf<Interval> rough;
};

constexpr double kWide = 1e-9;

using LineIndex = std::uint32_t;

/// Where two lines meet.
struct Corner {
  LineIndex first, second;
  VectorOf<Interval> rough;
  std::optional<int> weight_sign;  ///< of the sum of the coordinates, if it is certain
};

/// Convex, with an area: side i runs from corner i - 1 to corner i, along the first line of corner i and the second of
/// corner i - 1.
using Part = std::vector<Corner>;

class Clipper {
 public:
  Clipper(const Triangle& t, int axis) : t_(t), axis_(axis) {
    for (int i = 0; i < 3; ++i) lines_.emplace_back(i);
    parts_.push_back(part_of({0, 1, 2}));
  }

  void cut_off(const std::vector<const Kernel*>& kernels, Covering covering) {
    std::vector<std::vector<const Triangle*>> all;  // the planes of each kernel that cut t
    for (const Kernel* kernel : kernels) {
      auto planes = cutting_planes(*kernel, covering);
      if (planes) all.push_back(std::move(*planes));
    }
    // A kernel that holds all of t comes first, and then those that make few parts of it.
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (const auto& planes : all)
      if (!parts_.empty()) cut_off(planes);
  }

  bool is_empty() const { return parts_.empty(); }

  std::vector<Cell> cells() const {
    std::vector<Cell> result;
    for (const Part& part : parts_) result.push_back(whole(part));
    return result;
  }

  /// A cell within each of the cells, of points with short coordinates where that is possible.
  std::vector<Cell> inner_cells() const {
    std::vector<Cell> result;
    for (const Part& part : parts_) {
      auto within = short_cell(part);
      result.push_back(within ? std::move(*within) : whole(part));
    }
    return result;
  }

 private:
  /// Nothing if the kernel holds no part of t that has an area.
  std::optional<std::vector<const Triangle*>> cutting_planes(const Kernel& kernel, Covering covering) const {
    if (!kernel.is_solid() || !reaches(kernel, covering)) return std::nullopt;
    std::vector<const Triangle*> planes;
    for (const Triangle& plane : kernel.faces()) {
      const std::array<Side, 3> sides{side(plane, t_.a), side(plane, t_.b), side(plane, t_.c)};
      const auto count = [&](Side s) { return std::count(sides.begin(), sides.end(), s); };
      if (count(Side::On) == 3) {
        if (covering == Covering::Beyond && looks_the_same_way(plane)) return std::nullopt;
      } else if (count(Side::Inside) == 0) {
        return std::nullopt;
      } else if (count(Side::Outside) > 0) {
        planes.push_back(&plane);
      }
    }
    return planes;
  }

  /// False only if the piece lies on one side of the plane of t; if covering is Beyond, on the inner side.
  bool reaches(const Kernel& kernel, Covering covering) const {
    bool outside = false, inside = false;
    for (const Triangle& face : kernel.faces())
      for (const Vec3& p : {face.a, face.b, face.c}) {
        const Side s = side(t_, p);
        outside |= s != Side::Inside && (s == Side::Outside || covering == Covering::Surface);
        inside |= s != Side::Outside;
        if (outside && (inside || covering == Covering::Beyond)) return true;
      }
    return false;
  }

  void cut_off(const std::vector<const Triangle*>& planes) {
    std::vector<LineIndex> cutters;
    for (const Triangle* plane : planes) {
      cutters.push_back(static_cast<LineIndex>(lines_.size()));
      lines_.emplace_back(t_, *plane);
    }
    std::vector<Part> left;
    for (Part& part : parts_) add_outside(std::move(part), cutters, left);
    parts_ = std::move(left);
  }

  bool looks_the_same_way(const Triangle& plane) const {
    return turn(axis_, plane.a, plane.b, plane.c) == turn(axis_, t_.a, t_.b, t_.c);
  }

  Part part_of(const std::vector<LineIndex>& sides) const {
    Part part;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const LineIndex first = sides[i], second = sides[(i + 1) % sides.size()];
      const auto rough = cross(lines_[first].rough, lines_[second].rough);
      part.push_back({first, second, rough, certain_sign(sum(rough))});
    }
    return part;
  }

  /// 1 outside of the line, -1 inside, 0 on it. Exact.
  int side_of(const Corner& corner, LineIndex line) const {
    if (corner.first == line || corner.second == line) return 0;
    const auto height = certain_sign(dot(lines_[line].rough, corner.rough));
    if (height && corner.weight_sign) return *height * *corner.weight_sign;
    const VectorOf<ExactNumber> point = cross(lines_[corner.first].exact(), lines_[corner.second].exact());
    return sign(dot(lines_[line].exact(), point)) * sign(sum(point));
  }

  std::vector<int> sides_of(const Part& part, LineIndex line) const {
    std::vector<int> sides;
    for (const Corner& corner : part) sides.push_back(side_of(corner, line));
    return sides;
  }

  bool has_corner_inside(const Part& part, LineIndex line) const {
    return std::any_of(part.begin(), part.end(), [&](const Corner& corner) { return side_of(corner, line) < 0; });
  }

  /// Adds what lies outside of one of the lines.
  void add_outside(Part part, const std::vector<LineIndex>& cutters, std::vector<Part>& left) const {
    const auto meets = [&](LineIndex line) { return has_corner_inside(part, line); };
    if (!std::all_of(cutters.begin(), cutters.end(), meets)) {
      left.push_back(std::move(part));
      return;
    }
    const std::size_t before = left.size();
    Part rest = part;
    for (const LineIndex line : cutters) {
      const std::vector<int> sides = sides_of(rest, line);
      if (std::none_of(sides.begin(), sides.end(), [](int s) { return s > 0; })) continue;
      if (std::none_of(sides.begin(), sides.end(), [](int s) { return s < 0; })) {
        left.resize(before);
        left.push_back(std::move(part));
        return;
      }
      left.push_back(cut(rest, sides, line, 1));
      rest = cut(rest, sides, line, -1);
    }
  }

  /// The part on one side of a line that passes through the inside.
  Part cut(const Part& part, const std::vector<int>& sides, LineIndex line, int which) const {
    const std::size_t n = part.size();
    const auto lies_there = [&](std::size_t i) { return sides[i % n] == which; };
    std::size_t begin = 0;  // the first corner there; those that lie there follow each other
    while (lies_there(begin + n - 1) || !lies_there(begin)) ++begin;
    std::vector<LineIndex> kept{part[begin % n].first};
    for (std::size_t i = begin; lies_there(i); ++i) kept.push_back(part[i % n].second);
    kept.push_back(line);
    return part_of(kept);
  }

  Cell whole(const Part& part) const {
    Cell cell;
    for (const Corner& corner : part) cell.push_back(plane_point(corner));
    return cell;
  }

  std::optional<Cell> short_cell(const Part& part) const {
    std::vector<Vec3> corners;
    Vec3 middle;
    for (const Corner& corner : part) {
      corners.push_back(rough_weights(corner));
      middle += corners.back() / static_cast<double>(part.size());
    }
    Cell cell;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 weights = short_weights(middle * 0.75 + corners[i * part.size() / 3] * 0.25);
      if (!certainly_holds(part, weights)) return std::nullopt;
      cell.push_back(plane_point(weights));
    }
    return cell;
  }

  static Vec3 rough_weights(const Corner& corner) {
    const Interval total = sum(corner.rough);
    const auto weight = [&](int i) { return corner.rough[i].middle() / total.middle(); };
    return {weight(0), weight(1), weight(2)};
  }

  /// Their sum is 1, exactly, if they lie in [0, 1].
  static Vec3 short_weights(const Vec3& weights) {
    constexpr double kUnit = 0x1p-40;
    const double v = std::nearbyint(weights.y / kUnit) * kUnit, w = std::nearbyint(weights.z / kUnit) * kUnit;
    return {1 - v - w, v, w};
  }

  /// False where intervals do not tell.
  bool certainly_holds(const Part& part, const Vec3& weights) const {
    if (!(weights.x > 0 && weights.y > 0 && weights.z > 0)) return false;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const LineIndex line = part[i].first;
      const int inner = side_of(part[(i + 1) % part.size()], line);
      const VectorOf<Interval> point{Interval(weights.x), Interval(weights.y), Interval(weights.z)};
      if (certain_sign(dot(lines_[line].rough, point)) != inner) return false;
    }
    return true;
  }

  PlanePoint plane_point(const Vec3& weights) const {
    const auto coordinate = [&](int i) {
      return Number(Number(weights.x) * t_.a[i] + Number(weights.y) * t_.b[i] + Number(weights.z) * t_.c[i]);
    };
    return {coordinate((axis_ + 1) % 3), coordinate((axis_ + 2) % 3)};
  }

  PlanePoint plane_point(const Corner& corner) const {
    const VectorOf<Number> weights =
        cross(lines_[corner.first].coefficients<Number>(), lines_[corner.second].coefficients<Number>());
    const Number total = sum(weights);
    const auto coordinate = [&](int i) {
      const Number x = (weights[0] * t_.a[i] + weights[1] * t_.b[i] + weights[2] * t_.c[i]) / total;
      // Where lines are nearly parallel, intervals are wide, and would decide nothing about the point.
      const double size = std::abs(t_.b[i] - t_.a[i]) + std::abs(t_.c[i] - t_.a[i]);
      return x.approx().sup() - x.approx().inf() <= kWide * size ? x : x.narrowed();
    };
    return {coordinate((axis_ + 1) % 3), coordinate((axis_ + 2) % 3)};
  }

  const Triangle& t_;
  const int axis_;
  std::vector<Line> lines_;
  std::vector<Part> parts_;
};

/// What is left of t once all that lies in the kernels is cut off, in cells with an area. Exact.
Clipper remainder(const Triangle& t, int axis, const std::vector<const Kernel*>& kernels, Covering covering) {
  Clipper clipper(t, axis);
  clipper.cut_off(kernels, covering);
  return clipper;
}

/// True only if a face lies outside of the solid and does not touch it.
bool is_off(const Surface& solid, const Triangle& face) {
  const Box box = box_of(face);
  bool touches = false;
  solid.bvh.visit([&](const Box& other) { return !touches && box.overlaps(other); },
                  [&](FaceIndex f) { touches = touches || !certainly_apart(face, solid.faces[f]); });
  return !touches && winding_at(solid, ExactPoint(face.a)) < 1;
}

}  // namespace

std::vector<Vec3> points_beyond_kernels(const Triangle& t, int axis, const Pieces& pieces) {
  std::vector<Vec3> points;
  for (const Cell& cell : remainder(t, axis, pieces.near(box_of(t)), Covering::Surface).cells())
    for (const PlanePoint& corner : cell) points.push_back(rounded(lifted(t, axis, corner)));
  return points;
}

Holes find_holes(const Surface& solid, const Pieces& pieces, const Surface& all, const EnclosureOptions& options) {
  std::vector<std::uint32_t> piece_of;  // by number of the face in all pieces together
  for (std::uint32_t i = 0; i < pieces.meshes.size(); ++i)
    piece_of.resize(piece_of.size() + pieces.meshes[i].face_count(), i);
  // No piece winds a negative number of times, so that each winds at least once on the inner side of its faces. On the
  // outer side others have to. Where kernels are whole pieces, all that is left has no piece there.
  const auto open_cells = [&](FaceIndex f) -> std::optional<std::vector<Cell>> {
    if (is_off(solid, all.faces[f])) return std::vector<Cell>{};
    const std::uint32_t own = piece_of[index(all.source[f])];
    const auto others = pieces.near(box_of(all.faces[f]), own);
    const Clipper left = remainder(all.faces[f], all.axis[f], others, Covering::Beyond);
    const bool are_whole =
        std::all_of(others.begin(), others.end(), [](const Kernel* k) { return k->is_whole_piece(); });
    if (left.is_empty() || (are_whole && pieces.kernels[own].is_whole_piece())) return left.inner_cells();
    return std::nullopt;
  };
  return find_holes(solid, all, open_cells, options);
}

}  // namespace prohull::verify
