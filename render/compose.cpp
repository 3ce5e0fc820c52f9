#include "render/compose.h"

#include <limits>

#include "render/marks.h"

namespace prohull::render {
namespace {

using Bodies = std::vector<std::shared_ptr<const Body>>;

double crease_angle(const TriangleMesh& mesh, const Look& look) {
  constexpr std::size_t kTooSmallToSee = 10000;  // faces
  constexpr double kCrease = 40 * std::numbers::pi / 180;
  return look.crease_angle.value_or(mesh.face_count() >= kTooSmallToSee ? kCrease : 0);
}

Placement placement(const std::vector<TriangleMesh>& meshes) {
  Box box;
  for (const TriangleMesh& mesh : meshes) box.extend(bounding_box(mesh));
  return Placement(box);
}

Bodies bodies(const std::vector<TriangleMesh>& meshes, const Placement& placed, const Look& look) {
  Bodies result;
  for (const TriangleMesh& mesh : meshes)
    result.push_back(std::make_shared<const Body>(placed(mesh), crease_angle(mesh, look)));
  return result;
}

void append_used_positions(const TriangleMesh& mesh, std::vector<Vec3>& points) {
  PerVertex<char> used(mesh.vertex_count(), false);
  for (const auto& triangle : mesh.triangles)
    for (const VertexId v : triangle) used[v] = true;
  for (const VertexId v : used.ids())
    if (used[v]) points.push_back(mesh.positions[v]);
}

std::vector<Surface> surfaces(const PanelPlan& plan, const Bodies& bodies, const Look& look) {
  constexpr double kMiddle = 0.5;
  const Rgb clay = *parse_color("clay");
  const Material edged{plan.color, plan.inside ? look.opacity : 1, plan.line_width};
  std::vector<Surface> result{{.body = bodies[plan.shown], .material = edged, .colors = plan.face_colors}};
  if (plan.inside) result.push_back({bodies[*plan.inside], {plan.inside_color.value_or(clay)}});
  if (plan.right) {
    for (Surface& surface : result) surface.to = kMiddle;
    result.push_back({bodies[*plan.right], {clay}, kMiddle, 1});
  }
  return result;
}

/// Below everything that casts a shadow.
double ground_height(const std::vector<Surface>& surfaces, int up) {
  double height = std::numeric_limits<double>::infinity();
  for (const Surface& surface : surfaces)
    if (!surface.is_translucent()) height = std::min(height, bounding_box(surface.body->mesh).min[up]);
  return height;
}

Surface mark(const TriangleMesh& mesh, const Rgb& color) {
  constexpr double kCrease = std::numbers::pi / 3, kThrough = 0.4;
  return {std::make_shared<const Body>(mesh, kCrease), {.color = color, .through = kThrough}};
}

TriangleMesh balls(const Segment& segment, const std::vector<double>& fractions, double radius) {
  TriangleMesh mesh;
  for (const double t : fractions) append(mesh, ball(segment.a + t * (segment.b - segment.a), radius));
  return mesh;
}

/// Dotted from the first to the last crossing that was missed.
TriangleMesh line(const Segment& segment, const std::vector<double>& missed, double radius) {
  constexpr double kPeriod = 8;  // radii
  if (missed.empty()) return rod(segment, radius);
  const auto at = [&](double t) { return segment.a + t * (segment.b - segment.a); };
  const Vec3 from = at(missed.front()), to = at(missed.back());
  TriangleMesh mesh = rod({segment.a, from}, radius);
  append(mesh, dashes({from, to}, radius, kPeriod * radius));
  append(mesh, rod({to, segment.b}, radius));
  return mesh;
}

/// The marks have the same size in every picture, however near the camera is.
std::vector<Surface> marks(const MarkedSegment& marked, const Placement& placed, double zoom) {
  const double rod_radius = 0.003 / zoom, ball_radius = 0.012 / zoom;
  const Segment segment{placed(marked.segment.a), placed(marked.segment.b)};
  std::vector<Surface> result{mark(line(segment, marked.missed, rod_radius), *parse_color("black"))};
  if (!marked.found.empty()) result.push_back(mark(balls(segment, marked.found, ball_radius), *parse_color("green")));
  if (!marked.missed.empty()) result.push_back(mark(balls(segment, marked.missed, ball_radius), *parse_color("red")));
  return result;
}

Scene scene(const PanelPlan& plan, const Bodies& bodies, const Placement& placed, const Look& look) {
  Scene result{surfaces(plan, bodies, look), {}};
  if (look.ground) result.ground = ground_height(result.surfaces, look.view.up);
  if (plan.segment)
    for (Surface& surface : marks(*plan.segment, placed, plan.zoom)) result.surfaces.push_back(std::move(surface));
  return result;
}

View view(const PanelPlan& plan, const Placement& placed, const Look& look) {
  View result = look.view;
  result.zoom = plan.zoom;
  if (plan.center) result.center = placed(*plan.center);
  return result;
}

}  // namespace

std::vector<Panel> compose(const std::vector<PanelPlan>& plans, const std::vector<TriangleMesh>& meshes,
                           const Look& look, int width, int height) {
  const Placement placed = placement(meshes);
  const Bodies ready = bodies(meshes, placed, look);
  std::vector<Vec3> points;
  for (const auto& body : ready) append_used_positions(body->mesh, points);
  std::vector<Panel> panels;
  const int count = static_cast<int>(plans.size());
  for (int i = 0; i < count; ++i) {
    const PanelPlan& plan = plans[static_cast<std::size_t>(i)];
    panels.push_back({scene(plan, ready, placed, look),
                      Camera(view(plan, placed, look), points, width / count, height),
                      {i * width / count, 0, (i + 1) * width / count, height}});
  }
  return panels;
}

}  // namespace prohull::render
