#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "geometry/interior_contact.h"
#include "geometry/orientation.h"
#include "geometry/triangle_intersection.h"
#include "geometry/triangle_predicates.h"
#include "mesh/closed.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "verify/arrangement.h"
#include "verify/cell.h"
#include "verify/offenders.h"
#include "verify/self_intersection.h"
#include "verify/solids.h"
#include "verify/surface.h"
#include "verify/winding.h"

// Why the decision is complete. Let H be the outer surface, w its winding number and C the closure of the points off H
// where w >= 1. C is closed, so that a triangle lies in C if and only if a dense part of it does, and single points of
// it need no answer. H is made of finitely many flat pieces: near any point p it is a cone with the tip p. Therefore:
//
//   (1) Off H, p lies in C if and only if w(p) >= 1, and w is the same on everything connected that is off H.
//   (2) On H, p lies in C if and only if w >= 1 beside some piece of a face of H, as H cuts itself, that has p in its
//       closure: a region of space that has p in its closure does not fill the surroundings of p, through which a face
//       passes; what bounds it there are such pieces.
//
// A triangle with an area is divided into parts by the faces of H that meet its inside in a segment (Arrangement): w is
// the same everywhere on each side of a part, and decides, by (1) or, where faces hold the part or some of it, by (2).
// Where no face cuts the triangle and none holds it, all of it is one part ("free"); where H does not touch it at all,
// all that is free and shares a corner with it lies in the same region of H, and one corner decides.
//
// A triangle without area is a segment or a point. It is cut at the ends of what faces of H hold of it, and the middle
// of each piece decides: by (1), or by (2) with all pieces of the faces that hold it.
//
// A face of H beside which w >= 1 everywhere lies in C, and so does all that it holds; usually that is every face.
// Likewise a triangle that several such faces hold together, as in flat parts that H and the original divide into
// triangles differently: the faces hold a part of its inside that is closed in it, and open as well if at every edge of
// theirs that meets it another one goes on, in the same plane and on the other side, so that it is all of the inside.

namespace prohull {
namespace verify {
namespace {

std::array<Vec3, 3> corners_of(const Triangle& t) { return {t.a, t.b, t.c}; }

bool is_covered(const Windings& w) { return w.outside[0] >= 1 || w.inside[0] >= 1; }
bool is_uncovered(const Windings& w) { return !is_covered(w); }

/// Which parts of the faces of a surface lie in C.
class CoveredFaces {
 public:
  CoveredFaces(const Surface& surface, const FacePairs& pairs, Steps& steps)
      : surface_(surface),
        steps_(steps),
        meets_(surface.faces.size()),
        sheets_(surface.faces.size()),
        all_(surface.faces.size(), Answer::NotAsked) {
    for (const auto& [f, g] : pairs) meets_[f].push_back(g), meets_[g].push_back(f);
    self_intersections_ = pairs.size();
  }

  std::size_t self_intersections() const { return self_intersections_; }
  bool meets_others(FaceIndex f) const { return !meets_[f].empty(); }

  /// All of the face.
  bool contain(FaceIndex f) {
    if (beyond_.empty()) follow_edges();
    if (are_sheets_) return true;
    f = sheets_.find(f);
    if (all_[f] == Answer::NotAsked) {
      Arrangement pieces(surface_.faces[f], surface_.axis[f], random_, steps_);
      pieces.add(0, surface_, cutters_of(f));
      all_[f] = pieces.has_part(is_uncovered) ? Answer::No : Answer::Yes;
    }
    return all_[f] == Answer::Yes;
  }

  /// All of another face that goes on in the plane of f beyond its edge e, if that edge has just these two faces.
  bool go_on(FaceIndex f, int e) {
    if (beyond_.empty()) follow_edges();
    const FaceIndex g = beyond_[f][e];
    return g != f && contain(g);
  }

