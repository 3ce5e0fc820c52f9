#include "cover/cut_tree.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "cover/best_cut.h"
#include "verify/solid_volume.h"

namespace prohull::cover {
namespace {

/// How a part's cut is looked for.
struct Effort {
  int offsets;        ///< of planes of one direction
  std::size_t tried;  ///< cuts of a part
  int ahead;          ///< further cuts that are looked ahead
};
constexpr Effort kNarrow{15, 3, 1}, kWide{7, 8, 2};
/// The first cuts decide most: after so many, the wide search tries no more cuts than the narrow one.
constexpr std::size_t kWideLeaves = 8;
/// A cut that saves less, of the volume of the whole convex hull, is not made.
constexpr double kLeastGain = 1e-5;
/// Points of parts, for each cut that is tried or looked ahead: 150,000 for 100 pieces of 4 samples. A mesh of many
/// components, which no hull has with few faces, asks for more; it is cut as far as this goes.
constexpr std::size_t kMostWork = 500'000;

/// A part, and what may become of it.
struct Candidate {
  Part part;
  double volume;        ///< of its convex hull
  double solid_volume;  ///< of the solid in it; negative infinity if that is unknown
  double most_gain;     ///< no cuts save more
  bool is_searched = false;
  std::optional<Cut> first_cut = {};  ///< the best one, if any

  /// What the best cut saves.
  double gain() const { return first_cut ? volume - first_cut->volume : 0; }
};

/// A cut of a part, made.
struct Halves {
  Cut cut;
  std::vector<Candidate> sides;
  double volume_later = 0;  ///< after the further cuts that are looked ahead
};

/// The least of volumes that threads find.
class LeastVolume {
 public:
  double value() const { return value_; }
  void add(double volume) {
    double known = value_;
    while (volume < known && !value_.compare_exchange_weak(known, volume)) continue;
  }

 private:
  std::atomic<double> value_ = std::numeric_limits<double>::infinity();
};

class Cutting {
 public:
  Cutting(const Solid& solid, std::size_t leaves, const Effort& effort, ProgressMeter& meter)
      : solid_(solid), leaves_(leaves), effort_(effort), meter_(meter) {
    if (solid.has_inside()) boundary_ = verify::solid_boundary(solid.surface(), meter);
  }

  /// Negative infinity if it is unknown.
  double solid_volume() const { return solid_volume(Cell{}); }

  CutTree run() {
    Candidate root = candidate(whole(solid_), solid_volume());
    least_gain_ = kLeastGain * root.volume;
    add(std::move(root));
    for (std::size_t leaves = 1; leaves < leaves_; ++leaves) {
      meter_.at(leaves, leaves_);
      if (leaves == kWideLeaves) effort_ = {effort_.offsets, kNarrow.tried, kNarrow.ahead};
      const std::optional<Open> chosen = take_best();
      if (!chosen) break;
      tree_.nodes[chosen->node].plane = chosen->halves->cut.plane;
      tree_.nodes[chosen->node].below = tree_.nodes.size();
      tree_.nodes[chosen->node].above = tree_.nodes.size() + 1;
      for (const Candidate& side : chosen->halves->sides) add(side);
    }
    return std::move(tree_);
  }

 private:
  /// A leaf that may be cut.
  struct Open {
    std::size_t node;
    Candidate candidate;
    Effort effort;
    double gain;                   ///< for each cut, those ahead included: at most, until the cut is made
    std::optional<Halves> halves;  ///< the cut, made
  };

  static Candidate candidate(Part part, double solid_volume) {
    constexpr double kRounding = 1e-5;  // of volumes, by the surface
    const double volume = hull_volume(part);
    const Vec3 size = box_of(part).max - box_of(part).min;
    const double rounding = kRounding * 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    return {std::move(part), volume, solid_volume, volume - solid_volume + rounding};
  }

  double solid_volume(const Cell& cell) const {
    return boundary_ ? volume_within(cell, *boundary_) : -std::numeric_limits<double>::infinity();
  }

