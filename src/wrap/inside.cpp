#include "wrap/inside.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/winding_number.h"

namespace prohull {
namespace {

using Nodes = std::vector<std::uint32_t>;

/// Which of the edges from a node along the three axes are crossed by a triangle; bit i: along axis i.
std::vector<std::uint8_t> crossed_edges(const Grid& grid, const TriangleMesh& triangles) {
  constexpr double kNearly = 1e-9;  // in doubt an edge is crossed
  std::vector<std::uint8_t> crossed(grid.node_count());
  for (const FaceId f : triangles.triangles.ids()) {
    const Triangle t = triangles.triangle(f);
    const std::array p{grid.in_spacings(t.a), grid.in_spacings(t.b), grid.in_spacings(t.c)};
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto area = [&](const Vec3& a, const Vec3& b, double x, double y) {
        return (a[u] - x) * (b[v] - y) - (a[v] - y) * (b[u] - x);
      };
      const double whole = area(p[1], p[2], p[0][u], p[0][v]);
      if (std::abs(whole) < kNearly) continue;
      const auto [least_u, most_u] = std::minmax({p[0][u], p[1][u], p[2][u]});
      const auto [least_v, most_v] = std::minmax({p[0][v], p[1][v], p[2][v]});
      for (double x = std::ceil(least_u); x <= most_u; ++x)
        for (double y = std::ceil(least_v); y <= most_v; ++y) {
          const std::array part{area(p[1], p[2], x, y) / whole, area(p[2], p[0], x, y) / whole,
                                area(p[0], p[1], x, y) / whole};
          if (std::ranges::min(part) < -kNearly) continue;
          const double at = part[0] * p[0][axis] + part[1] * p[1][axis] + part[2] * p[2][axis];
          std::array<std::size_t, 3> node{};
          node[std::size_t(u)] = std::size_t(x), node[std::size_t(v)] = std::size_t(y);
          for (const double from : {at - kNearly, at + kNearly}) {
            node[std::size_t(axis)] = std::size_t(from);
            crossed[grid.node(node[0], node[1], node[2])] |= std::uint8_t(1 << axis);
          }
        }
    }
  }
  return crossed;
}

constexpr char kClosed = 0, kReached = 1, kOpen = 2;

/// Nodes next to each other along the first axis.
struct Run {
  std::uint32_t first, last;
};

/// use(from, to) for the neighbours of a run in each of the rows beside it.
template <class Use>
void beside(const Grid& grid, const Run& run, Use&& use) {
  const std::size_t row = grid.nodes(0), layer = row * grid.nodes(1);
  const std::size_t y = run.first / row % grid.nodes(1), z = run.first / layer;
  const bool is_first = run.first % row == 0, is_last = run.last % row + 1 == row;
  for (std::size_t step = 1; step < 4; ++step) {  // the rows that a tetrahedron may have in common with this one
    const std::size_t up = step & 1, far = step >> 1, length = up * row + far * layer;
    if (y + up < grid.nodes(1) && z + far < grid.nodes(2)) use(run.first + length, run.last + length + !is_last);
    if (y >= up && z >= far) use(run.first - length - !is_first, run.last - length);
  }
}

/// The longest run around a node of those like it.
template <class IsLike>
Run run_around(const Grid& grid, std::size_t node, IsLike is_like) {
  const std::size_t row = grid.nodes(0), start = node - node % row;
  std::size_t first = node, last = node;
  while (first > start && is_like(first - 1)) --first;
  while (last + 1 < start + row && is_like(last + 1)) ++last;
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
}

/// Open nodes that are connected to the border through open ones become reached: a whole run at once.
void reach_from_border(const Grid& grid, std::vector<char>& nodes) {
  std::vector<Run> front;
  const auto reach_all = [&](std::size_t from, std::size_t to) {  // of one row
    for (std::size_t n = from; n <= to; ++n) {
      if (nodes[n] != kOpen) continue;
      const Run run = run_around(grid, n, [&](std::size_t m) { return nodes[m] == kOpen; });
      std::fill(&nodes[run.first], &nodes[run.last] + 1, kReached);
      front.push_back(run);
      n = run.last;
    }
  };
  grid.along_border([&](std::size_t n) { reach_all(n, n); });
  while (!front.empty()) {
    const Run run = front.back();
    front.pop_back();
    beside(grid, run, reach_all);
  }
}

/// Nodes that are connected to the border through such nodes: is_open(node). Beyond the border all is open: whoever
/// goes straight away from it only gets farther from the triangles.
template <class IsOpen>
std::vector<char> reached_from_border(const Grid& grid, IsOpen is_open) {
  std::vector<char> nodes(grid.node_count());
  const std::size_t layer = grid.nodes(0) * grid.nodes(1);
  oneapi::tbb::parallel_for(std::size_t{0}, grid.nodes(2), [&](std::size_t z) {
    for (std::size_t n = z * layer; n < (z + 1) * layer; ++n) nodes[n] = is_open(n) ? kOpen : kClosed;
  });
  reach_from_border(grid, nodes);
  std::replace(nodes.begin(), nodes.end(), kOpen, kClosed);
  return nodes;
}

/// Of each node the distance from the nearest of some nodes, in spacings (Felzenszwalb and Huttenlocher 2012).
std::vector<float> distances_from_nodes(const Grid& grid, const std::vector<char>& is_seed) {
  constexpr float kFar = 1e9F;
  std::vector<float> squared(grid.node_count());
  std::ranges::transform(is_seed, squared.begin(), [](char seed) { return seed ? 0.0F : kFar; });
  const std::array<std::size_t, 3> nodes{grid.nodes(0), grid.nodes(1), grid.nodes(2)};
  const std::array<std::size_t, 3> stride{1, nodes[0], nodes[0] * nodes[1]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3, count = nodes[axis];
    oneapi::tbb::parallel_for(std::size_t{0}, nodes[v], [&](std::size_t j) {
      std::vector<std::size_t> site(count);
      std::vector<float> from(count + 1), value(count);
      for (std::size_t i = 0; i < nodes[u]; ++i) {
        float* const line = &squared[i * stride[u] + j * stride[v]];
        for (std::size_t k = 0; k < count; ++k) value[k] = line[k * stride[axis]];
        // The lower envelope of the parabolas value[q] + (k - q)^2.
        const auto meet = [&](std::size_t p, std::size_t q) {
          const auto x = float(p), y = float(q);
          return ((value[q] + y * y) - (value[p] + x * x)) / (2 * (y - x));
        };
        std::size_t last = 0;
        site[0] = 0, from[0] = -kFar, from[1] = kFar;
        for (std::size_t q = 1; q < count; ++q) {
          float x = meet(site[last], q);
          while (x <= from[last] && last > 0) x = meet(site[--last], q);
          if (x > from[last]) ++last;
          site[last] = q, from[last] = last == 0 ? -kFar : x, from[last + 1] = kFar;
        }
        for (std::size_t k = 0, s = 0; k < count; ++k) {
          while (from[s + 1] < float(k)) ++s;
          const float away = float(k) - float(site[s]);
          line[k * stride[axis]] = value[site[s]] + away * away;
        }
      }
    });
  }
  for (float& x : squared) x = std::sqrt(x);
  return squared;
}

struct Rooms {
  std::vector<char> nodes;  ///< 1: in a room; empty if there is none
  double largest_door = 0;

