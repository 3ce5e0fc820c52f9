#include "cover/ball_search.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "cover/farthest.h"
#include "geometry/bvh.h"

namespace prohull::cover {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

template <class Body>
void for_each_index(std::size_t count, Body body) {
  oneapi::tbb::parallel_for(std::size_t{0}, count, body);
}

/// How far a ball at the place has to reach out, to hold the points of the patch.
double need(const Place& place, const Patches& patches, const Patch& patch) {
  return farthest(place.center, patches.points_of(patch)) - place.depth;
}

/// No more than the need.
double least_need(const Place& place, const Patch& patch) { return norm(patch.middle - place.center) - place.depth; }

/// No less than the need, but for rounding.
double most_need(const Place& place, const Patch& patch) {
  return norm(patch.middle - place.center) + patch.radius - place.depth;
}

Bvh tree_of(const Patches& patches) {
  std::vector<Box> boxes;
  boxes.reserve(patches.size());
  for (const Patch& patch : patches.patches) boxes.push_back({patch.middle, patch.middle});
  return Bvh(std::move(boxes));
}

double squared_distance(const Vec3& p, const Box& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double far = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0});
    sum += far * far;
  }
  return sum;
}

/// Which places can hold which patches.
class Coverage {
 public:
  /// Within a reach of `most`.
  Coverage(const BallTask& task, const std::vector<Place>& places, double most)
      : patch_count_(task.patches.size()), lists_(places.size()), per_unit_(std::ldexp(1.0, -std::ilogb(most))) {
    const Bvh tree = tree_of(task.patches);
    for_each_index(places.size(), [&](std::size_t i) {
      task.meter.at(0);
      const double radius = most + places[i].depth;
      if (!(radius > 0)) return;
      tree.visit([&](const Box& box) { return squared_distance(places[i].center, box) <= radius * radius; },
                 [&](std::uint32_t patch) {
                   const Patch& held = task.patches.patches[patch];
                   double needed = most_need(places[i], held);
                   if (needed > 0) needed = need(places[i], task.patches, held);  // else it is held within any reach
                   if (needed <= most) lists_[i].push_back({patch, static_cast<float>(needed * per_unit_)});
                 });
    });
  }

  /// Greedy set cover, within a reach: the place that holds most of what is left comes next. Nothing if that takes more
  /// than `max_places`, or if a patch is out of reach of all.
  std::vector<std::uint32_t> greedy(double reach, std::size_t max_places) const {
    const double most = reach * per_unit_;
    std::vector<char> covered(patch_count_);
    std::size_t left = patch_count_;
    const auto gain = [&](std::uint32_t place) {
      std::size_t count = 0;
      for (const auto& [patch, needed] : lists_[place]) count += !covered[patch] && needed <= most;
      return count;
    };
    std::priority_queue<std::pair<std::size_t, std::uint32_t>> queue;
    for (std::uint32_t i = 0; i < lists_.size(); ++i) queue.push({gain(i), ~i});
    std::vector<std::uint32_t> chosen;
    while (left > 0) {
      if (queue.empty() || chosen.size() == max_places) return {};
      const std::uint32_t place = ~queue.top().second;
      queue.pop();
      const std::size_t gained = gain(place);
      if (gained == 0) continue;
      if (!queue.empty() && std::pair(gained, ~place) < queue.top()) {
        queue.push({gained, ~place});
        continue;
      }
      for (const auto& [patch, needed] : lists_[place]) covered[patch] |= needed <= most;
      left -= gained;
      chosen.push_back(place);
    }
    return chosen;
  }

 private:
  struct Held {
    std::uint32_t patch;
    float needed;  ///< in units near the largest reach, which floats may not hold
  };
  std::size_t patch_count_;
  std::vector<std::vector<Held>> lists_;
  double per_unit_;
};

/// A ball of a cover that is being improved.
struct Member {
  Place place;
  std::vector<std::uint32_t> patches = {};
  double needed = -kUnbounded;              ///< the greatest need of its patches
  double without_it = -kUnbounded;          ///< the same, if the next best balls had its patches
  std::vector<std::uint32_t> settled = {};  ///< patches for which no other place was found that is better
};

/// Balls that move until none can do better.
class Improvement {
 public:
  /// Required: the places hold all patches within a reach of `enough`.
  Improvement(const BallTask& task, const std::vector<Place>& places, double enough) : task_(task) {
    for (const Place& place : places) members_.push_back({place});
    assign(enough);
  }

