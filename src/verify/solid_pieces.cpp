#include "prohull/detail/solid_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/heap_with_ties.h"
#include "geometry/predicates.h"
#include "geometry/triangle_intersection.h"
#include "geometry/triangle_key.h"
#include "geometry/triangle_predicates.h"
#include "prohull/enclosure.h"
#include "prohull/mesh_query.h"
#include "prohull/union_verification.h"
#include "verify/convex_pairs.h"
#include "verify/solids.h"

namespace prohull {
namespace {

/// Corners around the axis of the meshes that stand for curved forms, until one tells.
constexpr std::array<std::size_t, 3> kSegments{16, 64, 256};
/// Those of a curved part whose reach is measured.
constexpr std::size_t kFineness = 128;

TriangleMesh mesh_of(std::span<const Triangle> triangles) {
  TriangleMesh mesh;
  for (const Triangle& t : triangles) {
    const VertexId a = mesh.positions.push_back(t.a), b = mesh.positions.push_back(t.b);
    mesh.triangles.push_back({a, b, mesh.positions.push_back(t.c)});
  }
  return mesh;
}

template <class Keeps>
TriangleMesh faces_that(const TriangleMesh& mesh, Keeps keeps) {
  TriangleMesh result;
  result.positions = mesh.positions;
  for (const FaceId f : mesh.triangles.ids())
    if (keeps(f)) result.triangles.push_back(mesh.triangles[f]);
  return result;
}

TriangleMesh without_equals(const TriangleMesh& mesh, const TriangleMesh& others) {
  std::vector<TriangleKey> keys;
  for (const FaceId f : others.triangles.ids()) keys.push_back(unoriented_key(others.triangle(f)));
  std::sort(keys.begin(), keys.end());
  return faces_that(
      mesh, [&](FaceId f) { return !std::binary_search(keys.begin(), keys.end(), unoriented_key(mesh.triangle(f))); });
}

bool lies_in_one(const Triangle& t, std::span<const CurvedForm> forms) {
  return std::any_of(forms.begin(), forms.end(), [&](const CurvedForm& form) {
    return form.contains(t.a) && form.contains(t.b) && form.contains(t.c);
  });
}

/// The pieces that bound solids, but the tangled ones, as one mesh. No winding is negative: the sum is at least 1 where
/// one of them is.
TriangleMesh solid_mesh(const SolidPieces& pieces, Curved curved, std::size_t segments) {
  TriangleMesh mesh = pieces.solids;
  for (const CurvedForm& form : pieces.curved) append(mesh, form.mesh(curved, segments));
  return mesh;
}

/// All faces that the mesh does not cover.
std::vector<Offender> offenders(const TriangleMesh& faces, const TriangleMesh& solid, const Progress& progress) {
  if (faces.face_count() == 0) return {};
  if (solid.face_count() > 0)
    return verify_cover(faces, solid, {.max_offenders = faces.face_count(), .progress = progress}).worst;
  std::vector<Offender> all;
  for (const FaceId f : faces.triangles.ids()) all.push_back({f, faces.triangle(f).a, 0});
  return all;
}

/// Which faces neither the mesh nor a tangled piece covers by itself. For faces that are points, that is exact.
PerFace<char> are_outside(const TriangleMesh& faces, const TriangleMesh& solid,
                          const std::vector<TriangleMesh>& tangled, const Progress& progress) {
  PerFace<char> outside(faces.face_count(), 1);
  const auto drop_covered = [&](const TriangleMesh& piece) {
    PerFace<char> sticks_out(faces.face_count(), 0);
    for (const Offender& offender : offenders(faces, piece, progress)) sticks_out[offender.face] = 1;
    for (const FaceId f : faces.triangles.ids()) outside[f] = outside[f] != 0 && sticks_out[f] != 0;
  };
  drop_covered(solid);
  for (const TriangleMesh& piece : tangled) drop_covered(piece);
  return outside;
}

/// The faces that balls do not cover, or with next to nothing to spare.
std::vector<Offender> offenders(const TriangleMesh& faces, std::span<const Ball> balls, const Progress& progress) {
  if (faces.face_count() == 0) return {};
  UnionVerification found =
      verify_union(balls, faces, false, {.max_offenders = faces.face_count(), .progress = progress});
  found.worst.insert(found.worst.end(), found.undecided.begin(), found.undecided.end());
  return std::move(found.worst);
}

TriangleMesh faces_of(const std::vector<Offender>& found, const TriangleMesh& faces) {
  PerFace<char> is_found(faces.face_count(), 0);
  for (const Offender& offender : found) is_found[offender.face] = 1;
  return faces_that(faces, [&](FaceId f) { return is_found[f] != 0; });
}

TriangleMesh uncovered(const TriangleMesh& faces, std::span<const Ball> balls, const Progress& progress) {
  return faces_of(offenders(faces, balls, progress), faces);
}

TriangleMesh uncovered(const TriangleMesh& faces, const SolidPieces& pieces, Curved curved, std::size_t segments,
                       const Progress& progress) {
  const TriangleMesh rest = faces_that(faces, [&](FaceId f) { return !lies_in_one(faces.triangle(f), pieces.curved); });
  const auto outside = are_outside(rest, solid_mesh(pieces, curved, segments), pieces.tangled, progress);
  return faces_that(rest, [&](FaceId f) { return outside[f] != 0; });
}

/// Those with a corner that lies in no solid piece. Exact.
TriangleMesh with_corner_outside(const TriangleMesh& faces, const SolidPieces& pieces, const Progress& progress) {
  std::vector<Triangle> corners;
  std::vector<FaceId> owners;
  for (const FaceId f : faces.triangles.ids()) {
    const Triangle t = faces.triangle(f);
    for (const Vec3& p : {t.a, t.b, t.c}) {
      if (lies_in_one({p, p, p}, pieces.curved)) continue;
      corners.push_back({p, p, p});
      owners.push_back(f);
    }
  }
  const auto outside = are_outside(mesh_of(corners), pieces.solids, pieces.tangled, progress);
  PerFace<char> keeps(faces.face_count(), 0);
  for (const FaceId corner : outside.ids())
    if (outside[corner] != 0) keeps[owners[index(corner)]] = 1;
  return faces_that(faces, [&](FaceId f) { return keeps[f] != 0; });
}

/// Also if the triangle has no area.
bool lies_in_plane(const Vec3& p, const Triangle& t) { return side(t.a, t.b, t.c, p) == Side::On; }

/// Whether one of the faces, which all leave the solid pieces, leaves the triangles, too: these cover some of a face
/// only if they lie in its plane. Not all are asked, as many faces may lie in a plane with many triangles.
bool one_leaves(const TriangleMesh& faces, const TriangleMesh& triangles) {
  constexpr std::uint32_t kMostFaces = 100;
  for (const FaceId f : faces.triangles.ids()) {
    if (index(f) == kMostFaces) break;
    const Triangle face = faces.triangle(f);
    const auto lies_in = [&](const std::array<VertexId, 3>& corners) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](VertexId v) { return lies_in_plane(triangles.positions[v], face); });
    };
    if (std::none_of(triangles.triangles.begin(), triangles.triangles.end(), lies_in)) return true;
  }
  return false;
}

