#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "prohull/mesh_query.h"
#include "render/color.h"
#include "render/normals.h"

namespace prohull::render {

// Scenes are drawn in their own unit: see Placement.

/// A mesh made ready to be drawn; the pictures that show it share it.
struct Body {
  /// Faces that meet at less than `crease_angle` radians look smooth; at 0 they are flat.
  explicit Body(TriangleMesh of, double crease_angle = 0);

  TriangleMesh mesh;
  QueryIndex index;
  CornerNormals normals;  ///< none: faces look flat
  double mean_side;       ///< of an isosceles right-angled triangle of the mean area
};

struct Material {
  Rgb color;
  double opacity = 1;     ///< of a surface seen head-on; below 1 it is translucent, and lights and shades nothing
  double line_width = 0;  ///< of the edges, in pixels; 0: not drawn
  double through = 0;     ///< how much is seen of it through what is opaque; in [0, 1]
};

struct Surface {
  std::shared_ptr<const Body> body;
  Material material;
  double from = 0, to = 1;   ///< the part of the picture's width where it is seen
  PerFace<Rgb> colors = {};  ///< empty: all faces have that of the material

  const Rgb& color(FaceId face) const { return colors.empty() ? material.color : colors[face]; }
  bool is_translucent() const { return material.opacity < 1; }
  bool is_seen_at(double column) const { return from <= column && column < to; }
};

struct Scene {
  std::vector<Surface> surfaces;
  std::optional<double> ground;  ///< height of a plane on which shadows fall
};

/// From a model's unit to the scene's, in which the longest side of the box is 1 and its centre 0: then lengths that
/// belong to the eye, as the reach of shadows, are plain numbers, and no coordinate is too large or too small.
class Placement {
 public:
  /// Throws InputError(EmptyMesh) for a box that is empty or a single point.
  explicit Placement(const Box& box);
  Vec3 operator()(const Vec3& p) const { return (0.5 * p - 0.5 * center_) / half_size_; }
  TriangleMesh operator()(TriangleMesh mesh) const;

 private:
  Vec3 center_;
  double half_size_;  // of the box; the size itself may be beyond all doubles
};

/// What a ray through the picture meets.
struct Meeting {
  const Surface* surface;  ///< nullptr: the ground
  FaceId face;
  double t;
  Vec3 position;
};

/// Follows rays through a scene. Keeps scratch memory; use one per thread. A column is a place in the picture's width,
/// in [0, 1): rays that begin there meet the surfaces that are seen there.
class Tracer {
 public:
  /// Both must outlive it.
  Tracer(const Scene& scene, const Vec3& vertical);

  /// The nearest that is opaque.
  std::optional<Meeting> first_opaque(const Ray& ray, double column);
  /// What is translucent, nearest first, up to t.
  const std::vector<Meeting>& translucent_before(double t, const Ray& ray, double column);
  /// The nearest that is seen through what is at t.
  std::optional<Meeting> shining_through(double t, const Ray& ray, double column);
  /// Whether something opaque is in the way.
  bool blocked(const Segment& segment, double column);

 private:
  std::optional<Meeting> ground(const Ray& ray) const;

  const Scene& scene_;
  const Vec3& vertical_;
  std::vector<MeshQuery> queries_;
  std::vector<Meeting> translucent_;
};

}  // namespace prohull::render
