#include "prohull/convex_cover.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "cover/cut_tree.h"
#include "cover/mesh_to_cover.h"
#include "cover/piece_hull.h"
#include "cover/primitives.h"
#include "cover/shape_choice.h"
#include "enclose/known_void.h"
#include "parallel/arena.h"
#include "prohull/closed_solid.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/union_verification.h"
#include "verify/original.h"

namespace prohull {
namespace cover {
namespace {

/// Cuts are looked for on a hull of so many faces: more make them hardly better.
constexpr std::size_t kSearchFaces = 1500;
/// Those of the wide search, which is costlier.
constexpr std::size_t kWideSearchFaces = 800;
/// Along the diagonal, of wraps around triangles that bound no solid: the finest that has space inside tells what lies
/// between them. Coarse ones close large openings.
constexpr double kWrapNodes = 128, kFewestWrapNodes = 16;
constexpr double kSearchTolerance = 1e-6;
/// Where there is no bound to keep, a search that leaves so little void is the last: with 8 pieces of 30 links and
/// models, further ones gained 0.04 % of the volume, and took as long again.
constexpr double kLittleVoid = 0.03;
/// How near a corner is to a plane that counts as on it, of the diagonal: the first is no more than rounding; each
/// further one is tried where the proof of the cover fails.
constexpr double kTolerances[]{1e-9, 1e-6, 1e-4};

void check(const ConvexCoverOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) refuse(what);
  };
  require(options.max_pieces >= 1, "a cover has at least 1 piece: ask for 1 or more");
  require(options.max_vertices >= 4, "a piece has at least 4 vertices: ask for 4 or more");
  const HullBounds& b = options.bounds;
  require(b.max_distance > 0 && b.max_void_ratio > 0 && b.max_added_volume > 0,
          "the greatest distance, void and added volume of a cover must be greater than 0");
}

/// What is cut into pieces.
struct Material {
  TriangleMesh solid;    ///< closed, outwards; or without faces: what lies in it is covered, too
  TriangleMesh faces;    ///< pieces are fitted to these
  TriangleMesh coarse;   ///< like the solid, or the faces where there is none, but few: cuts are looked for in it
  TriangleMesh coarser;  ///< around `coarse`, for the wide search
  InsideVolume inside;   ///< of the mesh, with its cavities
};

/// Vertices within the cubes of a grid become one.
TriangleMesh clustered(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  const double spacing = box.diagonal() / 64;
  std::map<std::array<int, 3>, VertexId> known;
  std::set<std::array<VertexId, 3>> faces;
  TriangleMesh result;
  for (auto t : mesh.triangles) {
    for (VertexId& v : t) {
      const Vec3 cell = (mesh.positions[v] - box.min) / spacing;
      const auto [entry, is_new] = known.try_emplace({int(cell.x), int(cell.y), int(cell.z)});
      if (is_new) entry->second = result.positions.push_back(mesh.positions[v]);
      v = entry->second;
    }
    std::sort(t.begin(), t.end());
    if (faces.insert(t).second) result.triangles.push_back(t);
  }
  return result;
}

/// A prism on flat triangles, so that parts of it have volumes by which cuts can be compared. Not closed if they are a
/// surface that branches.
TriangleMesh prism_on(const TriangleMesh& flat) {
  constexpr double kHeight = 1.0 / 64;  // of the diagonal
  const double diagonal = bounding_box(flat).diagonal();
  const auto normal_of = [&](const Triangle& t) { return cross((t.b - t.a) / diagonal, (t.c - t.a) / diagonal); };
  Vec3 normal;  // of the largest triangle
  for (const FaceId f : flat.triangles.ids())
    if (const Vec3 n = normal_of(flat.triangle(f)); norm(n) > norm(normal)) normal = n;
  if (!(norm(normal) > 0)) return flat;
  TriangleMesh result{flat.positions, {}};
  for (const Vec3& p : flat.positions) result.positions.push_back(p + normal * (kHeight * diagonal / norm(normal)));
  const auto above = [&](VertexId v) { return VertexId{index(v) + std::uint32_t(flat.positions.size())}; };
  std::set<std::array<VertexId, 2>> edges;
  for (const FaceId f : flat.triangles.ids()) {
    const double up = dot(normal_of(flat.triangle(f)), normal);
    auto [a, b, c] = flat.triangles[f];
    if (up == 0) continue;
    if (up < 0) std::swap(b, c);
    result.triangles.push_back({a, c, b});
    result.triangles.push_back({above(a), above(b), above(c)});
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) edges.insert(edge);
  }
  for (const auto& [a, b] : edges) {
    if (edges.contains({b, a})) continue;
    result.triangles.push_back({a, b, above(b)});
    result.triangles.push_back({a, above(b), above(a)});
  }
  return result;
}

