#include "prohull/detail/cover_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "prohull/detail/rounded.h"
#include "prohull/detail/summary.h"
#include "prohull/detail/text.h"

namespace prohull {
namespace {

std::size_t most_vertices(const ConvexCover& cover) {
  std::size_t most = 0;
  for (const ConvexPiece& piece : cover.pieces)
    if (shape_of(piece) == PieceShape::Polytope) most = std::max(most, piece.mesh.vertex_count());
  return most;
}

/// "12 convex pieces of at most 64 vertices", "3 boxes", "1 convex piece of 40 vertices and 3 boxes"
std::string described_pieces(const ConvexCover& cover) {
  const auto count = [&](PieceShape shape) {
    return static_cast<std::size_t>(std::ranges::count(cover.pieces, shape, shape_of));
  };
  std::vector<std::string> parts;
  if (const std::size_t n = count(PieceShape::Polytope); n > 0)
    parts.push_back(
        fmt::format("{} of {}{} vertices", counted(n, "convex piece"), n > 1 ? "at most " : "", most_vertices(cover)));
  const auto add = [&](PieceShape shape, const char* one, const char* many) {
    if (const std::size_t n = count(shape); n > 0) parts.push_back(counted(n, one, many));
  };
  add(PieceShape::Box, "box", "boxes");
  add(PieceShape::Capsule, "capsule", "capsules");
  add(PieceShape::Ball, "sphere", "spheres");
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string described_size(const ConvexCover& cover) {
  const char* const at_most = cover.volume_is_bound ? "at most " : "";
  if (cover.verdict.encloses_solid != Answer::Yes || !(cover.original_volume > 0))
    return fmt::format("volume {}{:.4g}", at_most, cover.volume);
  return fmt::format("{}{} more volume than the mesh{}", at_most, percent_text(std::max(0.0, cover.void_ratio), 2),
                     cover.is_estimated ? " (estimated)" : "");
}

/// From what spheres reach out.
std::string text_of_origin(const SphereCover& cover) {
  const DistanceBounds& from_triangles = *cover.verdict.distance_to_triangles;
  if (!cover.is_of_wrap) return text_of_openings(cover.verdict.cap_faces > 0, from_triangles);
  if (cover.verdict.distance().upper == from_triangles.upper) return ", from the triangles alone";
  return fmt::format("; that is from a wrap, and from the triangles alone it is at most {:.4g}",
                     rounded_up(from_triangles.upper, 4));
}

}  // namespace

std::string line_of_cover(const std::string& name, const ConvexCover& cover, double diagonal) {
  const double reach = cover.verdict.distance().upper;
  return fmt::format("{}: {}, {}, which reach out by at most {:.4g} ({:.3g} % of the diagonal){}{}", name,
                     described_pieces(cover), described_size(cover), rounded_up(reach, 4),
                     rounded_up(100 * reach / diagonal, 3), cover.fills_cavities ? " with cavities filled" : "",
                     text_of_openings(cover.verdict.cap_faces > 0, *cover.verdict.distance_to_triangles));
}

std::string line_of_cover(const std::string& name, const SphereCover& cover, std::size_t faces, double diagonal) {
  const double reach = cover.verdict.distance().upper;
  return fmt::format("{}: {} around {}, which reach out by at most {:.4g}, {:.3g} % of the diagonal{}", name,
                     counted(cover.balls.size(), "sphere"), counted(faces - cover.verdict.non_finite_faces, "face"),
                     rounded_up(reach, 4), rounded_up(diagonal > 0 ? 100 * reach / diagonal : 0, 3),
                     text_of_origin(cover));
}

std::string line_of_volume(const SphereCover& cover) {
  if (!(cover.original_volume > 0)) return "";
  const double void_ratio = cover.volume / cover.original_volume - 1;
  return fmt::format("volume: {:.4g} with overlaps counted once, {} {} than the solid's{}", cover.volume,
                     percent_text(std::abs(void_ratio), 1), void_ratio < 0 ? "less" : "more",
                     cover.is_estimated ? " (estimated)" : "");
}

std::string line_of_proof(const ConvexCover& cover, std::string_view what) {
  return "certified: " + certificate_of(cover.verdict, std::string(what));
}

std::string line_of_proof(const SphereCover& cover) {
  return "certified: " + certificate_of(cover.verdict, "the union of the spheres as written") +
         (cover.fills_wrap ? ", and the inside of the wrap" : "");
}

}  // namespace prohull
