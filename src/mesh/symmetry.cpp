#include "prohull/detail/symmetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/triangle_key.h"
#include "mesh/mirror_images.h"

namespace prohull {
namespace {

constexpr std::array<std::pair<std::string_view, Axis>, 3> kAxisNames{{{"x", Axis::X}, {"y", Axis::Y}, {"z", Axis::Z}}};

using PlacedCorner = std::array<double, 3>;

PlacedCorner corner(const Vec3& p) { return {p.x, p.y, p.z}; }

std::ptrdiff_t count(const std::vector<TriangleKey>& sorted, const TriangleKey& key) {
  const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), key);
  return last - first;
}

class Inspection {
 public:
  Inspection(const TriangleMesh& mesh, Axis axis)
      : mesh_(mesh), axis_(axis), plane_(mirror_plane_of(finite_bounding_box(mesh), axis)) {
    const Box box = finite_bounding_box(mesh);
    if (!box.is_empty()) report_.plane = box.center()[static_cast<int>(axis)];
    if (plane_) report_.plane = plane_->coordinate();
  }

  SymmetryReport run() {
    inspect_vertices();
    inspect_faces();
    return std::move(report_);
  }

 private:
  std::optional<Vec3> image_of(const Vec3& p) const { return plane_ && is_finite(p) ? plane_->image(p) : std::nullopt; }

  std::optional<TriangleKey> key_of_image(const Triangle& t) const {
    const auto a = image_of(t.a), b = image_of(t.b), c = image_of(t.c);
    return a && b && c ? std::optional(oriented_key({*a, *c, *b})) : std::nullopt;
  }

  void inspect_vertices() {
    PerVertex<char> is_used(mesh_.vertex_count(), 0);
    for (const auto& corners : mesh_.triangles)
      for (const VertexId v : corners) is_used[v] = 1;
    std::vector<PlacedCorner> places;
    for (const VertexId v : is_used.ids())
      if (is_used[v] && is_finite(mesh_.positions[v])) places.push_back(corner(mesh_.positions[v]));
    std::ranges::sort(places);
    for (const VertexId v : is_used.ids()) {
      if (!is_used[v]) continue;
      const auto image = image_of(mesh_.positions[v]);
      if (image && std::ranges::binary_search(places, corner(*image))) continue;
      ++report_.vertices_without_image;
      note("vertex", index(v), mesh_.positions[v]);
    }
  }

  // Of faces that lie on each other there must be as many on the other side.
  void inspect_faces() {
    std::vector<TriangleKey> keys;
    for (const FaceId f : mesh_.triangles.ids())
      if (const Triangle t = mesh_.triangle(f); key_of_image(t)) keys.push_back(oriented_key(t));
    std::ranges::sort(keys);
    for (const FaceId f : mesh_.triangles.ids()) {
      const Triangle t = mesh_.triangle(f);
      const auto image = key_of_image(t);
      if (image && count(keys, *image) == count(keys, oriented_key(t))) continue;
      ++report_.faces_without_image;
      note("face", index(f), t.a);
    }
  }

  void note(const char* what, std::uint32_t number, const Vec3& p) {
    if (report_.first_defect.empty())
      report_.first_defect = fmt::format("{} {} at ({:g}, {:g}, {:g}) has no mirror image in the plane {} = {:g}", what,
                                         number, p.x, p.y, p.z, name_of(axis_names(), axis_), report_.plane);
  }

  const TriangleMesh& mesh_;
  const Axis axis_;
  const std::optional<MirrorPlane> plane_;
  SymmetryReport report_;
};

}  // namespace

Names<Axis> axis_names() { return kAxisNames; }

SymmetryReport inspect_symmetry(const TriangleMesh& mesh, Axis axis) { return Inspection(mesh, axis).run(); }

}  // namespace prohull