/// A copy of the mesh in the frame in which cuts are looked for.
class Frame {
 public:
  explicit Frame(const Box& box) : center_(box.center()), size_(box.diagonal() > 0 ? box.diagonal() : 1) {}
  TriangleMesh scaled(TriangleMesh mesh) const {
    for (Vec3& p : mesh.positions) p = (p - center_) / size_;
    return mesh;
  }
  void unscale(CutTree& tree) const {
    for (CutTree::Node& node : tree.nodes) {
      node.plane.offset = node.plane.offset * size_ + dot(node.plane.normal, center_);
      node.volume *= size_ * size_ * size_;
    }
  }

 private:
  Vec3 center_;
  double size_;
};

std::vector<TriangleMesh> meshes_of(const std::vector<ConvexPiece>& pieces) {
  std::vector<TriangleMesh> meshes;
  for (const ConvexPiece& piece : pieces) meshes.push_back(piece.mesh);
  return meshes;
}

std::vector<TriangleMesh> meshes_around(const std::vector<ConvexPiece>& pieces) {
  std::vector<TriangleMesh> meshes;
  for (const ConvexPiece& piece : pieces) meshes.push_back(mesh_around(piece));
  return meshes;
}

/// The mesh of the piece is larger than what is written.
bool is_round(const ConvexPiece& piece) {
  return std::holds_alternative<Capsule>(piece.primitive) || std::holds_alternative<Ball>(piece.primitive);
}

struct UnionVolume {
  double volume;
  bool is_bound;  ///< ConvexCover::volume_is_bound
};

UnionVolume volume_of_union(const std::vector<ConvexPiece>& pieces, std::span<const TriangleMesh> meshes_around) {
  if (std::ranges::none_of(pieces, is_round)) return {union_volume(meshes_around), false};
  if (pieces.size() == 1) return {prohull::volume_of(pieces.front()), false};
  std::vector<Ball> balls;
  for (const ConvexPiece& piece : pieces)
    if (const auto* const ball = std::get_if<Ball>(&piece.primitive)) balls.push_back(*ball);
  if (balls.size() == pieces.size()) return {union_volume(balls), false};
  return {union_volume(meshes_around), true};
}

class Covering {
 public:
  Covering(TriangleMesh triangles, const ConvexCoverOptions& options)
      : options_(options),
        prepared_(prepared_for_hulls(std::move(triangles), enclosing_options(options.threads, options.progress))),
        hull_(convex_hull(prepared_.original)),
        inside_without_cavities_(prepared_.closed || is_closed(prepared_.original)
                                     ? volume_inside(prepared_, options.progress)
                                     : InsideVolume()),
        inside_(filled_volume(prepared_, inside_without_cavities_, options.progress)),
        cap_faces_(prepared_.closed ? verify::stand_in(prepared_.closed->mesh, prepared_.original).caps : 0) {}

  ConvexCover run() {
    ConvexCover cover = certified_cover();
    cover.fills_cavities = add_note_of_cavities(inside_without_cavities_.volume, inside_.volume, cover.notes);
    add_notes_of_repairs(prepared_.repairs, cover.notes);
    return cover;
  }

 private:
  ConvexCover certified_cover() {
    std::optional<ConvexCover> cover;
    if (prepared_.closed) cover = cover_of_closed_mesh();
    // One convex piece holds all that lies between the triangles, too. Bounds of the void ask for more: a volume.
    if (!cover && options_.max_pieces == 1 && !options_.bounds.any() && !is_flat())
      cover = best_cover(of_convex_hull());
    if (!cover || !cover->verdict.certified) {
      const Material material = measurable(of_open_triangles());
      cover = best_cover(material);
      if (prepared_.closed) cover->notes.emplace_back("no cover of the mesh itself was certified");
      if (cover->verdict.encloses_solid != Answer::Yes)
        cover->notes.emplace_back("the triangles are covered; what lies between them may not be");
    }
    if (!cover->verdict.certified) {
      cover = best_cover(of_convex_hull());
      cover->notes.emplace_back("no cover of several pieces was certified; this is the convex hull");
    } else if (is_no_better_than_one_piece(*cover)) {
      ConvexCover one = best_cover(of_convex_hull());
      if (one.verdict.certified && one.volume <= cover->volume) return one;
    }
    if (!cover->verdict.certified) throw InputError(Defect::NoCertificate, "no cover of these triangles was certified");
    return std::move(*cover);
  }

