#include "segment_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "prohull/detail/random_segments.h"

namespace prohull::bench {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : numbers_(seed) {}

  double unit() { return static_cast<double>(numbers_() >> 11) * 0x1p-53; }  ///< in [0, 1)
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(numbers_() % n); }

  Vec3 direction() {
    while (true) {
      const double x = 2 * unit() - 1, y = 2 * unit() - 1, z = 2 * unit() - 1;
      const double length = norm({x, y, z});
      if (length <= 1 && length > 0.1) return Vec3{x, y, z} / length;
    }
  }

 private:
  std::mt19937_64 numbers_;
};

/// Points of the surface, by area.
class Surface {
 public:
  struct Point {
    Vec3 position, normal;
  };

  explicit Surface(const TriangleMesh& mesh) : mesh_(mesh) {
    double area = 0;
    for (const FaceId f : mesh.triangles.ids()) area_up_to_.push_back(area += norm(normal(mesh.triangle(f))));
  }

  /// `part` of the area is before the point, in the order of the faces.
  Point point(double part, Random& random) const {
    const auto face = std::ranges::upper_bound(area_up_to_, part * area_up_to_.back());
    const auto last = area_up_to_.end() - 1;
    const Triangle t = mesh_.triangle(FaceId(static_cast<std::uint32_t>(std::min(face, last) - area_up_to_.begin())));
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 n = normal(t);
    return {t.a + u * (t.b - t.a) + v * (t.c - t.a), n / norm(n)};
  }

 private:
  static Vec3 normal(const Triangle& t) { return cross(t.b - t.a, t.c - t.a); }

  const TriangleMesh& mesh_;
  std::vector<double> area_up_to_;
};

/// Outside of the mesh, in every direction.
Vec3 far_point(const Box& box, Random& random) { return box.center() + box.diagonal() * random.direction(); }

VertexId some_corner(const TriangleMesh& mesh, Random& random) {
  return mesh.triangles[FaceId(random.below(mesh.face_count()))][random.below(3)];
}

std::vector<Segment> box(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  return random_segments(bounding_box(mesh), count, seed);
}

std::vector<Segment> surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const Surface faces(mesh);
  const Box around = bounding_box(mesh);
  std::vector<Segment> segments;
  while (segments.size() < count) {
    const Vec3 from = far_point(around, random), at = faces.point(random.unit(), random).position;
    segments.push_back({from, from + 2 * (at - from)});
  }
  return segments;
}

// In tiles, as renderers go, so that packets are compact.
std::vector<Segment> camera(const TriangleMesh& mesh, std::size_t count, std::uint64_t) {
  constexpr std::size_t kTile = 8;
  const std::size_t tiles = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(count)) / kTile);
  const Box around = bounding_box(mesh);
  const Vec3 view = Vec3{-1, -0.6, -0.4} / norm({1, 0.6, 0.4}), up_axis{0, 0, 1};
  const Vec3 eye = around.center() - 1.2 * around.diagonal() * view;
  const Vec3 right = cross(view, up_axis) / norm(cross(view, up_axis)), up = cross(right, view);
  const double pixel = around.diagonal() / static_cast<double>(kTile * tiles);
  const auto offset = [&](std::size_t i) { return (static_cast<double>(i) + 0.5) * pixel - around.diagonal() / 2; };
  std::vector<Segment> segments;
  for (std::size_t tile = 0; tile < tiles * tiles; ++tile)
    for (std::size_t i = 0; i < kTile * kTile; ++i) {
      const std::size_t x = tile % tiles * kTile + i % kTile, y = tile / tiles * kTile + i / kTile;
      const Vec3 at = around.center() + offset(x) * right + offset(y) * up;
      segments.push_back({eye, eye + 2 * (at - eye)});
    }
  return segments;
}