/// How far faces reach out of the union of the pieces.
///
/// Faces are cut into cells, as by distance_bounds, the one with the greatest bound first. Cells that the union covers
/// are dropped, so that nothing counts that is deep inside. The distance to a triangle, or to a curved form, is a
/// convex function: no point of a cell is farther from the union than the farthest corner is from a face or form near
/// it.
class Reach {
 public:
  /// `found` are the offenders among the faces, if the caller has them already.
  Reach(const TriangleMesh& faces, const SolidPieces& pieces, const Progress& progress,
        const std::optional<std::vector<Offender>>& found = {})
      : pieces_(pieces),
        progress_(progress),
        balls_(only_balls(pieces)),
        solid_(balls_.empty() ? solid_mesh(pieces, Curved::Within, kSegments[0]) : TriangleMesh()),
        surface_(surface()),
        query_(QueryIndex(surface_)),
        pairs_(pieces.solids) {
    double largest = 0;
    for (const TriangleMesh* mesh : {&surface_, &faces})
      for (const Vec3& p : mesh->positions)
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
    for (const CurvedForm& form : pieces.curved) largest = std::max(largest, form.largest_coordinate());
    // Offenders are rounded; cells are cut at rounded midpoints, at most some hundred times one after another; the
    // bounds of distances to curved forms are some 2^-46 of their size apart.
    rounding_ = 0x1p-42 * largest;
    add(faces, found ? *found : offenders_among(faces));
  }