  bool hold(std::size_t node) const { return !nodes.empty() && nodes[node]; }
};

/// Of each node, how many of the balls fit there. `levels` has their radii, ascending.
std::vector<std::uint8_t> balls_that_fit(const std::vector<float>& far, const std::vector<float>& levels) {
  std::vector<std::uint8_t> fit(far.size());
  std::ranges::transform(far, fit.begin(),
                         [&](float d) { return std::uint8_t(std::ranges::lower_bound(levels, d) - levels.begin()); });
  return fit;
}

/// Of each node, with how many of the balls it is reached from the border: a whole run at once.
std::vector<std::uint8_t> balls_that_reach(const Grid& grid, const std::vector<float>& far,
                                           const std::vector<float>& levels) {
  const std::vector<std::uint8_t> fit = balls_that_fit(far, levels);
  std::vector<std::uint8_t> reached(grid.node_count());
  std::vector<std::vector<Run>> fronts(levels.size() + 1);
  std::size_t balls = levels.size();
  const auto reach_all = [&](std::size_t from, std::size_t to) {  // of one row
    for (std::size_t n = from; n <= to; ++n) {
      const std::size_t passing = std::min<std::size_t>(balls, fit[n]);
      if (reached[n] > 0 || passing == 0) continue;  // whoever comes first comes with the largest one
      const Run run = run_around(
          grid, n, [&](std::size_t m) { return reached[m] == 0 && std::min<std::size_t>(balls, fit[m]) == passing; });
      std::fill(&reached[run.first], &reached[run.last] + 1, std::uint8_t(passing));
      fronts[passing].push_back(run);
      n = run.last;
    }
  };
  grid.along_border([&](std::size_t n) { reach_all(n, n); });
  for (; balls > 0; --balls)
    while (!fronts[balls].empty()) {
      const Run run = fronts[balls].back();
      fronts[balls].pop_back();
      beside(grid, run, reach_all);
      if (run.first % grid.nodes(0) > 0) reach_all(run.first - 1, run.first - 1);
      if (run.last % grid.nodes(0) + 1 < grid.nodes(0)) reach_all(run.last + 1, run.last + 1);
    }
  return reached;
}

constexpr float kLargerBall = 1.5F;

/// Adds the hollows whose doors balls of radius `level` do not pass, but in which larger ones fit. `reached` has for
/// each node how many balls get there; this is the one numbered `ball`.
void add_rooms(const Grid& grid, const std::vector<float>& far, float level, std::size_t ball,
               const std::vector<std::uint8_t>& reached, Rooms& rooms) {
  std::vector<char> is_core;
  for (std::size_t seed = 0; seed < grid.node_count(); ++seed) {
    if (reached[seed] > ball || far[seed] <= kLargerBall * level || rooms.hold(seed)) continue;
    is_core.resize(grid.node_count());
    if (is_core[seed]) continue;
    Nodes core{static_cast<std::uint32_t>(seed)};
    is_core[seed] = 1;
    while (!core.empty())
      for (const std::uint32_t m : std::exchange(core, {}))
        grid.around(m, [&](std::size_t n) {
          if (is_core[n] || far[n] <= level) return;
          is_core[n] = 1;
          core.push_back(static_cast<std::uint32_t>(n));
        });
  }
  if (is_core.empty()) return;
  rooms.nodes.resize(grid.node_count());
  rooms.largest_door = std::max(rooms.largest_door, 2.0 * level);
  const std::vector<float> from_core = distances_from_nodes(grid, is_core);
  for (std::size_t n = 0; n < grid.node_count(); ++n) rooms.nodes[n] |= from_core[n] <= level && grid.is_in_box(n);
}

/// Of each node, how far it is from the nodes near triangles, at most a spacing too little; exact is dear.
std::vector<float> distances_everywhere(const Grid& grid, const std::vector<float>& near) {
  std::vector<char> is_near(grid.node_count());
  std::ranges::transform(near, is_near.begin(), [](float d) { return d <= kLeastSeal; });
  return distances_from_nodes(grid, is_near);
}

/// Rooms with doors of any size, the narrowest first.
Rooms find_rooms(const Grid& grid, const std::vector<float>& far, float seal, ProgressMeter& meter) {
  Rooms rooms;
  const float widest = std::ranges::max(far) / 2;
  constexpr float kStep = 1.3F;
  std::vector<float> levels;
  for (float level = seal; level < widest; level *= kStep) levels.push_back(level);
  const std::vector<std::uint8_t> reached = balls_that_reach(grid, far, levels);
  for (std::size_t ball = 0; ball < levels.size(); ++ball) {
    meter.at(0);
    add_rooms(grid, far, levels[ball], ball, reached, rooms);
  }
  return rooms;
}

/// Nodes that are farther than kLeastSeal from triangles and that balls of radius `seal` reach from the border.
std::vector<char> reached_by_balls(const Grid& grid, const std::vector<float>& near, float seal, const Rooms& rooms,
                                   const std::vector<float>& far) {
  if (seal <= kLeastSeal)
    return reached_from_border(grid, [&](std::size_t n) { return near[n] > kLeastSeal && !rooms.hold(n); });
  const auto centers = reached_from_border(grid, [&](std::size_t n) { return far[n] > seal && !rooms.hold(n); });
  const std::vector<float> away = distances_from_nodes(grid, centers);
  return reached_from_border(grid,
                             [&](std::size_t n) { return away[n] <= seal && near[n] > kLeastSeal && !rooms.hold(n); });
}

std::array<std::size_t, 3> strides(const Grid& grid) { return {1, grid.nodes(0), grid.nodes(0) * grid.nodes(1)}; }

/// Nodes near triangles are outside if a way leads to them from others that no triangle crosses. It is short, so that
/// nothing leaks far.
void add_nearer_nodes(const Grid& grid, const std::vector<float>& near, const std::vector<std::uint8_t>& crossed,
                      const Rooms& rooms, std::vector<char>& outside) {
  Nodes front;
  for (std::size_t n = 0; n < grid.node_count(); ++n)
    if (outside[n] && near[n] < kInsideMargin - 1) front.push_back(static_cast<std::uint32_t>(n));
  constexpr int kSteps = 3;
  for (int step = 0; step < kSteps; ++step) {
    Nodes next;
    const auto visit = [&](std::size_t n) {
      if (outside[n] || near[n] > kLeastSeal || rooms.hold(n)) return;
      outside[n] = 1;
      next.push_back(static_cast<std::uint32_t>(n));
    };
    for (const std::uint32_t n : front)  // these are not on the border of the grid
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t stride = strides(grid)[axis];
        if (!(crossed[n] >> axis & 1)) visit(n + stride);
        if (!(crossed[n - stride] >> axis & 1)) visit(n - stride);
      }
    front = std::move(next);
  }
}

