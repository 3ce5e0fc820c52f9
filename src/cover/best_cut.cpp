#include "cover/best_cut.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>
#include <tuple>

#include "cover/growing_hull.h"
#include "geometry/directions.h"
#include "geometry/select.h"

namespace prohull::cover {
namespace {

constexpr double kLeastImprovement = 1e-6;  // relative
constexpr double kUnevenness = 1e-3;

std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (std::array{x, y, z} > std::array{0, 0, 0}) {
          const Vec3 d{double(x), double(y), double(z)};
          all.push_back(d / norm(d));
        }
  return all;
}

Cut cut_of(const Plane& plane, double below, double above) {
  return {plane, below + above, below + above + kUnevenness * std::max(below, above)};
}

Cut no_cut() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{}, kInfinity, kInfinity};
}

/// Leaves the points of which the convex hull in their plane is made, by Andrew's monotone chains, and returns its
/// area. The chains are exact, as coordinates are rounded to a grid that is finer than what GrowingHull tells apart.
double keep_extreme(std::vector<Vec3>& points, const Vec3& normal) {
  constexpr double kPerUnit = 0x1p24;
  if (points.size() < 3) return 0;
  struct Flat {
    double x, y;
    std::uint32_t number;
  };
  static thread_local std::vector<Flat> sorted, chain;
  static thread_local std::vector<Vec3> kept;
  sorted.clear(), kept.clear();
  const Vec3 u = any_normal(normal), v = cross(normal, u);
  const auto on_grid = [](double x) { return std::nearbyint(x * kPerUnit); };
  for (const Vec3& p : points)
    sorted.push_back({on_grid(dot(u, p)), on_grid(dot(v, p)), static_cast<std::uint32_t>(sorted.size())});
  std::sort(sorted.begin(), sorted.end(),
            [](const Flat& a, const Flat& b) { return std::tie(a.x, a.y, a.number) < std::tie(b.x, b.y, b.number); });
  const auto turns_left = [](const Flat& a, const Flat& b, const Flat& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  double twice_area = 0;
  for (int side = 0; side < 2; ++side) {
    chain.clear();
    for (const Flat& p : sorted) {
      while (chain.size() >= 2 && !turns_left(chain[chain.size() - 2], chain.back(), p)) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      twice_area += chain[i].x * chain[i + 1].y - chain[i + 1].x * chain[i].y;
    chain.pop_back();  // where the other chain begins
    for (const Flat& p : chain) kept.push_back(points[p.number]);
    std::reverse(sorted.begin(), sorted.end());
  }
  if (points.size() > 3) points.swap(kept);
  return twice_area / (2 * kPerUnit * kPerUnit);
}

using Edges = std::vector<std::array<std::uint32_t, 2>>;

/// Heights of the polygons that are at right angles to `normal`, those of the largest area first: where parts that were
/// built of blocks come apart.
std::vector<double> heights_of_steps(const Part& part, const Vec3& normal) {
  constexpr std::size_t kMost = 6;
  std::vector<std::pair<double, double>> steps;  // height, area
  for (std::size_t i = 0; i < part.polygon_count(); ++i) {
    const Vec3 area = area_vector(part, part.polygon(i));
    if (std::abs(dot(area, normal)) > (1 - 1e-6) * norm(area))
      steps.emplace_back(dot(part.points[part.polygon(i)[0]], normal), norm(area));
  }
  std::sort(steps.begin(), steps.end());
  std::vector<std::pair<double, double>> joined;
  for (const auto& [height, area] : steps)
    if (!joined.empty() && height - joined.back().first < 1e-6)
      joined.back().second += area;
    else
      joined.emplace_back(height, area);
  std::stable_sort(joined.begin(), joined.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  joined.resize(std::min(joined.size(), kMost));
  std::vector<double> heights;
  for (const auto& [height, area] : joined) heights.push_back(height);
  return heights;
}

/// Of a convex body between two parallel planes, at least, from its areas there: the roots of the areas between are
/// concave (Brunn and Minkowski).
double least_volume_between(double area, double other, double distance) {
  return distance / 3 * (area + std::sqrt(area * other) + other);
}

/// A volume that GrowingHull leaves out at most of what is in the box: points within a millionth of the hull, whose
/// surface is no larger than that of the box.
double left_out_by_hulls(const Box& box) {
  constexpr double kLeftOut = 1e-5;
  const Vec3 size = box.max - box.min;
  return kLeftOut * 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// The merits of the best cuts that were found so far.
class Leaders {
 public:
  /// So many cuts are asked for, and none of a merit greater than `most`.
  Leaders(std::size_t count, double most) : merits_(count, most), limit_(most) {}
  /// A cut of greater merit is not asked for any more.
  double limit() const { return limit_.load(std::memory_order_relaxed); }
  void add(double merit) {
    const std::scoped_lock lock(mutex_);
    if (merit >= merits_.back()) return;
    merits_.back() = merit;
    std::sort(merits_.begin(), merits_.end());
    limit_ = merits_.back();
  }

 private:
  std::mutex mutex_;
  std::vector<double> merits_;
  std::atomic<double> limit_;
};

/// The volumes of the hulls on both sides of planes of one direction. A hull grows from plane to plane, so that all of
/// them cost little more than one.
///
/// It stops growing where no further plane can be better than the limit. The hull on one side of a plane holds that of
/// another plane on this side, and beside it the part between the two planes, whose hull has at least the volume that
/// follows from its areas in the planes. So from the hull below plane i, and the areas above, a lower bound follows of
/// the volumes by plane i and by all above it.
class Sweep {
 public:
  Sweep(const Part& part, const Edges& edges, const Vec3& normal, const Solid& solid, int offsets)
      : part_(part),
        normal_(normal),
        tolerance_(solid.tolerance()),
        heights_(part.points.size()),
        order_(part.points.size()) {
    for (std::size_t i = 0; i < heights_.size(); ++i) heights_[i] = dot(normal, part.points[i]);
    std::iota(order_.begin(), order_.end(), 0u);
    sort_with_ties(order_.begin(), order_.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return heights_[i] < heights_[j]; });
    choose_offsets(offsets);
    slabs_.resize(offsets_.size());
    for (const auto& [a, b] : edges) heights_[a] < heights_[b] ? add_edge(a, b) : add_edge(b, a);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      for (const Vec3& p : new_corners(part, {normal, offsets_[i]}, solid)) slabs_[i].both.push_back(p);
      measure(slabs_[i]);
    }
    bound_above();
  }

  /// The volume of any cut is at least this.
  double bound() const { return offsets_.empty() ? std::numeric_limits<double>::infinity() : bound_; }

  /// The best one, or none if its merit is greater than the limit.
  Cut best(const Leaders& leaders) const {
    Cut best = no_cut();
    const auto is_out = [&](double volume) { return volume > std::min(leaders.limit(), best.merit) + slack_; };
    if (is_out(bound_)) return best;
    std::vector<double> below(offsets_.size()), least_before(offsets_.size() + 1, best.merit);
    std::size_t count = 0;
    grow(true, [&](std::size_t i, double volume) {
      below[i] = volume;
      count = i + 1;
      least_before[count] = std::min(least_before[i], volume + above_[i]);
      return !is_out(volume + above_[i]);
    });
    grow(false, [&](std::size_t i, double volume) {
      if (i < count)
        if (const Cut cut = cut_of({normal_, offsets_[i]}, below[i], volume); cut.merit <= best.merit) best = cut;
      return !is_out(volume - above_[i] + least_before[std::min(i, count)]);
    });
    return best;
  }

 private:
  /// What the surface has in a plane.
  struct Slab {
    std::vector<Vec3> both, lower, upper;   // of both sides, or only of the faces below, or above
    double lower_area = 0, upper_area = 0;  // of the hulls of what both sides have, and one of them
  };

  void choose_offsets(int count) {
    const double low = heights_[order_.front()], high = heights_[order_.back()];
    for (int i = 1; i <= count; ++i) offsets_.push_back(low + (high - low) * i / (count + 1));
    for (const double height : heights_of_steps(part_, normal_)) offsets_.push_back(height);
    std::sort(offsets_.begin(), offsets_.end());
    std::erase_if(offsets_, [&](double t) { return t < low + 10 * tolerance_ || t > high - 10 * tolerance_; });
  }

  void add_edge(std::uint32_t a, std::uint32_t b) {
    const double low = heights_[a], high = heights_[b];
    const auto first = std::lower_bound(offsets_.begin(), offsets_.end(), low - tolerance_);
    for (auto i = static_cast<std::size_t>(first - offsets_.begin());
         i < offsets_.size() && offsets_[i] <= high + tolerance_; ++i) {
      const bool starts_here = low > offsets_[i] - tolerance_, ends_here = high < offsets_[i] + tolerance_;
      if (starts_here && ends_here) continue;
      if (starts_here)
        slabs_[i].upper.push_back(part_.points[a]);
      else if (ends_here)
        slabs_[i].lower.push_back(part_.points[b]);
      else
        slabs_[i].both.push_back(crossing(part_.points[a], part_.points[b], low - offsets_[i], high - offsets_[i]));
    }
  }

  void measure(Slab& slab) const {
    slab.lower_area = slab.upper_area = keep_extreme(slab.both, normal_);
    const auto area_with = [&](std::vector<Vec3> points) {
      points.insert(points.end(), slab.both.begin(), slab.both.end());
      return keep_extreme(points, normal_);
    };
    if (!slab.lower.empty()) slab.lower_area = area_with(slab.lower);
    if (!slab.upper.empty()) slab.upper_area = area_with(slab.upper);
  }

  void bound_above() {
    above_.resize(offsets_.size());
    if (offsets_.empty()) return;
    bound_ = least_volume_between(slabs_.back().upper_area, 0, heights_[order_.back()] - offsets_.back());
    above_.back() = bound_;
    for (std::size_t i = offsets_.size() - 1; i-- > 0;)
      above_[i] = bound_ +=
          least_volume_between(slabs_[i].upper_area, slabs_[i + 1].lower_area, offsets_[i + 1] - offsets_[i]);
    bound_ += least_volume_between(0, slabs_.front().lower_area, offsets_.front() - heights_[order_.front()]);
    slack_ = left_out_by_hulls(box_of(part_));
  }

  /// goes_on(i, volume) for the hulls below, or above, of plane i, until it returns false.
  template <class GoesOn>
  void grow(bool up, GoesOn goes_on) const {
    static thread_local GrowingHull hull;
    hull.clear();
    std::size_t next = 0;
    const std::size_t n = order_.size();
    std::vector<Vec3> batch;
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
      const std::size_t i = up ? k : offsets_.size() - 1 - k;
      const double t = offsets_[i];
      batch = slabs_[i].both;
      const std::vector<Vec3>& own = up ? slabs_[i].lower : slabs_[i].upper;
      batch.insert(batch.end(), own.begin(), own.end());
      for (; next < n; ++next) {
        const std::uint32_t v = order_[up ? next : n - 1 - next];
        if (up ? heights_[v] >= t - tolerance_ : heights_[v] <= t + tolerance_) break;
        batch.push_back(part_.points[v]);
      }
      for (const Vec3& p : part_.inside)
        if (up ? dot(normal_, p) <= t : dot(normal_, p) >= t) batch.push_back(p);
      hull.add(batch);
      if (!goes_on(i, hull.volume())) return;
    }
  }

  const Part& part_;
  const Vec3 normal_;
  const double tolerance_;
  std::vector<double> heights_, offsets_;
  std::vector<std::uint32_t> order_;
  std::vector<Slab> slabs_;    // by offset
  std::vector<double> above_;  // by offset: of the hull above the plane, at least
  double bound_ = 0, slack_ = 0;
};

/// What planes that are close to each other have in common: the hulls of what lies on the same side of all of them.
class Neighborhood {
 public:
  Neighborhood(const Part& part, const Edges& edges, std::span<const Plane> planes, const Solid& solid)
      : part_(part), solid_(solid) {
    std::vector<int> sides;
    std::vector<Vec3> lower, upper;
    for (std::uint32_t i = 0; i < part.points.size(); ++i) {
      sides.push_back(common_side(part.points[i], planes, solid.tolerance()));
      if (sides[i] != 0)
        (sides[i] < 0 ? lower : upper).push_back(part.points[i]);
      else
        near_.push_back(i);
    }
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(edges_),
                 [&](const auto& e) { return sides[e[0]] * sides[e[1]] != 1; });
    has_lower_ = !lower.empty(), has_upper_ = !upper.empty();
    lower_.add(lower);
    upper_.add(upper);
  }

  /// There is none if the volume is greater than `most`.
  Cut cut_by(const Plane& plane, double most) const {
    static thread_local std::vector<Vec3> lower, upper, both;
    static thread_local std::vector<double> heights;
    lower.clear(), upper.clear(), both.clear(), heights.clear();
    const double tolerance = solid_.tolerance();
    for (const Vec3& p : part_.points) heights.push_back(plane.height(p));
    for (const std::uint32_t i : near_)
      if (std::abs(heights[i]) > tolerance) (heights[i] < 0 ? lower : upper).push_back(part_.points[i]);
    for (const Vec3& p : part_.inside) (plane.height(p) < 0 ? lower : upper).push_back(p);
    if ((lower.empty() && !has_lower_) || (upper.empty() && !has_upper_)) return no_cut();
    for (const auto& [a, b] : edges_) {
      const bool a_on = std::abs(heights[a]) <= tolerance, b_on = std::abs(heights[b]) <= tolerance;
      if (a_on != b_on) {
        const double other = heights[a_on ? b : a];
        (other < 0 ? lower : upper).push_back(part_.points[a_on ? a : b]);
      } else if (!a_on && (heights[a] < 0) != (heights[b] < 0)) {
        both.push_back(crossing(part_.points[a], part_.points[b], heights[a], heights[b]));
      }
    }
    for (const Vec3& p : new_corners(part_, plane, solid_)) both.push_back(p);
    keep_extreme(both, plane.normal);
    for (const Vec3& p : both) lower.push_back(p), upper.push_back(p);
    const double below = volume_with(lower_, lower);
    return below + upper_.volume() > most ? no_cut() : cut_of(plane, below, volume_with(upper_, upper));
  }

 private:
  /// 0 if the point is not clearly on the same side of all planes.
  static int common_side(const Vec3& p, std::span<const Plane> planes, double tolerance) {
    const auto is_on = [&](int sign) {
      return std::all_of(planes.begin(), planes.end(),
                         [&](const Plane& plane) { return sign * plane.height(p) > tolerance; });
    };
    return is_on(-1) ? -1 : is_on(1) ? 1 : 0;
  }

  static double volume_with(const GrowingHull& hull, const std::vector<Vec3>& points) {
    static thread_local GrowingHull grown;
    grown = hull;
    grown.add(points);
    return grown.volume();
  }

  const Part& part_;
  const Solid& solid_;
  bool has_lower_, has_upper_;
  GrowingHull lower_, upper_;
  std::vector<std::uint32_t> near_;  // points that are not of these hulls
  Edges edges_;                      // that a plane may cross
};