  DistanceBounds run() {
    while (is_wide() && seen_ < kMostCells && !is_stuck()) {
      const TriangleMesh cells = mesh_of(halves());
      add(cells, offenders_among(cells));
    }
    reach_.upper = std::max(cells_.empty() ? 0 : cells_.top().upper, reach_.lower) + rounding_;
    reach_.lower = std::max(0.0, reach_.lower - rounding_);
    return reach_;
  }

 private:
  static constexpr std::size_t kMostCells = 200'000;
  static constexpr double kRelativeGap = 0.01;

  struct Cell {
    Triangle triangle;
    double upper;
    std::vector<FaceId> nearest = {};  // whose pairs bound it closer, if it matters
    void bound_by(double distance) { upper = std::min(upper, distance); }
    bool operator<(const Cell& other) const { return upper < other.upper; }
  };

  TriangleMesh surface() const {
    TriangleMesh result = pieces_.solids;
    append(result, pieces_.triangles);
    return result;
  }

  /// In a slit between two pieces, cells keep their bound until they are as narrow as the slit. Other bounds shrink by
  /// then, as each cell that was there at the last look may have been cut twice.
  bool is_stuck() {
    if (seen_ < next_look_) return false;
    next_look_ = 8 * seen_;
    const double gap = cells_.top().upper - reach_.lower;
    return gap > 0.9 * std::exchange(gap_, gap);
  }

  bool is_wide(const Cell& cell) const { return cell.upper > (1 + kRelativeGap) * reach_.lower + rounding_; }
  bool is_wide() const { return !cells_.empty() && is_wide(cells_.top()); }

  std::vector<Offender> offenders_among(const TriangleMesh& faces) const {
    return balls_.empty() ? offenders(faces, solid_, progress_) : offenders(faces, balls_, progress_);
  }