  /// A point of the face, by the pieces of it that have the point in their closures.
  bool contain(FaceIndex f, const ExactPoint& p) {
    if (contain(f)) return true;
    Arrangement pieces(surface_.faces[f], surface_.axis[f], random_, steps_);
    pieces.add(0, surface_, cutters_of(f));
    return pieces.has_part_at(p, is_covered);
  }

 private:
  enum class Answer : std::uint8_t { NotAsked, Yes, No };

  /// Looks beyond the edges that have just two faces. If these meet no other faces, there are but two regions around
  /// the edge, and each face has both beside it.
  void follow_edges() {
    for (FaceIndex f = 0; f < surface_.faces.size(); ++f) beyond_.push_back({f, f, f});
    const std::vector<FaceEdge> sides = edges(surface_);
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      for (end = i; end < sides.size() && sides[end].key == sides[i].key;) ++end;
      if (end - i != 2) continue;
      const auto [key, f, e] = sides[i];
      const auto [same, g, d] = sides[i + 1];
      if (meets_[f].empty() && meets_[g].empty()) sheets_.join(f, g);
      const auto here = corners_of(surface_.faces[f]), there = corners_of(surface_.faces[g]);
      const Vec3 &p = here[e], &q = here[(e + 1) % 3], &r = here[(e + 2) % 3], &s = there[(d + 2) % 3];
      const int axis = surface_.axis[f];
      if (side(surface_.faces[f], s) == Side::On && turn(axis, p, q, r) * turn(axis, p, q, s) < 0)
        beyond_[f][e] = g, beyond_[g][d] = f;
    }
    are_sheets_ = self_intersections_ > 0 && are_outward_sheets(sides);
  }

  /// Whether each component is_outward_sheet without self-intersections, as of parts that only pass through each other.
  /// Then each winds once around what is beside its faces on their inner side, and none winds around anything less than
  /// zero times.
  bool are_outward_sheets(const std::vector<FaceEdge>& sides) const {
    DisjointSets components(surface_.faces.size());
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (sides[i].key == sides[i - 1].key) components.join(sides[i].face, sides[i - 1].face);
    for (FaceIndex f = 0; f < meets_.size(); ++f)
      for (const FaceIndex g : meets_[f])
        if (components.find(f) == components.find(g)) return false;
    std::map<FaceIndex, TriangleMesh> meshes;
    for (FaceIndex f = 0; f < surface_.faces.size(); ++f) {
      TriangleMesh& mesh = meshes[components.find(f)];
      const auto [a, b, c] = corners_of(surface_.faces[f]);
      mesh.triangles.push_back({mesh.positions.push_back(a), mesh.positions.push_back(b), mesh.positions.push_back(c)});
    }
    return std::ranges::all_of(meshes, [](const auto& mesh) { return is_outward_sheet(mesh.second); });
  }

  std::vector<Triangle> cutters_of(FaceIndex f) const {
    std::vector<Triangle> cutters;
    for (const FaceIndex g : meets_[f])
      if (interior_contact(surface_.faces[f], surface_.axis[f], surface_.faces[g]).interior == Contact::Crossing)
        cutters.push_back(surface_.faces[g]);
    return cutters;
  }

