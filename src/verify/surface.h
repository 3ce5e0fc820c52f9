#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "geometry/bvh.h"
#include "prohull/triangle_mesh.h"

namespace prohull::verify {

using FaceIndex = std::uint32_t;  ///< of a face of a Surface

/// What becomes of a mesh whose volume is negative: as a rule it is inside out, and is turned.
enum class Turning : std::uint8_t { Outwards, Never };

/// A mesh as the verifier sees it: a closed chain of triangles, without the faces that have no area: they bound
/// nothing.
struct Surface {
  std::vector<Triangle> faces;
  std::vector<std::uint8_t> axis;                     ///< along which the face projects to a triangle with an area
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< numbered by position: equal positions have equal numbers
  std::vector<FaceId> source;                         ///< the face of the mesh
  Bvh bvh;
  double volume = 0;  ///< rounded

  /// Throws InputError, with `name` in the message, if the mesh is empty, not closed or not finite.
  Surface(const TriangleMesh& mesh, std::string_view name, Turning turning = Turning::Outwards);
  /// Of no faces: it winds around no point.
  Surface() = default;
};

/// Whether all faces have an area and are connected by edges, matched by position, with two faces each that run along
/// them in opposite directions. Requires what require_usable does.
bool is_one_sheet(const TriangleMesh& mesh);

/// Of a closed mesh. Exact.
int volume_sign(const TriangleMesh& mesh);

struct Turned {
  std::size_t faces = 0;    ///< that changed
  std::size_t inwards = 0;  ///< of these, of components that are inside out: cavities turn with what they are in
};

/// Turns components as turned_outwards does. Throws InputError as require_usable.
Turned turn_outwards(TriangleMesh& mesh, std::string_view name);

/// The same, and returns the faces of all components but cavities.
std::vector<FaceId> turn_outwards_and_fill(TriangleMesh& mesh, std::string_view name);

/// Side e of a face, from its corner e to the next.
struct FaceEdge {
  std::uint64_t key;  ///< equal for sides with the same ends, in either direction
  FaceIndex face;
  std::uint8_t edge;
};

/// Sorted by key.
std::vector<FaceEdge> edges(const Surface& surface);

}  // namespace prohull::verify
