#include "exact_reference.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <thread>

namespace prohull::bench {
namespace {

// Exact.

using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

/// In e, by ascending powers. The sign for a small positive e is that of the first coefficient that is not 0.
using Polynomial = std::vector<Integer>;

Polynomial combined(const Polynomial& p, const Polynomial& q, int sign_of_q) {
  Polynomial sum(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < p.size(); ++i) sum[i] += p[i];
  for (std::size_t i = 0; i < q.size(); ++i) sum[i] += sign_of_q * q[i];
  return sum;
}
Polynomial operator+(const Polynomial& p, const Polynomial& q) { return combined(p, q, 1); }
Polynomial operator-(const Polynomial& p, const Polynomial& q) { return combined(p, q, -1); }

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  Polynomial product(p.size() + q.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j)
      if (!p[i].is_zero() && !q[j].is_zero()) product[i + j] += p[i] * q[j];
  return product;
}

int sign(const Polynomial& p) {
  for (const Integer& c : p)
    if (const int s = c.sign(); s != 0) return s;
  return 0;
}

using Point = std::array<Polynomial, 3>;

Point operator-(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }

Polynomial determinant(const Point& x, const Point& y, const Point& z) {
  return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
}

/// Doubles as multiples of one power of two. That also scales e, which changes no sign: all signs here are of
/// polynomials that are linear in the move.
class Scale {
 public:
  explicit Scale(std::initializer_list<Vec3> points) {
    for (const Vec3& p : points)
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] != 0) unit_ = std::min(unit_, std::ilogb(p[axis]) - 52);
  }

  Point fixed(const Vec3& p) const { return {Polynomial{whole(p.x)}, Polynomial{whole(p.y)}, Polynomial{whole(p.z)}}; }
  Point moved(const Vec3& p) const {
    return {Polynomial{whole(p.x), 1}, Polynomial{whole(p.y), 0, 1}, Polynomial{whole(p.z), 0, 0, 1}};
  }

 private:
  Integer whole(double x) const {
    if (x == 0) return 0;
    const int exponent = std::ilogb(x) - 52;
    return Integer(static_cast<std::int64_t>(std::ldexp(x, -exponent))) << static_cast<unsigned>(exponent - unit_);
  }

  int unit_ = std::numeric_limits<int>::max();
};

/// Positive if the moved point is on the outside of the face, times six the volume of both.
Polynomial volume(const Scale& scale, const Vec3& point, const Triangle& face) {
  const Point a = scale.fixed(face.a), x = scale.moved(point);
  return determinant(scale.fixed(face.b) - a, scale.fixed(face.c) - a, x - a);
}

int exact_side(const Vec3& point, const Triangle& face) {
  return sign(volume(Scale{point, face.a, face.b, face.c}, point, face));
}

/// On which side of the line from p to q the moved segment passes.
int exact_turn(const Segment& segment, const Vec3& p, const Vec3& q) {
  const Scale scale{segment.a, segment.b, p, q};
  const Point a = scale.moved(segment.a);
  return sign(determinant(scale.moved(segment.b) - a, scale.fixed(p) - a, scale.fixed(q) - a));
}

/// -1 if the moved segment crosses `first` before `second`, 0 if at one place. Requires that it crosses both.
int exact_order(const Segment& segment, const Triangle& first, const Triangle& second) {
  const Scale scale{segment.a, segment.b, first.a, first.b, first.c, second.a, second.b, second.c};
  const auto start = [&](const Triangle& face) { return volume(scale, segment.a, face); };
  const auto change = [&](const Triangle& face) { return start(face) - volume(scale, segment.b, face); };
  // t = start / change
  const Polynomial one = change(first), other = change(second);
  return sign(start(first) * other - start(second) * one) * sign(one) * sign(other);
}

// Rounded.

struct Rounded {
  double value, error;
  int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }  ///< 0: not known
};

// Each of the six products has rows that are rounded differences, and takes part in five more operations: its relative
// error is less than (1 + u)^8 - 1 < 9 u, u = 2^-53. The sum of the absolute products, computed in the same way, is at
// least (1 - u)^8 of the true one. So 16 u of it bounds the error, but for products that underflow: each of these is
// off by 2^-1075, six of them times an entry of x.
Rounded rounded_determinant(const Vec3& x, const Vec3& y, const Vec3& z) {
  const double value = x.x * (y.y * z.z - y.z * z.y) + x.y * (y.z * z.x - y.x * z.z) + x.z * (y.x * z.y - y.y * z.x);
  const auto of = [](double p) { return std::abs(p); };
  const double permanent = of(x.x) * (of(y.y * z.z) + of(y.z * z.y)) + of(x.y) * (of(y.z * z.x) + of(y.x * z.z)) +
                           of(x.z) * (of(y.x * z.y) + of(y.y * z.x));
  return {value, 16 * 0x1p-53 * permanent + 0x1p-1060 * (1 + of(x.x) + of(x.y) + of(x.z))};
}

Rounded rounded_volume(const Vec3& point, const Triangle& face) {
  return rounded_determinant(face.b - point, face.a - point, face.c - point);
}

int side(const Vec3& point, const Triangle& face) {
  const int rounded = rounded_volume(point, face).sign();
  return rounded != 0 ? rounded : exact_side(point, face);
}

int turn(const Segment& segment, const Vec3& p, const Vec3& q) {
  const Vec3& a = segment.a;
  const int rounded = rounded_determinant(segment.b - a, p - a, q - a).sign();
  return rounded != 0 ? rounded : exact_turn(segment, p, q);
}

