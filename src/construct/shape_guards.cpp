#include "construct/shape_guards.h"

#include <algorithm>
#include <cmath>

#include "geometry/compactness.h"

namespace prohull {
namespace {

double least_compactness_before(const Star& star) {
  const std::size_t n = star.link.size();
  double least = std::min(
      compactness(star.double_areas[n], squared_edges(star.local_o, star.local_d, star.local[0])),
      compactness(star.double_areas[n + 1], squared_edges(star.local_d, star.local_o, star.local[star.o_faces])));
  for (std::size_t i = 0; i < n; ++i)
    least = std::min(least, compactness(star.double_areas[i],
                                        squared_edges(star.local_apex(i), star.local[i], star.local[star.after(i)])));
  return least;
}

// has(i): whether the collapse makes face i; link(i) is where its corner is then.
std::optional<Refusal> refused(const Star& star, const Vec3& apex, const HullOptions& options, auto&& has,
                               auto&& link) {
  const double least_cosine = std::cos(options.guards.max_normal_deviation);
  double least_compactness = 1;
  for (std::size_t i = 0; i < star.link.size(); ++i) {
    if (!has(i)) continue;
    const Vec3 &a = link(i), &b = link(star.after(i));
    const Vec3 n = cross(a - apex, b - apex);
    const double length = norm(n);
    if (star.double_areas[i] > 0 && dot(n, star.planes[i].normal) < least_cosine * length)
      return Refusal::NormalDeviation;
    least_compactness = std::min(least_compactness, compactness(length, squared_edges(apex, a, b)));
  }
  double required = options.guards.min_compactness_ratio * least_compactness_before(star);
  if (options.strategy == Strategy::Lazy) required = std::min(required, options.guards.sufficient_compactness);
  if (!(least_compactness > required)) return Refusal::Compactness;
  return std::nullopt;
}

}  // namespace

double overhang_left(const Box& box, const Box& of, double max_overhang) {
  const double reach = max_overhang * of.diagonal();
  double left = reach;
  for (int axis = 0; axis < 3; ++axis)
    left = std::min({left, box.min[axis] - (of.min[axis] - reach), of.max[axis] + reach - box.max[axis]});
  return std::isfinite(left) ? std::max(left, 0.0) / box.diagonal() : max_overhang;
}

std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options) {
  return refused(
      star, apex, options, [](std::size_t) { return true; },
      [&](std::size_t i) -> const Vec3& { return star.local[i]; });
}

std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options, std::size_t moved,
                                     const std::optional<Vec3>& to) {
  return refused(
      star, apex, options, [&](std::size_t i) { return to || (i != moved && star.after(i) != moved); },
      [&](std::size_t i) -> const Vec3& { return to && i == moved ? *to : star.local[i]; });
}

}  // namespace prohull