  // But for rounding.
  bool is_flat() const {
    constexpr double kFlat = 1e-4;  // of the diagonal: the edge of a cube as large as the convex hull
    return std::cbrt(signed_volume(hull_)) < kFlat * bounding_box(prepared_.original).diagonal();
  }

  bool is_no_better_than_one_piece(const ConvexCover& cover) const {
    return cover.pieces.size() > 1 && !options_.bounds.any() && !is_flat() && signed_volume(hull_) <= cover.volume;
  }

  /// Bounds of the void ask for a volume.
  Material measurable(Material material) const {
    require_volume(material.inside.volume, options_.bounds);
    return material;
  }

  /// Collapses leave all components of a mesh, so that a hull of few faces around them is large where they overlap. A
  /// hull of a wrap has one, and holds what has no volume, but no sharp edges. Both are searched, if either is coarser
  /// than the mesh, and the first cover leaves more than little void.
  ConvexCover cover_of_closed_mesh() {
    constexpr std::size_t kFewest = 4;  // faces of a component
    const TriangleMesh& mesh = prepared_.closed->mesh;
    const std::size_t components = mesh.face_count() > kSearchFaces ? inspect(mesh).components : 1;
    std::optional<ConvexCover> cover;
    if (kFewest * components <= kSearchFaces) cover = best_cover(measurable(of_closed_mesh(mesh)));
    const bool is_enough = cover && cover->verdict.certified && cover->void_ratio < little_void();
    if ((components > 1 || dropped_faces_stick_out()) && !is_enough) {
      TriangleMesh all = mesh;
      append(all, prepared_.dropped);
      const double spacing = bounding_box(all).diagonal() / kWrapNodes;
      ConvexCover joined = best_cover(measurable(of_closed_mesh(wrap_around(all, spacing, options_.progress).mesh)));
      if (!cover || is_better(joined, *cover)) cover = std::move(joined);
    }
    return std::move(*cover);
  }

  /// Of the convex hull of the solid, in which a search of the solid would leave them no piece of their own.
  bool dropped_faces_stick_out() const {
    constexpr double kSame = 1 - 1e-6;  // but for rounding
    return prepared_.dropped.face_count() > 0 &&
           signed_volume(convex_hull(prepared_.closed->mesh)) < kSame * signed_volume(hull_);
  }

  /// With bounds, a search that leaves more may need fewer pieces for them.
  double little_void() const { return options_.bounds.any() ? 0 : kLittleVoid; }

  bool is_better(const ConvexCover& a, const ConvexCover& b) const {
    const auto rank = [&](const ConvexCover& cover) {
      return std::tuple(!cover.verdict.certified, excess(cover), options_.bounds.any() ? cover.pieces.size() : 0,
                        cover.volume);
    };
    return rank(a) < rank(b);
  }

  /// `like`: in which cuts are looked for.
  Material of_closed_mesh(const TriangleMesh& like) const {
    TriangleMesh faces = prepared_.closed->mesh;
    append(faces, prepared_.dropped);
    return of_solid(prepared_.closed->mesh, std::move(faces), inside_, like);
  }

  Material of_solid(const TriangleMesh& closed, TriangleMesh faces, InsideVolume volume,
                    const TriangleMesh& like) const {
    TriangleMesh coarse = with_faces(like, kSearchFaces), coarser = with_faces(coarse, kWideSearchFaces);
    return {closed, std::move(faces), std::move(coarse), std::move(coarser), volume};
  }

  /// The mesh, or a hull around it of so many faces.
  TriangleMesh with_faces(const TriangleMesh& mesh, std::size_t faces) const {
    if (mesh.face_count() <= faces) return mesh;
    return build_hull(mesh, {.target_faces = faces,
                             .relax_guards = true,
                             .threads = options_.threads,
                             .progress = options_.progress})
        .hull.base();
  }