/// Where the segment, unmoved, crosses the plane of a face that it crosses when moved.
struct Interval {
  Interval(const Segment& segment, const Triangle& face) {
    const Rounded start = rounded_volume(segment.a, face), end = rounded_volume(segment.b, face);
    const double before = std::abs(start.value), behind = std::abs(end.value);
    middle = before / (before + behind);
    // t grows with the volume at the start and falls with that at the end; three more roundings.
    const auto t = [](double from, double to) { return from / (from + to); };
    low = t(std::max(0.0, before - start.error), behind + end.error) * (1 - 8 * 0x1p-53);
    high = t(before + start.error, std::max(0.0, behind - end.error)) * (1 + 8 * 0x1p-53);
  }
  double low, middle, high;
};

/// Whether the line certainly misses the box in the plane of two axes, seen from the origin of the line: `center` and
/// `half` are off by less than 4 u (|center| + half), the direction by u, and the products and sums by less than 4 u.
bool misses(double dy, double dz, double cy, double cz, double hy, double hz) {
  const double distance = std::abs(dy * cz - dz * cy);
  const double reach = std::abs(dy) * hz + std::abs(dz) * hy;
  const double size = std::abs(dy) * (std::abs(cz) + hz) + std::abs(dz) * (std::abs(cy) + hy);
  return distance > reach + 32 * 0x1p-53 * size + 0x1p-1060;
}

bool misses(const Segment& segment, const Box& box) {
  const Vec3 direction = segment.b - segment.a;
  Vec3 center, half;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::max(segment.a[axis], segment.b[axis]) < box.min[axis]) return true;
    if (std::min(segment.a[axis], segment.b[axis]) > box.max[axis]) return true;
    const double low = box.min[axis] - segment.a[axis], high = box.max[axis] - segment.a[axis];
    center[axis] = low / 2 + high / 2, half[axis] = high / 2 - low / 2;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    if (misses(direction[y], direction[z], center[y], center[z], half[y], half[z])) return true;
  }
  return false;
}

/// Bits of x, y and z in turns, of cells of a 1024^3 grid.
std::uint32_t morton_code(const Vec3& p, const Box& around) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = around.max[axis] - around.min[axis];
    const double part = size > 0 ? (p[axis] - around.min[axis]) / size : 0;
    const auto cell = static_cast<std::uint32_t>(std::clamp(1024 * part, 0.0, 1023.0));
    for (unsigned bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1u) << (3 * bit + static_cast<unsigned>(axis));
  }
  return code;
}

}  // namespace

ExactReference::ExactReference(const TriangleMesh& mesh) : mesh_(mesh) {
  const Box around = bounding_box(mesh);
  PerFace<std::uint32_t> codes;
  for (const FaceId f : mesh.triangles.ids()) {
    order_.push_back(f);
    codes.push_back(morton_code(mesh.triangle(f).a, around));
  }
  std::ranges::sort(order_, [&](FaceId f, FaceId g) { return std::pair(codes[f], f) < std::pair(codes[g], g); });
  levels_.emplace_back();
  for (const FaceId f : order_) {
    const Triangle t = mesh.triangle(f);
    Box& box = levels_.back().emplace_back();
    for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  }
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> boxes((below.size() + kPerBox - 1) / kPerBox);
    for (std::size_t i = 0; i < below.size(); ++i) boxes[i / kPerBox].extend(below[i]);
    levels_.push_back(std::move(boxes));
  }
}

void ExactReference::add_candidates(const Segment& segment, std::size_t level, std::size_t i,
                                    std::vector<FaceId>& found) const {
  if (misses(segment, levels_[level][i])) return;
  if (level == 0) {
    found.push_back(order_[i]);
    return;
  }
  const std::size_t end = std::min((i + 1) * kPerBox, levels_[level - 1].size());
  for (std::size_t k = i * kPerBox; k < end; ++k) add_candidates(segment, level - 1, k, found);
}

std::vector<ExactCrossing> ExactReference::crossings(const Segment& segment) const {
  std::vector<FaceId> candidates;
  add_candidates(segment, levels_.size() - 1, 0, candidates);

  struct Found {
    ExactCrossing crossing;
    Interval at;
  };
  std::vector<Found> found;
  for (const FaceId f : candidates) {
    const Triangle t = mesh_.triangle(f);
    const int around = turn(segment, t.a, t.b);
    if (around == 0 || turn(segment, t.b, t.c) != around || turn(segment, t.c, t.a) != around) continue;
    const int start = side(segment.a, t), end = side(segment.b, t);
    if (start * end < 0) found.push_back({{f, start > 0, 0, 0}, Interval(segment, t)});
  }
  const auto order = [&](const Found& x, const Found& y) {
    if (x.at.high < y.at.low) return -1;
    if (y.at.high < x.at.low) return 1;
    return exact_order(segment, mesh_.triangle(x.crossing.face), mesh_.triangle(y.crossing.face));
  };
  std::ranges::sort(found, [&](const Found& x, const Found& y) { return order(x, y) < 0; });

  std::vector<ExactCrossing> crossings;
  for (std::size_t i = 0; i < found.size(); ++i) {
    ExactCrossing& c = crossings.emplace_back(found[i].crossing);
    c.t = found[i].at.middle;
    if (i > 0) c.place = crossings[i - 1].place + (order(found[i - 1], found[i]) != 0 ? 1 : 0);
  }
  return crossings;
}

std::vector<std::vector<ExactCrossing>> ExactReference::crossings(std::span<const Segment> segments) const {
  std::vector<std::vector<ExactCrossing>> all(segments.size());
  const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> workers;
  for (std::size_t first = 0; first < threads; ++first)
    workers.emplace_back([&, first] {
      for (std::size_t i = first; i < segments.size(); i += threads) all[i] = crossings(segments[i]);
    });
  return all;
}

}  // namespace prohull::bench
