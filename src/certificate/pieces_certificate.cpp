#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "certificate/certificate_file.h"
#include "certificate/finite_original.h"
#include "geometry/bvh.h"
#include "geometry/triangle_predicates.h"
#include "prohull/certificate.h"
#include "verify/exact.h"

// A triangle that no piece holds alone is cut by the planes of pieces that hold parts of it. Points of the triangle are
// given by barycentric coordinates, up to a factor. There a plane is a line, and each corner of a part is the meeting
// point of two lines of the input, so that numbers do not grow.

namespace prohull {
namespace certificate {
namespace {

using verify::Number;
using PieceIndex = std::uint32_t;

struct Plane {
  Triangle face;
  std::uint64_t number;  ///< of the triangle in the files
};

struct Piece {
  std::vector<Plane> planes;
  Box box;

  bool contains(const Vec3& p) const {
    return box.contains(p) &&
           std::ranges::none_of(planes, [&](const Plane& plane) { return side(plane.face, p) == Side::Outside; });
  }
};

class Pieces {
 public:
  explicit Pieces(std::span<const TriangleMesh> meshes) {
    std::vector<Box> boxes;
    for (const TriangleMesh& mesh : meshes) {
      Piece& piece = pieces_.emplace_back();
      for (const FaceId f : mesh.triangles.ids())
        if (const Triangle t = mesh.triangle(f); projection_axis(t))
          piece.planes.push_back({t, face_count_ + index(f)});
      piece.box = bounding_box(mesh);
      boxes.push_back(piece.box);
      face_count_ += mesh.face_count();
    }
    bvh_ = Bvh(std::move(boxes));
  }

  const Piece& operator[](PieceIndex i) const { return pieces_[i]; }
  std::size_t face_count() const { return face_count_; }

  /// Sorted.
  std::vector<PieceIndex> near(const Box& box) const {
    std::vector<PieceIndex> found;
    bvh_.visit([&](const Box& other) { return other.overlaps(box); }, [&](std::uint32_t i) { found.push_back(i); });
    std::ranges::sort(found);
    return found;
  }

