#include "geometry/orientation.h"

#include <algorithm>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/interior_contact.h"
#include "geometry/triangle_predicates.h"
#include "geometry/winding_number.h"

namespace prohull {
namespace {

/// What the components that face outwards bound.
struct Solid {
  std::vector<Triangle> faces;
  WindingNumber winding;
  Bvh bvh;

  explicit Solid(std::vector<Triangle> outwards) : faces(std::move(outwards)), winding(faces), bvh(faces) {}
};

bool has_corner(const Triangle& of, const Triangle& beside, Side where) {
  return side(beside, of.a) == where || side(beside, of.b) == where || side(beside, of.c) == where;
}

/// Whether the solids may overlap where a face that looks inwards meets one that looks outwards, in more than a point.
/// Where they only touch, one of the faces lies beyond the plane of the other, or they lie in one plane and look the
/// same way.
bool crosses(const Triangle& inwards, int inwards_axis, const Triangle& outwards) {
  const auto axis = projection_axis(outwards);
  if (!axis) return false;
  const Contact held = interior_contact(inwards, inwards_axis, outwards).interior;
  if (held == Contact::Covering || held == Contact::Same)
    return turn(*axis, inwards.a, inwards.b, inwards.c) != turn(*axis, outwards.a, outwards.b, outwards.c);
  if (held == Contact::None && interior_contact(outwards, *axis, inwards).interior == Contact::None) return false;
  return has_corner(inwards, outwards, Side::Inside) && has_corner(outwards, inwards, Side::Outside);
}

/// A face that crosses no other one may still lie inside of the solid, between corners that all lie on its surface.
/// Then a point of the face, rounded, answers.
bool lies_inside_between_corners(const Triangle& t, const Solid& solid) {
  for (const Vec3& p : {t.a, t.b, t.c})
    if (solid.winding.at(p)) return false;
  return solid.winding.at(t.a / 3 + t.b / 3 + t.c / 3).value_or(0) > 0;
}

/// Whether a face that looks inwards crosses the solid.
bool crosses(const Triangle& t, const Solid& solid) {
  const auto axis = projection_axis(t);
  if (!axis) return false;
  const Box box = box_of(t);
  bool found = false, lies_on_it = false;
  solid.bvh.visit([&](const Box& other) { return !found && box.overlaps(other); },
                  [&](std::uint32_t f) {
                    found = found || crosses(t, *axis, solid.faces[f]);
                    lies_on_it = lies_on_it || coplanar(t, solid.faces[f]);
                  });
  return found || (!lies_on_it && lies_inside_between_corners(t, solid));
}

Facing facing_of_negative(const std::vector<Triangle>& component, const Solid& solid) {
  bool inside = false, outside = false;
  for (const Triangle& t : component)
    for (const Vec3& p : {t.a, t.b, t.c})
      if (const auto winding = solid.winding.at(p)) (*winding > 0 ? inside : outside) = true;
  if (inside == outside) return Facing::Unclear;
  if (inside) return Facing::Cavity;
  const bool is_crossing = std::ranges::any_of(component, [&](const Triangle& t) { return crosses(t, solid); });
  return is_crossing ? Facing::Unclear : Facing::InsideOut;
}

}  // namespace

Orientation orientation(const TriangleOfFace& triangle, std::span<const std::uint32_t> component,
                        std::size_t components) {
  Orientation result;
  result.components.assign(components, Facing::Outwards);
  result.turn_all = volume_sign(component.size(), triangle) < 0;
  result.inside_out.assign(components, result.turn_all);
  if (components < 2) return result;

  std::vector<std::vector<Triangle>> parts(components);
  for (std::size_t f = 0; f < component.size(); ++f) {
    Triangle t = triangle(f);
    if (result.turn_all) std::swap(t.b, t.c);
    parts[component[f]].push_back(t);
  }
  std::vector<std::size_t> negative;
  std::vector<Triangle> positive;
  for (std::size_t c = 0; c < components; ++c) {
    const int sign = volume_sign(parts[c]);
    result.inside_out[c] = result.turn_all && sign > 0;
    if (sign < 0)
      negative.push_back(c);
    else
      positive.insert(positive.end(), parts[c].begin(), parts[c].end());
  }
  if (negative.empty()) return result;
  const Solid solid(std::move(positive));
  for (const std::size_t c : negative) {
    result.components[c] = facing_of_negative(parts[c], solid);
    result.inside_out[c] = !result.turn_all && result.components[c] != Facing::Cavity;
  }
  return result;
}

}  // namespace prohull
