#include "view/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "prohull/detail/finite.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "robot/json.h"
#include "view/blocks.h"
#include "view/facts.h"
#include "view/heat.h"
#include "view/levels.h"
#include "view/motion.h"
#include "view/robot.h"
#include "view/shared_faces.h"

namespace prohull::view {
namespace {

using nlohmann::json;

/// Faces and vertices keep their order, so that the page knows their numbers.
TriangleMesh drawable(const TriangleMesh& mesh, const std::string& name) {
  TriangleMesh finite = finite_part(mesh);
  if (finite.face_count() == 0) throw InputError(Defect::EmptyMesh, name + ": it has no finite face to show");
  return finite;
}

/// What is drawn lies in it.
struct BoxOf {
  Box operator()(const TriangleMesh& mesh) const { return finite_bounding_box(mesh); }
  Box operator()(const Pieces& pieces) const { return finite_bounding_box(together(pieces)); }
  Box operator()(const ProgressiveHull& hull) const {
    Box box;
    for (const Vec3& p : hull.positions()) box.extend(p);
    return box;
  }
  Box operator()(const ShownRobot& shown) const {
    Box box = drawn_box(shown);
    for (const auto* const meshes : {&shown.visual, &shown.collision})
      for (const TriangleMesh& mesh : *meshes) box.extend(finite_bounding_box(mesh));  // where its numbers are
    return box;
  }
  Box operator()(const Balls& balls) const {
    Box box;
    for (const Ball& ball : balls) {
      const Vec3 reach{ball.radius, ball.radius, ball.radius};
      box.extend(ball.center - reach), box.extend(ball.center + reach);
    }
    return box;
  }
};

/// The mesh that hulls are compared with.
struct Reference {
  explicit Reference(TriangleMesh given) : mesh(std::move(given)), index(mesh) {}
  TriangleMesh mesh;
  QueryIndex index;
};

class Writer {
 public:
  Writer(const std::vector<Shown>& shown, const std::optional<Original>& original, const PageOptions& options)
      : options_(options), grid_(scene_box(shown, original)) {
    if (original) {
      given_ = &*original;
      reference_.emplace(drawable(given_->mesh, given_->name));
    }
    json objects = json::array();
    for (const Shown& s : shown) {
      json facts = std::visit([&](const auto& shape) { return object(s, shape); }, s.shape);
      facts["name"] = s.name;
      objects.push_back(facts);
    }
    if (original) {
      json facts = mesh_object(given_->mesh, reference_->mesh);
      facts["name"] = original->name;
      facts["role"] = "original";
      objects.push_back(facts);
    }
    scene_ = {{"version", options.version}, {"unit", options.unit}, {"grid", grid_.facts()}, {"objects", objects}};
  }

  Scene scene() && { return {std::move(scene_), std::move(blocks_)}; }

 private:
  static Box scene_box(const std::vector<Shown>& shown, const std::optional<Original>& original) {
    Box box;
    for (const Shown& s : shown) box.extend(std::visit(BoxOf{}, s.shape));
    if (original) box.extend(BoxOf{}(original->mesh));
    return box;
  }

  BatchOptions batch() const { return {.threads = options_.threads, .progress = options_.progress}; }

  json object(const Shown& shown, const TriangleMesh& given) {
    const TriangleMesh mesh = drawable(given, shown.name);
    json facts = mesh_object(given, mesh);
    if (!reference_) return facts;
    facts["verification"] = verification_facts(shown, *given_, options_);
    facts["distance"] = distance_facts(mesh, reference_->mesh, options_);
    facts["heat"] = heat_facts(mesh, reference_->index, false, batch(), blocks_);
    return facts;
  }

  json object(const Shown& shown, const ProgressiveHull& hull) {
    if (reference_) return levels_object(shown, hull, *given_, *reference_);
    const Original finest{"the finest level", hull.original()};
    return levels_object(shown, hull, finest, Reference(finest.mesh));
  }

