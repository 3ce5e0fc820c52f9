#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// The sign of the signed volume of a closed chain of triangles. Exact.
int volume_sign(std::span<const Triangle> faces);

/// Says which triangle a face is.
using TriangleOfFace = std::function<Triangle(std::size_t face)>;

/// The same of the first `count` faces.
int volume_sign(std::size_t count, const TriangleOfFace& triangle);

/// How a component of a closed mesh faces.
enum class Facing : std::uint8_t {
  Outwards,   ///< its volume is not negative
  Cavity,     ///< negative volume, inside the components that face outwards
  InsideOut,  ///< negative volume, outside of them, at most touching them: to be turned
  Unclear,    ///< negative volume, and crosses them, or all of its corners lie on them: neither turned nor a cavity
};

struct Orientation {
  bool turn_all = false;  ///< the mesh as a whole is inside out: the volumes of its components add up to less than 0
  std::vector<Facing> components;  ///< how each faces once that is done
  std::vector<bool> inside_out;    ///< of each, as given: its volume is negative, and it is no cavity
};

/// `component` has the number, below `components`, of the component of each face. Exact, but for faces of negative
/// components with all three corners on the surface of others: a point of the face, rounded, says where they lie.
Orientation orientation(const TriangleOfFace& triangle, std::span<const std::uint32_t> component,
                        std::size_t components);

}  // namespace prohull
