#include "construct/progressive/mirrored_collapse.h"

#include <algorithm>

#include "construct/shape_guards.h"
#include "geometry/float32.h"

namespace prohull {

bool MirroredCollapse::look_at(const Star& star) {
  second_ = images_[star.edge], second_twin_ = mesh_.twin(second_);
  image_of_o_ = mesh_.tip(second_), image_of_d_ = mesh_.tail(second_);
  valence_ = star.valence();
  if (mesh_.edge(second_) == mesh_.edge(star.edge)) {
    kind_ = Kind::Itself;
    is_upright_ = image_of_o_ == star.o;
    return true;
  }
  if (image_of_o_ == star.o) return look_at_fan(star, star.d);
  if (image_of_d_ == star.d) return look_at_fan(star, star.o);
  return look_at_pair(star);
}

// An end and its image may be joined by an edge, that between them across the plane. Of the two faces beside it, which
// both stars have, the first collapse makes (s, o', p): s' sees it from outside because s, on the same side of the
// plane as o, sees (o, o', p) so. With more in common, the second edge would not satisfy the link condition any more.
bool MirroredCollapse::look_at_pair(const Star& star) {
  const int side = plane_.side(mesh_.position(star.o));
  if (side == 0 || side != plane_.side(mesh_.position(star.d))) return false;
  kind_ = Kind::Apart;
  for (std::size_t i = 0; i < star.link.size(); ++i) {
    if (star.link[i] != image_of_o_ && star.link[i] != image_of_d_) continue;
    const bool is_beside_both = i == 0 || i == star.o_faces;
    if (kind_ == Kind::Across || is_beside_both || star.link[i] != (i < star.o_faces ? image_of_o_ : image_of_d_))
      return false;
    kind_ = Kind::Across, moved_ = i;
  }
  return true;
}

// All faces around the far end, the one in the plane and the image of the far end make room for those around one vertex
// in the plane. The link of the first new vertex has the image in it: the second edge, between the two, must satisfy
// the link condition.
bool MirroredCollapse::look_at_fan(const Star& star, VertexId far) {
  kind_ = Kind::ToPlane;
  const VertexId image = far == star.o ? image_of_o_ : image_of_d_;
  if (image == star.o || image == star.d || plane_.side(mesh_.position(far)) == 0) return false;
  const auto place = std::ranges::find(star.link, image);
  if (place == star.link.end()) return false;
  moved_ = static_cast<std::size_t>(place - star.link.begin());
  const VertexId before = star.link[(moved_ + star.link.size() - 1) % star.link.size()],
                 after = star.link[star.after(moved_)];
  std::size_t joined = 0;
  for (const HalfEdgeId h : mesh_.around(image)) {
    const VertexId v = mesh_.tip(h);
    if (v == star.o || v == star.d)
      ++joined;
    else if (v != before && v != after && std::ranges::find(star.link, v) != star.link.end())
      return false;
  }
  valence_ = star.valence() + mesh_.valence(image) - 3 - joined;
  return valence_ >= 3;
}

std::optional<Placement> MirroredCollapse::place(const Star& star, double margin) {
  if (!goes_to_plane()) return place_outside(star, margin);
  star_plane_.axis = plane_.axis;
  star_plane_.coordinate = (plane_.coordinate() - star.origin[plane_.axis]) / star.scale;
  star_plane_.weights.assign(star.planes.size(), 1);
  if (kind_ == Kind::ToPlane) {
    // Half of what both collapses add together: faces whose images are in the star too count half.
    const VertexId middle = image_of_o_ == star.o ? star.o : star.d;
    for (std::size_t i = 0; i < star.planes.size(); ++i)
      if (i >= star.link.size() || star.apex(i) == middle || i == moved_ || star.after(i) == moved_)
        star_plane_.weights[i] = 0.5;
  }
  return place_outside(star, margin, star_plane_);
}

std::optional<Vec3> MirroredCollapse::as_stored(const Star& star, Vec3 p, bool float32_coordinates) const {
  const auto stored = [&](double x) { return float32_coordinates ? nearest_float32(x) : x; };
  for (int axis = 0; axis < 3; ++axis) p[axis] = stored(p[axis]);
  double& x = p[plane_.axis];
  // Of a number and its image, the one rounded makes the other exact, mostly.
  x = goes_to_plane() ? stored(plane_.coordinate()) : stored(plane_.sum - stored(plane_.sum - x));
  const auto image = plane_.image(p);
  if (!image || stored((*image)[plane_.axis]) != (*image)[plane_.axis]) return std::nullopt;
  const int side = goes_to_plane() ? 0 : plane_.side(mesh_.position(star.o));
  return plane_.side(p) == side ? std::optional(p) : std::nullopt;
}

std::optional<Refusal> MirroredCollapse::refused_shape(const Star& star, const Vec3& apex,
                                                       const HullOptions& options) const {
  if (kind_ == Kind::Apart || kind_ == Kind::Itself) return prohull::refused_shape(star, apex, options);
  if (kind_ == Kind::ToPlane) return prohull::refused_shape(star, apex, options, moved_, std::nullopt);
  Vec3 image = apex;
  image[plane_.axis] = 2 * ((plane_.coordinate() - star.origin[plane_.axis]) / star.scale) - apex[plane_.axis];
  return prohull::refused_shape(star, apex, options, moved_, image);
}

// Beside the plane nothing new can meet its image.
bool MirroredCollapse::is_beside_plane(const Star& star, const Vec3& apex) const {
  const int side = plane_.side(apex);
  return std::ranges::all_of(star.link, [&](VertexId v) { return plane_.side(mesh_.position(v)) == side; });
}

bool MirroredCollapse::would_add_intersections(SelfIntersectionGuard& guard, const Star& star, const Vec3& apex) {
  if (guard.would_add_intersections(mesh_, star, apex)) return true;
  if (kind_ == Kind::Itself || (kind_ == Kind::Apart && is_beside_plane(star, apex))) return false;
  find_faces(star, apex);
  return guard.would_add_intersections(mesh_, gone_, made_);
}

// Those that the two collapses replace, and those that they make.
void MirroredCollapse::find_faces(const Star& star, const Vec3& apex) {
  const Vec3 second = second_apex(apex);
  gone_.clear(), made_.clear();
  for (const VertexId v : {star.o, star.d, image_of_o_, image_of_d_})
    for (const HalfEdgeId h : mesh_.around(v)) gone_.push_back(FaceId{index(h) / 3});
  std::ranges::sort(gone_);
  gone_.erase(std::unique(gone_.begin(), gone_.end()), gone_.end());
  const auto after = [&](VertexId v) {
    if (v == star.o || v == star.d) return apex;
    return v == image_of_o_ || v == image_of_d_ ? second : mesh_.position(v);
  };
  for (const FaceId f : gone_) {
    const auto [a, b, c] = mesh_.corners(f);
    const Triangle t{after(a), after(b), after(c)};
    if (t.a != t.b && t.b != t.c && t.c != t.a) made_.push_back(t);
  }
}

}  // namespace prohull
