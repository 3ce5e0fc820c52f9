#include "verify/nearest_face.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"
#include "geometry/morton_code.h"
#include "geometry/triangle_distance.h"
#include "prohull/error.h"

namespace prohull::verify {

void require_distances(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "there is no distance without faces");
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate, "there is no distance from coordinates that are not finite");
}

double largest_coordinate(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  return box.is_empty() ? 0 : prohull::largest_coordinate(box);
}

double usable_unit(double largest_coordinate) {
  constexpr double kLarge = 0x1p200;
  if (largest_coordinate == 0 || !std::isfinite(largest_coordinate)) return 1;
  if (1 / kLarge < largest_coordinate && largest_coordinate < kLarge) return 1;
  return std::ldexp(1.0, -std::max(std::ilogb(largest_coordinate), -1000));
}

TriangleMesh scaled(TriangleMesh mesh, double unit) {
  for (Vec3& p : mesh.positions) p = p * unit;
  return mesh;
}

DistanceBounds unscaled(const DistanceBounds& bounds, double unit) {
  if (unit == 1) return bounds;
  const double lower = bounds.lower / unit;  // exact but for those that underflow
  return {lower * unit > bounds.lower ? std::nextafter(lower, 0) : lower,
          std::nextafter(bounds.upper / unit, std::numeric_limits<double>::infinity()), bounds.farthest / unit};
}

NearestFace::NearestFace(const TriangleMesh& mesh) : mesh_(mesh), cube_(bounding_box(mesh)) {
  std::vector<std::uint64_t> by_code;
  by_code.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) {
    const auto [x, y, z] = cube_.at(box_of(mesh.triangle(f)).center());
    by_code.push_back(std::uint64_t{morton_code(x, y, z)} << 32 | index(f));
  }
  std::sort(by_code.begin(), by_code.end());
  std::vector<FloatBox> boxes;
  boxes.reserve(by_code.size()), face_at_.reserve(by_code.size());
  for (const std::uint64_t code : by_code) {
    face_at_.push_back(static_cast<std::uint32_t>(code));
    boxes.push_back(cube_.at(mesh.triangle(FaceId{face_at_.back()})));
  }
  levels_ = four_wide_tree(std::move(boxes));
}

namespace {

/// A point of the unit cube, and how far boxes are from it.
class FromPoint {
 public:
  explicit FromPoint(const std::array<float, 3>& p) {
    constexpr float kFar = 0x1p40f;  // beyond this, boxes count as nearer than they are
    float reach = 1;
    for (const float x : p) reach = std::max(reach, std::min(std::abs(x), kFar));
    // The coordinates of both, and a difference, are rounded by at most 2^-22 of it.
    const float slack = 0x1p-21f * reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float x = std::clamp(p[axis], -kFar, kFar), low = x - slack, high = x + slack;
      low_[axis] = Float4{low, low, low, low}, high_[axis] = Float4{high, high, high, high};
    }
  }

  /// Never above the squared distances of what is in the boxes, but for the rounding of squares and sums.
  Float4 squared_distances(const FourBoxes& boxes) const {
    Float4 sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float4 gap = max(max(boxes.min[axis] - high_[axis], low_[axis] - boxes.max[axis]), Float4{});
      sum += gap * gap;
    }
    return sum;
  }

 private:
  Float4 low_[3], high_[3];
};

}  // namespace

template <class Measure>
void NearestFace::visit_near(const Vec3& p, double best, Measure measure) const {
  if (face_at_.empty()) return;
  struct Open {
    float squared_distance;
    std::uint32_t level, node;
  };
  constexpr std::size_t kMostOpen = 64;  // three in each of at most 16 levels, and four
  constexpr float kMore = 1 + 0x1p-19f;  // of rounded squares and sums
  std::array<Open, kMostOpen> stack;
  const auto limit_of = [&](double distance) {
    const auto length = static_cast<float>(std::min(distance * cube_.scale(), 0x1p60));
    return length * length * kMore;
  };
  const FromPoint from(cube_.at(p));
  float limit = limit_of(best);
  stack[0] = {0, static_cast<std::uint32_t>(levels_.size()), 0};
  for (std::size_t size = 1; size > 0;) {
    const Open open = stack[--size];
    if (open.squared_distance > limit) continue;
    if (open.level == 0) {
      best = std::min(best, measure(face_at_[open.node]));
      limit = limit_of(best);
      continue;
    }
    const Float4 distances = from.squared_distances(levels_[open.level - 1][open.node]);
    const std::size_t first = size;
    for (unsigned near = mask(distances <= Float4{limit, limit, limit, limit}); near != 0; near &= near - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
      const float d = distances[i];
      std::size_t at = size++;
      for (; at > first && stack[at - 1].squared_distance < d; --at) stack[at] = stack[at - 1];
      stack[at] = {d, open.level - 1, FourBoxes::kWidth * open.node + i};
    }
  }
}