  double reach() const {
    double most = -kUnbounded;
    for (const Member& member : members_) most = std::max(most, member.needed);
    return most;
  }

  /// Lloyd's algorithm: each ball moves to where it holds its patches best, then each patch goes to the best ball.
  void run() {
    constexpr int kMostRounds = 20;
    constexpr double kLeastGain = 1e-4;
    for (int round = 0; round < kMostRounds; ++round) {
      const double before = reach();
      for_each_index(members_.size(), [&](std::size_t i) { recentre(members_[i]); });
      assign(before);
      if (reach() > before * (1 - kLeastGain)) return;
    }
  }

  /// Splits the ball that reaches out most, again and again, as long as there are balls to spare: others can do what
  /// these do.
  void relocate(std::size_t max_balls) {
    constexpr int kMostSteps = 40, kStepsPerRun = 10;
    for (int step = 1; step <= kMostSteps; ++step) {
      const double before = reach();
      if (members_.size() >= max_balls && !remove_needless(before)) return;
      split_worst();
      assign(before);
      if (step % kStepsPerRun == 0) run();
    }
  }

  BallCover cover() const {
    BallCover cover;
    for (const Member& member : members_) {
      double radius = 0;
      for (const std::uint32_t patch : member.patches)
        radius = std::max(radius, farthest(member.place.center, points_of(patch)));
      cover.balls.push_back({member.place.center, radius});
    }
    cover.reach = reach();
    return cover;
  }

 private:
  std::span<const Vec3> points_of(std::uint32_t patch) const {
    return task_.patches.points_of(task_.patches.patches[patch]);
  }

  /// Of the balls with all that they hold within a reach of `enough`.
  Bvh tree(double enough) const {
    std::vector<Box> boxes;
    for (const Member& member : members_) {
      const double radius = std::max(member.place.depth + enough, 0.0) * (1 + 1e-9);
      const Vec3 across{radius, radius, radius};
      boxes.push_back({member.place.center - across, member.place.center + across});
    }
    return Bvh(std::move(boxes));
  }

  /// The ball with the least need of a patch, and the least need of all others.
  struct Best {
    double needed = kUnbounded, next = kUnbounded;
    std::uint32_t member = 0;

    void offer(double need, std::uint32_t i) {
      if (std::pair(need, i) < std::pair(needed, member))
        next = needed, needed = need, member = i;
      else
        next = std::min(next, need);
    }
  };

  void assign(double enough) {
    const auto& patches = task_.patches.patches;
    const Bvh members = tree(enough);
    std::vector<Best> best(patches.size());
    for_each_index(patches.size(), [&](std::size_t p) {
      const Box here{patches[p].middle, patches[p].middle};
      members.visit([&](const Box& box) { return box.overlaps(here); },
                    [&](std::uint32_t i) {
                      if (least_need(members_[i].place, patches[p]) < best[p].next)
                        best[p].offer(need(members_[i].place, task_.patches, patches[p]), i);
                    });
    });
    for (Member& member : members_) member = {.place = member.place, .settled = std::move(member.settled)};
    for (std::uint32_t p = 0; p < patches.size(); ++p) {
      Member& member = members_[best[p].member];
      member.patches.push_back(p);
      member.needed = std::max(member.needed, best[p].needed);
      member.without_it = std::max(member.without_it, best[p].next);
    }
    std::erase_if(members_, [](const Member& member) { return member.patches.empty(); });
  }

  /// Whether there was one without which the balls still reach out by less than `reach`.
  bool remove_needless(double reach) {
    const auto least = std::ranges::min_element(members_, {}, &Member::without_it);
    if (!(least->without_it < reach)) return false;
    members_.erase(least);
    assign(reach);
    return true;
  }

  /// Across the direction of its farthest point.
  void split_worst() {
    Member& worst = *std::ranges::max_element(members_, {}, &Member::needed);
    const Vec3 center = worst.place.center;
    const auto away = [&](std::uint32_t p) { return farthest(center, points_of(p)); };
    const std::uint32_t far = *std::ranges::max_element(worst.patches, {}, away);
    const Vec3 across = task_.patches.patches[far].middle - center;
    Member half{worst.place};
    std::erase_if(worst.patches, [&](std::uint32_t p) {
      const bool is_near = dot(task_.patches.patches[p].middle - center, across) > squared_norm(across) / 4;
      if (is_near) half.patches.push_back(p);
      return is_near;
    });
    if (half.patches.empty()) return;
    settle(half);
    if (!worst.patches.empty()) settle(worst);
    members_.push_back(half);
  }

