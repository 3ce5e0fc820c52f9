#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/refuse.h"
#include "render/compose.h"
#include "render/draw.h"
#include "render/pieces.h"
#include "robot/hulls/link_hulls.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

/// Of a bigger original the picture would take a moment, and shows the hull alone.
constexpr std::size_t kMostFacesInside = 100'000;

std::string png_of(render::PanelPlan plan, const TriangleMesh& mesh, const TriangleMesh* inside, int width, int height,
                   Watch& watch) {
  std::vector<TriangleMesh> meshes{with_finite_faces(mesh)};
  if (inside) plan.line_width = 1;
  if (inside && inside->face_count() <= kMostFacesInside) {
    plan.inside = meshes.size();
    meshes.push_back(with_finite_faces(*inside));
  }
  const auto panels = render::compose({std::move(plan)}, meshes, {}, width, height);
  return render::encode_png(
      render::draw(width, height, panels, {.background = render::Rgb{1, 1, 1}, .progress = watch.progress()}));
}

void check_size(int width, int height) {
  if (std::min(width, height) < 1 || std::max(width, height) > render::Image::kMaxSide)
    refuse("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
           " pixels: expected sides of 1 to " + std::to_string(render::Image::kMaxSide));
}

/// A PNG picture of a mesh, drawn as a hull if there is something inside.
py::bytes picture(const TriangleMesh& mesh, const TriangleMesh* inside, int width, int height) {
  check_size(width, height);
  render::PanelPlan plan;
  plan.color = *render::parse_color(inside ? "blue" : "clay");
  return watched(py::none(), [&](Watch& watch) { return png_of(plan, mesh, inside, width, height, watch); });
}

/// Of convex pieces, or of balls as rows of four numbers, each in a colour of its own.
py::bytes picture_of_parts(const std::vector<SharedMesh>& pieces, const Array<double>& balls, int width, int height) {
  check_size(width, height);
  return watched(py::none(), [&](Watch& watch) {
    std::vector<TriangleMesh> meshes;
    for (const SharedMesh& piece : pieces) meshes.push_back(*piece);
    render::Exploded parts = render::exploded(robot::mesh_of(meshes, balls_of(balls)), 0);
    render::PanelPlan plan;
    plan.face_colors = std::move(parts.colors);
    return png_of(std::move(plan), parts.mesh, nullptr, width, height, watch);
  });
}

}  // namespace

void bind_pictures(py::module_& module) {
  module.def("picture", &picture);
  module.def("picture_of_parts", &picture_of_parts);
}

}  // namespace prohull::python
