#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enclose/request.h"
#include "prohull/collide.h"
#include "prohull/enclosing_hull.h"
#include "verify/original.h"

namespace prohull {

constexpr double kTentHeight = 64;  ///< above a slab, in its widths: 1/64 of the diagonal

using SolidId = std::size_t;  ///< its place in EnclosingHulls::solids

struct WrapKind {
  double nodes_per_edge;   ///< of a face of the hull: the grid is as fine as these faces can carry, about
  double offset, closing;  ///< as in WrapOptions, in spacings
  double flatness = 0;     ///< as in WrapOptions

  bool operator==(const WrapKind&) const = default;
};

/// The closed meshes that hulls are built from, and what is made once of each. All is made when it is asked for first.
class Solids {
 public:
  explicit Solids(const Request& request);

  const Solid& operator[](SolidId id) const { return entries_[id].solid; }
  std::size_t size() const { return entries_.size(); }

  bool has_mesh() const { return !entries_.empty() && entries_[0].solid.source == Source::Mesh; }
  /// The mesh, with its folds covered (folds.h). None if that does not help.
  std::optional<SolidId> unfolded();
  /// The mesh, with sheets around what it does not cover, as far from it as about `distance` (folds.h). None if that
  /// does not help.
  std::optional<SolidId> with_sheets(double distance);
  /// A slab around what is flat, if it is convex. None around other flat input, or if its padded volume is known to be
  /// `too_large` before it is made.
  std::optional<SolidId> convex_hull(std::optional<double> too_large);
  /// A convex polytope of at most so many faces, at least 4, around the convex hull, or a tent over what is flat. None
  /// if the convex hull has no more faces itself.
  std::optional<SolidId> polytope(std::size_t faces);
  /// At a distance from what is closed, or from sheets with nothing inside. None if it would pass through itself.
  std::optional<SolidId> offset(double distance);
  /// For a hull of so many faces. None if nothing is thick enough, or `why_not` says why.
  std::optional<SolidId> wrap(const WrapKind& kind, double spacing, std::size_t faces, std::string& why_not);
  /// Those made for hulls of so many faces, which must not depend on what else is asked for.
  std::span<const SolidId> wraps(std::size_t faces) const;

  /// What hulls are verified against.
  verify::Original& original() { return original_; }
  /// The progressive hull of the solid, down to the fewest faces that are asked for.
  const HullResult& levels(SolidId id, std::uint64_t seed);
  /// What its hulls must cover: the triangles, their caps, and the doors of the wrap.
  const TriangleMesh& to_cover(SolidId id) const;
  /// A lower bound of the distance of a hull from that.
  double distance_from(const TriangleMesh& hull, SolidId id);

  /// Of what lies inside of the input; 0 if nothing is known of it. Of what is not closed, the first wrap tells it.
  double volume(std::size_t faces) const;
  /// That with which bounds compare hulls: filled_volume, or that of the original as verify_hull has it. As `volume`
  /// where the original bounds no solid, or is too tangled.
  double verified_volume(std::size_t faces) const;
  /// Of the closed mesh, where repairs have dropped parts within others, as cavities: as verify_hull would have it, and
  /// 0 where it is too tangled. None if nothing was dropped.
  std::optional<double> filled_volume() const { return filled_volume_; }
  double repair_seconds() const { return repair_seconds_; }
  std::vector<Solid> taken();  ///< all, in the order in which they were made; nothing is left here

 private:
  struct Entry {
    Solid solid;
    TriangleMesh with_doors;                     ///< if it has doors: what to cover, and these
    std::optional<CollisionIndex> surface;       ///< of what to cover
    std::map<std::uint64_t, HullResult> levels;  ///< by seed
    double inside_volume = 0;                    ///< of a wrap: of what it takes for the inside of the input
    std::optional<WrapKind> kind;                ///< of a wrap
  };

  SolidId add(Solid solid);
  std::size_t self_intersections_of(const TriangleMesh& mesh);
  double exact_volume();
  std::optional<Solid> slab() const;
  TriangleMesh padded_convex_solid(TriangleMesh convex) const;

  const Request& request_;
  verify::Original original_;
  std::vector<Entry> entries_;
  double volume_ = 0, verified_volume_ = 0, repair_seconds_ = 0;
  std::optional<double> filled_volume_;
  bool has_no_convex_hull_ = false;
  std::optional<std::optional<SolidId>> unfolded_;  ///< once it was asked for
  std::optional<SolidId> convex_hull_;
  std::map<double, std::optional<SolidId>> offsets_;   ///< by distance
  std::map<double, std::optional<SolidId>> sheets_;    ///< by distance
  std::map<std::size_t, SolidId> polytopes_;           ///< by faces
  std::map<std::size_t, std::vector<SolidId>> wraps_;  ///< by faces
};

}  // namespace prohull