  void add(const TriangleMesh& faces, const std::vector<Offender>& found) {
    std::vector<Triangle> cells, points;
    for (const Offender& offender : found) {
      cells.push_back(faces.triangle(offender.face));
      points.push_back({offender.point, offender.point, offender.point});
    }
    const auto cell_leaves = leaves_tangled(cells), point_leaves = leaves_tangled(points);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (cell_leaves[i] == 0) continue;
      const Triangle& t = cells[i];
      if (point_leaves[i] != 0) look_at(found[i].point);
      if (solid_.face_count() == 0 && pieces_.tangled.empty()) look_at(t.b), look_at(t.c);
      cells_.push(bounded(t));
      ++seen_;
    }
  }

  std::vector<char> leaves_tangled(const std::vector<Triangle>& triangles) const {
    if (pieces_.tangled.empty()) return std::vector<char>(triangles.size(), 1);
    const auto outside = are_outside(mesh_of(triangles), {}, pieces_.tangled, progress_);
    return {outside.begin(), outside.end()};
  }

  /// A point that is outside of the union, or on the border of what is; or in a curved piece.
  void look_at(const Vec3& p) {
    const auto closest = query_.closest_point(p);
    double distance = closest ? closest->lower : std::numeric_limits<double>::infinity();
    for (const CurvedForm& form : pieces_.curved) distance = std::min(distance, form.distance(p).lower);
    if (distance > reach_.lower) reach_.lower = distance, reach_.farthest = p;
  }

  /// By the curved pieces and by the faces nearest to the corners.
  Cell bounded(const Triangle& t) {
    Cell cell{t, std::numeric_limits<double>::infinity()};
    for (const CurvedForm& form : pieces_.curved)
      cell.bound_by(std::max({form.distance(t.a).upper, form.distance(t.b).upper, form.distance(t.c).upper}));
    if (surface_.face_count() == 0) return cell;
    std::vector<Triangle> near;
    for (const Vec3& p : {t.a, t.b, t.c}) {
      const FaceId face = query_.closest_point(p)->face;
      near.push_back(surface_.triangle(face));
      if (index(face) < pieces_.solids.face_count()) cell.nearest.push_back(face);
    }
    cell.bound_by(distance_bounds(mesh_of({&t, 1}), mesh_of(near), {.max_cells = 1}).upper);
    return cell;
  }

  std::vector<Triangle> halves() {
    // To ask whether cells are covered takes the time of some, and more where the pieces have many faces.
    const std::size_t at_once = std::max<std::size_t>(1024, solid_.face_count() / 4);
    std::vector<Triangle> result;
    while (result.size() < 2 * at_once && is_wide()) {
      Cell cell = cells_.top();
      cells_.pop();
      for (const FaceId f : std::exchange(cell.nearest, {})) cell.bound_by(pairs_.distance_at_most(f, cell.triangle));
      if (is_wide(cell))
        add_halves(cell.triangle, result);
      else
        cells_.push(std::move(cell));
    }
    return result;
  }

  /// A segment is halved as one. Halves of it as a triangle would lie on each other, and cells be without number.
  static void add_halves_of(const Segment& s, std::vector<Triangle>& result) {
    const Vec3 middle = s.a * 0.5 + s.b * 0.5;
    result.push_back({s.a, middle, middle});
    result.push_back({middle, s.b, s.b});
  }

  static void add_halves(const Triangle& t, std::vector<Triangle>& result) {
    if (!projection_axis(t)) return add_halves_of(segment_of(t), result);
    const double ab = squared_norm(t.b - t.a), bc = squared_norm(t.c - t.b), ca = squared_norm(t.a - t.c);
    const auto [a, b, c] = ab >= bc && ab >= ca ? t : bc >= ca ? Triangle{t.b, t.c, t.a} : Triangle{t.c, t.a, t.b};
    const Vec3 middle = a * 0.5 + b * 0.5;
    result.push_back({a, middle, c});
    result.push_back({middle, b, c});
  }

  const SolidPieces& pieces_;
  const Progress& progress_;
  const std::vector<Ball> balls_;  // the pieces, if they are nothing else; then there is no solid_
  const TriangleMesh solid_, surface_;
  MeshQuery query_;
  verify::ConvexPairs pairs_;
  double rounding_ = 0;
  HeapWithTies<Cell> cells_;
  std::size_t seen_ = 0, next_look_ = 1024;
  double gap_ = std::numeric_limits<double>::infinity();  // at the last look
  DistanceBounds reach_;
};

/// By the exact test of unions of balls, for which no meshes have to stand.
PieceCover cover_by_balls(const TriangleMesh& faces, std::span<const Ball> balls, const SolidPieces& pieces,
                          const Progress& progress) {
  PieceCover result{Covers::Unknown, uncovered(faces, balls, progress), {}};
  if (result.outside.face_count() == 0) return {};
  result.reach = Reach(result.outside, pieces, progress).run();
  if (result.reach.lower > 0 || with_corner_outside(result.outside, pieces, progress).face_count() > 0)
    result.covers = Covers::No;
  return result;
}

/// Where no piece is curved or tangled, a single exact test decides: the winding numbers of the pieces add up.
PieceCover cover_by_solids(const TriangleMesh& faces, const SolidPieces& pieces, const Progress& progress) {
  const std::vector<Offender> found = offenders(faces, pieces.solids, progress);
  if (found.empty()) return {};
  PieceCover result{Covers::Unknown, faces_of(found, faces), {}};
  result.reach = Reach(faces, pieces, progress, found).run();
  if (result.reach.lower > 0 || one_leaves(result.outside, pieces.triangles)) result.covers = Covers::No;
  return result;
}