  void add(Candidate candidate) {
    const std::size_t node = tree_.nodes.size();
    tree_.nodes.push_back({candidate.volume});
    const double gain = candidate.most_gain / (1 + effort_.ahead);
    if (gain > least_gain_) open_.push_back({node, std::move(candidate), effort_, gain, {}});
  }

  /// Of the leaves, the one whose cut saves most. Cuts are looked for only where they may save that much.
  std::optional<Open> take_best() {
    while (!open_.empty()) {
      const auto best =
          std::max_element(open_.begin(), open_.end(), [](const Open& a, const Open& b) { return a.gain < b.gain; });
      const bool is_known = best->halves.has_value();
      if (!is_known && find_cut(*best)) continue;
      std::optional<Open> taken = std::move(*best);
      open_.erase(best);
      if (is_known) return taken;
    }
    return std::nullopt;
  }

  /// False if there is none that is worth it.
  bool find_cut(Open& open) {
    const Part& part = open.candidate.part;
    const std::vector<Cut> first = cuts(part, solid_, open.effort.offsets, open.effort.tried);
    if (first.empty()) return false;
    work_ += first.size() * static_cast<std::size_t>(open.effort.ahead + 1) * part.points.size();
    if (work_ > kMostWork) return false;
    const std::vector<Cut> distinct = distinct_refined(part, first);
    std::vector<std::optional<Halves>> tried(distinct.size());
    LeastVolume least;
    oneapi::tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t i) {
      tried[i] = halves(open.candidate, distinct[i], open.effort, least.value());
      least.add(tried[i]->volume_later);
    });
    const auto best = std::min_element(tried.begin(), tried.end(),
                                       [](const auto& a, const auto& b) { return a->volume_later < b->volume_later; });
    open.gain = (open.candidate.volume - (*best)->volume_later) / (1 + open.effort.ahead);
    open.halves = std::move(*best);
    return open.gain > least_gain_;
  }

  /// The first cuts, refined; of those that end in nearly the same plane only the best one.
  std::vector<Cut> distinct_refined(const Part& part, const std::vector<Cut>& first) const {
    const HalvesVolume halves(part, solid_);
    std::vector<Cut> all(first.size()), distinct;
    oneapi::tbb::parallel_for(std::size_t{0}, first.size(), [&](std::size_t i) { all[i] = refined(halves, first[i]); });
    std::ranges::stable_sort(all, {}, &Cut::merit);
    for (const Cut& cut : all)
      if (std::ranges::none_of(distinct, [&](const Cut& d) { return nearly_same(d.plane, cut.plane); }))
        distinct.push_back(cut);
    return distinct;
  }

  bool nearly_same(const Plane& a, const Plane& b) const {
    constexpr double kCosine = 0.9995, kShare = 0.005;  // of 1.8 degrees; of the diagonal
    const Vec3 center = solid_.box().center();
    const double sign = dot(a.normal, b.normal) < 0 ? -1 : 1;
    return sign * dot(a.normal, b.normal) > kCosine &&
           std::abs(a.height(center) - sign * b.height(center)) < kShare * solid_.box().diagonal();
  }

  /// The volume later is exact if it is no greater than `most`.
  Halves halves(const Candidate& whole, const Cut& cut, const Effort& effort, double most) const {
    Halves result{cut, sides(whole, cut.plane)};
    result.volume_later = volume_after(effort.ahead, result.sides, effort.offsets, most);
    return result;
  }

  std::vector<Candidate> sides(const Candidate& whole, const Plane& plane) const {
    auto [below, above] = cut(whole.part, plane, solid_);
    const double volume = solid_volume(below.cell);
    const double rest = boundary_ ? whole.solid_volume - volume : volume;
    return {candidate(std::move(below), volume), candidate(std::move(above), rest)};
  }

