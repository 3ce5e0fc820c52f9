#include "construct/tight/tight_placement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "construct/placement.h"
#include "geometry/apart_filter.h"
#include "geometry/closest_point.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"

namespace prohull {

/// Of the tetrahedron (0, apex, a, b) that moving a vertex from 0 to `apex` removes: planes with unit normals, which
/// have it on their inner sides.
struct Removed {
  Removed(const Vec3& apex, const Vec3& a, const Vec3& b)
      : new_face(plane(apex, a, b, Vec3{})),
        others{plane(Vec3{}, a, b, apex), plane(Vec3{}, apex, a, b), plane(Vec3{}, apex, b, a)} {}
  static HalfSpace plane(const Vec3& u, const Vec3& v, const Vec3& w, const Vec3& inside) {
    const Vec3 n = cross(v - u, w - u);
    const double length = norm(n);
    const Vec3 unit = length > 0 ? n / length : Vec3{};
    return dot(unit, inside - u) > 0 ? HalfSpace{unit, dot(unit, u)} : HalfSpace{-unit, -dot(unit, u)};
  }
  HalfSpace new_face;
  std::array<HalfSpace, 3> others;
};

namespace {

constexpr double kReach = 0.5;  ///< how far a vertex moves at once, along each axis, local

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

double depth(const HalfSpace& plane, const Vec3& p) { return dot(plane.normal, p) - plane.offset; }

struct FloatPlane {
  float x, y, z, offset;
};

FloatPlane in_float32(const HalfSpace& plane) {
  return {static_cast<float>(plane.normal.x), static_cast<float>(plane.normal.y), static_cast<float>(plane.normal.z),
          static_cast<float>(plane.offset)};
}

bool is_beyond(const std::array<HalfSpace, 3>& planes, const Vec3& p, double least_depth) {
  return std::ranges::all_of(planes, [&](const HalfSpace& plane) { return depth(plane, p) > least_depth; });
}

/// Keeps what is deeper than that.
void clip(std::vector<Vec3>& polygon, const HalfSpace& plane, double least_depth, std::vector<Vec3>& result) {
  result.clear();
  if (polygon.empty()) return;
  const double first = depth(plane, polygon.front()) - least_depth;
  double dp = first;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const bool is_last = i + 1 == polygon.size();
    const Vec3 &p = polygon[i], &q = polygon[is_last ? 0 : i + 1];
    const double dq = is_last ? first : depth(plane, q) - least_depth;
    if (dp >= 0) result.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) result.push_back(p + (q - p) * (dp / (dp - dq)));
    dp = dq;
  }
  std::swap(polygon, result);
}

}  // namespace

TightPlacement::TightPlacement(const Original& original, bool float32_coordinates)
    : original_(original),
      float32_coordinates_(float32_coordinates),
      rounding_(storage_rounding(original.bounds(), float32_coordinates)) {}

Vec3 TightPlacement::as_stored(const Vec3& p) const { return float32_coordinates_ ? nearest_float32(p) : p; }

void TightPlacement::set(const Vec3& from, const HalfEdgeMesh& mesh, const std::vector<VertexId>& link) {
  from_ = from;
  is_begun_ = false;
  link_.clear(), local_.clear(), found_.clear();
  looks_ = 0;
  known_.clear();
  for (const VertexId v : link) link_.push_back(mesh.position(v));
  scale_ = 0;
  for (const Vec3& p : link_) scale_ = std::max(scale_, norm(p - from));
  inverse_scale_ = 1 / scale_;
  for (const Vec3& p : link_) local_.push_back(to_local(p));
  objective_ = {};
  for (std::size_t i = 0; i < link_.size(); ++i) objective_ += cross(local_[i], local_[after(i)]);
}

void TightPlacement::know(const std::vector<Vec3>& points) {
  for (const Vec3& p : points) add_known(to_local(p));
}

