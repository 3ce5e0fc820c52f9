#include "robot/motion/path_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "prohull/detail/finite.h"
#include "prohull/detail/inside_out.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "robot/link_triangles.h"
#include "robot/motion/joint_paths.h"

namespace prohull::robot {
namespace {

/// The closed shapes of a body, and its others.
struct Shapes {
  TriangleMesh closed, open;
  TriangleMesh within;  // as closed, but within curved shapes
  bool are_curved = false;
  std::vector<std::string> notes;

  /// What stands for a curved shape.
  void add(const TriangleMesh& around, const TriangleMesh& inside) {
    append(closed, around), append(within, inside);
    are_curved = true;
  }

  void add(TriangleMesh mesh, const std::string& name) {
    mesh = with_finite_faces(std::move(mesh));
    if (mesh.face_count() == 0) return;
    if (!is_closed(mesh)) return append(open, mesh);
    const OutwardSolid solid = outward_solid(std::move(mesh), name);
    if (!solid.turned.empty()) notes.push_back(solid.turned);
    append(closed, solid.mesh), append(within, solid.mesh);
  }

  std::optional<ProofBody> shape() const {
    std::vector<TriangleMesh> meshes, meshes_within;
    for (const TriangleMesh* const mesh : {&closed, &open})
      if (mesh->face_count() > 0) meshes.push_back(*mesh);
    for (const TriangleMesh* const mesh : {&within, &open})
      if (are_curved && mesh->face_count() > 0) meshes_within.push_back(*mesh);
    return meshes.empty() ? std::nullopt : std::optional<ProofBody>(std::in_place, meshes, meshes_within);
  }

  void give(PathBody& body) const {
    body.shape = shape();
    body.notes = notes;
    body.triangles = closed;
    append(body.triangles, open);
  }
};

bool has_finite_faces(const TriangleMesh& mesh) { return with_finite_faces(mesh).face_count() == mesh.face_count(); }

void require_distinct_names(std::span<const PathBody> bodies) {
  std::set<std::string> names;
  for (const PathBody& body : bodies)
    if (!names.insert(body.name).second)
      refuse(fmt::format("two bodies are called '{}'; give the mesh of the world another name", body.name));
}

std::size_t body_called(std::span<const PathBody> bodies, const std::string& name) {
  const auto found = std::ranges::find(bodies, name, &PathBody::name);
  if (found != bodies.end()) return static_cast<std::size_t>(found - bodies.begin());
  std::vector<std::string> names;
  for (const PathBody& body : bodies) names.push_back(body.name);
  refuse(fmt::format("no link with geometry and no mesh of the world is called '{}'; there are {}", name,
                     fmt::join(names, ", ")));
}

std::string open_note(const PathBody& body) {
  const bool is_closed = !body.shape || std::ranges::all_of(body.shape->parts, &CollisionIndex::is_solid);
  return !is_closed ? fmt::format("{}: not closed: only its faces count, not what lies inside", body.name) : "";
}

}  // namespace

PathBody link_body(const Robot& robot, std::size_t link, Geometry which) {
  PathBody body{robot.links[link].name, link};
  Shapes all;
  const bool is_one = shapes(robot.links[link], which).size() == 1;
  const std::string name = is_one ? body.name : "a mesh of " + body.name;
  for (const Shape& shape : shapes(robot.links[link], which)) {
    if (const auto* const other = std::get_if<OtherForm>(&shape.form))
      body.unread = fmt::format("its geometry of type {} is not read", other->what);
    TriangleMesh mesh = link_triangles({&shape, 1}, {});
    if (shape.mesh() && mesh.face_count() == 0) body.unread = "a mesh of it has no triangles";
    if (!has_finite_faces(mesh)) body.unread = "a mesh of it has corners that are not finite";
    if (curved_form(shape.form))
      all.add(mesh, placed(shape.origin, form_mesh(shape.form, Curved::Within)));
    else
      all.add(std::move(mesh), name);
  }
  all.give(body);
  if (const auto& only = shapes(robot.links[link], which); only.size() == 1 && only[0].mesh())
    body.file = only[0].mesh()->path, body.in_link = only[0].origin;
  return body;
}

PathBody path_body(std::string name, std::optional<std::size_t> link, const TriangleMesh& mesh) {
  Shapes all;
  all.add(mesh, name);
  PathBody body{std::move(name), link};
  all.give(body);
  return body;
}

PathBodies path_bodies(const Robot& robot, Geometry which, std::span<const WorldMesh> world, const Progress& progress) {
  PathBodies made;
  const Geometry other = which == Geometry::Visual ? Geometry::Collision : Geometry::Visual;
  std::vector<std::string> replaced;
  ProgressMeter meter(progress, "index");
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    meter.at(link, robot.links.size());
    const bool has_it = !shapes(robot.links[link], which).empty();
    PathBody body = link_body(robot, link, has_it ? which : other);
    if (!body.shape && body.unread.empty()) continue;
    if (!has_it) replaced.push_back(body.name);
    made.bodies.push_back(std::move(body));
  }
  if (!replaced.empty())
    made.notes.push_back(fmt::format("links without {} geometry, so that their {} geometry counts: {}",
                                     prohull::name_of(geometry_names(), which),
                                     prohull::name_of(geometry_names(), other), fmt::join(replaced, ", ")));
  for (const WorldMesh& mesh : world) {
    meter.go_on();
    if (mesh.mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, mesh.name + ": no triangles");
    if (!has_finite_faces(mesh.mesh))
      throw InputError(Defect::NonFiniteCoordinate, mesh.name + ": corners of triangles are not finite");
    made.bodies.push_back(path_body(mesh.name, {}, mesh.mesh));
  }
  require_distinct_names(made.bodies);
  for (const PathBody& body : made.bodies) {
    if (!body.unread.empty()) made.notes.push_back(fmt::format("{}: {}", body.name, body.unread));
    made.notes.insert(made.notes.end(), body.notes.begin(), body.notes.end());
    if (std::string note = open_note(body); !note.empty()) made.notes.push_back(std::move(note));
  }
  return made;
}

std::vector<BodyPair> pairs_on_path(const Robot& robot, std::span<const PathBody> bodies,
                                    std::span<const LinkPair> links,
                                    std::span<const std::pair<std::string, std::string>> names) {
  std::set<BodyPair> ignored;
  for (const auto& [a, b] : names) ignored.insert(std::minmax({body_called(bodies, a), body_called(bodies, b)}));
  const JointPaths joints(robot);
  const auto are_ignored_links = [&](std::size_t a, std::size_t b) {
    return joints.are_adjacent(a, b) || std::ranges::find(links, LinkPair(std::minmax(a, b))) != links.end();
  };
  std::vector<BodyPair> pairs;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const auto &link_a = bodies[a].link, &link_b = bodies[b].link;
      if ((!link_a && !link_b) || ignored.contains({a, b})) continue;
      if (link_a && link_b && are_ignored_links(*link_a, *link_b)) continue;
      pairs.emplace_back(a, b);
    }
  return pairs;
}

}  // namespace prohull::robot