 private:
  std::vector<Piece> pieces_;
  Bvh bvh_;
  std::size_t face_count_ = 0;
};

using Triple = std::array<Number, 3>;

Triple cross_product(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Triple difference(const Vec3& a, const Vec3& b) {
  return {Number(a.x) - Number(b.x), Number(a.y) - Number(b.y), Number(a.z) - Number(b.z)};
}

Number dot_product(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// One triangle, and the tree of its parts.
class TriangleTree {
 public:
  TriangleTree(const Triangle& t, const Pieces& pieces, File& file) : t_(t), pieces_(pieces), file_(file) {
    for (int i = 0; i < 3; ++i) {
      Triple& side_line = lines_.emplace_back(Triple{Number(0), Number(0), Number(0)});
      side_line[i] = Number(-1);
    }
  }

  void write() {
    std::vector<Candidate> candidates;
    for (const PieceIndex i : pieces_.near(box_of(t_)))
      if (auto candidate = candidate_of(i)) candidates.push_back(std::move(*candidate));
    std::ranges::stable_sort(candidates, {}, [](const Candidate& c) { return c.cutters.size(); });
    if (candidates.empty())
      write_leaf(0);
    else
      write(part_of({0, 1, 2}), candidates);
  }

 private:
  using LineIndex = std::uint32_t;

  struct Cutter {
    LineIndex line;
    std::uint64_t plane;  ///< the number of its triangle
  };

  /// A piece that may hold a part of t with an area, and its planes that have corners of t outside.
  struct Candidate {
    PieceIndex piece;
    std::vector<Cutter> cutters;
  };

  struct Corner {
    LineIndex first, second;  ///< the corner is where they meet
    Triple point;
    int weight_sign;  ///< of the sum of its coordinates
  };
  /// Convex, with an area: side i runs from corner i - 1 to corner i along the first line of corner i.
  using Part = std::vector<Corner>;

  std::optional<Candidate> candidate_of(PieceIndex i) {
    Candidate candidate{i, {}};
    for (const Plane& plane : pieces_[i].planes) {
      const std::array<Side, 3> sides{side(plane.face, t_.a), side(plane.face, t_.b), side(plane.face, t_.c)};
      if (std::ranges::count(sides, Side::Outside) == 0) continue;
      if (std::ranges::count(sides, Side::Inside) == 0) return std::nullopt;
      candidate.cutters.push_back({static_cast<LineIndex>(lines_.size()), plane.number});
      lines_.push_back(line_of(plane.face));
    }
    return candidate;
  }

  /// Positive outside.
  Triple line_of(const Triangle& plane) const {
    const Triple normal = cross_product(difference(plane.b, plane.a), difference(plane.c, plane.a));
    return {dot_product(normal, difference(t_.a, plane.a)), dot_product(normal, difference(t_.b, plane.a)),
            dot_product(normal, difference(t_.c, plane.a))};
  }

  Part part_of(const std::vector<LineIndex>& sides) const {
    Part part;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const LineIndex first = sides[i], second = sides[(i + 1) % sides.size()];
      const Triple point = cross_product(lines_[first], lines_[second]);
      part.push_back({first, second, point, int(CGAL::sign(point[0] + point[1] + point[2]))});
    }
    return part;
  }

  /// 1 outside of the line, -1 inside, 0 on it.
  int side_of(const Corner& corner, LineIndex line) const {
    if (corner.first == line || corner.second == line) return 0;
    return int(CGAL::sign(dot_product(lines_[line], corner.point))) * corner.weight_sign;
  }

  std::vector<int> sides_of(const Part& part, LineIndex line) const {
    std::vector<int> sides;
    for (const Corner& corner : part) sides.push_back(side_of(corner, line));
    return sides;
  }

  /// The part on one side of a line that passes through the inside.
  Part cut(const Part& part, const std::vector<int>& sides, LineIndex line, int which) const {
    const std::size_t n = part.size();
    const auto lies_there = [&](std::size_t i) { return sides[i % n] == which; };
    std::size_t begin = 0;  // the first corner there; those that lie there follow each other
    while (lies_there(begin + n - 1) || !lies_there(begin)) ++begin;
    std::vector<LineIndex> kept{part[begin % n].first};
    for (std::size_t i = begin; lies_there(i); ++i) kept.push_back(part[i % n].second);
    kept.push_back(line);
    return part_of(kept);
  }

  /// What the planes of a piece cut off from a part, one after the other; nothing if the piece holds none of its area.
  std::optional<std::vector<std::pair<std::uint64_t, Part>>> cut_off(Part part, const Candidate& candidate) const {
    std::vector<std::pair<std::uint64_t, Part>> beyond;
    for (const auto& [line, plane] : candidate.cutters) {
      const std::vector<int> sides = sides_of(part, line);
      if (std::ranges::none_of(sides, [](int s) { return s < 0; })) return std::nullopt;
      if (std::ranges::none_of(sides, [](int s) { return s > 0; })) continue;
      beyond.emplace_back(plane, cut(part, sides, line, 1));
      part = cut(part, sides, line, -1);
    }
    return beyond;
  }

  void write(const Part& part, const std::vector<Candidate>& candidates) {
    for (const Candidate& candidate : candidates) {
      const auto beyond = cut_off(part, candidate);
      if (!beyond) continue;
      for (const auto& [plane, rest] : *beyond) file_.number(0), file_.number(plane);
      write_leaf(candidate.piece);
      for (auto rest = beyond->rbegin(); rest != beyond->rend(); ++rest) write(rest->second, candidates);
      return;
    }
    write_leaf(0);  // no piece holds it: the checker will say so
  }

  void write_leaf(PieceIndex piece) { file_.number(piece + std::uint64_t{1}); }

  const Triangle t_;
  const Pieces& pieces_;
  File& file_;
  std::deque<Triple> lines_;  ///< the first three are the sides of t
};

/// The first piece that holds each vertex may hold its triangles, too.
class Holders {
 public:
  Holders(const TriangleMesh& mesh, const Pieces& pieces) : mesh_(mesh), around_(mesh.vertex_count()) {
    for (const VertexId v : mesh.positions.ids())
      if (const Vec3& p = mesh.positions[v]; is_finite(p))
        for (const PieceIndex i : pieces.near({p, p}))
          if (pieces[i].contains(p)) around_[v].push_back(i);
  }

  std::optional<PieceIndex> of(FaceId f) const {
    const auto& [a, b, c] = mesh_.triangles[f];
    for (const PieceIndex i : around_[a])
      if (std::ranges::binary_search(around_[b], i) && std::ranges::binary_search(around_[c], i)) return i;
    return std::nullopt;
  }

 private:
  const TriangleMesh& mesh_;
  PerVertex<std::vector<PieceIndex>> around_;
};

}  // namespace
}  // namespace certificate

Certificate pieces_certificate(std::span<const TriangleMesh> pieces, const CertifiedOriginal& original) {
  const certificate::FiniteOriginal finite(original.mesh);
  const certificate::Pieces prepared(pieces);
  certificate::File file = certificate::header(HullSide::Outer, original, prepared.face_count(), finite);
  file.section(certificate::Section::Pieces);
  file.number(certificate::kCovers);
  file.number(pieces.size());
  for (const TriangleMesh& piece : pieces) file.number(piece.face_count());
  const certificate::Holders holders(finite.triangles, prepared);
  for (const FaceId f : finite.triangles.triangles.ids())
    if (const auto piece = holders.of(f))
      file.number(*piece + std::uint64_t{1});
    else
      certificate::TriangleTree(finite.triangles.triangle(f), prepared, file).write();
  return {.bytes = file.bytes(), .claims = {"cover every finite triangle"}};
}

}  // namespace prohull
