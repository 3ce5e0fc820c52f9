#pragma once

#include <array>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "prohull/geometry.h"
#include "verify/steps.h"
#include "verify/surface.h"
#include "verify/winding.h"

namespace prohull::verify {

namespace arranged {
class Segments;
}

/// The winding numbers of up to two surfaces just outside and just inside of a triangle.
struct Windings {
  std::array<int, 2> outside{}, inside{};
  int holders = 0;  ///< triangles of add_holders that hold the part
};

/// How faces of up to two surfaces divide a triangle t: by the segments in which they meet its inside. Beside each part
/// that the segments leave, the windings are the same everywhere. Exact.
///
/// The parts are never made. If some windings are beside a part of t and not beside all of it, a segment bounds that
/// part. Along a segment the windings on its left and on its right change only where other segments cross it or end on
/// it, by what the faces of these contribute; and from one segment to another by what is crossed on the way. Rays
/// through space are needed for a single point of t.
class Arrangement {
 public:
  using Sought = std::function<bool(const Windings&)>;

  /// t has an area along `axis`.
  Arrangement(const Triangle& t, int axis, std::mt19937& random, Steps& steps);
  ~Arrangement();
  Arrangement(const Arrangement&) = delete;
  Arrangement& operator=(const Arrangement&) = delete;

  /// Adds surface 0 or 1, with all faces of it that meet the inside of t in segments.
  void add(std::size_t number, const Surface& surface, std::span<const Triangle> faces);

  /// Adds triangles in the plane of t, with an area, whose number is to be told as Windings::holders. They must outlive
  /// the arrangement.
  void add_holders(std::span<const Triangle> coplanar);

  /// Whether windings that are sought are beside some part.
  bool has_part(const Sought& sought);
  /// The same for parts that have p, a point of t, in their closures.
  bool has_part_at(const ExactPoint& p, const Sought& sought);
  /// Points, rounded, in such parts and at their corners, the first one inside of a part; none if there is no such
  /// part. Where there are many parts, not all of them have points here.
  std::vector<Vec3> points_of_parts(const Sought& sought);

  using Value = std::function<int(const Windings&)>;
  using Visit = std::function<void(const Triangle&, int times)>;
  /// Visits triangles within t, rounded, that overlap: each times its number, they add up to the parts, each times its
  /// value, as sums of oriented triangles do. Which triangles, and how often, is exact.
  void visit_parts(const Value& value, const Visit& visit);

 private:
  const std::unique_ptr<arranged::Segments> segments_;
};

}  // namespace prohull::verify