  /// Of triangles that bound no solid by themselves: what lies between them is what lies in a wrap.
  Material of_open_triangles() const {
    const TriangleMesh& triangles = prepared_.original;
    if (is_flat()) {
      constexpr double kSame = 1 - 1e-6;  // but for rounding: a cut of what is convex gains nothing
      const TriangleMesh prism = prism_on(clustered(triangles));
      const bool may_gain = is_closed(prism) && signed_volume(prism) < kSame * signed_volume(convex_hull(prism));
      const TriangleMesh& coarse = may_gain ? prism : triangles;
      return {{}, triangles, coarse, coarse, {}};
    }
    const TriangleMesh near = prepared_.with_caps();
    const double diagonal = bounding_box(triangles).diagonal();
    Wrap around;
    for (double nodes = kWrapNodes; around.inside_volume == 0; nodes /= 2) {
      if (nodes < kFewestWrapNodes) return of_surface();
      around = wrap_around(near, diagonal / nodes, options_.progress);
    }
    const bool is_known = inside_.volume > 0 && !inside_.is_estimated;
    const InsideVolume inside = is_known ? inside_ : InsideVolume{around.inside_volume, /*is_estimated=*/true};
    return of_solid(around.mesh, triangles, inside, around.mesh);
  }

  Material of_surface() const {
    const TriangleMesh coarse = clustered(prepared_.original);
    return {{}, prepared_.original, coarse, coarse, {}};
  }

  /// One piece.
  Material of_convex_hull() const { return {hull_, hull_, hull_, hull_, inside_}; }

  /// For few pieces there is a wide search, which finds better cuts: bounds that those keep ask for no more.
  ConvexCover best_cover(const Material& material) {
    const std::size_t most = options_.max_pieces;
    if (!options_.bounds.any() || most <= kMostPiecesOfWide) return best_cover(material, most);
    ConvexCover few = best_cover(material, kMostPiecesOfWide);
    if (few.verdict.certified && few.within_bounds) return few;
    ConvexCover many = best_cover(material, most);
    return is_better(few, many) ? few : many;
  }

  /// The most pieces; or as few as keep the bounds, or fill the mesh.
  ConvexCover best_cover(const Material& material, std::size_t max_pieces) {
    const CutSearch search = search_of(material, max_pieces);
    const CutTree tree = tree_of(search, max_pieces, material);
    Solid solid(material.faces, material.solid, kTolerances[0]);
    const std::size_t most = fewest_parts(tree);
    ConvexCover best = fitted(tree, most, solid, material);
    // Fewer pieces do without the cut that defeats the proof.
    for (std::size_t count = most; !best.verdict.certified && count > 2;) {
      count -= std::max<std::size_t>(1, count / 6);
      best = fitted(tree_of(search, count, material), count, solid, material);
    }
    // Where the most pieces miss the bounds, fewer may keep them, or miss them by less: around a wrist, 52 pieces reach
    // out by 3.0 % of the diagonal, and 21 by 1.6 %.
    std::size_t low = 0, high = most;  // the cover of `low` pieces does not suffice
    for (std::size_t count = most / 2; options_.bounds.any() && !best.within_bounds && count > 0; count /= 2) {
      ConvexCover cover = fitted(tree_of(search, count, material), count, solid, material);
      if (is_better(cover, best)) best = std::move(cover), high = count;
    }
    while (suffices(best, material) && high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      ConvexCover cover = fitted(tree_of(search, middle, material), middle, solid, material);
      if (cover.verdict.certified && suffices(cover, material))
        best = std::move(cover), high = middle;
      else
        low = middle;
    }
    return shaped(std::move(best), material);
  }

  /// Pieces that fill the mesh, but for rounding, may be more than that takes: not every way to cut it ends in few.
  bool suffices(const ConvexCover& cover, const Material& material) const {
    return options_.bounds.any() ? cover.within_bounds : cover.volume < (1 + kNoVoid) * material.inside.volume;
  }

  CutSearch search_of(const Material& material, std::size_t max_pieces) const {
    ProgressMeter meter(options_.progress, "cut");
    const Frame frame(bounding_box(material.coarse));
    const auto solid = [&](const TriangleMesh& mesh) { return search_solid(mesh, material, frame); };
    return arena_of(options_.threads).execute([&] {
      return CutSearch(solid(material.coarse), solid(material.coarser), max_pieces, little_void(), meter);
    });
  }

  /// In the frame of the material; of `count` leaves, or of fewer.
  CutTree tree_of(const CutSearch& search, std::size_t count, const Material& material) const {
    ProgressMeter meter(options_.progress, "cut");
    CutTree tree = arena_of(options_.threads).execute([&] { return search.tree(count, meter); });
    Frame(bounding_box(material.coarse)).unscale(tree);
    meter.at(1);
    return tree;
  }

