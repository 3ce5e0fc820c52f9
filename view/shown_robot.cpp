#include "view/shown_robot.h"

#include "prohull/collide.h"
#include "prohull/error.h"
#include "robot/link_triangles.h"

namespace prohull::view {
namespace {

using namespace prohull::robot;

void tell(const Progress& progress, std::size_t done, std::size_t all) {
  if (progress && !progress("read", static_cast<double>(done) / static_cast<double>(all))) throw Cancelled();
}

/// The shapes whose meshes were found.
std::vector<Shape> found(const std::vector<Shape>& shapes) {
  std::vector<Shape> result;
  for (const Shape& shape : shapes)
    if (!shape.mesh() || !shape.mesh()->path.empty()) result.push_back(shape);
  return result;
}

std::vector<Shape> picked(const std::vector<Shape>& shapes, const std::vector<std::size_t>& places) {
  std::vector<Shape> result;
  for (const std::size_t i : places) result.push_back(shapes[i]);
  return result;
}

/// What the link collides with once the hulls are written, in its frame.
TriangleMesh new_collision(const Link& link, const LinkHulls& made, Geometry from) {
  if (made.status == LinkStatus::Primitives) return link_triangles(shapes(link, from), {});
  if (made.hulls.empty()) return link_triangles(found(link.collision), {});
  TriangleMesh mesh = placed(made.frame.in_link, made.hulls.front().mesh);
  append(mesh, link_triangles(picked(shapes(link, from), made.primitives), {}));
  return mesh;
}

}  // namespace

ShownRobot as_shipped(const Robot& robot, const Progress& progress) {
  ShownRobot shown{robot, {}, {}};
  for (const Link& link : robot.links) {
    tell(progress, shown.visual.size(), robot.links.size());
    shown.visual.push_back(link_triangles(link.visual, {}));
    shown.collision.push_back(link_triangles(link.collision, {}));
  }
  return shown;
}

ShownRobot with_hulls(const Robot& robot, std::span<const LinkHulls> hulls, Geometry from, const Progress& progress) {
  ShownRobot shown{robot, {}, {}};
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    tell(progress, i, robot.links.size());
    shown.visual.push_back(link_triangles(found(robot.links[i].visual), {}));
    shown.collision.push_back(new_collision(robot.links[i], hulls[i], from));
  }
  return shown;
}

}  // namespace prohull::view