  /// The volume of the parts after so many further cuts, each of which is the one that saves most. Exact if it is no
  /// greater than `most`.
  double volume_after(int further, std::vector<Candidate> parts, int offsets, double most) const {
    search(parts, offsets, further == 1, most);
    const auto best = std::max_element(parts.begin(), parts.end(),
                                       [](const Candidate& a, const Candidate& b) { return a.gain() < b.gain(); });
    if (further == 1 || best->gain() <= 0)
      return std::accumulate(parts.begin(), parts.end(), -best->gain(),
                             [](double sum, const Candidate& part) { return sum + part.volume; });
    std::vector<Candidate> halves = sides(*best, best->first_cut->plane);
    parts.erase(best);
    std::move(halves.begin(), halves.end(), std::back_inserter(parts));
    return volume_after(further - 1, std::move(parts), offsets, most);
  }

  /// Finds the best cuts of the parts, but for those that may not save most. If it `is_last`, the volume after the one
  /// that saves most counts only if it is no greater than `most`.
  void search(std::vector<Candidate>& parts, int offsets, bool is_last, double most) const {
    double least_gain = -std::numeric_limits<double>::infinity();
    if (is_last)
      least_gain = std::accumulate(parts.begin(), parts.end(), -most,
                                   [](double sum, const Candidate& part) { return sum + part.volume; });
    std::vector<Candidate*> open;
    for (Candidate& part : parts)
      if (part.is_searched)
        least_gain = std::max(least_gain, part.gain());
      else
        open.push_back(&part);
    std::ranges::stable_sort(open, std::greater(), &Candidate::most_gain);
    for (Candidate* const part : open) {
      if (part->most_gain < least_gain) break;
      const double merit =
          is_last ? greatest_merit(part->volume - least_gain) : std::numeric_limits<double>::infinity();
      for (const Cut& cut : cuts(part->part, solid_, offsets, 1, merit)) part->first_cut = cut;
      part->is_searched = true;
      least_gain = std::max(least_gain, part->gain());
    }
  }

  const Solid& solid_;
  const std::size_t leaves_;
  Effort effort_;
  ProgressMeter& meter_;
  CutTree tree_;
  std::vector<Open> open_;
  std::optional<std::vector<verify::BoundaryPiece>> boundary_;  // if the solid has an inside
  double least_gain_ = 0;
  std::size_t work_ = 0;
};

/// Of each node: the least volumes of the parts it is divided into, by their number from 1 on; [0] is infinite.
std::vector<std::vector<double>> volumes_below(const CutTree& tree) {
  std::vector<std::vector<double>> all(tree.nodes.size());
  for (std::size_t node = tree.nodes.size(); node-- > 0;) {  // children come after their parents
    const CutTree::Node& n = tree.nodes[node];
    std::vector<double>& least = all[node];
    least = {std::numeric_limits<double>::infinity(), n.volume};
    if (n.below == 0) continue;
    const std::vector<double>&below = all[n.below], &above = all[n.above];
    least.resize(below.size() + above.size() - 1, least[0]);
    for (std::size_t i = 1; i < below.size(); ++i)
      for (std::size_t j = 1; j < above.size(); ++j) least[i + j] = std::min(least[i + j], below[i] + above[j]);
  }
  return all;
}

/// The tree without the cuts below the k leaves of least volume.
class Pruning {
 public:
  explicit Pruning(const CutTree& tree) : tree_(tree), volumes_(volumes_below(tree)) {}

  CutTree run(std::size_t k) {
    add(0, k);
    return std::move(result_);
  }

 private:
  std::size_t add(std::size_t node, std::size_t k) {
    const CutTree::Node& n = tree_.nodes[node];
    const std::size_t number = result_.nodes.size();
    result_.nodes.push_back({n.volume, n.plane});
    if (k == 1 || n.below == 0) return number;
    const std::size_t parts = parts_below(n, k);
    const std::size_t below = add(n.below, parts), above = add(n.above, k - parts);
    result_.nodes[number].below = below;
    result_.nodes[number].above = above;
    return number;
  }