  /// Where a plane and the surface nearly coincide, rounding may leave a corner out. Another tolerance then helps.
  ConvexCover fitted(const CutTree& tree, std::size_t count, Solid& solid, const Material& material) {
    ConvexCover cover;
    for (const double tolerance : kTolerances) {
      solid.set_tolerance(tolerance);
      cover = certified(pieces(tree, std::min(count, leaves(tree)), solid), material);
      if (cover.verdict.certified) break;
    }
    return cover;
  }

  static Solid search_solid(const TriangleMesh& mesh, const Material& material, const Frame& frame) {
    const TriangleMesh scaled = frame.scaled(mesh);
    const bool is_solid = material.solid.face_count() > 0 || is_closed(scaled);
    return Solid(scaled, is_solid ? scaled : TriangleMesh(), kSearchTolerance);
  }

  /// Pieces that save nothing are not made.
  static std::size_t fewest_parts(const CutTree& tree) {
    const std::vector<double> least = least_volumes(tree);
    const auto first =
        std::find_if(least.begin(), least.end(), [&](double v) { return v <= least.back() * (1 + 1e-6); });
    return static_cast<std::size_t>(first - least.begin());
  }

  std::vector<ConvexPiece> pieces(const CutTree& tree, std::size_t count, const Solid& solid) {
    const std::vector<Part> parts = divided(tree, count, solid);
    ProgressMeter meter(options_.progress, "fit");
    std::vector<ConvexPiece> result(parts.size());
    arena_of(options_.threads).execute([&] {
      oneapi::tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        meter.go_on();
        result[i].mesh = piece_hull(parts[i], options_.max_vertices, options_.float32_coordinates);
      });
    });
    std::erase_if(result, [](const ConvexPiece& piece) { return piece.mesh.face_count() == 0; });
    if (result.empty())
      throw InputError(Defect::NoVolume,
                       fmt::format("the mesh is only {:g} across, and no piece of it has a volume that numbers hold: "
                                   "scale the mesh",
                                   bounding_box(prepared_.original).diagonal()));
    meter.at(1);
    return result;
  }

  /// In the shape that is asked for, as far as the bounds allow it.
  ConvexCover shaped(ConvexCover polytopes, const Material& material) const {
    if (options_.shape == PieceShape::Polytope || !polytopes.within_bounds) return polytopes;
    ConvexCover cover = in_shape(polytopes, material);
    // The mesh of a box is larger than the box: what it covers proves less than that the polytope in the box covers it.
    Verdict& verdict = cover.verdict;
    verdict.certified = verdict.certified && polytopes.verdict.certified;
    verdict.covers_triangles = std::min(verdict.covers_triangles, polytopes.verdict.covers_triangles);
    verdict.encloses_solid = verdict.certified ? polytopes.verdict.encloses_solid : verdict.encloses_solid;
    note_size(cover);
    return cover;
  }

  ConvexCover in_shape(const ConvexCover& polytopes, const Material& material) const {
    const bool has_float32_boxes = options_.float32_coordinates && options_.boxes_as_meshes;
    std::vector<ConvexPiece> all = polytopes.pieces;
    for (ConvexPiece& piece : all) take_shape(piece, options_.shape, has_float32_boxes);
    ConvexCover cover = certified(all, material);
    if (cover.within_bounds) return cover;
    std::vector<std::size_t> by_growth(all.size());
    std::iota(by_growth.begin(), by_growth.end(), std::size_t{0});
    const auto growth = [&](std::size_t i) {
      return signed_volume(mesh_around(all[i])) - signed_volume(polytopes.pieces[i].mesh);
    };
    std::stable_sort(by_growth.begin(), by_growth.end(),
                     [&](std::size_t i, std::size_t j) { return growth(i) < growth(j); });
    std::vector<ConvexPiece> chosen = polytopes.pieces;
    for (const std::size_t i : by_growth) {
      std::vector<ConvexPiece> pieces = chosen;
      pieces[i] = all[i];
      if (measured(pieces, material).within_bounds) chosen = std::move(pieces);
    }
    return certified(std::move(chosen), material);
  }

  /// Shapes that are worse than one polytope are hardly meant.
  void note_size(ConvexCover& cover) const {
    constexpr double kClearly = 1.05;  // the polytopes around capsules and spheres are some per cent larger than these
    const double one = signed_volume(hull_);
    if (!(one > 0) || cover.volume <= kClearly * one) return;
    cover.notes.push_back(
        fmt::format("together the pieces in the shape of a {} have {:.2g} times the volume of the convex hull of the "
                    "whole mesh; ask for more pieces, for another shape, or for a bound of the void, with which pieces "
                    "stay polytopes",
                    name_of(piece_shape_names(), options_.shape), cover.volume / one));
  }

  ConvexCover certified(std::vector<ConvexPiece> pieces, const Material& material) const {
    ConvexCover cover = measured(std::move(pieces), material);
    prove(cover);
    return cover;
  }

  void prove(ConvexCover& cover) const {
    const Stopwatch watch;
    const auto verified = [&](const TriangleMesh& original) {
      return verify_union(meshes_of(cover.pieces), original, {.max_offenders = 1, .progress = options_.progress});
    };
    Verdict found = verified(prepared_.original);
    if (found.certified && !found.original_closed && prepared_.closed && verified(prepared_.closed->mesh).certified)
      found.encloses_solid = Answer::Yes;
    found.cap_faces = cap_faces_;
    found.non_finite_faces = prepared_.repairs.dropped_non_finite_faces;
    found.distance_to_triangles = cover.verdict.distance_to_triangles;
    found.distance_to_solid = cover.verdict.distance_to_solid;
    cover.verdict = std::move(found);
    cover.verify_seconds = watch.seconds();
  }

  ConvexCover measured(std::vector<ConvexPiece> pieces, const Material& material) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<TriangleMesh> meshes = meshes_around(pieces);
    ConvexCover cover;
    cover.pieces = std::move(pieces);
    const auto [volume, is_bound] = volume_of_union(cover.pieces, meshes);
    cover.volume = volume, cover.volume_is_bound = is_bound;
    cover.is_estimated = material.inside.is_estimated;
    // No estimate may say that the mesh is larger than what covers it.
    if (!cover.is_estimated || material.inside.volume <= cover.volume) cover.original_volume = material.inside.volume;
    cover.void_ratio = cover.original_volume > 0 ? cover.volume / cover.original_volume - 1 : infinity;
    const DistanceOptions how{.progress = options_.progress};
    DistanceBounds from_triangles = union_reach(meshes, prepared_.original, how), from_solid = from_triangles;
    if (prepared_.closed && prepared_.caps.face_count() > 0)
      from_solid = union_reach(meshes, prepared_.closed->mesh, how);
    from_solid.upper = std::min(from_solid.upper, from_triangles.upper);  // the solid has the triangles
    if (std::ranges::any_of(cover.pieces, is_round)) from_solid.lower = from_triangles.lower = 0;
    cover.verdict.distance_to_triangles = from_triangles;
    if (prepared_.closed) cover.verdict.distance_to_solid = from_solid;
    cover.within_bounds = excess(cover) == 0;
    return cover;
  }

  /// By what factor the bound is missed that is missed by most; 0 if all are kept.
  double excess(const ConvexCover& cover) const {
    const HullBounds& b = options_.bounds;
    const auto of = [](double value, double bound) { return value <= bound ? 0.0 : value / bound; };
    return std::max({of(cover.verdict.distance().upper, b.max_distance), of(cover.void_ratio, b.max_void_ratio),
                     of(cover.volume - cover.original_volume, b.max_added_volume)});
  }

  const ConvexCoverOptions& options_;
  const RepairedMesh prepared_;
  const TriangleMesh hull_;  // the convex hull of the triangles; without faces if they lie in a plane
  const InsideVolume inside_without_cavities_, inside_;  // of the triangles, if they can be closed
  const std::size_t cap_faces_;                          // as Verdict has them
};

}  // namespace
}  // namespace cover

Names<PieceShape> piece_shape_names() {
  static constexpr std::pair<std::string_view, PieceShape> kNames[]{{"polytope", PieceShape::Polytope},
                                                                    {"box", PieceShape::Box},
                                                                    {"capsule", PieceShape::Capsule},
                                                                    {"sphere", PieceShape::Ball}};
  return kNames;
}

double volume_of(const ConvexPiece& piece) {
  if (const auto* const capsule = std::get_if<Capsule>(&piece.primitive)) return cover::volume(*capsule);
  if (const auto* const ball = std::get_if<Ball>(&piece.primitive)) return cover::volume(*ball);
  return signed_volume(piece.mesh);
}

ConvexCover convex_cover(TriangleMesh triangles, const ConvexCoverOptions& options) {
  const Stopwatch watch;
  cover::check(options);
  if (options.float32_coordinates) check_float32_spacing(triangles);
  ConvexCover result = cover::Covering(std::move(triangles), options).run();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace prohull