/// The plane shifted, and turned about the middle of its meeting with a part: about the foot of the part's centre.
std::vector<Plane> neighbors(const Plane& plane, const Vec3& center, double angle, double shift) {
  const Vec3 n = plane.normal, u = any_normal(n), v = cross(n, u);
  const Vec3 pivot = center - n * plane.height(center);
  std::vector<Plane> result{{n, plane.offset + shift}, {n, plane.offset - shift}};
  for (const Vec3& side : {u, -u, v, -v}) {
    const Vec3 m = n + side * angle, unit = m / norm(m);
    result.push_back({unit, dot(unit, pivot)});
  }
  return result;
}

}  // namespace

double quick_volume(const Part& part) {
  static thread_local GrowingHull hull;
  hull.clear();
  hull.add(hull_points(part));
  return hull.volume();
}

double greatest_merit(double volume) { return volume * (1 + kUnevenness); }

std::vector<Cut> cuts(const Part& part, const Solid& solid, int offsets, std::size_t count, double most) {
  static const std::vector<Vec3> all = directions();
  const auto part_edges = edges(part);
  std::vector<Cut> result;
  if (part.points.size() < 4 || quick_volume(part) == 0) return result;
  std::vector<std::optional<Sweep>> sweeps(all.size());
  oneapi::tbb::parallel_for(std::size_t{0}, all.size(),
                            [&](std::size_t i) { sweeps[i].emplace(part, part_edges, all[i], solid, offsets); });
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return sweeps[i]->bound() < sweeps[j]->bound(); });
  Leaders leaders(count, most);
  result.resize(all.size());
  oneapi::tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    result[order[k]] = sweeps[order[k]]->best(leaders);
    leaders.add(result[order[k]].merit);
  });
  std::erase_if(result, [](const Cut& c) { return !std::isfinite(c.volume); });
  std::stable_sort(result.begin(), result.end(), [](const Cut& a, const Cut& b) { return a.merit < b.merit; });
  result.resize(std::min(result.size(), count));
  return result;
}