  const Surface& surface_;
  Steps& steps_;
  std::vector<std::vector<FaceIndex>> meets_;
  bool are_sheets_ = false;
  DisjointSets sheets_;                           // of faces that have the same regions beside them
  std::vector<Answer> all_;                       // by representative
  std::vector<std::array<FaceIndex, 3>> beyond_;  // each edge: the face that goes on in the plane, or the face itself
  std::size_t self_intersections_ = 0;
  std::mt19937 random_;  // no answer depends on it
};

Number difference(double a, double b) { return Number(a) - Number(b); }

/// The determinant of turn(axis, a, b, p).
Number doubled_area(int axis, const Vec3& a, const Vec3& b, const Vec3& p) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return difference(b[u], a[u]) * difference(p[v], a[v]) - difference(b[v], a[v]) * difference(p[u], a[u]);
}

/// Positive outside of the plane of h.
Number height(const Triangle& h, const Vec3& p) {
  Number sum(0);
  for (int axis = 0; axis < 3; ++axis) sum += doubled_area(axis, h.a, h.b, h.c) * difference(p[axis], h.a[axis]);
  return sum;
}

/// The part of a segment that a face holds, by fractions of the way from a to b.
struct HeldPart {
  FaceIndex face;
  Number begin, end;
};

/// For a face that the segment touches.
HeldPart held_part(const Segment& s, const Surface& surface, FaceIndex f) {
  const Triangle& h = surface.faces[f];
  const Number from = height(h, s.a), to = height(h, s.b);
  if (from != to) {
    const Number at = from / (from - to);
    return {f, at, at};
  }
  const int axis = surface.axis[f], orientation = turn(axis, h.a, h.b, h.c);
  HeldPart part{f, 0, 1};
  for (const auto& [p, q] : {std::pair{h.a, h.b}, {h.b, h.c}, {h.c, h.a}}) {
    const Number a = orientation * doubled_area(axis, p, q, s.a), b = orientation * doubled_area(axis, p, q, s.b);
    if (a < 0) part.begin = std::max(part.begin, Number(a / (a - b)));
    if (b < 0) part.end = std::min(part.end, Number(a / (a - b)));
  }
  return part;
}

ExactPoint between(const Segment& s, const Number& fraction) {
  std::array<Number, 3> p;
  for (int i = 0; i < 3; ++i) p[i] = s.a[i] + fraction * difference(s.b[i], s.a[i]);
  return ExactPoint(std::move(p));
}

class CoverVerifier {
 public:
  CoverVerifier(const TriangleMesh& mesh, const TriangleMesh& outer, const EnclosureOptions& options)
      : mesh_(mesh),
        outer_(outer, "outer"),
        options_(options),
        counter_(options.progress, "verify", mesh.face_count()),
        steps_(counter_.meter(), options.max_steps),
        covered_(outer_, self_intersections(outer_, counter_.meter()), steps_),
        number_(numbered_by_position(mesh.positions)),
        groups_(mesh.vertex_count()),
        is_clear_(mesh.vertex_count()) {}

  EnclosureReport report() {
    for (const FaceId f : mesh_.triangles.ids()) {
      if (is_enough()) break;
      counter_.next();
      try {
        check(f);
      } catch (const OutOfSteps&) {
        ++undecided_;
      }
    }
    check_free();
    EnclosureReport report;
    report.self_intersections = covered_.self_intersections();
    report.outer_volume = outer_.volume;
    report.faces_outside = offenders_.size();
    report.faces_undecided = undecided_;
    report.encloses = offenders_.empty() && undecided_ == 0;
    report.worst = worst_of(std::move(offenders_), options_.max_offenders);
    counter_.finish();
    return report;
  }

 private:
  bool is_enough() const { return offenders_.size() > options_.most_outside; }

  void check(FaceId f) {
    const Triangle t = mesh_.triangle(f);
    const Box box = box_of(t);
    near_.clear();
    outer_.bvh.visit([&](const Box& other) { return box.overlaps(other); },
                     [&](FaceIndex h) {
                       if (!certainly_apart(t, outer_.faces[h])) near_.push_back(h);
                     });
    if (near_.empty())
      add_clear(f);
    else if (const auto axis = projection_axis(t))
      check_triangle(f, t, *axis);
    else
      check_segment(f, t);
  }

  void check_triangle(FaceId f, const Triangle& t, int axis) {
    bool is_met = false;
    cutters_.clear();
    holders_.clear();
    for (const FaceIndex h : near_) {
      const TriangleContact c = interior_contact(t, axis, outer_.faces[h]);
      if (c.interior == Contact::None) continue;
      is_met = true;
      if (c.interior == Contact::Crossing) cutters_.push_back(outer_.faces[h]);
      if (c.interior == Contact::Crossing || !covered_.contain(h)) continue;
      if (c.interior == Contact::Same || holds(outer_.faces[h], axis, t)) return;
      holders_.push_back(h);
    }
    if (!is_met)
      free_.push_back(f);
    else if (!are_held_together(t, axis))
      check_parts(f, t, axis);
  }