double NearestFace::distance(const Vec3& p, std::uint32_t face) const {
  return norm(p - closest_point(p, mesh_.triangle(FaceId(face))));
}

double NearestFace::at_least(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  visit_near(p, least, [&](std::uint32_t f) {
    const TriangleDistance d = triangle_distance({p, p, p}, mesh_.triangle(FaceId(f)));
    least = std::min(least, d.lower);
    return d.upper;
  });
  return least;
}

// Of a needle, the closest point that is found may be far from the closest one.
DistanceBounds proven(const DistanceBounds& found, const NearestFace& faces, double rounding) {
  DistanceBounds bounds{.upper = found.upper + rounding};
  if (found.lower > 0) bounds.lower = std::max(0.0, faces.at_least(found.farthest) - rounding);
  if (bounds.lower > 0) bounds.farthest = found.farthest;
  return bounds;
}

NearestFace::Found NearestFace::nearest(const Vec3& p, Found known, std::size_t& looked_at) const {
  visit_near(p, known.distance, [&](std::uint32_t f) {
    ++looked_at;
    const double d = distance(p, f);
    if (d < known.distance) known = {f, d};
    return d;
  });
  return known;
}

namespace {

/// No point of the part is farther away.
double upper(const FarFromFaces::Part& part) {
  std::array<double, 7> farthest{};  // from each face, the mean of two, and the mean of all
  for (const auto& [a, b, c] : part.distances) {
    const std::array from{a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
    for (std::size_t i = 0; i < from.size(); ++i) farthest[i] = std::max(farthest[i], from[i]);
  }
  return std::ranges::min(farthest);
}

/// A side of a part, and how far along it the part is cut.
struct CutPlace {
  std::size_t side;
  double fraction;
};

/// Where another face becomes the nearer one: both halves are then near to one. Of strips that lie over strips, this
/// leaves half of the parts that halves of the longest side do, and of faces in one plane few more than there are edges
/// between them. Short sides would lead to ever shorter ones, and what is cut at other sides may keep the longest.
CutPlace cut_place(const FarFromFaces::Part& part) {
  constexpr double kShort = 0.25;   // of the bound
  constexpr double kLeast = 0.125;  // of the side
  const auto longest = static_cast<std::size_t>(longest_side(part.corners));
  double greatest = kShort * upper(part);
  CutPlace place{longest, 0.5};
  for (const std::size_t i : {longest, (longest + 1) % 3, (longest + 2) % 3}) {
    const std::size_t j = (i + 1) % 3;
    const double from_i = part.distances[i][j] - part.distances[i][i],
                 from_j = part.distances[j][i] - part.distances[j][j];
    if (!(from_i > 0 && from_j > 0 && from_i + from_j > greatest)) continue;
    greatest = from_i + from_j;
    place = {i, std::clamp(from_i / greatest, kLeast, 1 - kLeast)};
    if (i == longest) break;
  }
  return place;
}

}  // namespace

void FarFromFaces::add(const Triangle& t, const std::array<NearestFace::Found, 3>& nearest, Search& search) const {
  Part part{{t.a, t.b, t.c}, {}, {}, 0};
  for (std::size_t j = 0; j < 3; ++j) part.faces[j] = nearest[j].face;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      part.distances[i][j] = i == j ? nearest[i].distance : faces_.distance(part.corners[i], part.faces[j]);
  search.add(part, upper(part));
}

NearestFace::Found FarFromFaces::look_at(const Vec3& p, Search& search, const NearestFace::Found& known) const {
  std::size_t looked_at = 0;
  const NearestFace::Found found = faces_.nearest(p, known, looked_at);
  search.took(looked_at);
  search.reaches(p, found.distance);
  return found;
}

void FarFromFaces::cut(const Part& part, Search& search) const {
  if (part.cuts == kMostCuts) return search.leave(upper(part));
  const auto [i, fraction] = cut_place(part);
  const std::size_t j = (i + 1) % 3;
  const Vec3 p = part.corners[i] * (1 - fraction) + part.corners[j] * fraction;
  std::array<double, 3> distances;
  for (std::size_t k = 0; k < 3; ++k) distances[k] = faces_.distance(p, part.faces[k]);
  Part one = part;
  ++one.cuts;
  Part other = one;
  one.corners[j] = other.corners[i] = p;
  one.distances[j] = other.distances[i] = distances;
  if (search.is_enough(upper(one)) && search.is_enough(upper(other))) {
    search.add(one, upper(one)), search.add(other, upper(other));
    return;
  }
  const auto guess = static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
  const NearestFace::Found found = look_at(p, search, {part.faces[guess], distances[guess]});
  one.faces[j] = other.faces[i] = found.face;
  for (std::size_t k = 0; k < 3; ++k)
    one.distances[k][j] = other.distances[k][i] = faces_.distance(part.corners[k], found.face);
  one.distances[j][j] = other.distances[i][i] = found.distance;
  search.add(one, upper(one)), search.add(other, upper(other));
}

}  // namespace prohull::verify