  void settle(Member& member) const {
    member.needed = -kUnbounded;
    for (const std::uint32_t p : member.patches)
      member.needed = std::max(member.needed, need(member.place, task_.patches, task_.patches.patches[p]));
    recentre(member);
  }

  /// A pattern search for the least need.
  void recentre(Member& member) const {
    task_.meter.at(0);
    if (member.settled == member.patches) return;
    std::vector<Vec3> points, feet{member.place.foot};
    for (const std::uint32_t patch : member.patches)
      points.insert(points.end(), points_of(patch).begin(), points_of(patch).end());
    constexpr double kFirstStep = 0.5, kLastStep = 0.01;
    const double size = std::max(member.needed, task_.size);
    bool has_moved = false;
    for (double step = kFirstStep * size; step > kLastStep * size; step /= 2)
      while (moves(member, points, feet, step)) has_moved = true;
    if (has_moved)
      member.settled.clear();
    else
      member.settled = member.patches;
  }

  /// `feet` are those of all places tried so far.
  bool moves(Member& member, const std::vector<Vec3>& points, std::vector<Vec3>& feet, double step) const {
    const double enough = member.needed - 1e-3 * step;
    for (const Vec3& direction : directions(member.place, points)) {
      const Vec3 center = member.place.center + direction * step;
      const double far = farthest(center, points);
      if (far - member.place.depth - step >= member.needed) continue;  // the depth grows by no more than the step
      if (far - task_.depth.most_at(center, feet) >= enough) continue;
      const Place place = task_.depth.at(center);
      feet.push_back(place.foot);
      if (!(far - place.depth < enough)) continue;
      member.place = place, member.needed = far - place.depth;
      return true;
    }
    return false;
  }

  /// Towards the farthest point, into the solid, both, and along the axes.
  std::vector<Vec3> directions(const Place& place, const std::vector<Vec3>& points) const {
    const auto nearer = [&](const Vec3& p, const Vec3& q) {
      return squared_norm(p - place.center) < squared_norm(q - place.center);
    };
    const Vec3 out = *std::ranges::max_element(points, nearer) - place.center;
    std::vector<Vec3> all{norm(out) > 0 ? out / norm(out) : Vec3{}, place.inwards};
    all.push_back((all[0] + all[1]) * 0.7);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) {
        Vec3 direction;
        direction[axis] = sign;
        all.push_back(direction);
      }
    return all;
  }

  const BallTask& task_;
  std::vector<Member> members_;
};

/// Places that hold all patches within a reach.
struct Start {
  std::vector<Place> places;
  double reach = kUnbounded;
};

/// Balls around boxes: the one that reaches out most is halved across its longest side, again and again, until they
/// keep `enough`. Of all these the start that reaches out least. Greedy starts leave corners over, which take many
/// balls.
Start halved(const BallTask& task, std::size_t max_balls, double enough) {
  const auto& patches = task.patches.patches;
  const auto box_of = [&](const std::vector<std::uint32_t>& some) {
    Box box;
    for (const std::uint32_t p : some)
      for (const Vec3& point : task.patches.points_of(patches[p])) box.extend(point);
    return box;
  };
  const auto ball_around = [&](std::vector<std::uint32_t> some) {
    Member ball{task.depth.at(box_of(some).center()), std::move(some)};
    for (const std::uint32_t p : ball.patches)
      ball.needed = std::max(ball.needed, need(ball.place, task.patches, patches[p]));
    return ball;
  };
  std::vector<std::uint32_t> all(patches.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Member> balls{ball_around(std::move(all))};
  Start best;
  for (;;) {
    task.meter.at(0);
    Member& worst = *std::ranges::max_element(balls, {}, &Member::needed);
    if (worst.needed < best.reach) {
      best = {{}, worst.needed};
      for (const Member& ball : balls) best.places.push_back(ball.place);
    }
    if (balls.size() >= max_balls || best.reach <= enough) return best;
    const Box box = box_of(worst.patches);
    const Vec3 middle = box.center(), size = box.max - box.min;
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<std::uint32_t> lower, upper;
    for (const std::uint32_t p : worst.patches) (patches[p].middle[axis] > middle[axis] ? upper : lower).push_back(p);
    if (lower.empty() || upper.empty()) return best;
    worst = ball_around(std::move(lower));
    balls.push_back(ball_around(std::move(upper)));
  }
}

std::vector<Place> chosen_of(const std::vector<Place>& places, const std::vector<std::uint32_t>& chosen) {
  std::vector<Place> result;
  for (const std::uint32_t i : chosen) result.push_back(places[i]);
  return result;
}

}  // namespace