  /// Whether the holders go on beyond each of their edges that meets the inside of t.
  bool are_held_together(const Triangle& t, int axis) {
    for (const FaceIndex h : holders_) {
      const auto corners = corners_of(outer_.faces[h]);
      for (int e = 0; e < 3; ++e)
        if (meets_inside(t, axis, corners[e], corners[(e + 1) % 3]) && !covered_.go_on(h, e)) return false;
    }
    return !holders_.empty();
  }

  /// For p and q in the plane of t: a segment misses the inside of a triangle if and only if the line of an edge, or of
  /// the segment, separates them.
  static bool meets_inside(const Triangle& t, int axis, const Vec3& p, const Vec3& q) {
    const int inside = turn(axis, t.a, t.b, t.c);
    for (const auto& [a, b] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}})
      if (turn_at_edge(axis, a, b, p) != inside && turn_at_edge(axis, a, b, q) != inside) return false;
    const auto [least, greatest] =
        std::minmax({turn_at_edge(axis, p, q, t.a), turn_at_edge(axis, p, q, t.b), turn_at_edge(axis, p, q, t.c)});
    return least < 0 && greatest > 0;
  }

  /// Whether h, in the plane of t, holds all of t.
  static bool holds(const Triangle& h, int axis, const Triangle& t) {
    const int outside = -turn(axis, h.a, h.b, h.c);
    for (const auto& [p, q] : {std::pair{h.a, h.b}, {h.b, h.c}, {h.c, h.a}})
      for (const Vec3& corner : {t.a, t.b, t.c})
        if (turn_at_edge(axis, p, q, corner) == outside) return false;
    return true;
  }

  void check_parts(FaceId f, const Triangle& t, int axis) {
    Arrangement parts(t, axis, random_, steps_);
    parts.add(0, outer_, cutters_);
    const std::vector<Vec3> uncovered = parts.points_of_parts(is_uncovered);
    if (!uncovered.empty()) offenders_.push_back(farthest(f, uncovered, outer_));
  }

  void check_segment(FaceId f, const Triangle& t) {
    std::erase_if(near_, [&](FaceIndex h) { return !triangles_touch(t, outer_.faces[h]); });
    if (near_.empty()) return add_clear(f);
    const Segment s = segment_of(t);
    std::vector<HeldPart> parts;
    std::vector<Number> ends{0, 1};
    for (const FaceIndex h : near_) {
      const HeldPart& part = parts.emplace_back(held_part(s, outer_, h));
      ends.push_back(part.begin);
      ends.push_back(part.end);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<Vec3> uncovered;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const Number middle = (ends[i - 1] + ends[i]) / 2;
      if (contains(between(s, middle), middle, parts)) continue;
      for (const Number& fraction : {ends[i - 1], middle, ends[i]}) uncovered.push_back(between(s, fraction).rounded());
    }
    if (!uncovered.empty()) offenders_.push_back(farthest(f, uncovered, outer_));
  }

  /// Whether C contains the point of a segment at `fraction`.
  bool contains(const ExactPoint& p, const Number& fraction, std::span<const HeldPart> parts) {
    bool is_on = false;
    for (const HeldPart& part : parts) {
      if (fraction < part.begin || part.end < fraction) continue;
      if (covered_.contain(part.face, p)) return true;
      is_on = true;
    }
    return !is_on && winding_at(outer_, p) >= 1;
  }

  /// A triangle that H does not touch.
  void add_clear(FaceId f) {
    free_.push_back(f);
    for (const VertexId v : mesh_.triangles[f]) is_clear_[number_[index(v)]] = true;
  }

  void check_free() {
    for (const FaceId f : free_) {
      const auto first = clear_corner(f);
      if (!first) continue;
      for (const VertexId v : mesh_.triangles[f])
        if (const std::uint32_t i = number_[index(v)]; is_clear_[i]) groups_.join(*first, i);
    }
    std::vector<std::optional<bool>> is_covered(mesh_.vertex_count());  // by representative
    for (const FaceId f : free_) {
      if (is_enough()) break;
      const auto corner = clear_corner(f);
      if (!corner) {
        check_alone(f);
        continue;
      }
      auto& answer = is_covered[groups_.find(*corner)];
      if (!answer) answer = winding_at(outer_, ExactPoint(mesh_.positions[VertexId(*corner)])) >= 1;
      if (!*answer) add_outside(f);
    }
  }

  /// A free triangle that touches H with all corners that do not belong to others.
  void check_alone(FaceId f) {
    const Triangle t = mesh_.triangle(f);
    const int axis = *projection_axis(t);
    const Cell cell = whole_cell(t, axis);
    SurfacePoint p(t, axis, cell, random_);
    if (!winding_beside(outer_, p, cell, random_).is_cover()) add_outside(f);
  }

  std::optional<std::uint32_t> clear_corner(FaceId f) const {
    for (const VertexId v : mesh_.triangles[f])
      if (const std::uint32_t i = number_[index(v)]; is_clear_[i]) return i;
    return std::nullopt;
  }

  /// A triangle of which all but single points is outside.
  void add_outside(FaceId f) {
    const Triangle t = mesh_.triangle(f);
    offenders_.push_back(farthest(f, std::array{t.a, t.b, t.c, t.a / 3 + t.b / 3 + t.c / 3}, outer_));
  }

  const TriangleMesh& mesh_;
  const Surface outer_;
  const EnclosureOptions& options_;
  ProgressCounter counter_;
  Steps steps_;
  CoveredFaces covered_;
  const std::vector<std::uint32_t> number_;  // of the vertices, by position
  DisjointSets groups_;                      // of clear vertices, which are in one region of H
  std::vector<bool> is_clear_;               // by number: H does not touch a triangle that has the vertex
  std::vector<FaceId> free_;                 // the triangles that no face of H cuts or holds
  std::vector<FaceIndex> near_;              // of the triangle at hand
  std::vector<Triangle> cutters_;            // of the triangle at hand
  std::vector<FaceIndex> holders_;           // faces in C that hold a part of the triangle at hand
  std::mt19937 random_;                      // the verdict does not depend on it
  std::vector<Offender> offenders_;
  std::size_t undecided_ = 0;
};

}  // namespace

