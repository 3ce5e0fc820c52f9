#include "io/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mesh/triangulate_polygon.h"

namespace prohull {
namespace {

constexpr std::int64_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

bool is_restart(std::int64_t corner) { return corner == -1 || corner == kNoIndex; }

}  // namespace

MeshBuilder::MeshBuilder(std::string file, std::size_t first_number, std::string_view content,
                         const ReadOptions& options)
    : file_(std::move(file)),
      first_number_(first_number),
      non_finite_(options.non_finite),
      content_(content),
      meter_(options.progress, "read"),
      divided_(options.divided) {}

void MeshBuilder::tell(Place place) {
  constexpr std::size_t kInterval = 4096;
  if (++items_ % kInterval != 0) return;
  if (place.unit == Place::Unit::Byte) return meter_.at(place.number, content_.size());
  if (place.unit != Place::Unit::Line) return meter_.at(0);
  if (lines_ == 0) lines_ = 1 + static_cast<std::size_t>(std::ranges::count(content_, '\n'));
  meter_.at(place.number, lines_);
}

void MeshBuilder::add_vertex(const Vec3& position, Place place) {
  tell(place);
  if (!is_finite(position))
    refuse_non_finite(position, fmt::format("vertex {}", first_number_ + vertex_count()), place);
  if (vertex_count() == static_cast<std::size_t>(kNoIndex)) fail(file_, place, "more than 2^32 - 1 vertices");
  mesh_.positions.push_back(position);
}

void MeshBuilder::refuse_non_finite(const Vec3& position, std::string_view subject, Place place) const {
  if (non_finite_ == NonFinite::Keep) return;
  const int axis = !std::isfinite(position.x) ? 0 : !std::isfinite(position.y) ? 1 : 2;
  fail(file_, place,
       fmt::format("{} has {} = {}; coordinates must be finite; `prohull repair` drops such triangles", subject,
                   "xyz"[axis], position[axis]),
       Defect::NonFiniteCoordinate);
}

VertexId MeshBuilder::checked(std::int64_t corner, Place place) {
  if (corner < 0 || corner >= kNoIndex) fail_on_index(corner, place);
  if (corner > highest_corner_) highest_corner_ = corner, highest_corner_place_ = place;
  return VertexId(static_cast<std::uint32_t>(corner));
}

void MeshBuilder::fail_on_index(std::int64_t corner, Place place) const {
  const auto shown = corner + static_cast<std::int64_t>(first_number_);
  if (corner < 0)
    fail(file_, place, fmt::format("the face has vertex {}; vertices count from {}", shown, first_number_));
  fail(file_, place,
       fmt::format("the face has vertex {}, but the file has {} vertices, counted from {}", shown, vertex_count(),
                   first_number_));
}

void MeshBuilder::add_triangle(VertexId a, VertexId b, VertexId c, Place place) {
  if (mesh_.face_count() == static_cast<std::size_t>(kNoIndex)) fail(file_, place, "more than 2^32 - 1 triangles");
  mesh_.triangles.push_back({a, b, c});
}

void MeshBuilder::add_polygon(std::span<const std::int64_t> corners, Place place) {
  if (corners.empty()) return;
  tell(place);
  if (corners.size() < 3) {  // a point or an edge: no surface, but a hull covers it
    const VertexId first = checked(corners.front(), place), last = checked(corners.back(), place);
    add_triangle(first, last, last, place);
    return;
  }
  if (corners.size() > 3)
    polygons_.push_back(
        {static_cast<std::uint32_t>(mesh_.face_count()), static_cast<std::uint32_t>(corners.size()), place});
  const VertexId first = checked(corners[0], place);
  VertexId last = checked(corners[1], place);
  for (const std::int64_t corner : corners.subspan(2)) {
    const VertexId next = checked(corner, place);
    add_triangle(first, last, next, place);
    last = next;
  }
}

void MeshBuilder::add_triangle_strips(std::span<const std::int64_t> corners, Place place) {
  std::size_t length = 0;
  VertexId a{}, b{};
  for (const std::int64_t corner : corners) {
    if (is_restart(corner)) {
      length = 0;
      continue;
    }
    const VertexId c = checked(corner, place);
    if (length >= 2 && a != b && b != c && c != a) {
      if (length % 2 == 0)
        add_triangle(a, b, c, place);
      else
        add_triangle(b, a, c, place);
    }
    a = b, b = c, ++length;
  }
}

/// Replaces the fan of the polygon by triangles that do not overlap where it is not convex.
void MeshBuilder::triangulate(const Polygon& polygon) {
  const auto triangle = [&](std::uint32_t i) -> auto& { return mesh_.triangles[FaceId(polygon.first_triangle + i)]; };
  std::vector<VertexId> corners = {triangle(0)[0], triangle(0)[1]};
  for (std::uint32_t i = 0; i + 2 < polygon.corner_count; ++i) corners.push_back(triangle(i)[2]);
  const auto is_somewhere = [&](VertexId v) { return is_finite(mesh_.positions[v]); };
  if (!std::ranges::all_of(corners, is_somewhere)) return;  // it stays a fan
  const auto triangles = triangulate_polygon(corners, mesh_.positions);
  if (!triangles)
    fail(file_, polygon.place,
         fmt::format("a polygon with {} corners that is too intricate to triangulate; split it", polygon.corner_count));
  bool is_fan = true;
  for (std::uint32_t i = 0; i < triangles->size(); ++i)
    is_fan &= triangle(i) == (*triangles)[i], triangle(i) = (*triangles)[i];
  if (divided_ && !is_fan) divided_->push_back({FaceId(polygon.first_triangle), corners});
}

TriangleMesh MeshBuilder::finish() {
  if (highest_corner_ >= static_cast<std::int64_t>(vertex_count()))
    fail_on_index(highest_corner_, highest_corner_place_);
  for (const Polygon& polygon : polygons_) triangulate(polygon);
  return std::move(mesh_);
}

}  // namespace prohull
