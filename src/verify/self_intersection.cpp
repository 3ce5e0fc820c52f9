#include "verify/self_intersection.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <bit>

#include "geometry/cones.h"
#include "geometry/four_boxes.h"
#include "geometry/morton_code.h"
#include "geometry/triangle_intersection.h"
#include "mesh/closed.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "verify/disk_stars.h"

namespace prohull::verify {
namespace {

/// All pairs of some triangles of which the boxes overlap. The triangles lie along a Morton curve, and by fours in a
/// tree of boxes: tests of boxes are most of the work.
template <class TriangleOf, class AreApart>
class PairSearch {
 public:
  /// are_apart(f, g) may know of two that they do not meet.
  PairSearch(std::uint32_t count, const TriangleOf& triangle_of, const AreApart& are_apart)
      : triangle_of_(triangle_of), are_apart_(are_apart), cube_(box_of_all(count, triangle_of)) {
    sort_faces(count);
    pack();
    cones_ = Cones(count, [&](std::uint32_t slot) { return triangle_of_(face_at_[slot]); });
  }

  /// What add(found, f, g) makes of all pairs that meet, from Found{} on, in any order; join(found, other) adds what
  /// another thread has found.
  template <class Found, class Add, class Join>
  Found meeting(ProgressMeter& meter, Add add, Join join) const {
    using Leaves = oneapi::tbb::blocked_range<std::uint32_t>;
    return oneapi::tbb::parallel_reduce(
        Leaves(0, static_cast<std::uint32_t>(levels_[0].size()), kLeavesToAThread), Found{},
        [&](const Leaves& leaves, Found found) {
          Scratch scratch;
          for (std::uint32_t leaf = leaves.begin(); leaf != leaves.end(); ++leaf) {
            meter.go_on();
            add_pairs_of(leaf, scratch, [&](std::uint32_t f, std::uint32_t g) { add(found, f, g); });
          }
          return found;
        },
        [&](Found found, Found other) {
          join(found, std::move(other));
          return found;
        });
  }

 private:
  static constexpr std::uint32_t kWidth = Cones::kWidth, kLeavesToAThread = 1024;

  struct Scratch {
    std::vector<std::uint32_t> nodes, children;
  };

  template <class Visit>
  void add_pairs_of(std::uint32_t leaf, Scratch& scratch, Visit visit) const {
    find_leaves_from(leaf, scratch);
    for (std::uint32_t lane = 0; lane < kWidth && kWidth * leaf + lane < face_at_.size(); ++lane) {
      const std::uint32_t f = face_at_[kWidth * leaf + lane];
      const Triangle t = triangle_of_(f);
      const FourBoxes box = FourBoxes::four(levels_[0][leaf].child(lane));
      for (const std::uint32_t other : scratch.nodes) {
        unsigned met = levels_[0][other].overlapping(box);
        if (other == leaf) met &= ~1u << lane;
        for (; met != 0; met &= met - 1) {
          const std::uint32_t g = face_at_[kWidth * other + static_cast<std::uint32_t>(std::countr_zero(met))];
          if (!are_apart_(f, g) && triangles_intersect(t, triangle_of_(g))) visit(std::min(f, g), std::max(f, g));
        }
      }
    }
  }

  static Box box_of_all(std::uint32_t count, const TriangleOf& triangle_of) {
    Box box;
    for (std::uint32_t f = 0; f < count; ++f)
      for (const Triangle t = triangle_of(f); const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
    return box;
  }

  void sort_faces(std::uint32_t count) {
    std::vector<std::uint64_t> by_code(count);
    oneapi::tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t f) {
      const auto [x, y, z] = cube_.at(box_of(triangle_of_(f)).center());
      by_code[f] = std::uint64_t{morton_code(x, y, z)} << 32 | f;
    });
    oneapi::tbb::parallel_sort(by_code);
    face_at_.reserve(count);
    for (const std::uint64_t code : by_code) face_at_.push_back(static_cast<std::uint32_t>(code));
  }

