#include "render/scene.h"

#include <algorithm>
#include <cmath>

#include "prohull/error.h"

namespace prohull::render {
namespace {

double mean_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    sum += 0.5 * norm(cross(t.b - t.a, t.c - t.a));
  }
  return sum / static_cast<double>(mesh.face_count());
}

}  // namespace

Body::Body(TriangleMesh of, double crease_angle)
    : mesh(std::move(of)),
      index(mesh),
      normals(crease_angle > 0 ? corner_normals(mesh, crease_angle) : CornerNormals()),
      mean_side(std::sqrt(2 * mean_area(mesh))) {}

Placement::Placement(const Box& box) : center_(box.center()) {
  const Vec3 half = 0.5 * box.max - 0.5 * box.min;
  half_size_ = std::max({half.x, half.y, half.z});
  if (box.is_empty() || !(half_size_ > 0)) throw InputError(Defect::EmptyMesh, "there is nothing to draw");
}

TriangleMesh Placement::operator()(TriangleMesh mesh) const {
  for (Vec3& p : mesh.positions) p = (*this)(p);
  return mesh;
}

Tracer::Tracer(const Scene& scene, const Vec3& vertical) : scene_(scene), vertical_(vertical) {
  for (const Surface& surface : scene.surfaces) queries_.emplace_back(surface.body->index);
}

std::optional<Meeting> Tracer::first_opaque(const Ray& ray, double column) {
  std::optional<Meeting> nearest = ground(ray);
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const Surface& surface = scene_.surfaces[i];
    if (surface.is_translucent() || !surface.is_seen_at(column)) continue;
    if (const auto hit = queries_[i].first_hit(ray); hit && (!nearest || hit->t < nearest->t))
      nearest = Meeting{&surface, hit->face, hit->t, hit->position};
  }
  return nearest;
}

const std::vector<Meeting>& Tracer::translucent_before(double t, const Ray& ray, double column) {
  const bool ends = std::isfinite(t);
  const Segment until{ray.origin, ends ? ray.origin + t * ray.direction : ray.origin};
  translucent_.clear();
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const Surface& surface = scene_.surfaces[i];
    if (!surface.is_translucent() || !surface.is_seen_at(column)) continue;
    for (const Hit& hit : ends ? queries_[i].all_hits(until) : queries_[i].all_hits(ray))
      translucent_.push_back({&surface, hit.face, ends ? t * hit.t : hit.t, hit.position});
  }
  std::ranges::stable_sort(translucent_, {}, &Meeting::t);
  return translucent_;
}

std::optional<Meeting> Tracer::shining_through(double t, const Ray& ray, double column) {
  std::optional<Meeting> nearest;
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const Surface& surface = scene_.surfaces[i];
    if (surface.material.through == 0 || !surface.is_seen_at(column)) continue;
    if (const auto hit = queries_[i].first_hit(ray); hit && hit->t > t && (!nearest || hit->t < nearest->t))
      nearest = Meeting{&surface, hit->face, hit->t, hit->position};
  }
  return nearest;
}

bool Tracer::blocked(const Segment& segment, double column) {
  if (scene_.ground && dot(segment.a, vertical_) > *scene_.ground && dot(segment.b, vertical_) < *scene_.ground)
    return true;
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const Surface& surface = scene_.surfaces[i];
    if (!surface.is_translucent() && surface.is_seen_at(column) && queries_[i].any_hit(segment)) return true;
  }
  return false;
}

std::optional<Meeting> Tracer::ground(const Ray& ray) const {
  const double fall = -dot(ray.direction, vertical_);
  if (!scene_.ground || !(fall > 0)) return std::nullopt;
  const double t = (dot(ray.origin, vertical_) - *scene_.ground) / fall;
  if (!(t > 0)) return std::nullopt;
  return Meeting{nullptr, FaceId{}, t, ray.origin + t * ray.direction};
}

}  // namespace prohull::render