  json object(const Shown& shown, const Pieces& pieces) {
    const TriangleMesh all = together(pieces), mesh = drawable(all, shown.name);
    json facts = mesh_object(all, mesh);
    facts["union"] = counted(pieces.size(), "piece");
    if (!reference_) return facts;
    add_union_facts(facts, shown, pieces);
    if (is_closed(reference_->mesh)) facts["heat"] = heat_facts(mesh, reference_->index, true, batch(), blocks_);
    return facts;
  }

  json object(const Shown& shown, const Balls& balls) {
    if (balls.empty()) throw InputError(Defect::EmptyMesh, shown.name + ": it has no sphere to show");
    std::vector<std::uint32_t> centers, radii;
    for (const Ball& ball : balls) {
      for (const std::uint32_t q : grid_(ball.center)) centers.push_back(q);
      radii.push_back(static_cast<std::uint32_t>(ball.radius / grid_.step()));
    }
    json facts = {{"kind", "balls"},
                  {"union", counted(balls.size(), "sphere")},
                  {"centers", blocks_.plain(centers)},
                  {"radii", blocks_.plain(radii)}};
    facts["role"] = "hull";
    if (reference_) add_union_facts(facts, shown, balls);
    return facts;
  }

  json object(const Shown& shown, const ShownRobot& robot) {
    const Box box = drawn_box(robot);
    if (box.is_empty()) throw InputError(Defect::EmptyMesh, shown.name + ": the robot has no geometry to draw");
    std::vector<std::uint32_t> corners;
    for (const Vec3& corner : {box.min, box.max})
      for (const std::uint32_t q : grid_(corner)) corners.push_back(q);
    json links = json::array();
    for (std::size_t i = 0; i < robot.robot.links.size(); ++i)
      links.push_back({{"name", robot.robot.links[i].name},
                       {"visual", link_object(shown, robot.visual[i])},
                       {"collision", link_object(shown, robot.collision[i])}});
    json facts = {{"role", "hull"}, {"kind", "robot"}, {"links", links}, {"joints", joint_facts(robot.robot)}};
    facts["corners"] = blocks_.plain(corners);
    facts.update(disabled_facts(robot, options_.threads));
    if (robot.motion) facts["motion"] = motion_facts(*robot.motion);
    return facts;
  }

  json link_object(const Shown& shown, const TriangleMesh& mesh) {
    if (mesh.face_count() == 0) return {};
    return mesh_object(mesh, drawable(mesh, shown.name));
  }

  template <class Parts>
  void add_union_facts(json& facts, const Shown& shown, const Parts& parts) const {
    facts["verification"] = verification_facts(shown, *given_, options_);
    if (!facts["verification"].contains("refused"))
      facts["distance"] = distance_facts(parts, reference_->mesh, options_);
  }

  json mesh_object(const TriangleMesh& given, const TriangleMesh& mesh) {
    std::vector<std::uint32_t> positions, triangles;
    for (const Vec3& p : mesh.positions)
      for (const std::uint32_t q : grid_(p)) positions.push_back(q);
    for (const auto& t : mesh.triangles)
      for (const VertexId v : t) triangles.push_back(index(v));
    return {{"role", "hull"},
            {"kind", "mesh"},
            {"facts", mesh_facts(mesh)},
            {"left_out", given.face_count() - mesh.face_count()},
            {"left_out_vertices", given.vertex_count() - mesh.vertex_count()},
            {"positions", blocks_.running(positions, 3)},
            {"triangles", blocks_.running(triangles, 1)}};
  }

  json levels_object(const Shown& shown, const ProgressiveHull& hull, const Original& given,
                     const Reference& reference) {
    const bool is_own = !reference_;
    json facts = levels_facts(hull, distances_of(hull, reference, is_own), grid_, blocks_);
    facts["role"] = "hull";
    facts["kind"] = "levels";
    facts["side"] = name_of(hull_side_names(), hull.side());
    facts["finest_level"] = name_of(finest_level_names(), hull.finest_level());
    facts["base_faces"] = hull.base_face_count();
    facts["original_faces"] = hull.original_face_count();
    facts["original_shown"] = !is_own;
    facts["verification"] = verification_facts(shown, given, options_);
    if (is_closed(reference.mesh)) add_volumes(facts, hull, turned_outwards(reference.mesh));
    facts["stops"] = stops_of(hull, reference);
    return facts;
  }

