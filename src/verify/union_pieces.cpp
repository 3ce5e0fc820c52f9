#include "verify/union_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geometry/orientation.h"
#include "geometry/triangle_predicates.h"
#include "mesh/closed.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/error.h"
#include "verify/original.h"
#include "verify/solids.h"
#include "verify/surface.h"

namespace prohull::verify {
namespace {

std::vector<Triangle> faces_with_area(const TriangleMesh& mesh) {
  std::vector<Triangle> faces;
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); projection_axis(t)) faces.push_back(t);
  return faces;
}

Vec3 mean_of_corners(const std::vector<Triangle>& faces, const Box& box) {
  Vec3 sum;
  for (const Triangle& t : faces) sum += (t.a - box.min) + (t.b - box.min) + (t.c - box.min);
  return box.min + sum / (3 * static_cast<double>(faces.size()));
}

void turn(TriangleMesh& mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
}

[[noreturn]] void refuse(std::size_t piece, Defect defect, std::string_view why) {
  throw InputError(defect, fmt::format("piece {}: {}", piece + 1, why));
}

/// Turned outwards.
TriangleMesh closed_piece(TriangleMesh mesh, std::size_t number, std::size_t& turned) {
  try {
    usable_box(mesh, "piece's");
    require_closed(mesh, "piece's");
  } catch (const InputError& error) {
    refuse(number, error.defect(), error.what());
  }
  const int sign = volume_sign(faces_with_area(mesh));
  if (sign == 0) refuse(number, Defect::NoVolume, "it has no volume; a piece must be a solid");
  if (sign < 0) {
    turn(mesh);
    ++turned;
  }
  return mesh;
}

}  // namespace

Kernel::Kernel(const TriangleMesh& piece) : faces_(faces_with_area(piece)), box_(bounding_box(piece)) {
  constexpr std::size_t kMostFaces = 5000;  // windings are faster than so many planes
  if (faces_.empty() || faces_.size() > kMostFaces) return;
  const Vec3 middle = mean_of_corners(faces_, box_);
  is_solid_ = std::ranges::all_of(faces_, [&](const Triangle& t) { return side(t, middle) == Side::Inside; });
  is_whole_piece_ = std::ranges::all_of(piece.triangles, [&](const auto& corners) {
    return std::ranges::all_of(corners, [&](VertexId v) { return contains(piece.positions[v]); });
  });
}

bool Kernel::contains(const Vec3& p) const {
  return is_solid_ && box_.overlaps({p, p}) &&
         std::ranges::none_of(faces_, [&](const Triangle& t) { return side(t, p) == Side::Outside; });
}

TriangleMesh Pieces::together() const {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) append(all, mesh);
  return all;
}

std::vector<const Kernel*> Pieces::near(const Box& box, std::optional<std::size_t> except) const {
  std::vector<std::uint32_t> found;
  bvh.visit([&](const Box& other) { return other.overlaps(box); },
            [&](std::uint32_t k) {
              if (k != except) found.push_back(k);
            });
  std::ranges::sort(found);
  std::vector<const Kernel*> result;
  for (const std::uint32_t k : found) result.push_back(&kernels[k]);
  return result;
}

Pieces prepare_pieces(std::span<const TriangleMesh> pieces, const VerificationOptions& options,
                      const Progress& progress) {
  if (pieces.empty()) throw InputError(Defect::EmptyMesh, "there is no piece: a union needs at least one");
  ProgressCounter counter(progress, "verify", pieces.size());
  Pieces result;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    counter.next();
    const TriangleMesh& mesh = result.meshes.emplace_back(closed_piece(pieces[i], i, result.turned));
    result.kernels.emplace_back(mesh);
    if (result.kernels.back().is_solid()) continue;
    const Answer is_tangled = winds_negatively(mesh, most_steps(options, mesh.face_count()), progress);
    result.are_sure &= is_tangled != Answer::Undecided;
    if (is_tangled == Answer::Yes)
      refuse(i, Defect::InconsistentOrientation,
             "it intersects itself and is inside out in parts, so that it bounds no solid; take its convex hull, or "
             "`prohull build`, instead");
  }
  std::vector<Box> boxes;
  for (const Kernel& kernel : result.kernels) boxes.push_back(kernel.box());
  result.bvh = Bvh(std::move(boxes));
  counter.finish();
  return result;
}

std::vector<FaceId> faces_beyond_kernels(const TriangleMesh& mesh, const Pieces& pieces) {
  PerVertex<std::vector<std::uint32_t>> around(mesh.vertex_count());  // sorted
  for (const VertexId v : mesh.positions.ids()) {
    const Vec3& p = mesh.positions[v];
    if (!is_finite(p)) continue;
    pieces.bvh.visit(
        [&](const Box& box) {
          return box.overlaps({p, p});
        },
        [&](std::uint32_t k) {
          if (pieces.kernels[k].contains(p)) around[v].push_back(k);
        });
    std::ranges::sort(around[v]);
  }
  const auto holds = [&](VertexId v, std::uint32_t k) { return std::ranges::binary_search(around[v], k); };
  std::vector<FaceId> beyond;
  for (const FaceId f : mesh.triangles.ids()) {
    const auto& [a, b, c] = mesh.triangles[f];
    if (std::ranges::none_of(around[a], [&, v = b, w = c](std::uint32_t k) { return holds(v, k) && holds(w, k); }))
      beyond.push_back(f);
  }
  return beyond;
}

}  // namespace prohull::verify
