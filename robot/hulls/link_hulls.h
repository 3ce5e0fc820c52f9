#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/detail/shapes.h"
#include "prohull/enclosing_hull.h"
#include "prohull/progress.h"
#include "prohull/verdict.h"
#include "robot/files/robot_file.h"
#include "robot/link_triangles.h"

namespace prohull::robot {

/// What the collision geometry of a link is made of.
enum class Collision {
  Hull,     ///< one mesh, which may be concave: enclosing_hulls
  Convex,   ///< convex pieces: convex_cover
  Spheres,  ///< balls that cover the surface: sphere_cover
};

/// "hull", "convex", "spheres"
Names<Collision> collision_names();

/// What is asked of the collision geometry of a link. Lengths are in metres.
struct Budget {
  Collision collision = Collision::Hull;
  std::vector<std::size_t> faces{500};  ///< of a hull: one hull for each number
  std::size_t pieces = 8;               ///< convex pieces at most
  std::size_t vertices = 64;            ///< of a convex piece at most; at least 4
  std::size_t spheres = 64;             ///< spheres at most; at most kMostCoverBalls
  double max_distance = 0;              ///< as HullBounds::max_distance; 0: no bound
  double padding = 0;                   ///< a hull keeps at least this distance from the geometry
  bool skip = false;                    ///< leave the collision elements of this link as they are

  bool operator==(const Budget&) const = default;
};

struct LinkHullOptions {
  Geometry from = Geometry::Visual;
  Budget budget = {};                          ///< of every link without one of its own
  std::map<std::string, Budget> budgets = {};  ///< by the name of the link
  bool tight = false;
  bool skip_missing = false;         ///< leave links alone whose meshes are not found, in place of throwing
  std::filesystem::path cache = {};  ///< a folder for hulls by content and options; empty: none
  unsigned threads = 0;              ///< 0: one for each core
  /// The stage is the name of the link that was finished last; the fraction is that of all links.
  Progress progress = {};

  /// The link's own budget, or else that of every link.
  const Budget& budget_of(const std::string& link) const;
};

/// A hull of the meshes of a link; or the convex pieces, or the balls, that cover them.
struct LinkHull {
  std::size_t target_faces = 0;  ///< 0 of pieces and balls
  /// In LinkHulls::frame, with float32 coordinates: simulators and planners read no others, of an OBJ file either.
  /// Several pieces are appended; each ball has a mesh around it.
  TriangleMesh mesh = {};
  std::vector<TriangleMesh> pieces = {};  ///< not empty if they were asked for
  std::vector<Ball> balls = {};           ///< likewise
  Verdict verdict = {};  ///< distances are from curved forms themselves; caps of openings belong to the solid
  bool target_reached = false, within_bounds = true;
  std::string source = {};  ///< "mesh", "convex-hull" or "wrap": what a hull was built from
  double volume = 0;        ///< of the union
  double padding = 0;       ///< least distance from the triangles that the construction claims; 0 if none was asked for
  std::size_t self_intersections = 0;
  std::vector<std::string> notes = {};

  bool certified() const { return verdict.certified; }
  bool has_openings() const { return verdict.cap_faces > 0; }  ///< that count as closed: the two distances may differ
};

/// All pieces in one mesh, with a mesh around each ball, or within it.
TriangleMesh mesh_of(std::span<const TriangleMesh> pieces, std::span<const Ball> balls, Curved curved = Curved::Around);

enum class LinkStatus {
  Hulled,      ///< it has hulls
  Primitives,  ///< its geometry has no meshes: the primitives themselves become the collision elements
  Skipped,     ///< as the budget, or skip_missing, asked
  Unread,      ///< a shape of it cannot be read here (OtherForm): its collision elements stay as they are
  Empty,       ///< it has no geometry to enclose
};
std::string_view name_of(LinkStatus status);  ///< "hulled", "primitives", "skipped", "unread", "empty"

struct LinkHulls {
  std::size_t link = 0;
  Collision collision = Collision::Hull;  ///< as its budget says
  LinkStatus status = LinkStatus::Empty;
  std::string why;                      ///< why it was skipped, or what is not read
  Frame frame;                          ///< of the meshes among the shapes, and of `triangles` and the hulls; with
                                        ///< spheres that of the link
  TriangleMesh triangles;               ///< of the shapes, meshes around curved ones: what the hulls enclose
  std::size_t non_finite_faces = 0;     ///< of `triangles`: they are left out
  std::vector<std::size_t> primitives;  ///< shapes that are kept beside the hull; with spheres only spheres are
  std::vector<LinkHull> hulls;          ///< one for each number of faces; empty unless Hulled
  double sealed_volume = 0;             ///< of what lies inside of the geometry; 0: unknown
  bool is_estimated = false;            ///< `sealed_volume` is an estimate, from a wrap
  double convex_volume = 0;             ///< of its convex hull; 0 of what is flat
  std::vector<std::string> repairs;     ///< sentences: what was repaired, which openings were closed
  double seconds = 0;
  bool from_cache = false;
};

/// Whether the collision geometry is made around the shape, and does not keep it as it is. Padded hulls enclose
/// primitives too, which would not be padded themselves. Spheres cover all other primitives.
bool is_covered(const Shape& shape, const Budget& budget);

/// What covers the links: "hulls", "convex pieces", "spheres"; "collision geometry" where links differ.
std::string_view cover_words(std::span<const LinkHulls> links);

/// Throws InputError(InvalidOption): a budget of a link that does not exist; padding, several numbers of faces or
/// `tight` where there is no hull that could have them; more spheres than kMostCoverBalls.
void check_budgets(const Robot& robot, const LinkHullOptions& options);

/// Hulls of all links, in the order of Robot::links. Links are worked on side by side; the result is the same for any
/// number of threads.
///
/// Guaranteed: `verdict` is decided exactly, in this call, by verify_hull or verify_union, from the coordinates of
/// the hull, which files and their readers keep, and the finite triangles of the link. That holds for hulls of the
/// cache too. Throws InputError: as check_budgets; CannotRead that lists every mesh which was not found, unless
/// skip_missing; Cancelled.
std::vector<LinkHulls> link_hulls(const Robot& robot, const LinkHullOptions& options = {});

}  // namespace prohull::robot
