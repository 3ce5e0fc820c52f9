#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/place.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/mesh_io.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What all readers share: takes vertices and polygons in the order of the file, checks that coordinates are finite,
/// unless others are kept, and that indices exist, and triangulates. Faces may come before their vertices.
class MeshBuilder {
 public:
  /// `first_number` is the number of the first vertex in the format's own counting, for messages. `content`
  /// must outlive the builder.
  MeshBuilder(std::string file, std::size_t first_number, std::string_view content, const ReadOptions& options);

  void reserve_vertices(std::size_t count) { mesh_.positions.reserve(count); }
  void reserve_triangles(std::size_t count) { mesh_.triangles.reserve(count); }
  std::size_t vertex_count() const { return mesh_.vertex_count(); }
  std::size_t triangle_count() const { return mesh_.face_count(); }
  const PerVertex<Vec3>& positions() const { return mesh_.positions; }

  void add_vertex(const Vec3& position, Place place);
  /// Unless such are kept, says which coordinate of `subject` ("vertex 3") is not finite.
  void refuse_non_finite(const Vec3& position, std::string_view subject, Place place) const;
  /// Corners count from 0 and may be any integers: those that no vertex can have are refused here or by `finish`.
  void add_polygon(std::span<const std::int64_t> corners, Place place);
  /// Triangles (a, b, c), (c, b, d), (c, d, e), ...; -1 (also as unsigned) starts the next strip. Triangles with two
  /// equal corners only lead from one part of a strip to the next, and are left out.
  void add_triangle_strips(std::span<const std::int64_t> corners, Place place);

  TriangleMesh finish();

 private:
  struct Polygon {
    std::uint32_t first_triangle, corner_count;
    Place place;
  };

  void tell(Place place);
  VertexId checked(std::int64_t corner, Place place);
  void add_triangle(VertexId a, VertexId b, VertexId c, Place place);
  [[noreturn]] void fail_on_index(std::int64_t corner, Place place) const;
  void triangulate(const Polygon& polygon);

  std::string file_;
  std::size_t first_number_;
  NonFinite non_finite_;
  std::string_view content_;
  ProgressMeter meter_;
  std::size_t lines_ = 0, items_ = 0;
  TriangleMesh mesh_;
  std::vector<Polygon> polygons_;  ///< of more than three corners; each stands in the mesh as a fan until `finish`
  std::vector<DividedFace>* divided_;
  std::int64_t highest_corner_ = -1;
  Place highest_corner_place_;
};

}  // namespace prohull