PieceCover cover_flat(const TriangleMesh& faces, const SolidPieces& pieces, const Progress& progress) {
  if (const std::vector<Ball> balls = only_balls(pieces); !balls.empty())
    return cover_by_balls(faces, balls, pieces, progress);
  if (pieces.curved.empty() && pieces.tangled.empty())
    return cover_by_solids(without_equals(faces, pieces.triangles), pieces, progress);
  PieceCover result{Covers::Unknown, without_equals(faces, pieces.triangles), {}};
  TriangleMesh leaving;  // the solid pieces
  for (const std::size_t segments : kSegments) {
    result.outside = uncovered(result.outside, pieces, Curved::Within, segments, progress);
    if (result.outside.face_count() == 0) return {};
    leaving = with_corner_outside(result.outside, pieces, progress);
    // Several pieces may cover a face together, and sums of windings do not tell that of tangled ones.
    if (leaving.face_count() == 0 && pieces.tangled.empty())
      leaving = uncovered(result.outside, pieces, Curved::Around, segments, progress);
    if (leaving.face_count() == 0) continue;
    if (!pieces.curved.empty())
      result.outside = uncovered(result.outside, pieces, Curved::Within, kSegments[1], progress);
    break;
  }
  result.reach = Reach(result.outside, pieces, progress).run();
  if (result.reach.lower > 0 || one_leaves(leaving, pieces.triangles)) result.covers = Covers::No;
  return result;
}

bool is_within_one(const TriangleMesh& mesh, std::span<const CurvedForm> forms) {
  return std::ranges::any_of(forms, [&](const CurvedForm& form) {
    return std::ranges::all_of(mesh.positions, [&](const Vec3& p) { return form.contains(p); });
  });
}

/// Whether the pieces leave no hole in a curved form, the surface of which they cover: decided for a mesh around it,
/// and that they do for a mesh within it.
Covers fill(const SolidPieces& pieces, const CurvedForm& form, std::size_t segments, const Progress& progress) {
  const TriangleMesh around = form.mesh(Curved::Around, segments), within = form.mesh(Curved::Within, segments);
  if (is_within_one(around, pieces.curved)) return Covers::Yes;
  if (const std::vector<Ball> balls = only_balls(pieces); !balls.empty()) {
    if (verify_union(balls, around, true, {.progress = progress}).certified) return Covers::Yes;
    return verify_union(balls, within, true, {.progress = progress}).holes > 0 ? Covers::No : Covers::Unknown;
  }
  const auto enclosing = [&](const TriangleMesh& inner, const TriangleMesh& piece) {
    return verify_enclosure(inner, piece, {.progress = progress});
  };
  if (std::ranges::any_of(pieces.tangled, [&](const auto& piece) { return enclosing(around, piece).encloses; }))
    return Covers::Yes;
  if (pieces.solids.face_count() == 0 && pieces.curved.empty()) return Covers::Unknown;
  if (enclosing(around, solid_mesh(pieces, Curved::Within, segments)).encloses) return Covers::Yes;
  const bool has_hole =
      pieces.tangled.empty() && enclosing(within, solid_mesh(pieces, Curved::Around, segments)).cavities > 0;
  return has_hole ? Covers::No : Covers::Unknown;
}

/// How far a form reaches out of pieces that cover its surface. From a point of it, the way out of a mesh around it is
/// no longer than from the middle to a corner of that.
DistanceBounds reach_into_holes(const CurvedForm& form, const SolidPieces& pieces, const Progress& progress) {
  const Vec3 middle = form.middle();
  DistanceBounds reach = Reach(mesh_of({{{middle, middle, middle}}}), pieces, progress).run();
  if (reach.lower == 0) reach.farthest = middle;
  for (const Vec3& p : form.mesh(Curved::Around, kSegments[0]).positions)
    reach.upper = std::max(reach.upper, (1 + 0x1p-40) * norm(p - middle));
  return reach;
}