std::vector<FaceId> faces_beside_the_solid(const Surface& surface, const TriangleMesh& mesh, const FacePairs& pairs,
                                           const Progress& progress) {
  ProgressCounter counter(progress, "verify", surface.faces.size());
  Steps steps(counter.meter(), std::numeric_limits<std::size_t>::max());
  CoveredFaces covered(surface, pairs, steps);
  // To find out takes a cut for each pair; from some number on it is faster to ask whether the hull covers them.
  constexpr std::size_t kMostPairs = 1000;
  const bool are_few = covered.self_intersections() <= kMostPairs;
  PerFace<char> bounds_it(mesh.face_count(), 0);
  for (FaceIndex f = 0; f < surface.faces.size(); ++f) {
    counter.next();
    bounds_it[surface.source[f]] = (are_few || !covered.meets_others(f)) && covered.contain(f);
  }
  std::vector<FaceId> result;
  for (const FaceId f : mesh.triangles.ids())
    if (!bounds_it[f]) result.push_back(f);
  counter.finish();
  return result;
}

// Beside an edge there are its two faces only, so without self-intersections each side of the surface is in one region
// of space. One of the two regions is that outside of all, with a winding number of 0. Then that of the other one is 1
// or -1, as the volume is.
bool is_outward_sheet(const TriangleMesh& mesh) { return is_one_sheet(mesh) && volume_sign(mesh) > 0; }

}  // namespace verify

EnclosureReport verify_cover(const TriangleMesh& triangles, const TriangleMesh& outer,
                             const EnclosureOptions& options) {
  require_usable(triangles, "original");
  return verify::CoverVerifier(triangles, outer, options).report();
}

}  // namespace prohull
