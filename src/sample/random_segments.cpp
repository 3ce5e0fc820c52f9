#include "prohull/detail/random_segments.h"

#include <random>

#include "prohull/error.h"

namespace prohull {
namespace {

/// Uniform numbers with the same bits everywhere. The standard fixes those of the engine, but not those of its
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// One of 0 to count - 1; none is likelier than another by more than count / 2^64.
  unsigned below(unsigned count) { return static_cast<unsigned>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

Vec3 point_in(const Box& box, Random& random) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = box.min[axis] + random.unit() * (box.max[axis] - box.min[axis]);
  return p;
}

Vec3 point_on_side(const Box& box, unsigned side, Random& random) {
  Vec3 p = point_in(box, random);
  const int axis = static_cast<int>(side / 2);
  p[axis] = side % 2 == 0 ? box.min[axis] : box.max[axis];
  return p;
}

Box twice(const Box& box) {
  if (box.is_empty()) throw InputError(Defect::EmptyMesh, "an empty box has no sides for segments to start from");
  const Vec3 center = box.center(), extent = box.max - box.min;
  const Box twice{center - extent, center + extent};
  if (!is_finite(twice.max - twice.min))
    throw InputError(Defect::NonFiniteCoordinate, "a box twice as large as this one overflows; scale the mesh");
  return twice;
}

}  // namespace

std::vector<Segment> random_segments(const Box& box, std::size_t count, std::uint64_t seed) {
  const Box sides = twice(box);
  constexpr unsigned kSides = 6;
  Random random(seed);
  std::vector<Segment> segments;
  segments.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned from = random.below(kSides), to = (from + 1 + random.below(kSides - 1)) % kSides;
    const Vec3 a = point_on_side(sides, from, random);
    segments.push_back({a, point_on_side(sides, to, random)});
  }
  return segments;
}

std::vector<Vec3> random_points(const Box& box, std::size_t count, std::uint64_t seed) {
  twice(box);  // for what it throws
  Random random(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = point_in(box, random);
  return points;
}

}  // namespace prohull
