#include "construct/guard/tolerance_guard.h"

#include <algorithm>
#include <cmath>

namespace prohull {
namespace {

// What is less than this, in a star of size 1, is rounding.
constexpr double kRoundingOfGuard = 1e-9;

// The rest is for the proof, which ends when it knows a distance to 1 %, and for the rounding of coordinates.
constexpr double kUsedPart = 0.98;

// Faces that are seen from the side have an area that is mostly rounding.
constexpr double kLeastPartSeen = 0.02;

}  // namespace

bool ToleranceGuard::would_exceed(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex) {
  set_old_faces(mesh, star);
  new_tolerances_.clear();
  apex_.deviation = 0;
  const auto [least, greatest] =
      std::minmax_element(old_faces_.begin(), old_faces_.end(),
                          [](const OldFace& a, const OldFace& b) { return a.tolerance < b.tolerance; });
  if (least->tolerance == Tolerances::kAny) return false;
  least_tolerance_ = least->tolerance, greatest_tolerance_ = greatest->tolerance;
  set_points(star, apex);
  return std::ranges::none_of(directions(star, apex), [&](const Vec3& direction) { return holds_along(direction); });
}

// A mapping along any of them proves the bound. On the sample bracket, three leave 24 % fewer faces within a tolerance
// of 1 % of its diagonal than the first one alone.
std::array<Vec3, 3> ToleranceGuard::directions(const Star& star, const Vec3& apex) {
  Vec3 by_area, by_face;
  for (std::size_t i = 0; i < star.planes.size(); ++i) {
    by_area += star.planes[i].normal * star.double_areas[i];
    by_face += star.planes[i].normal;
  }
  return {by_area, by_face, apex - (star.local_o + star.local_d) * 0.5};
}

bool ToleranceGuard::holds_along(const Vec3& direction) {
  if (!project_without_folds(direction)) return false;
  bound_apex();
  if (is_beyond_all()) return false;
  set_new_tolerances();
  return is_within_tolerances();
}

// Each new face has it at a corner, and lies over old ones.
bool ToleranceGuard::is_beyond_all() const { return apex_.deviation * scale_ > kUsedPart * greatest_tolerance_; }

void ToleranceGuard::collapsed() {
  tolerances_.deviations.push_back(apex_.deviation * scale_);
  for (std::size_t i = 0; i < new_tolerances_.size(); ++i) tolerances_.faces[old_faces_[i].id] = new_tolerances_[i];
}

void ToleranceGuard::set_old_faces(const HalfEdgeMesh& mesh, const Star& star) {
  old_faces_.clear();
  const auto add = [&](HalfEdgeId h) {
    const FaceId id{index(h) / 3};
    old_faces_.push_back({id, tolerances_.faces[id], {}});
  };
  const HalfEdgeId h = star.edge, g = mesh.twin(h);
  for (HalfEdgeId a = mesh.rotated(h), end = mesh.next(g); a != end; a = mesh.rotated(a)) add(a);
  for (HalfEdgeId a = mesh.rotated(g), end = mesh.next(h); a != end; a = mesh.rotated(a)) add(a);
  add(h), add(g);
}

void ToleranceGuard::set_points(const Star& star, const Vec3& apex) {
  scale_ = star.scale;
  const std::size_t n = star.link.size();
  const auto point = [&](VertexId v, const Vec3& local) {
    return Point{.local = local, .deviation = tolerances_.deviations[v] / scale_};
  };
  link_.clear();
  for (std::size_t i = 0; i < n; ++i) link_.push_back(point(star.link[i], star.local[i]));
  o_ = point(star.o, star.local_o), d_ = point(star.d, star.local_d);
  apex_ = {.local = apex};
  for (std::size_t i = 0; i < n; ++i)
    old_faces_[i].corners = {i < star.o_faces ? &o_ : &d_, &link_[i], &link_[star.after(i)]};
  old_faces_[n].corners = {&o_, &d_, &link_[0]}, old_faces_[n + 1].corners = {&d_, &o_, &link_[star.o_faces]};
}

// False if the star or its replacement cannot be told from one that folds.
bool ToleranceGuard::project_without_folds(const Vec3& direction) {
  const double length = norm(direction);
  if (!(length > kRoundingOfGuard)) return false;
  const Vec3 n = direction / length;
  const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 u = cross(n, axis);
  u = u / norm(u);
  const Vec3 v = cross(n, u);
  const auto project = [&](Point& p) { p.x = dot(u, p.local), p.y = dot(v, p.local); };
  for (Point& p : link_) project(p);
  project(o_), project(d_), project(apex_);
  const auto is_upright = [](const Corners& corners) {
    const auto& [a, b, c] = corners;
    return double_area(corners) > kLeastPartSeen * norm(cross(b->local - a->local, c->local - a->local));
  };
  for (const OldFace& face : old_faces_)
    if (!is_upright(face.corners)) return false;
  for (std::size_t i = 0; i < link_.size(); ++i)
    if (!is_upright(new_face(i))) return false;
  return winds_once();
}

// The link goes counter-clockwise around the new vertex, but may do so twice. If it does not, its projection is a
// simple polygon, over which both stars lie once.
bool ToleranceGuard::winds_once() const {
  int turns = 0;
  for (std::size_t i = 0; i < link_.size(); ++i) turns += link_[i].y <= apex_.y && new_face(i)[2]->y > apex_.y;
  return turns == 1;
}

// The least deviation of the new vertex that bounds all corners of the overlay, where they lie in faces with a
// tolerance.
void ToleranceGuard::bound_apex() {
  const std::size_t n = link_.size();
  apex_.deviation = 0;
  bound_at_apex();
  const auto is_of_face_with_tolerance = [&](const Point& end) {
    return std::ranges::any_of(old_faces_, [&](const OldFace& face) {
      return face.tolerance < Tolerances::kAny && std::ranges::find(face.corners, &end) != face.corners.end();
    });
  };
  for (const Point* const end : {&o_, &d_})
    if (is_of_face_with_tolerance(*end)) bound_at_end(*end);
  // Each edge inside of the star is the first or the third one of a face; some of them of two.
  for (std::size_t i = 0; i < n + 2 && !is_beyond_all(); ++i)
    if (const auto& [id, tolerance, corners] = old_faces_[i]; tolerance < Tolerances::kAny) {
      bound_at_crossings(*corners[0], *corners[1]);
      bound_at_crossings(*corners[0], *corners[2]);
      if (i >= n) bound_at_crossings(*corners[1], *corners[2]);
    }
}

void ToleranceGuard::bound_at_apex() {
  const OldFace* at = nullptr;
  double most_inside = -std::numeric_limits<double>::infinity();
  bool has_tolerance = false;
  for (const OldFace& face : old_faces_) {
    const double inside = std::ranges::min(weights_at(apex_, face.corners));
    has_tolerance |= inside > -kRoundingOfGuard && face.tolerance < Tolerances::kAny;
    if (inside > most_inside) most_inside = inside, at = &face;
  }
  if (!has_tolerance && at->tolerance == Tolerances::kAny) return;
  const Weights w = weights_at(apex_, at->corners);
  Vec3 below;
  double deviation = 0;
  for (int i = 0; i < 3; ++i) below += at->corners[i]->local * w[i], deviation += at->corners[i]->deviation * w[i];
  raise_apex(1, 0, deviation + norm(apex_.local - below));
}

void ToleranceGuard::bound_at_end(const Point& end) {
  std::size_t at = 0;
  double most_inside = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < link_.size(); ++i)
    if (const double inside = std::ranges::min(weights_at(end, new_face(i))); inside > most_inside)
      most_inside = inside, at = i;
  const Corners face = new_face(at);
  const Weights w = weights_at(end, face);
  const Vec3 above = face[0]->local * w[0] + face[1]->local * w[1] + face[2]->local * w[2];
  raise_apex(w[0], face[1]->deviation * w[1] + face[2]->deviation * w[2], end.deviation + norm(above - end.local));
}