  /// How many of the node's k parts lie below its plane.
  std::size_t parts_below(const CutTree::Node& node, std::size_t k) const {
    const std::vector<double>&below = volumes_[node.below], &above = volumes_[node.above];
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < std::min(k, below.size()); ++i)
      if (k - i < above.size() && below[i] + above[k - i] < least) best = i, least = below[i] + above[k - i];
    return best;
  }

  const CutTree& tree_;
  const std::vector<std::vector<double>> volumes_;  // by node
  CutTree result_;
};

/// Moves each plane of a tree as long as that makes the volume of all leaves less; from the root on. One node after
/// another: the meter throws, and what is thrown in one parallel loop would end others half done.
class Settling {
 public:
  Settling(CutTree& tree, const Solid& solid, ProgressMeter& meter) : tree_(tree), solid_(solid), meter_(meter) {}
  void run() { settle(0, whole(solid_)); }

 private:
  void settle(std::size_t node, const Part& part) {
    meter_.at(0);
    CutTree::Node& n = tree_.nodes[node];
    n.volume = part.empty() ? 0 : hull_volume(part);
    if (n.below == 0) return;
    if (!part.empty()) n.plane = moved_plane(n, part);
    const auto sides = cut(part, n.plane, solid_);
    settle(n.below, sides.first);
    settle(n.above, sides.second);
  }

  Plane moved_plane(const CutTree::Node& node, const Part& part) const {
    const HalvesVolume halves(part, solid_);
    const bool is_last = is_leaf(node.below) && is_leaf(node.above);
    return with_least_value(node.plane, halves.box(), [&](std::span<const Plane> planes, double most) {
      std::vector<double> volumes(planes.size());
      if (is_last)
        std::ranges::transform(halves(planes, most), volumes.begin(), &Cut::volume);
      else
        oneapi::tbb::parallel_for(std::size_t{0}, planes.size(),
                                  [&](std::size_t i) { volumes[i] = volume_of_leaves(node, part, planes[i]); });
      return volumes;
    });
  }

  double volume_of_leaves(const CutTree::Node& node, const Part& part, const Plane& plane) const {
    const auto [below, above] = cut(part, plane, solid_);
    return volume_of_leaves(node.below, below) + volume_of_leaves(node.above, above);
  }

  double volume_of_leaves(std::size_t node, const Part& part) const {
    if (part.empty()) return 0;
    const CutTree::Node& n = tree_.nodes[node];
    return n.below == 0 ? quick_volume(part) : volume_of_leaves(n, part, n.plane);
  }

  bool is_leaf(std::size_t node) const { return tree_.nodes[node].below == 0; }

  CutTree& tree_;
  const Solid& solid_;
  ProgressMeter& meter_;
};

/// The planes of flat regions of the surface that lie close to a plane, those of the largest area first.
std::vector<Plane> flat_regions_near(const Part& part, const Plane& plane, double distance) {
  constexpr std::size_t kMost = 4;
  constexpr double kLeastCosine = 0.9994;  // 2 degrees
  struct Region {
    Plane plane;
    double area;
  };
  std::vector<Region> regions;
  for (std::size_t i = 0; i < part.polygon_count(); ++i) {
    const Vec3 &origin = part.points[part.polygon(i)[0]], area = area_vector(part, part.polygon(i));
    const double size = norm(area), cosine = dot(area, plane.normal);
    if (std::abs(plane.height(origin)) > distance || std::abs(cosine) < kLeastCosine * size || size == 0) continue;
    const Vec3 normal = cosine > 0 ? area / size : -area / size;
    const Plane own{normal, dot(normal, origin)};
    const auto same = std::find_if(regions.begin(), regions.end(), [&](const Region& r) {
      return dot(r.plane.normal, normal) > 1 - 1e-9 && std::abs(r.plane.height(origin)) < 1e-5 * distance;
    });
    if (same != regions.end())
      same->area += size;
    else if (regions.size() < 1000)
      regions.push_back({own, size});
  }
  std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.area > b.area; });
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < std::min(kMost, regions.size()); ++i)
    if (regions[i].area > 1e-2 * distance * distance) planes.push_back(regions[i].plane);
  return planes;
}