/// Up to which depth a point of the original in a removed tetrahedron counts as outside of it; local.
double TightPlacement::allowed_depth() const {
  constexpr double kTouching = 1e-10;  // the exact test decides
  return original_.clearance() > 0 ? -original_.clearance() / scale_ : kTouching;
}

double TightPlacement::least_margin() const {
  constexpr double kLeast = 1e-10;
  return (original_.clearance() + 2 * rounding_) / scale_ + kLeast;
}

// For what rounding and the tolerances of the proposal have got wrong.
double TightPlacement::wide_margin() const {
  constexpr double kWide = 1e-7;
  return (original_.clearance() + 8 * rounding_) / scale_ + kWide;
}

void TightPlacement::begin(double margin) {
  constexpr int kMaxPrograms = 32;
  margin_ = margin;
  programs_left_ = kMaxPrograms;
  encloses_ = false;
  constraints_.clear();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 normal;
      normal[axis] = sign;
      constraints_.push_back({normal, -kReach});
    }
}

// Cutting planes: the linear program without the original, then again and again with the points of the original that
// its answer would leave outside.
std::optional<Vec3> TightPlacement::propose() {
  const double least_gain = original_.clearance() > 0 ? 1e-4 : 3e-4;  // of the objective
  if (!(norm(objective_) > 0)) return std::nullopt;
  while (programs_left_-- > 0) {
    const auto best = optimum_or_nearest(objective_, constraints_);
    if (!best || dot(objective_, *best) > -least_gain * norm(objective_)) return std::nullopt;
    if (!(original_.padding() > 0 ? add_known_padding_cuts(*best) : add_known_cuts(*best))) return best;
  }
  return std::nullopt;
}

// Nothing if there is nothing to gain. Sets encloses_ unless the exact test is against it but no point is to be seen
// that is in the way.
std::optional<Vec3> TightPlacement::propose_enclosing() {
  for (;;) {
    const auto apex = propose();
    if (!apex) return std::nullopt;
    const Vec3 to = as_stored(from_ + *apex * scale_);
    if (!is_finite(to)) return apex;
    const std::size_t cuts = constraints_.size();
    encloses_ = !(original_.padding() > 0 ? cut_where_near(*apex, to) : cut_where_met(*apex, to));
    if (constraints_.size() > cuts) continue;
    encloses_ = encloses_ && is_outside(to);
    return apex;
  }
}

std::optional<Vec3> TightPlacement::guess() {
  begin(least_margin());
  is_begun_ = true;
  const auto apex = propose();
  if (!apex) return std::nullopt;
  return as_stored(from_ + *apex * scale_);
}

// The face (x, a, b) has q inside where dot(x - q, (a - q) cross (b - q)) is positive: linear in x.
bool TightPlacement::add_cut(std::size_t i, const Vec3& q) {
  const Vec3 n = cross(local_[i] - q, local_[after(i)] - q);
  const double length = norm(n);
  if (!(length > 0)) return false;
  constraints_.push_back({n / length, dot(n, q) / length + margin_});
  return true;
}

void TightPlacement::Known::clear() {
  points.clear();
  fours.clear();
}

void TightPlacement::Known::add(const Vec3& p) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr Float4 kFour{kNan, kNan, kNan, kNan};
  const std::size_t lane = points.size() % 4;
  if (lane == 0) fours.push_back({kFour, kFour, kFour});
  for (int axis = 0; axis < 3; ++axis) fours.back()[static_cast<std::size_t>(axis)][lane] = static_cast<float>(p[axis]);
  points.push_back(p);
}

// Not of triangles that need no inside: there a point may be known on one side of a sheet, and then holds a vertex on
// the other. Hulls of sheets had up to three times the volume.
void TightPlacement::add_known(const Vec3& local) {
  if (original_.clearance() > 0 && original_.padding() == 0) return;
  if (original_.padding() == 0 && squared_norm(local) > 1) return;  // no tetrahedron reaches so far
  known_.add(local);
}

