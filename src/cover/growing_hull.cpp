#include "cover/growing_hull.h"

#include <algorithm>
#include <cmath>

#include "geometry/no_index.h"

namespace prohull::cover {
namespace {

constexpr double kTolerance = 1e-6;
/// Points are moved by this much, so that no four of them lie in a plane and no rounding folds the hull.
constexpr double kShift = 1e-7;

double sixfold(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

}  // namespace

void GrowingHull::clear() {
  started_ = false;
  sixfold_volume_ = 0;
  points_.clear();
  faces_.clear();
  normal_x_.clear(), normal_y_.clear(), normal_z_.clear(), offset_.clear();
  free_.clear();
  seen_.clear();
  next_at_.clear();
  crowded_.clear();
  stamp_ = 0;
  random_ = {};
}

void GrowingHull::add(std::span<const Vec3> points) {
  if (started_) return insert(points);
  points_.insert(points_.end(), points.begin(), points.end());
  if (points_.size() < 4 || !start()) return;
  const std::vector<Vec3> waiting(points_.begin() + 4, points_.end());
  points_.resize(4);
  next_at_.assign(4, kNone);
  insert(waiting);
}

/// Brings four points that are not in a plane to the front and makes a tetrahedron of them.
bool GrowingHull::start() {
  const auto bring = [&](std::size_t place, auto&& measure) {
    const auto first = points_.begin() + static_cast<std::ptrdiff_t>(place);
    std::iter_swap(first, std::max_element(first, points_.end(),
                                           [&](const Vec3& p, const Vec3& q) { return measure(p) < measure(q); }));
    return measure(points_[place]);
  };
  bring(0, [](const Vec3& p) { return p.x; });
  const Vec3 a = points_[0];
  bring(1, [&](const Vec3& p) { return squared_norm(p - a); });
  const Vec3 along = points_[1] - a;
  bring(2, [&](const Vec3& p) { return squared_norm(cross(p - a, along)); });
  const Vec3 normal = cross(along, points_[2] - a);
  const double size = norm(normal);
  if (size == 0 || bring(3, [&](const Vec3& p) { return std::abs(dot(p - a, normal)); }) <= 10 * kTolerance * size)
    return false;
  if (dot(points_[3] - a, normal) > 0) std::swap(points_[1], points_[2]);
  origin_ = (points_[0] + points_[1] + points_[2] + points_[3]) / 4;
  new_face(0, 1, 2), new_face(1, 0, 3), new_face(2, 1, 3), new_face(0, 2, 3);
  faces_[0].beyond = {1, 2, 3};
  faces_[1].beyond = {0, 3, 2};
  faces_[2].beyond = {0, 1, 3};
  faces_[3].beyond = {0, 2, 1};
  return started_ = true;
}

Vec3 GrowingHull::shifted(const Vec3& p) {
  return p + Vec3{random_() * kShift, random_() * kShift, random_() * kShift};
}

std::uint32_t GrowingHull::new_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t f;
  if (free_.empty()) {
    f = static_cast<std::uint32_t>(faces_.size());
    faces_.emplace_back();
    normal_x_.push_back(0), normal_y_.push_back(0), normal_z_.push_back(0), offset_.push_back(0);
    seen_.push_back(0);
  } else {
    f = free_.back();
    free_.pop_back();
  }
  faces_[f].corners = {a, b, c};
  faces_[f].farthest = kNone;
  const Vec3 &p = points_[a], &q = points_[b], &r = points_[c];
  const Vec3 n = cross(q - p, r - p);
  const double size = norm(n);
  const Vec3 unit = size > 0 ? n * (1 / size) : Vec3{};
  normal_x_[f] = unit.x, normal_y_[f] = unit.y, normal_z_[f] = unit.z, offset_[f] = dot(unit, p);
  faces_[f].sixfold_volume = sixfold(p - origin_, q - origin_, r - origin_);
  sixfold_volume_ += faces_[f].sixfold_volume;
  return f;
}

void GrowingHull::remove_face(std::uint32_t f) {
  sixfold_volume_ -= faces_[f].sixfold_volume;
  faces_[f].farthest = kNone;
  normal_x_[f] = normal_y_[f] = normal_z_[f] = 0;
  offset_[f] = 1;
  free_.push_back(f);
}

void GrowingHull::insert(std::span<const Vec3> points) {
  for (const Vec3& p : points) {
    waiting_.push_back({shifted(p), 0, kNone});
    keep_where_seen(static_cast<std::uint32_t>(waiting_.size() - 1));
  }
  while (!crowded_.empty()) {
    const std::uint32_t f = crowded_.back();
    if (faces_[f].farthest == kNone)
      crowded_.pop_back();
    else
      insert_farthest(f);
  }
  waiting_.clear();
}

/// With the first face that sees the point. Eight faces are looked at together.
void GrowingHull::keep_where_seen(std::uint32_t waiting) {
  const Vec3 p = waiting_[waiting].point;
  const auto count = static_cast<std::uint32_t>(faces_.size());
  const auto sees = [&](std::uint32_t f) { return height(f, p) > kTolerance; };
  std::uint32_t f = 0;
  for (; f + 8 <= count; f += 8) {
    int any = 0;
    for (std::uint32_t k = 0; k < 8; ++k) any |= sees(f + k);
    if (any) break;
  }
  while (f < count && !sees(f)) ++f;
  if (f < count) keep(waiting, f, height(f, p));
}

void GrowingHull::keep_where_fan_sees(std::uint32_t waiting) {
  for (const std::uint32_t f : fan_)
    if (const double h = height(f, waiting_[waiting].point); h > kTolerance) return keep(waiting, f, h);
}

void GrowingHull::keep(std::uint32_t waiting, std::uint32_t face, double height) {
  std::uint32_t& farthest = faces_[face].farthest;
  Waiting& kept = waiting_[waiting];
  kept.height = height;
  if (farthest == kNone) crowded_.push_back(face);
  if (farthest == kNone || height > waiting_[farthest].height) {
    kept.next = farthest;
    farthest = waiting;
  } else {
    kept.next = waiting_[farthest].next;
    waiting_[farthest].next = waiting;
  }
}

void GrowingHull::insert_farthest(std::uint32_t face) {
  const Waiting chosen = waiting_[faces_[face].farthest];
  faces_[face].farthest = chosen.next;
  find_visible(chosen.point, face);
  if (!find_horizon()) return;
  collect_beyond_visible();
  points_.push_back(chosen.point);
  next_at_.push_back(kNone);
  for (const std::uint32_t f : visible_) remove_face(f);
  add_fan();
  for (const std::uint32_t w : orphans_) keep_where_fan_sees(w);
}

void GrowingHull::collect_beyond_visible() {
  orphans_.clear();
  for (const std::uint32_t f : visible_)
    for (std::uint32_t w = faces_[f].farthest; w != kNone; w = waiting_[w].next) orphans_.push_back(w);
}

/// The faces around `first` that see p.
void GrowingHull::find_visible(const Vec3& p, std::uint32_t first) {
  ++stamp_;
  visible_.assign(1, first);
  seen_[first] = stamp_;
  for (std::size_t i = 0; i < visible_.size(); ++i)
    for (const std::uint32_t g : faces_[visible_[i]].beyond) {
      if (seen_[g] == stamp_) continue;
      if (height(g, p) > 0) seen_[g] = stamp_, visible_.push_back(g);
    }
}

/// False where rounding makes it pass a vertex twice: such a point is left out.
bool GrowingHull::find_horizon() {
  horizon_.clear();
  for (const std::uint32_t f : visible_)
    for (int e = 0; e < 3; ++e)
      if (const std::uint32_t g = faces_[f].beyond[e]; seen_[g] != stamp_)
        horizon_.push_back({faces_[f].corners[e], faces_[f].corners[(e + 1) % 3], g});
  bool simple = true;
  for (const Edge& e : horizon_) {
    if (next_at_[e.a] != kNone) simple = false;
    next_at_[e.a] = 0;
  }
  for (const Edge& e : horizon_) next_at_[e.a] = kNone;
  return simple && horizon_.size() >= 3;
}

/// From the newest point to the horizon.
void GrowingHull::add_fan() {
  const auto apex = static_cast<std::uint32_t>(points_.size() - 1);
  fan_.clear();
  for (const Edge& e : horizon_) {
    const std::uint32_t f = new_face(e.a, e.b, apex);
    faces_[f].beyond[0] = e.beyond;
    Face& other = faces_[e.beyond];
    for (int i = 0; i < 3; ++i)
      if (other.corners[i] == e.b && other.corners[(i + 1) % 3] == e.a) other.beyond[i] = f;
    next_at_[e.a] = f;
    fan_.push_back(f);
  }
  for (const std::uint32_t f : fan_) {
    const std::uint32_t next = next_at_[faces_[f].corners[1]];
    if (next == kNone) continue;
    faces_[f].beyond[1] = next;
    faces_[next].beyond[2] = f;
  }
  for (const std::uint32_t f : fan_) next_at_[faces_[f].corners[0]] = kNone;
}

}  // namespace prohull::cover
