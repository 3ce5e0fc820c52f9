#include "geometry/orientation.h"

#include <utility>

#include "geometry/winding_number.h"

namespace prohull {
namespace {

Facing facing_of_negative(const std::vector<Triangle>& component, const WindingNumber& solid) {
  bool inside = false, outside = false;
  for (const Triangle& t : component)
    for (const Vec3& p : {t.a, t.b, t.c})
      if (const auto winding = solid.at(p)) (*winding > 0 ? inside : outside) = true;
  return inside && outside ? Facing::Unclear : inside ? Facing::Cavity : Facing::InsideOut;
}

}  // namespace

Orientation orientation(std::vector<Triangle> faces, std::span<const std::uint32_t> component, std::size_t components) {
  Orientation result;
  result.components.assign(components, Facing::Outwards);
  result.turn_all = volume_sign(faces) < 0;
  if (result.turn_all)
    for (Triangle& t : faces) std::swap(t.b, t.c);
  if (components < 2) return result;

  std::vector<std::vector<Triangle>> parts(components);
  for (std::size_t f = 0; f < faces.size(); ++f) parts[component[f]].push_back(faces[f]);
  std::vector<std::size_t> negative;
  std::vector<Triangle> positive;
  for (std::size_t c = 0; c < components; ++c) {
    if (volume_sign(parts[c]) < 0)
      negative.push_back(c);
    else
      positive.insert(positive.end(), parts[c].begin(), parts[c].end());
  }
  if (negative.empty()) return result;
  const WindingNumber solid(std::move(positive));
  for (const std::size_t c : negative) result.components[c] = facing_of_negative(parts[c], solid);
  return result;
}

}  // namespace prohull
