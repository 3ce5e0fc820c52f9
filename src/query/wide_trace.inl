// The ways of a line and of a point through a WideBvh, for one instruction set: included by wide_trace.cpp with TARGET as the attribute
// that allows it and mask_of as the signs of eight lanes. Lanes compute what scalars would: all instruction sets visit
// the same faces in the same order.

/// Offers the faces of a leaf that the line may cross. Whether to go on.
TARGET bool offer_faces(const WideBvh& tree, std::uint32_t child, const WideShear& line, HitCollector& hits) {
  const WideBvh::Leaf& leaf = tree.leaf(child);
  tree.prefetch_corners(leaf);
  const double per_quantum = leaf.per_quantum, low_k = leaf.low[line.k];
  const auto slope_u = static_cast<float>(line.slope_u), slope_v = static_cast<float>(line.slope_v),
             u0 = static_cast<float>((leaf.low[line.i] + line.slope_u * low_k + line.u0) * per_quantum),
             v0 = static_cast<float>((leaf.low[line.j] + line.slope_v * low_k + line.v0) * per_quantum),
             d = 2 * WideBvh::kCornerError + 0.25f + 0x1p-23f * std::max(std::abs(u0), std::abs(v0)) + static_cast<float>(line.error * per_quantum);
  // In quanta, as WideShear has it: u and v of each corner, off by less than d.
  Float8 u[3], v[3];
  Float8 size = {};
  for (int c = 0; c < 3; ++c) {
    const Float8 p = __builtin_convertvector(leaf.corner[c][line.k], Float8);
    u[c] = (__builtin_convertvector(leaf.corner[c][line.i], Float8) + p * slope_u) + u0;
    v[c] = (__builtin_convertvector(leaf.corner[c][line.j], Float8) + p * slope_v) + v0;
    const auto au = reinterpret_cast<Float8>(reinterpret_cast<Truth8>(u[c]) & 0x7fffffff),
               av = reinterpret_cast<Float8>(reinterpret_cast<Truth8>(v[c]) & 0x7fffffff);
    size = size > au ? size : au;
    size = size > av ? size : av;
  }
  const Float8 ab = u[0] * v[1] - v[0] * u[1], bc = u[1] * v[2] - v[1] * u[2], ca = u[2] * v[0] - v[2] * u[0];
  const Float8 error = (size + d) * (8 * d);
  Float8 least = ab < bc ? ab : bc, most = bc < ab ? ab : bc;
  least = ca < least ? ca : least;
  most = ca > most ? ca : most;
  const unsigned all = (2u << (WideBvh::faces_of(child) - 1)) - 1;
  unsigned maybe = all & ~mask_of((least < -error) & (most > error));
  if (maybe == 0) return true;
  const unsigned positive = mask_of(least > error), sure = positive | mask_of(most < -error);
  for (; maybe != 0; maybe &= maybe - 1) {
    const int lane = std::countr_zero(maybe);
    const FaceId face{leaf.face[lane]};
    if ((sure >> lane & 1) == 0) {
      hits.offer(face, tree.triangle(leaf, lane));
    } else {
      const Range at = line.range_of(leaf, lane, {ab[lane], bc[lane], ca[lane]}, error[lane]);
      if (at.high < 0 || at.low > hits.limit()) continue;
      const int sign = (positive >> lane & 1) == unsigned{line.k_forwards} ? 1 : -1;
      const bool is_certain = at.low > 0 && at.high < hits.limit();
      if (!is_certain || !hits.settles(sign)) hits.offer_pierced(face, tree.triangle(leaf, lane), sign);
    }
    if (hits.is_complete()) return false;
  }
  return true;
}