std::vector<Place> places_for_balls(const BallTask& task, double spacing, std::size_t most) {
  const auto& patches = task.patches.patches;
  const std::size_t stride = 1 + patches.size() / std::max(most, std::size_t{1});
  std::vector<Place> all((patches.size() + stride - 1) / stride);
  Box box;
  for_each_index(all.size(), [&](std::size_t i) {
    task.meter.at(0);
    const Patch& patch = patches[i * stride];
    const auto medial = task.depth.medial_place(task.patches.points[patch.begin], task.size / 2);
    all[i] = medial ? *medial : task.depth.at(patch.middle);
  });
  for (const Place& place : all) box.extend(place.center);
  const CubeGrid grid(box, spacing);
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3& c = all[i].center;
    order.push_back({CubeGrid::number({grid.cell(0, c.x), grid.cell(1, c.y), grid.cell(2, c.z)}), i});
  }
  std::ranges::sort(order, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    if (all[a.second].depth != all[b.second].depth) return all[a.second].depth > all[b.second].depth;
    return a.second < b.second;
  });
  std::vector<Place> result;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || order[i].first != order[i - 1].first) result.push_back(all[order[i].second]);
  return result;
}

BallCover least_reach(const BallTask& task, const std::vector<Place>& places, std::size_t max_balls, double most) {
  const Coverage coverage(task, places, most);
  task.meter.at(0.6);
  std::vector<std::uint32_t> best = coverage.greedy(most, max_balls);
  if (best.empty()) return {};
  constexpr int kBisections = 6;
  double least = 0;
  for (int i = 0; i < kBisections; ++i) {
    const double reach = (least + most) / 2;
    std::vector<std::uint32_t> chosen = coverage.greedy(reach, max_balls);
    if (chosen.empty())
      least = reach;
    else
      most = reach, best = std::move(chosen);
  }
  task.meter.at(0.7);
  BallCover cover = improved(task, chosen_of(places, best), most, max_balls);
  constexpr double kRegained = 1.5;  // a start this much worse may still end better; of more, few do
  const Start parts = halved(task, max_balls, 0);
  if (!(parts.reach < kRegained * most)) return cover;
  BallCover other = improved(task, parts.places, parts.reach, max_balls);
  return other.reach < cover.reach ? other : cover;
}

BallCover fewest_balls(const BallTask& task, const std::vector<Place>& places, std::size_t max_balls, double reach) {
  constexpr double kLoosest = 1.3, kStep = 0.05;
  const Coverage coverage(task, places, reach * kLoosest);
  std::size_t tried = 0;  // of balls around boxes, which are the same for the same number
  for (double loose = kLoosest; loose > 1 - kStep / 2; loose -= kStep) {
    const double enough = reach * loose;
    const std::vector<Place> greedy = chosen_of(places, coverage.greedy(enough, max_balls));
    const Start fewer = halved(task, greedy.empty() ? max_balls : greedy.size() - 1, enough);
    if (greedy.empty() && fewer.reach > enough) return {};
    if (fewer.reach <= enough && fewer.places.size() > tried) {
      tried = fewer.places.size();
      BallCover cover = improved(task, fewer.places, enough, tried);
      if (cover.reach <= reach) return cover;
    }
    if (greedy.empty()) continue;
    BallCover cover = improved(task, greedy, enough, greedy.size());
    if (cover.reach <= reach) return cover;
  }
  return {};
}

BallCover improved(const BallTask& task, const std::vector<Place>& places, double enough, std::size_t max_balls) {
  Improvement improvement(task, places, enough);
  improvement.run();
  improvement.relocate(max_balls);
  return improvement.cover();
}

}  // namespace prohull::cover
