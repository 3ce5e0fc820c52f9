#include "robot/motion/bodies.h"

#include <algorithm>
#include <utility>

#include "prohull/convex_hull.h"
#include "prohull/detail/finite.h"
#include "robot/motion/proof_body.h"

namespace prohull::robot {

namespace {

void append_primitives(const Robot& robot, const LinkHulls& link, Geometry from, Curved curved, TriangleMesh& mesh) {
  for (const std::size_t i : link.primitives) {
    const Shape& shape = shapes(robot.links[link.link], from)[i];
    append(mesh, placed(shape.origin, form_mesh(shape.form, curved)));
  }
}

/// The hull with the primitives that are kept; empty if it is not certified.
TriangleMesh hull_in_link(const Robot& robot, const LinkHulls& link, Geometry from, std::size_t set,
                          Curved curved = Curved::Around) {
  const bool is_hulled = link.status == LinkStatus::Hulled;
  if (is_hulled && !link.hulls[set].certified()) return {};
  TriangleMesh hull;
  if (is_hulled && curved == Curved::Within && !link.hulls[set].balls.empty())
    hull = placed(link.frame.in_link, mesh_of({}, link.hulls[set].balls, curved));
  else if (is_hulled && robot.fills_collision_meshes && link.hulls[set].pieces.empty() && link.hulls[set].balls.empty())
    hull = placed(link.frame.in_link, convex_hull(link.hulls[set].mesh));
  else if (is_hulled)
    hull = placed(link.frame.in_link, link.hulls[set].mesh);
  append_primitives(robot, link, from, curved, hull);
  return hull;
}

bool is_curved(const Shape& shape) { return curved_form(shape.form).has_value(); }

/// Empty if no shape is curved.
TriangleMesh visual_within(const Robot& robot, const LinkHulls& link, Geometry from) {
  const std::vector<Shape>& all = shapes(robot.links[link.link], from);
  const bool is_read = link.status == LinkStatus::Hulled || link.status == LinkStatus::Primitives;
  if (!is_read || std::ranges::none_of(all, is_curved)) return {};
  TriangleMesh mesh;
  for (const Shape& shape : all)
    append(mesh, is_curved(shape) ? placed(shape.origin, form_mesh(shape.form, Curved::Within))
                                  : link_triangles({&shape, 1}, {}));
  return mesh;
}

/// Empty if nothing in the hull is curved.
TriangleMesh hull_within(const Robot& robot, const LinkHulls& link, Geometry from, std::size_t set) {
  const std::vector<Shape>& all = shapes(robot.links[link.link], from);
  const bool has_balls = link.status == LinkStatus::Hulled && !link.hulls[set].balls.empty();
  if (!has_balls && std::ranges::none_of(link.primitives, [&](std::size_t i) { return is_curved(all[i]); })) return {};
  return hull_in_link(robot, link, from, set, Curved::Within);
}

}  // namespace

Bodies bodies_of(const Robot& robot, std::span<const LinkHulls> links, Geometry from, std::size_t set) {
  Bodies bodies;
  for (const LinkHulls& link : links) {
    TriangleMesh visual;
    if (link.status == LinkStatus::Hulled) visual = placed(link.frame.in_link, link.triangles);
    append_primitives(robot, link, from, Curved::Around, visual);
    bodies.convex.push_back(convex_hull(visual));
    bodies.visual.push_back(std::move(visual));
    bodies.hull.push_back(hull_in_link(robot, link, from, set));
    bodies.visual_within.push_back(visual_within(robot, link, from));
    bodies.hull_within.push_back(hull_within(robot, link, from, set));
  }
  return bodies;
}

std::vector<std::optional<CertifiedBody>> certified_bodies(const Robot& robot, std::span<const LinkHulls> links,
                                                           std::span<const HullFiles> hulls, Geometry from) {
  std::vector<std::optional<CertifiedBody>> bodies(robot.links.size());
  for (const LinkHulls& link : links) {
    CertifiedBody& body =
        bodies[link.link].emplace(CertifiedBody{.name = robot.links[link.link].name, .link = link.link});
    const auto files = std::ranges::find_if(
        hulls, [&](const HullFiles& of) { return of.link == link.link && of.set == 0 && of.meshes.size() == 1; });
    if (link.primitives.empty() && files != hulls.end() && files->meshes[0].extension() == ".stl" &&
        !robot.fills_collision_meshes)
      body.stl = files->meshes[0], body.in_link = link.frame.in_link;
    else
      body.triangles = with_finite_faces(hull_in_link(robot, link, from, 0));
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