TARGET void trace(const WideBvh& tree, const DirectedLine& directed, HitCollector& hits) {
  const WideLine line(tree, directed);
  // Eight times the same, and kept in registers.
  const Float8 near_x = Float8{} + line.near_origin[0], near_y = Float8{} + line.near_origin[1],
               near_z = Float8{} + line.near_origin[2], far_x = Float8{} + line.far_origin[0],
               far_y = Float8{} + line.far_origin[1], far_z = Float8{} + line.far_origin[2],
               inverse_x = Float8{} + line.inverse[0], inverse_y = Float8{} + line.inverse[1],
               inverse_z = Float8{} + line.inverse[2], wide_x = inverse_x * WideLine::kWiden,
               wide_y = inverse_y * WideLine::kWiden, wide_z = inverse_z * WideLine::kWiden;
  const std::ptrdiff_t back_x = line.backwards[0] ? 3 : 0, back_y = line.backwards[1] ? 3 : 0,
                       back_z = line.backwards[2] ? 3 : 0;
  struct Entry {
    float from;
    std::uint32_t child;
  };
  Entry stack[WideBvh::kStackSize];
  int size = 0;
  float end = WideLine::end(hits.limit());
  std::optional<WideShear> shear;
  std::uint32_t child = WideBvh::kRoot;
  for (;;) {
    while (!WideBvh::is_leaf(child)) {
      const WideBvh::Node& node = tree.node(child);
      const Float8* const low = node.plane;
      const Float8 from_x = (low[back_x] - near_x) * inverse_x, to_x = (low[3 - back_x] - far_x) * wide_x,
                   from_y = (low[1 + back_y] - near_y) * inverse_y, to_y = (low[4 - back_y] - far_y) * wide_y,
                   from_z = (low[2 + back_z] - near_z) * inverse_z, to_z = (low[5 - back_z] - far_z) * wide_z;
      // NaN is the second, if it is one of the two.
      Float8 from = {}, to = from + end;
      from = from_x > from ? from_x : from;
      from = from_y > from ? from_y : from;
      from = from_z > from ? from_z : from;
      to = to_x < to ? to_x : to;
      to = to_y < to ? to_y : to;
      to = to_z < to ? to_z : to;
      unsigned met = mask_of(from <= to);
      if (met == 0) goto next;
      int lane = std::countr_zero(met);
      met &= met - 1;
      if (met == 0) {
        child = node.child[lane];
        continue;
      }
      // The nearest goes on, the others wait, nearer ones on top.
      const int first = size;
      Entry nearest{from[lane], node.child[lane]};
      do {
        lane = std::countr_zero(met);
        met &= met - 1;
        Entry entry{from[lane], node.child[lane]};
        if (entry.from < nearest.from) std::swap(entry, nearest);
        if (WideBvh::is_leaf(entry.child) && entry.child != WideBvh::kNoChild) tree.prefetch_leaf(entry.child);
        int place = size++;
        for (; place > first && stack[place - 1].from < entry.from; --place) stack[place] = stack[place - 1];
        stack[place] = entry;
      } while (met != 0);
      child = nearest.child;
    }
    if (child != WideBvh::kNoChild) {
      if (!shear) shear.emplace(line);
      if (!offer_faces(tree, child, *shear, hits)) return;
      end = WideLine::end(hits.limit());
    }
  next:
    do {
      if (size == 0) return;
      child = stack[--size].child;
    } while (stack[size].from > end);
  }
}