/// Of a form the surface of which the pieces cover, as a mesh around it with so many segments tells; nothing if a finer
/// one may tell more.
std::optional<PieceCover> cover_inside(const CurvedForm& form, const SolidPieces& pieces, std::size_t segments,
                                       const Progress& progress) {
  const Covers covers = fill(pieces, form, segments, progress);
  if (covers == Covers::Yes) return PieceCover{};
  if (covers == Covers::Unknown && segments != kSegments.back()) return std::nullopt;
  return PieceCover{covers, {}, reach_into_holes(form, pieces, progress)};
}

PieceCover cover_curved_by_balls(const CurvedForm& form, std::span<const Ball> balls, const SolidPieces& pieces,
                                 const Progress& progress) {
  PieceCover result{Covers::Unknown, {}, {}};
  for (const std::size_t segments : kSegments) {
    result.outside = uncovered(form.mesh(Curved::Around, segments), balls, progress);
    if (result.outside.face_count() > 0) continue;
    if (const auto cover = cover_inside(form, pieces, segments, progress)) return *cover;
  }
  const auto reach = [&](Curved curved) {
    return Reach(uncovered(form.mesh(curved, kFineness), balls, progress), pieces, progress).run();
  };
  result.reach = reach(Curved::Within);
  result.reach.upper = reach(Curved::Around).upper;
  if (result.reach.lower > 0) result.covers = Covers::No;
  return result;
}

/// Faces around the form to prove that it is covered, and faces within it to prove that it is not.
PieceCover cover_curved(const CurvedForm& form, const SolidPieces& pieces, const Progress& progress) {
  if (std::find(pieces.curved.begin(), pieces.curved.end(), form) != pieces.curved.end()) return {};
  if (const std::vector<Ball> balls = only_balls(pieces); !balls.empty())
    return cover_curved_by_balls(form, balls, pieces, progress);
  PieceCover result{Covers::Unknown, {}, {}};
  for (const std::size_t segments : kSegments) {
    result.outside = uncovered(form.mesh(Curved::Around, segments), pieces, Curved::Within, segments, progress);
    if (result.outside.face_count() == 0) {
      if (const auto cover = cover_inside(form, pieces, segments, progress)) return *cover;
      continue;
    }
    const TriangleMesh within = form.mesh(Curved::Within, segments);
    if (!pieces.tangled.empty() || uncovered(within, pieces, Curved::Around, segments, progress).face_count() == 0)
      continue;
    result.covers = Covers::No;
    break;
  }
  result.reach = Reach(form.mesh(Curved::Within, kFineness), pieces, progress).run();
  result.reach.upper = Reach(form.mesh(Curved::Around, kFineness), pieces, progress).run().upper;
  if (result.reach.lower > 0) result.covers = Covers::No;
  return result;
}

}  // namespace

std::vector<Ball> only_balls(const SolidPieces& pieces) {
  std::vector<Ball> balls;
  for (const CurvedForm& form : pieces.curved)
    if (const auto ball = form.ball()) balls.push_back(*ball);
  const bool has_others = pieces.solids.face_count() + pieces.triangles.face_count() > 0 || !pieces.tangled.empty() ||
                          balls.size() < pieces.curved.size();
  return has_others ? std::vector<Ball>() : balls;
}

bool is_tangled(const TriangleMesh& mesh, const Progress& progress) {
  return verify::winds_negatively(mesh, verify::most_steps({}, mesh.face_count()), progress) != Answer::No;
}

PieceCover verify_pieces(const TriangleMesh& triangles, const SolidPieces& pieces, const Progress& progress) {
  return cover_flat(triangles, pieces, progress);
}

PieceCover verify_pieces(const CurvedForm& form, const SolidPieces& pieces, const Progress& progress) {
  return cover_curved(form, pieces, progress);
}

}  // namespace prohull