HalvesVolume::HalvesVolume(const Part& part, const Solid& solid)
    : part_(part), solid_(solid), box_(box_of(part)), edges_(edges(part)) {}

std::vector<Cut> HalvesVolume::operator()(std::span<const Plane> planes, double most) const {
  const Neighborhood neighborhood(part_, edges_, planes, solid_);
  const double limit = most + left_out_by_hulls(box_);
  std::vector<Cut> result(planes.size());
  oneapi::tbb::parallel_for(std::size_t{0}, planes.size(),
                            [&](std::size_t i) { result[i] = neighborhood.cut_by(planes[i], limit); });
  return result;
}

Cut refined(const HalvesVolume& halves, const Cut& cut) {
  const auto merits = [&](std::span<const Plane> planes, double most) {
    std::vector<double> result;
    for (const Cut& c : halves(planes, most)) result.push_back(c.merit);
    return result;
  };
  const Plane best = with_least_value(cut.plane, halves.box(), merits);
  return halves({&best, 1}).front();
}

Plane with_least_value(const Plane& plane, const Box& box, const ValuesOfPlanes& values) {
  Plane best = plane;
  double least = values({&plane, 1}, std::numeric_limits<double>::infinity()).front(), angle = 0.25,
         shift = box.diagonal() / 30;
  for (int round = 0; round < 5; ++round, angle /= 2, shift /= 2) {
    for (bool improved = true; improved;) {
      const std::vector<Plane> tries = neighbors(best, box.center(), angle, shift);
      const std::vector<double> tried = values(tries, least);
      const auto found = std::min_element(tried.begin(), tried.end());
      // Rounding makes merits below 0, too.
      improved = *found < least * (least > 0 ? 1 - kLeastImprovement : 1 + kLeastImprovement);
      if (improved) least = *found, best = tries[static_cast<std::size_t>(found - tried.begin())];
    }
  }
  return best;
}

}  // namespace prohull::cover