/// Offers the faces of a leaf of which the box may be as near to q as the limit. q is a point in the frame, off by at
/// most `slack`.
// In quanta, a corner is off by kCornerError < 1/2 + 2^-7, q by slack per_quantum, and its rounding and that of the
// difference, which is at most 65536 + |q|, by 2^-24 of these each. What is beyond one quantum is left for `slack`.
TARGET void offer_near_faces(const WideBvh& tree, std::uint32_t child, const Vec3& q, double slack, ClosestCollector& closest) {
  const WideBvh::Leaf& leaf = tree.leaf(child);
  tree.prefetch_corners(leaf);
  Float8 squared_distance{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<float>((q[axis] - leaf.low[static_cast<std::size_t>(axis)]) * leaf.per_quantum);
    const float error = 1 + 0x1p-22f * std::abs(at) + static_cast<float>(slack * leaf.per_quantum);
    const Float8 a = __builtin_convertvector(leaf.corner[0][axis], Float8),
                 b = __builtin_convertvector(leaf.corner[1][axis], Float8),
                 c = __builtin_convertvector(leaf.corner[2][axis], Float8);
    const Float8 ab_least = a < b ? a : b, ab_most = a < b ? b : a;
    const Float8 below = (ab_least < c ? ab_least : c) - at, above = at - (ab_most > c ? ab_most : c);
    Float8 gap = (below > above ? below : above) - error;
    gap = gap > 0 ? gap : Float8{};
    squared_distance += gap * gap;
  }
  const double per_unit = tree.scale() * leaf.per_quantum * (1 + 0x1p-20);
  const unsigned all = (2u << (WideBvh::faces_of(child) - 1)) - 1;
  double limit = -1;
  unsigned left = all;
  for (int lane = 0; (left >> lane) != 0; ++lane) {
    if (closest.limit() != limit) {
      limit = closest.limit();
      const auto squared_limit = static_cast<float>(limit * per_unit * (limit * per_unit)) + 1e-30f;
      left &= all & ~mask_of(squared_distance > squared_limit);
    }
    if ((left >> lane & 1) != 0) closest.offer(FaceId{leaf.face[lane]}, tree.triangle(leaf, lane));
  }
}

/// Of four children from `kFirst` on, how far q is from their boxes, squared. Which are as near as `squared_reach`.
template <int kFirst>
TARGET inline __attribute__((always_inline)) unsigned near_boxes(const WideBvh::Node& node, const Vec3& q, double squared_reach, double* squared_distance) {
  Double4 sum{};
  for (int axis = 0; axis < 3; ++axis) {
    const Float8 &all_low = node.plane[axis], &all_high = node.plane[axis + 3];
    const Float4 low = __builtin_shufflevector(all_low, all_low, kFirst, kFirst + 1, kFirst + 2, kFirst + 3),
                 high = __builtin_shufflevector(all_high, all_high, kFirst, kFirst + 1, kFirst + 2, kFirst + 3);
    const Double4 below = __builtin_convertvector(low, Double4) - q[axis],
                  above = q[axis] - __builtin_convertvector(high, Double4);
    Double4 gap = below > above ? below : above;
    gap = gap > 0 ? gap : Double4{};
    sum += gap * gap;
  }
  std::memcpy(squared_distance + kFirst, &sum, sizeof sum);
  return mask(__builtin_convertvector(sum <= squared_reach, Truth4)) << kFirst;
}

// In the frame q = (p - center) scale is off by at most 2 eps of each of its coordinates, eps = 2^-53. Distances to
// boxes are rounded by a relative 4 eps, which the limit makes up for, with 2^-500 for squares that underflow.
TARGET void trace_nearest(const WideBvh& tree, ClosestCollector& closest) {
  struct Near {
    double squared_distance;
    std::uint32_t child;
  };
  using line_filter::kEpsilon;
  const Vec3 q = tree.in_frame(closest.point());
  const double slack = 4 * kEpsilon * (std::abs(q.x) + std::abs(q.y) + std::abs(q.z)) + 0x1p-500;
  Near stack[WideBvh::kStackSize];
  int size = 0;
  stack[size++] = {0, WideBvh::kRoot};
  while (size > 0) {
    const Near entry = stack[--size];
    const double reach = closest.limit() * tree.scale() * (1 + 16 * kEpsilon) + slack, squared_reach = reach * reach;
    if (entry.squared_distance > squared_reach) continue;
    if (WideBvh::is_leaf(entry.child)) {
      offer_near_faces(tree, entry.child, q, slack, closest);
      continue;
    }
    const WideBvh::Node& node = tree.node(entry.child);
    double squared_distance[WideBvh::kWidth];
    const int first = size;
    unsigned near = near_boxes<0>(node, q, squared_reach, squared_distance) |
                    near_boxes<4>(node, q, squared_reach, squared_distance);
    for (; near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      if (node.child[i] == WideBvh::kNoChild) continue;
      const Near child{squared_distance[i], node.child[i]};
      int place = size++;
      for (; place > first && stack[place - 1].squared_distance < child.squared_distance; --place)
        stack[place] = stack[place - 1];
      stack[place] = child;
    }
  }
}