/// Where a node inside has one outside next to it, and no triangle between: a square there, and values that keep the
/// surface near it.
void add_doors(const Grid& grid, const std::vector<std::uint8_t>& crossed, const std::vector<char>& outside,
               Inside& result) {
  constexpr float kBeside = 0.5F;
  for (std::size_t z = 0; z + 1 < grid.nodes(2); ++z)
    for (std::size_t y = 0; y + 1 < grid.nodes(1); ++y)
      for (std::size_t x = 0; x + 1 < grid.nodes(0); ++x) {
        const std::size_t n = grid.node(x, y, z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t m = n + strides(grid)[axis];
          if (outside[n] == outside[m] || crossed[n] >> axis & 1) continue;
          float &a = result.signed_distances[n], &b = result.signed_distances[m];
          if (std::max(std::abs(a), std::abs(b)) <= kLeastSeal) continue;
          for (float* value : {&a, &b}) *value = std::clamp(*value, -kBeside, kBeside);
          Vec3 middle{double(x), double(y), double(z)}, u, v;
          middle[int(axis)] += 0.5, u[int(axis + 1) % 3] = 0.5, v[int(axis + 2) % 3] = 0.5;
          std::array<VertexId, 4> corners{};
          const std::array around{middle + u + v, middle - u + v, middle - u - v, middle + u - v};
          for (std::size_t i = 0; i < 4; ++i) corners[i] = result.doors.positions.push_back(grid.position(around[i]));
          result.doors.triangles.push_back({corners[0], corners[1], corners[2]});
          result.doors.triangles.push_back({corners[0], corners[2], corners[3]});
        }
      }
}