// Where an edge of the star crosses the edges of its replacement.
void ToleranceGuard::bound_at_crossings(const Point& from, const Point& to) {
  const double x = to.x - from.x, y = to.y - from.y;
  for (const Point& end : link_) {
    if (&end == &from || &end == &to) continue;
    const double u = end.x - apex_.x, v = end.y - apex_.y, a = apex_.x - from.x, b = apex_.y - from.y;
    const double determinant = x * v - y * u;
    if (determinant == 0) continue;  // parallel: corners of the overlay lie at their ends
    const double s = (a * v - b * u) / determinant, t = (a * y - b * x) / determinant;
    if (!(s >= -kRoundingOfGuard && s <= 1 + kRoundingOfGuard && t >= -kRoundingOfGuard && t <= 1 + kRoundingOfGuard))
      continue;
    const Vec3 was = from.local * (1 - s) + to.local * s, is = apex_.local * (1 - t) + end.local * t;
    raise_apex(1 - t, end.deviation * t, from.deviation * (1 - s) + to.deviation * s + norm(is - was));
  }
}

// So that weight * (deviation of the apex) + rest >= needed.
void ToleranceGuard::raise_apex(double weight, double rest, double needed) {
  if (needed <= rest) return;
  apex_.deviation = weight > kRoundingOfGuard ? std::max(apex_.deviation, (needed - rest) / weight)
                                              : std::numeric_limits<double>::infinity();
}

void ToleranceGuard::set_new_tolerances() {
  if (least_tolerance_ == greatest_tolerance_) return new_tolerances_.assign(link_.size(), least_tolerance_);
  new_tolerances_.assign(link_.size(), Tolerances::kAny);
  for (std::size_t i = 0; i < link_.size(); ++i)
    for (const OldFace& face : old_faces_)
      if (face.tolerance < new_tolerances_[i] && overlap(face.corners, new_face(i)))
        new_tolerances_[i] = face.tolerance;
}

bool ToleranceGuard::is_within_tolerances() const {
  for (std::size_t i = 0; i < link_.size(); ++i)
    for (const Point* const corner : new_face(i))
      if (!(corner->deviation * scale_ <= kUsedPart * new_tolerances_[i])) return false;
  return true;
}

double ToleranceGuard::double_area(const Corners& corners) {
  const auto& [a, b, c] = corners;
  return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

ToleranceGuard::Weights ToleranceGuard::weights_at(const Point& p, const Corners& corners) {
  const auto& [a, b, c] = corners;
  const double area = double_area(corners);
  const double of_a = double_area({&p, b, c}) / area, of_b = double_area({a, &p, c}) / area;
  return {of_a, of_b, 1 - of_a - of_b};
}

// Whether no edge of one has all of the other beyond it.
bool ToleranceGuard::overlap(const Corners& a, const Corners& b) {
  const auto separates = [](const Corners& edges, const Corners& others) {
    for (int i = 0; i < 3; ++i) {
      const Point &p = *edges[i], &q = *edges[(i + 1) % 3];
      const double x = q.x - p.x, y = q.y - p.y, length = std::sqrt(x * x + y * y);
      if (std::ranges::all_of(others, [&](const Point* other) {
            return double_area({&p, &q, other}) <= kRoundingOfGuard * length;
          }))
        return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

}  // namespace prohull
