#include "robot/motion/bodies.h"

#include <utility>

#include "prohull/convex_hull.h"

namespace prohull::robot {

Bodies bodies_of(const Robot& robot, std::span<const LinkHulls> links, Geometry from, std::size_t set) {
  Bodies bodies;
  for (const LinkHulls& link : links) {
    TriangleMesh visual, hull;
    if (link.status == LinkStatus::Hulled) {
      visual = placed(link.frame.in_link, link.triangles);
      hull = placed(link.frame.in_link, link.hulls[set].mesh);
    }
    for (const std::size_t i : link.primitives) {
      const Shape& shape = shapes(robot.links[link.link], from)[i];
      const TriangleMesh primitive = placed(shape.origin, form_mesh(shape.form, Curved::Around));
      append(visual, primitive), append(hull, primitive);
    }
    if (link.status == LinkStatus::Hulled && !link.hulls[set].certified) hull = {};
    bodies.convex.push_back(convex_hull(visual));
    bodies.visual.push_back(std::move(visual));
    bodies.hull.push_back(std::move(hull));
  }
  return bodies;
}

TriangleMesh at_rest(const Robot& robot, std::span<const TriangleMesh> links) {
  const std::vector<Pose> poses = link_poses(robot, rest_positions(robot));
  TriangleMesh whole;
  for (std::size_t i = 0; i < links.size(); ++i) append(whole, placed(poses[i], links[i]));
  return whole;
}

}  // namespace prohull::robot