/// Fills what balls of radius `closing` do not reach.
void fill(const Grid& grid, const std::vector<float>& far, float closing, const std::vector<char>& outside,
          Inside& result) {
  constexpr float kSlack = 2, kBeside = 0.5F;  // `far` is up to so much too little
  const auto centers = reached_from_border(grid, [&](std::size_t n) { return outside[n] && far[n] > closing; });
  const std::vector<float> away = distances_from_nodes(grid, centers);
  const auto stays =
      reached_from_border(grid, [&](std::size_t n) { return outside[n] && away[n] <= closing + kSlack; });
  std::vector<float>& values = result.signed_distances;
  for (std::size_t n = 0; n < grid.node_count(); ++n) {
    if (!outside[n] || stays[n]) continue;
    values[n] = std::min(values[n], -kBeside);
    grid.around(n, [&](std::size_t m) {
      if (stays[m]) values[m] = std::min(values[m], kBeside);
    });
  }
}

/// Those to which ways lead from one of them along edges that no triangle crosses. All have the same winding number.
template <class IsMember>
Nodes connected_nodes(const Grid& grid, std::size_t start, const std::vector<std::uint8_t>& crossed,
                      IsMember take_if_member) {
  Nodes found;
  const auto visit = [&](std::size_t n) {
    if (take_if_member(n)) found.push_back(static_cast<std::uint32_t>(n));
  };
  visit(start);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {  // nodes inside are not on the border of the grid
      const std::size_t n = found[i], stride = strides(grid)[axis];
      if (!(crossed[n] >> axis & 1)) visit(n + stride);
      if (!(crossed[n - stride] >> axis & 1)) visit(n - stride);
    }
  return found;
}