// For each face of the star, the known point that would be farthest outside.
bool TightPlacement::add_known_cuts(const Vec3& apex) {
  constexpr float kRounding = 4e-6f;  // of the depths of points within 1, with room
  bool added = false;
  const double allowed = allowed_depth();
  for (std::size_t i = 0; i < local_.size() && !known_.points.empty(); ++i) {
    const Vec3 &a = local_[i], &b = local_[after(i)];
    if (determinant(a, b, apex) >= 0) continue;  // adds
    const Removed removed(apex, a, b);
    const auto& [first, second, third] = removed.others;
    const std::array planes{in_float32(removed.new_face), in_float32(first), in_float32(second), in_float32(third)};
    double deepest = allowed;
    std::optional<Vec3> point;
    for (std::size_t four = 0; four < known_.fours.size(); ++four) {
      const auto& [x, y, z] = known_.fours[four];
      Truth4 may_be_inside{-1, -1, -1, -1};
      for (const auto& [nx, ny, nz, offset] : planes) may_be_inside &= nx * x + ny * y + nz * z > offset - kRounding;
      for (unsigned lanes = mask(may_be_inside); lanes != 0; lanes &= lanes - 1) {
        const Vec3& p = known_.points[4 * four + static_cast<std::size_t>(std::countr_zero(lanes))];
        const double d = depth(removed.new_face, p);
        if (d > deepest && is_beyond(removed.others, p, allowed)) deepest = d, point = p;
      }
    }
    if (point && add_cut(i, *point)) added = true;
  }
  return added;
}

/// In the removed tetrahedron, the point that is farthest outside of the new face.
class TightPlacement::Deepest {
 public:
  Deepest(const Removed& removed, double allowed) : removed_(removed), allowed_(allowed), deepest_(allowed) {}

  /// False where the triangle has no point inside, for certain: it lies beyond one of the planes.
  bool may_reach(const std::array<Vec3, 3>& triangle) const {
    const auto is_before = [&](const HalfSpace& plane) {
      return std::ranges::all_of(triangle, [&](const Vec3& p) { return depth(plane, p) < allowed_; });
    };
    return !is_before(removed_.new_face) && std::ranges::none_of(removed_.others, is_before);
  }
  void take_if_inside(const Vec3& p) {
    if (depth(removed_.new_face, p) > deepest_ && is_beyond(removed_.others, p, allowed_)) take(p);
  }
  void take_part_of(std::vector<Vec3>& polygon, std::vector<Vec3>& scratch) {
    clip(polygon, removed_.new_face, allowed_, scratch);
    for (const HalfSpace& plane : removed_.others) clip(polygon, plane, allowed_, scratch);
    if (polygon.size() >= 3)
      for (const Vec3& p : polygon) take(p);
  }
  const std::optional<Vec3>& point() const { return point_; }

 private:
  void take(const Vec3& p) {
    if (const double d = depth(removed_.new_face, p); d > deepest_) deepest_ = d, point_ = p;
  }

  const Removed& removed_;
  const double allowed_;
  double deepest_;
  std::optional<Vec3> point_;
};

std::array<Vec3, 3> TightPlacement::local_corners(FaceId f) const {
  const Triangle t = original_.mesh().triangle(f);
  return {to_local(t.a), to_local(t.b), to_local(t.c)};
}

void TightPlacement::find_near(const Tetrahedron& removed) {
  near_.clear();
  original_.find_near(removed, near_);
  looks_ += near_.size();
  if (original_.clearance() == 0) leave_out_apart(removed);
}

/// Those left out are certainly not in the way.
void TightPlacement::leave_out_apart(const Tetrahedron& removed) {
  if (near_.empty()) return;
  const auto& [a, b, c, d] = removed;
  const ApartFilter filter({to_local(a), to_local(b), to_local(c), to_local(d)});
  std::size_t kept = 0;
  for (std::size_t k = 0; k < near_.size(); k += 2) {
    const FaceId first = near_[k], second = near_[std::min(k + 1, near_.size() - 1)];
    const unsigned apart = filter.certainly_apart(local_corners(first), local_corners(second));
    if ((apart & 1) == 0) near_[kept++] = first;
    if ((apart & 2) == 0 && k + 1 < near_.size()) near_[kept++] = second;
  }
  near_.resize(kept, FaceId{});
}