  PerVertex<double> distances_of(const ProgressiveHull& hull, const Reference& reference, bool is_own) const {
    const std::vector<Vec3> points(hull.positions().begin(), hull.positions().end());
    PerVertex<double> distances(points.size(), 0);
    const std::size_t first = is_own ? hull.original_vertex_count() : 0;  // those before lie on the original
    const auto closest = closest_points(reference.index, std::span(points).subspan(first),
                                        std::numeric_limits<double>::infinity(), batch());
    for (std::size_t i = 0; i < closest.size(); ++i)
      distances[VertexId(static_cast<std::uint32_t>(first + i))] = closest[i]->distance;
    return distances;
  }

  /// Whether no part of the mesh lies in another one, so that the signed volume is that of the solid.
  static bool counts_once(const TriangleMesh& mesh) {
    constexpr double kRounding = 1e-9;
    const double with_overlaps = signed_volume(mesh);
    const auto solid = solid_volume(mesh);
    return solid && std::abs(with_overlaps - *solid) <= kRounding * *solid;
  }

  /// Signed volumes of the levels, where these count nothing twice: the winding numbers of each level lie between those
  /// of the base mesh and of the finest one, and these are 0 or 1 everywhere.
  void add_volumes(json& facts, const ProgressiveHull& hull, const TriangleMesh& original) {
    if (!counts_once(original) || !counts_once(hull.base())) return;
    const double volume = signed_volume(original);
    std::vector<std::uint32_t> ratios;
    for (const double v : volumes_of_levels(hull))
      ratios.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(v / volume - 1)));
    facts["void_ratios"] = blocks_.running(ratios, 1);
  }

  /// Levels whose farthest point is searched: from the base mesh on, each finer by half than the one before.
  /// "until_next" bounds the distance of all levels between such a level and the next one. Nesting alone does not bound
  /// it: a level may close a cavity, and finer levels lie deep in that. Without PageOptions::measures_levels, the base
  /// mesh alone.
  json stops_of(const ProgressiveHull& hull, const Reference& reference) const {
    json stops = json::array();
    MadeFaces made(hull);
    const SharedFaces shared(reference.mesh);
    if (!options_.measures_levels) {
      json stop = reach_of(shared.left_out_of(hull.level(0)), reference);
      stop["faces"] = hull.base_face_count();
      return json::array({stop});
    }
    for (std::size_t faces = hull.base_face_count();; faces = std::min(faces + faces / 2, hull.original_face_count())) {
      const TriangleMesh level = hull.level(faces);
      const json new_faces = reach_of(shared.left_out_of(made.until(splits_before(hull, faces))), reference);
      if (!stops.empty()) {
        double& bound = stops.back()["until_next"].get_ref<double&>();
        bound = std::max(bound, new_faces["upper"].get<double>());
      }
      json stop = reach_of(shared.left_out_of(level), reference);
      stop["faces"] = level.face_count();
      stop["until_next"] = stop["upper"];
      stops.push_back(stop);
      if (faces == hull.original_face_count()) return stops;
    }
  }

  /// How far faces that the original does not have reach out of it, if there are any.
  json reach_of(const TriangleMesh& faces, const Reference& reference) const {
    if (faces.face_count() > 0) return distance_facts(faces, reference.mesh, options_);
    return {{"lower", 0.0}, {"upper", 0.0}, {"farthest", reference.mesh.triangle(FaceId{0}).a}};
  }

  static std::size_t splits_before(const ProgressiveHull& hull, std::size_t faces) {
    return (faces - hull.base_face_count()) / 2;
  }

  const PageOptions& options_;
  const Original* given_ = nullptr;     // the original, as it was given
  std::optional<Reference> reference_;  // the same, as it is drawn
  Grid grid_;
  Blocks blocks_;
  json scene_;
};

}  // namespace

Scene scene_of(const std::vector<Shown>& shown, const std::optional<Original>& original, const PageOptions& options) {
  if (shown.size() > kMostShown) refuse(fmt::format("a page shows {} hulls at most", kMostShown));
  return Writer(shown, original, options).scene();
}

}  // namespace prohull::view