/// Of the cube around a node, the part that is inside, in place of what such parts of its neighbours outside are. It
/// fits where the surface is parallel to the grid, as faces of boxes are, on nodes or between them, and the mean of
/// other places.
double part_inside(float signed_distance) {
  constexpr float kOn = 1e-4F;
  const float depth = -signed_distance;
  if (depth < kOn) return 0;
  return depth <= 1 + kOn ? 0.5 + double(depth) : 1;
}

}  // namespace

std::vector<char> find_cavities(const Grid& grid, const TriangleMesh& closed, const Inside& inside) {
  std::vector<Triangle> triangles;
  for (const FaceId f : closed.triangles.ids()) triangles.push_back(closed.triangle(f));
  const WindingNumber winding(std::move(triangles));
  const std::vector<std::uint8_t> crossed = crossed_edges(grid, closed);
  std::vector<char> is_new(grid.node_count()), is_cavity(grid.node_count());
  std::ranges::transform(inside.signed_distances, is_new.begin(), [](float d) { return d < 0; });
  const auto take = [&](std::size_t n) { return std::exchange(is_new[n], 0) != 0; };
  for (std::size_t start = 0; start < grid.node_count(); ++start) {
    if (!is_new[start]) continue;
    const Nodes nodes = connected_nodes(grid, start, crossed, take);
    std::optional<int> known;
    for (std::size_t i = 0; i < nodes.size() && !known; ++i) known = winding.at(grid.position(grid.place(nodes[i])));
    if (known.value_or(1) < 1)
      for (const std::uint32_t n : nodes) is_cavity[n] = 1;
  }
  return is_cavity;
}

Inside find_inside(const Grid& grid, const TriangleMesh& triangles, const InsideOptions& options,
                   ProgressMeter& meter) {
  Inside result;
  std::vector<float>& near = result.signed_distances = distances(grid, triangles, kInsideMargin - 1, meter);
  const auto level = static_cast<float>(std::max<double>(options.seal, kLeastSeal));
  const auto closing = static_cast<float>(options.closing);
  const bool is_far_wanted = options.seal_rooms || level > kLeastSeal || closing > 0;
  const std::vector<float> far = is_far_wanted ? distances_everywhere(grid, near) : std::vector<float>{};
  const Rooms rooms = options.seal_rooms ? find_rooms(grid, far, level, meter) : Rooms{};
  std::vector<char> outside = reached_by_balls(grid, near, level, rooms, far);
  const std::vector<std::uint8_t> crossed = crossed_edges(grid, triangles);
  add_nearer_nodes(grid, near, crossed, rooms, outside);
  for (std::size_t n = 0; n < grid.node_count(); ++n)
    if (!outside[n]) near[n] = -near[n];
  const auto is_deep = [](float d) { return d < -kLeastSeal; };
  if (std::ranges::any_of(near, is_deep))
    for (const float distance : near) result.volume += part_inside(distance);
  add_doors(grid, crossed, outside, result);
  if (closing > 0) fill(grid, far, closing, outside, result);
  result.largest_door = rooms.largest_door;
  return result;
}

}  // namespace prohull