void TightPlacement::find_reaching(const Deepest& deepest) {
  reaching_.clear();
  for (const FaceId f : near_)
    if (const auto corners = local_corners(f); deepest.may_reach(corners)) reaching_.push_back(corners);
}

void TightPlacement::take_parts_of_reaching(Deepest& deepest) {
  for (const auto& corners : reaching_) {
    polygon_.assign(corners.begin(), corners.end());
    deepest.take_part_of(polygon_, clipped_);
  }
}

/// Exact, of the triangles that are near.
bool TightPlacement::is_any_in_the_way(const Tetrahedron& removed) {
  if (original_.clearance() > 0) leave_out_apart(removed);
  return std::ranges::any_of(near_, [&](FaceId f) { return original_.is_in_the_way(f, removed); });
}

// Adds a cut for each removed tetrahedron that the original is in the way of: at a corner, or where there is none at a
// point of an edge or face. Whether it is in the way of none; exact.
bool TightPlacement::cut_where_met(const Vec3& apex, const Vec3& to) {
  bool met = false;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Tetrahedron tetrahedron{link_[i], to, link_[after(i)], from_};
    if (side(from_, link_[i], link_[after(i)], to) != Side::Inside) continue;  // adds, or is flat
    find_near(tetrahedron);
    if (near_.empty()) continue;
    const Removed removed(apex, local_[i], local_[after(i)]);
    Deepest deepest(removed, allowed_depth());
    find_reaching(deepest);
    for (const auto& corners : reaching_)
      for (const Vec3& p : corners) deepest.take_if_inside(p);
    if (!deepest.point()) take_parts_of_reaching(deepest);
    if (!deepest.point()) {
      met = met || is_any_in_the_way(tetrahedron);
      continue;
    }
    met = true;
    if (add_cut(i, *deepest.point())) found_.push_back(from_ + *deepest.point() * scale_), add_known(*deepest.point());
  }
  return met;
}

/// The half-space beyond the plane that touches the ball around q and contains the line through p along `axis`: of the
/// two such planes, that on the side of `towards`. None if the line is too near.
std::optional<HalfSpace> beyond_ball(const Vec3& q, double radius, const Vec3& p, const Vec3& axis,
                                     const Vec3& towards) {
  const double size = norm(axis);
  if (!(size > 0)) return std::nullopt;
  const Vec3 w = axis / size, to_p = p - q, across = to_p - w * dot(to_p, w);
  const double distance = norm(across);
  if (!(distance > radius)) return std::nullopt;
  const Vec3 e = across / distance, f = cross(w, e);
  const double cosine = radius / distance, sine = std::sqrt(1 - cosine * cosine);
  const Vec3 n = e * cosine + f * (dot(f, towards) >= 0 ? sine : -sine);
  return HalfSpace{n, dot(n, q) + radius};
}

// Faces that contain the line of the link edge, or touch it at a corner, keep the distance from q exactly there.
bool TightPlacement::add_padding_cut(std::size_t i, const Vec3& apex, const Vec3& q) {
  const Vec3 &a = local_[i], &b = local_[after(i)];
  const Foot foot = foot_on_triangle(q - apex, q - a, q - b, a - apex, b - apex);
  const Vec3 outwards = Removed(apex, a, b).new_face.normal;
  if (foot.on == Foot::On::Face) {
    auto cut = beyond_ball(q, margin_, a, b - a, outwards);
    if (!cut) cut = HalfSpace{outwards, dot(outwards, q) + margin_};
    constraints_.push_back(*cut);
    return true;
  }
  if (foot.from != 0) return false;  // at the link, which stays
  const Vec3 end = foot.to == 1 ? a : b, at = foot.on == Foot::On::Corner ? apex : apex + (end - apex) * foot.v;
  const double distance = norm(at - q);
  if (!(distance > 0)) return false;
  const Vec3 u = (at - q) / distance;
  std::optional<HalfSpace> cut;
  if (foot.on == Foot::On::Edge) cut = beyond_ball(q, margin_, end, cross(u, apex - end), u);
  constraints_.push_back(cut ? *cut : HalfSpace{u, dot(u, q) + margin_});
  return true;
}

