#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// The sign of the signed volume of a closed chain of triangles. Exact.
int volume_sign(std::span<const Triangle> faces);

/// How a component of a closed mesh faces.
enum class Facing : std::uint8_t {
  Outwards,   ///< its volume is not negative
  Cavity,     ///< negative volume, inside the components that face outwards
  InsideOut,  ///< negative volume, outside of them: to be turned
  Unclear,    ///< negative volume, partly inside and partly outside
};

struct Orientation {
  bool turn_all = false;  ///< the mesh as a whole is inside out: the volumes of its components add up to less than 0
  std::vector<Facing> components;  ///< how each faces once that is done
};

/// `component` has the number, below `components`, of each face's component. Exact.
Orientation orientation(std::vector<Triangle> faces, std::span<const std::uint32_t> component, std::size_t components);

}  // namespace prohull