  void pack() {
    std::vector<FloatBox> boxes(face_at_.size());
    oneapi::tbb::parallel_for(std::size_t{0}, boxes.size(),
                              [&](std::size_t slot) { boxes[slot] = cube_.at(triangle_of_(face_at_[slot])); });
    levels_ = four_wide_tree(std::move(boxes));
  }

  /// Sets scratch.nodes to the leaves, from this one on, with a box that overlaps the one around all of its own, but
  /// for those that their cones tell apart from it.
  void find_leaves_from(std::uint32_t leaf, Scratch& scratch) const {
    const FourBoxes around = FourBoxes::four(levels_[0][leaf].around());
    const Cone* const own = cones_.find(0, leaf);
    const auto may_meet = [&](std::size_t level, std::uint32_t node) {
      const Cone* const cone = own ? cones_.find(level, node) : nullptr;
      return !cone || !are_apart(*own, *cone);
    };
    scratch.nodes.assign(1, 0);
    for (std::size_t level = levels_.size() - 1; level > 0; --level) {
      const std::uint32_t first = leaf >> (2 * (level - 1));  // the child on the way to the leaf
      scratch.children.clear();
      for (const std::uint32_t i : scratch.nodes)
        for (unsigned met = levels_[level][i].overlapping(around); met != 0; met &= met - 1)
          if (const auto child = kWidth * i + static_cast<std::uint32_t>(std::countr_zero(met));
              child >= first && may_meet(level - 1, child))
            scratch.children.push_back(child);
      std::swap(scratch.nodes, scratch.children);
    }
  }

  const TriangleOf& triangle_of_;
  const AreApart& are_apart_;
  UnitCube cube_;
  Cones cones_;
  std::vector<std::uint32_t> face_at_;
  FourWideTree levels_;  ///< over the faces in this order
};

template <class TriangleOf, class AreApart>
FacePairs all_pairs(std::size_t count, const TriangleOf& triangle_of, const AreApart& are_apart, ProgressMeter& meter) {
  if (count == 0) return {};
  FacePairs pairs =
      PairSearch(static_cast<FaceIndex>(count), triangle_of, are_apart)
          .template meeting<FacePairs>(
              meter, [](FacePairs& found, FaceIndex f, FaceIndex g) { found.emplace_back(f, g); },
              [](FacePairs& found, FacePairs other) { found.insert(found.end(), other.begin(), other.end()); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

FacePairs self_intersections(const Surface& surface, ProgressMeter& meter) {
  const auto triangle_of = [&](FaceIndex f) -> const Triangle& { return surface.faces[f]; };
  return all_pairs(
      surface.faces.size(), triangle_of, [](FaceIndex, FaceIndex) { return false; }, meter);
}

FacePairs self_intersections(const TriangleMesh& mesh, ProgressMeter& meter) {
  require_usable(mesh, "given");
  const DiskStars stars(mesh);
  const auto triangle_of = [&](FaceIndex f) { return mesh.triangle(FaceId{f}); };
  return all_pairs(mesh.face_count(), triangle_of, stars, meter);
}

std::size_t count_self_intersections(const TriangleMesh& mesh, ProgressMeter& meter) {
  require_usable(mesh, "given");
  const DiskStars stars(mesh);
  const auto triangle_of = [&](FaceIndex f) { return mesh.triangle(FaceId{f}); };
  return PairSearch(static_cast<FaceIndex>(mesh.face_count()), triangle_of, stars)
      .template meeting<std::size_t>(
          meter, [](std::size_t& found, FaceIndex, FaceIndex) { ++found; },
          [](std::size_t& found, std::size_t other) { found += other; });
}

}  // namespace prohull::verify

namespace prohull {

std::size_t count_self_intersections(const TriangleMesh& mesh) {
  ProgressMeter silent({}, "verify");
  return verify::count_self_intersections(mesh, silent);
}

}  // namespace prohull