// For each face of the star, the known point that is nearest to it, or farthest outside.
bool TightPlacement::add_known_padding_cuts(const Vec3& apex) {
  constexpr double kTouching = 1 - 1e-9;
  const double radius = original_.clearance() / scale_ * kTouching;
  bool added = false;
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Vec3 &a = local_[i], &b = local_[after(i)];
    const bool removes = determinant(a, b, apex) < 0;
    const Removed removed(apex, a, b);
    double worst = -radius;
    std::optional<Vec3> point;
    for (const Vec3& p : known_.points) {
      const double d = depth(removed.new_face, p);
      if (!(d > worst)) continue;
      double sunk = d;
      if (!(d > 0 && removes && is_beyond(removed.others, p, 0))) sunk = -norm(p - closest_point(p, {apex, a, b}));
      if (sunk > worst) worst = sunk, point = p;
    }
    if (point && add_padding_cut(i, apex, *point)) added = true;
  }
  return added;
}

std::optional<Vec3> TightPlacement::deepest_in(std::size_t i, const Vec3& apex, const Tetrahedron& tetrahedron) {
  find_near(tetrahedron);
  std::erase_if(near_, [&](FaceId f) { return !original_.is_in_the_way(f, tetrahedron); });
  const Removed removed(apex, local_[i], local_[after(i)]);
  Deepest deepest(removed, 0);
  find_reaching(deepest);
  take_parts_of_reaching(deepest);
  return deepest.point();
}

// As cut_where_met, of new faces that are too near too.
bool TightPlacement::cut_where_near(const Vec3& apex, const Vec3& to) {
  bool met = false;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Tetrahedron tetrahedron{link_[i], to, link_[after(i)], from_};
    std::optional<Vec3> point;
    if (side(from_, link_[i], link_[after(i)], to) == Side::Inside) {
      point = deepest_in(i, apex, tetrahedron);
      met = met || !near_.empty();
    }
    if (!point)
      if (const auto q = original_.nearest_within_padding({to, link_[i], link_[after(i)]}))
        met = true, point = to_local(q->point);
    if (point && add_padding_cut(i, apex, *point)) found_.push_back(from_ + *point * scale_), add_known(*point);
  }
  return met;
}

// Of tetrahedra that no triangle meets.
bool TightPlacement::is_outside(const Vec3& to) const {
  if (original_.is_outside_at(from_)) return true;
  for (std::size_t i = 0; i < link_.size(); ++i)
    if (const Tetrahedron removed{from_, link_[i], link_[after(i)], to};
        side(removed.a, removed.b, removed.c, removed.d) == Side::Inside && !original_.is_outside_inside_of(removed))
      return false;
  return true;
}

bool TightPlacement::keeps_padding(const Vec3& to) const {
  for (std::size_t i = 0; i < link_.size(); ++i)
    if (!original_.keeps_padding({to, link_[i], link_[after(i)]})) return false;
  return true;
}

bool TightPlacement::keeps_enclosing(const Vec3& to) {
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Tetrahedron removed{from_, link_[i], link_[after(i)], to};
    if (side(removed.a, removed.b, removed.c, removed.d) != Side::Inside) continue;
    find_near(removed);
    if (is_any_in_the_way(removed)) return false;
    if (!original_.is_outside_inside_of(removed)) return false;
  }
  return keeps_padding(to);
}

}  // namespace prohull
