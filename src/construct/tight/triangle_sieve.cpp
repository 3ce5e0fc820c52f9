#include "construct/tight/triangle_sieve.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/select.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {
namespace {

/// In the frame, far more than what float32 coordinates, and what is computed of them, are wrong by.
constexpr double kRounding = 0x1p-20;
constexpr float kNowhere = std::numeric_limits<float>::infinity();

/// Halves the faces along their longest side again and again, down to leaves of four: those of a node lie together.
class Order {
 public:
  explicit Order(const TriangleMesh& mesh) {
    faces_.reserve(mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      Placed& placed = faces_.emplace_back(Placed{{}, f});
      for (int axis = 0; axis < 3; ++axis)
        placed.center[axis] =
            std::min({t.a[axis], t.b[axis], t.c[axis]}) * 0.5 + std::max({t.a[axis], t.b[axis], t.c[axis]}) * 0.5;
    }
    halve(0, faces_.size());
  }
  std::vector<FaceId> faces() const {
    std::vector<FaceId> faces;
    faces.reserve(faces_.size());
    for (const Placed& placed : faces_) faces.push_back(placed.face);
    return faces;
  }

 private:
  struct Placed {
    Vec3 center;
    FaceId face;
  };
  // The first half has a power of 2 of them, so that nodes and leaves begin where halves do.
  void halve(std::size_t begin, std::size_t end) {
    if (end - begin <= 4) return;
    Box box;
    for (std::size_t i = begin; i < end; ++i) box.extend(faces_[i].center);
    const Vec3 size = box.max * 0.5 - box.min * 0.5;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = begin + std::bit_ceil(end - begin) / 2;
    const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
    select_nth(at(begin), at(middle), at(end), [axis](const Placed& p, const Placed& q) {
      return p.center[axis] != q.center[axis] ? p.center[axis] < q.center[axis] : p.face < q.face;
    });
    const auto halve_first = [&] { halve(begin, middle); };
    const auto halve_second = [&] { halve(middle, end); };
    constexpr std::size_t kWorthAThread = 4096;
    if (end - begin > kWorthAThread) return oneapi::tbb::parallel_invoke(halve_first, halve_second);
    halve_first();
    halve_second();
  }

  std::vector<Placed> faces_;
};

TriangleMesh in_order(const TriangleMesh& mesh) {
  TriangleMesh ordered;
  ordered.triangles.reserve(mesh.face_count());
  PerVertex<VertexId> number(mesh.positions.size(), kNoVertex);
  for (const FaceId f : Order(mesh).faces()) {
    auto corners = mesh.triangles[f];
    for (VertexId& v : corners) {
      if (number[v] == kNoVertex) number[v] = ordered.positions.push_back(mesh.positions[v]);
      v = number[v];
    }
    ordered.triangles.push_back(corners);
  }
  return ordered;
}

}  // namespace

TriangleSieve::TriangleSieve(const TriangleMesh& mesh) : mesh_(in_order(mesh)) {
  if (mesh_.face_count() == 0) return;
  const Box bounds = bounding_box(mesh_);
  center_ = bounds.center();
  const Vec3 half = bounds.max * 0.5 - bounds.min * 0.5;
  scale_ = 1 / std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
  std::vector<FloatBox> boxes;
  for (std::uint32_t first = 0; first < mesh_.face_count(); first += kWidth) {
    const Leaf& leaf = leaves_.emplace_back(leaf_of_faces_from(first));
    boxes.push_back(kEmptyBox);
    for (std::uint32_t lane = 0; lane < kWidth && first + lane < mesh_.face_count(); ++lane)
      for (const auto& [x, y, z] : leaf.corner) {
        const std::array<float, 3> p{x[lane], y[lane], z[lane]};
        boxes.back().extend({p, p});
      }
  }
  levels_ = four_wide_tree(std::move(boxes));
}

// Lanes without a face are beyond all boxes.
TriangleSieve::Leaf TriangleSieve::leaf_of_faces_from(std::uint32_t first) const {
  Leaf leaf;
  for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
    const bool is_there = first + lane < mesh_.face_count();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 p = is_there ? in_frame(mesh_.positions[mesh_.triangles[FaceId{first + lane}][corner]]) : Vec3{};
      for (int axis = 0; axis < 3; ++axis)
        leaf.corner[corner][axis][lane] = is_there ? static_cast<float>(p[axis]) : kNowhere;
    }
  }
  return leaf;
}

void TriangleSieve::add_box(Region& region, const Box& box, double reach) const {
  const Vec3 low = in_frame(box.min), high = in_frame(box.max);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    region.low[i] = static_cast<float>(low[axis] - reach * scale_ - kRounding);
    region.high[i] = static_cast<float>(high[axis] + reach * scale_ + kRounding);
  }
}

// Of normals that rounding may have turned the plane is left out. In the frame, as `reach` is.
void TriangleSieve::add_plane(Region& region, const Vec3& normal, const Vec3& on, const Vec3& inside, double reach) {
  const double length = norm(normal);
  const Vec3 unit = dot(normal, inside - on) > 0 ? normal / length : normal / -length;
  region.planes[region.plane_count++] = {
      {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)},
      static_cast<float>(dot(unit, on) - reach - kRounding)};
}

TriangleSieve::Region TriangleSieve::around(const Tetrahedron& t, double reach) const {
  Region region;
  Box box;
  for (const Vec3& p : {t.a, t.b, t.c, t.d}) box.extend(p);
  add_box(region, box, reach);
  const std::array corners{in_frame(t.a), in_frame(t.b), in_frame(t.c), in_frame(t.d)};
  const double diagonal = box.diagonal() * scale_;
  // The region is a little wider where two planes meet: that is allowed.
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % 4], &r = corners[(i + 2) % 4], &inside = corners[(i + 3) % 4];
    if (const Vec3 n = cross(q - p, r - p); norm(n) > 1e-6 * diagonal * diagonal)
      add_plane(region, n, p, inside, reach * scale_);
  }
  return region;
}

TriangleSieve::Region TriangleSieve::around(const Triangle& t, double reach) const {
  Region region;
  Box box;
  for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  add_box(region, box, reach);
  const Vec3 a = in_frame(t.a), b = in_frame(t.b), c = in_frame(t.c), n = cross(b - a, c - a);
  const double diagonal = box.diagonal() * scale_;
  if (norm(n) > 1e-6 * diagonal * diagonal) {
    add_plane(region, n, a, a + n, reach * scale_);
    add_plane(region, n, a, a - n, reach * scale_);
  }
  return region;
}

}  // namespace prohull
