#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// Every triangle in four, the middles of its edges moved at random by up to a twentieth of the edge along each axis,
/// so that no part is flat. The same bits everywhere. The result may intersect itself.
TriangleMesh subdivided(const TriangleMesh& mesh);

}  // namespace prohull::bench