/// Halves of the part by the plane, or by one close to it: by a flat region of the surface, or by the plane, moved, if
/// the halves are larger than `expected`. The plane was found on another, coarser solid. There it may run along a wall
/// that lies a little beyond it here; then a slice of that wall reaches all along the other half.
class Halving {
 public:
  Halving(const Part& part, const Solid& solid) : part_(part), solid_(solid) {}

  std::pair<Part, Part> near(const Plane& plane, double expected) {
    const double size = solid_.box().diagonal();
    try_plane(plane);
    for (const Plane& flat : flat_regions_near(part_, plane, 0.02 * size)) try_plane(flat);
    for (const double share : {0.001, 0.003, 0.01, 0.02}) {
      if (least_ <= 1.01 * expected) break;
      try_plane({plane.normal, plane.offset + share * size});
      try_plane({plane.normal, plane.offset - share * size});
    }
    return std::move(best_);
  }

 private:
  void try_plane(const Plane& plane) {
    std::pair<Part, Part> halves = cut(part_, plane, solid_);
    const double volume = hull_volume(halves.first) + hull_volume(halves.second);
    if (volume < least_) least_ = volume, best_ = std::move(halves);
  }

  const Part& part_;
  const Solid& solid_;
  std::pair<Part, Part> best_;
  double least_ = std::numeric_limits<double>::infinity();
};

class Division {
 public:
  Division(const CutTree& tree, const Solid& solid) : tree_(tree), solid_(solid) {}

  std::vector<Part> run() {
    divide(0, whole(solid_));
    return std::move(parts_);
  }

 private:
  void divide(std::size_t node, const Part& part) {
    if (part.empty()) return;
    const CutTree::Node& n = tree_.nodes[node];
    if (n.below == 0) return parts_.push_back(part);
    const double expected = tree_.nodes[n.below].volume + tree_.nodes[n.above].volume;
    const auto [lower, upper] = Halving(part, solid_).near(n.plane, expected);
    divide(n.below, lower);
    divide(n.above, upper);
  }

  const CutTree& tree_;
  const Solid& solid_;
  std::vector<Part> parts_;
};

}  // namespace

CutSearch::CutSearch(Solid solid, const Solid& coarser, std::size_t pieces, double little_void, ProgressMeter& meter)
    : solid_(std::move(solid)) {
  if (pieces == 1) {
    trees_.push_back({{CutTree::Node{}}});
    return;
  }
  const std::size_t most = pieces + pieces / 4 + 8;  // so that there is a choice of leaves
  Cutting narrow(solid_, most, kNarrow, meter);
  trees_.push_back(narrow.run());
  const std::vector<double> volumes = least_volumes(trees_[0]);
  const double void_ratio = volumes[std::min(pieces, volumes.size() - 1)] / narrow.solid_volume() - 1;
  const bool is_enough = void_ratio >= kNoVoid && void_ratio < little_void;  // what fills may do with fewer pieces
  if (pieces <= kMostPiecesOfWide && !is_enough) trees_.push_back(Cutting(coarser, most, kWide, meter).run());
}

CutTree CutSearch::tree(std::size_t pieces, ProgressMeter& meter) const {
  std::vector<CutTree> trees;
  for (const CutTree& found : trees_) {
    trees.push_back(Pruning(found).run(std::min(pieces, leaves(found))));
    Settling(trees.back(), solid_, meter).run();
  }
  return std::move(*std::min_element(trees.begin(), trees.end(), [](const CutTree& a, const CutTree& b) {
    return least_volumes(a).back() < least_volumes(b).back();
  }));
}

std::vector<double> least_volumes(const CutTree& tree) { return volumes_below(tree).front(); }

std::vector<Part> divided(const CutTree& tree, std::size_t k, const Solid& solid) {
  return Division(Pruning(tree).run(k), solid).run();
}

}  // namespace prohull::cover
