#include "exhaustive_scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <thread>

namespace prohull::bench {
namespace {

float rounded_up(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

}  // namespace

// A line misses a box if their projections along an axis do: with n = direction x axis, |n . (center - origin)| is then
// greater than the sum of |n_i| half_i. The direction is scaled to a greatest entry of 1; centres and halves are at
// most
// 1. Where the line meets the box, no term exceeds 2, and rounding the factors, products and sums of the left side
// comes to at most 10 units of 2^-24, of the right side to 8. The rest, in double, is nothing to that for segments that
// start within some sizes of the mesh, as those of P&T 4.2 do.
class ExhaustiveScan::Line {
 public:
  Line(const Vec3& origin, const Vec3& direction) {
    const Vec3 along = direction / std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    const Vec3 moment = cross(along, origin);
    for (int axis = 0; axis < 3; ++axis) {
      along_[axis] = static_cast<float>(along[axis]);
      moment_[axis] = static_cast<float>(moment[axis]);
    }
  }

  /// Of each lane, whether the line certainly misses the box.
  std::array<std::int32_t, 4> misses(const FourBoxes& boxes) const {
    constexpr float kError = 0x1p-19f;
    auto missed = boxes.center[0] != boxes.center[0];
    for (int axis = 0; axis < 3; ++axis) {
      const int y = (axis + 1) % 3, z = (axis + 2) % 3;
      const Float4 distance = along_[y] * boxes.center[z] - along_[z] * boxes.center[y] - moment_[axis];
      const Float4 reach = std::abs(along_[y]) * boxes.half[z] + std::abs(along_[z]) * boxes.half[y] + kError;
      missed |= (distance > reach) | (distance < -reach);
    }
    return std::bit_cast<std::array<std::int32_t, 4>>(missed);
  }

 private:
  float along_[3], moment_[3];
};

ExhaustiveScan::ExhaustiveScan(const TriangleMesh& mesh) : mesh_(mesh) {
  const Box around = bounding_box(mesh);
  center_ = around.center();
  const Vec3 half = around.max - center_;
  scale_ = 1 / std::max({half.x, half.y, half.z});
  set(around_, 0, {(around.min - center_) * scale_, half * scale_});
  boxes_.resize((mesh.face_count() + 3) / 4);
  for (const FaceId f : mesh.triangles.ids()) {
    Box box;
    for (const VertexId v : mesh.triangles[f]) box.extend((mesh.positions[v] - center_) * scale_);
    set(boxes_[index(f) / 4], index(f) % 4, box);
  }
}

void ExhaustiveScan::set(FourBoxes& boxes, std::size_t lane, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto center = static_cast<float>(box.center()[axis]);
    boxes.center[axis][lane] = center;
    boxes.half[axis][lane] = rounded_up(std::max(box.max[axis] - center, center - box.min[axis]));
  }
}

std::vector<FaceId> ExhaustiveScan::not_certainly_missed(const Segment& segment) const {
  std::vector<FaceId> faces;
  const Line line((segment.a - center_) * scale_, segment.b - segment.a);
  if (line.misses(around_)[0]) return faces;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto missed = line.misses(boxes_[i]);
    if (missed == std::array<std::int32_t, 4>{-1, -1, -1, -1}) continue;
    for (std::size_t lane = 0; lane < 4; ++lane)
      if (!missed[lane] && 4 * i + lane < mesh_.face_count())
        faces.push_back(FaceId(static_cast<std::uint32_t>(4 * i + lane)));
  }
  return faces;
}

std::vector<Hit> ExhaustiveScan::all_hits(const Segment& segment) const {
  const std::vector<FaceId> faces = not_certainly_missed(segment);
  TriangleMesh soup;
  for (const FaceId f : faces) {
    const Triangle t = mesh_.triangle(f);
    const auto first = static_cast<std::uint32_t>(soup.vertex_count());
    for (const Vec3& p : {t.a, t.b, t.c}) soup.positions.push_back(p);
    soup.triangles.push_back({VertexId{first}, VertexId{first + 1}, VertexId{first + 2}});
  }
  MeshQuery query{QueryIndex(std::move(soup), Engine::Brute)};
  std::vector<Hit> hits = query.all_hits(segment);
  for (Hit& hit : hits) hit.face = faces[index(hit.face)];
  return hits;
}

std::vector<std::vector<Hit>> ExhaustiveScan::all_hits(std::span<const Segment> segments) const {
  std::vector<std::vector<Hit>> hits(segments.size());
  const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> workers;
  for (std::size_t t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      for (std::size_t i = t; i < segments.size(); i += threads) hits[i] = all_hits(segments[i]);
    });
  return hits;
}

}  // namespace prohull::bench
