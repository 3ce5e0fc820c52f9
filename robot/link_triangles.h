#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "prohull/detail/solid_pieces.h"
#include "prohull/triangle_mesh.h"
#include "robot/model.h"

namespace prohull::robot {

/// In which frame the triangles of several shapes are.
///
/// If all have the same origin, they are in that frame, and nothing is rounded but by the scale of mesh files.
/// Otherwise they are in the frame of the link, each vertex where `placed` of collide.h puts it.
struct Frame {
  std::optional<std::size_t> same_origin_as;  ///< the first of the shapes, if all have its origin and it is none
  Pose in_link;                               ///< where the frame is in the frame of the link
};
Frame common_frame(std::span<const Shape> shapes);

/// Where the frame of the shape is in that frame.
Pose pose_in(const Frame& frame, const Shape& shape);

/// A sphere, cylinder or capsule, where the pose puts it; none of any other form.
std::optional<CurvedForm> curved_form(const Form& form, const Pose& pose = {});

/// Triangles of a box, sphere, cylinder or capsule, closed and outwards, in its own frame.
/// Guaranteed, exactly: with Curved::Around the mesh encloses the form, with Curved::Within the form encloses it. A
/// box has 12 faces that are the box itself. `segments` is the number of corners around the axis, at least 8.
TriangleMesh form_mesh(const Form& form, Curved curved, std::size_t segments = 64);

/// The triangles of a mesh file as the robot scales it, in the shape's own frame. A mirrored one is turned outwards.
/// Vertices that are not finite are kept, unless it is filled. Throws InputError as read_mesh, and CannotRead if the
/// file was not found.
TriangleMesh mesh_triangles(const MeshFile& mesh);

/// Without the faces that have a corner which is not finite. Corners that are not are 0.
TriangleMesh finite_triangles(TriangleMesh mesh);

/// Whether float32 holds all coordinates.
bool keeps_float32(const TriangleMesh& mesh);

/// All shapes that are meshes or primitives, in `frame`. Curved forms as meshes around them. OtherForm is left out.
TriangleMesh link_triangles(std::span<const Shape> shapes, const Frame& frame);

/// The geometry of a link with its curved forms themselves.
struct CurvedParts {
  SolidPieces parts;  ///< `triangles` of meshes and boxes, and `curved`; empty if no form is curved
  double around = 0;  ///< how far the meshes around the curved forms reach out of them at most: proven
};

struct LinkGeometry {
  TriangleMesh triangles;  ///< as link_triangles makes them
  CurvedParts curved;
};
LinkGeometry link_geometry(std::span<const Shape> shapes, const Frame& frame);

/// Moves a mesh from the frame of its shape into `frame`, not rounded if both are the same.
TriangleMesh in_frame(TriangleMesh mesh, const Pose& origin, const Frame& frame);

}  // namespace prohull::robot