// Directions are distributed as the cosine to the normal: a point of the unit sphere around the tip of the normal.
std::vector<Segment> ambient_occlusion(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  constexpr std::size_t kDirections = 16;
  Random random(seed);
  const Surface faces(mesh);
  const double size = bounding_box(mesh).diagonal();
  const std::size_t points = std::max<std::size_t>(1, count / kDirections);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < points; ++i) {
    const double part = (static_cast<double>(i) + random.unit()) / static_cast<double>(points);
    const auto [position, normal] = faces.point(part, random);
    const Vec3 from = position + 1e-4 * size * normal;
    for (std::size_t k = 0; k < kDirections; ++k) {
      const Vec3 along = normal + random.direction();
      segments.push_back({from, from + 0.1 * size / std::max(norm(along), 1e-3) * along});
    }
  }
  return segments;
}

std::vector<Segment> to_vertex(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const Box around = bounding_box(mesh);
  std::vector<Segment> segments;
  while (segments.size() < count)
    segments.push_back({far_point(around, random), mesh.positions[some_corner(mesh, random)]});
  return segments;
}

/// Rounded: the line misses the vertex by about a unit in the last place.
std::vector<Segment> past_vertex(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  constexpr double kBeyond = 5;
  std::vector<Segment> segments = to_vertex(mesh, count, seed);
  for (Segment& s : segments) s.b = s.a + kBeyond * (s.b - s.a);
  return segments;
}

std::vector<Segment> to_edge(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const Box around = bounding_box(mesh);
  std::vector<Segment> segments;
  while (segments.size() < count) {
    const auto& corners = mesh.triangles[FaceId(random.below(mesh.face_count()))];
    const std::uint32_t first = random.below(3);
    const Vec3 &p = mesh.positions[corners[first]], &q = mesh.positions[corners[(first + 1) % 3]];
    segments.push_back({far_point(around, random), p * 0.5 + q * 0.5});
  }
  return segments;
}

std::vector<Segment> along_axis(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const Box around = bounding_box(mesh);
  const double margin = around.diagonal() / 4;
  std::vector<Segment> segments;
  while (segments.size() < count) {
    Segment s{mesh.positions[some_corner(mesh, random)], {}};
    s.b = s.a;
    const int axis = static_cast<int>(random.below(3));
    s.a[axis] = around.min[axis] - margin, s.b[axis] = around.max[axis] + margin;
    if (random.below(2) == 1) std::swap(s.a, s.b);
    segments.push_back(s);
  }
  return segments;
}

std::vector<Segment> vertex_to_vertex(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Segment> segments;
  while (segments.size() < count) {
    const Segment s{mesh.positions[some_corner(mesh, random)], mesh.positions[some_corner(mesh, random)]};
    if (s.a != s.b) segments.push_back(s);
  }
  return segments;
}

constexpr std::array kCommon{
    SegmentSet{"box", "from one side of a box to another (P&T 4.2)", box},
    SegmentSet{"surface", "from outside through a random point of the surface", surface},
    SegmentSet{"camera", "a picture of the mesh, in tiles of 8 x 8", camera, true},
    SegmentSet{"ambient occlusion",
               "from points just above the surface, 16 directions each by the cosine, a tenth of the diagonal long",
               ambient_occlusion, true},
};
constexpr std::array kAimed{
    SegmentSet{"to a vertex", "from outside, ending exactly at a vertex", to_vertex},
    SegmentSet{"past a vertex", "from outside, past a vertex within a unit in the last place", past_vertex},
    SegmentSet{"to an edge", "from outside, ending at the rounded middle of an edge", to_edge},
    SegmentSet{"along an axis", "along an axis, exactly through a vertex", along_axis},
    SegmentSet{"vertex to vertex", "exactly from one vertex to another", vertex_to_vertex},
};

}  // namespace

std::span<const SegmentSet> common_sets() { return kCommon; }
std::span<const SegmentSet> aimed_sets() { return kAimed; }

}  // namespace prohull::bench
