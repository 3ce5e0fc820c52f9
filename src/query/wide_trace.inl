// The ways of a line and of a point through a WideBvh, for one instruction set: included by wide_trace.cpp with TARGET
// as the attribute that allows it, mask_of as the signs of lanes, floats_of and doubles_of as numbers of a leaf and a
// node. Lanes compute what scalars would: all instruction sets visit the same faces in the same order.

/// Offers the faces of a leaf that the line may cross. Whether to go on.
TARGET bool offer_faces(const WideBvh& tree, std::uint32_t child, const WideShear& line, HitCollector& hits) {
  const WideBvh::Leaf& leaf = tree.leaf(child);
  tree.prefetch_corners(leaf);
  const double per_quantum = leaf.per_quantum, low_k = leaf.low[line.k];
  const auto slope_u = static_cast<float>(line.slope_u), slope_v = static_cast<float>(line.slope_v),
             u0 = static_cast<float>((leaf.low[line.i] + line.slope_u * low_k + line.u0) * per_quantum),
             v0 = static_cast<float>((leaf.low[line.j] + line.slope_v * low_k + line.v0) * per_quantum),
             d = 2 * WideBvh::kCornerError + 0.25f + 0x1p-23f * std::max(std::abs(u0), std::abs(v0)) +
                 static_cast<float>(line.error * per_quantum);
  // In quanta, as WideShear has it: u and v of each corner, off by less than d.
  Float8 u[3], v[3];
  Float8 size = {};
  for (int c = 0; c < 3; ++c) {
    const Float8 p = floats_of(leaf.corner[c][line.k]);
    u[c] = (floats_of(leaf.corner[c][line.i]) + p * slope_u) + u0;
    v[c] = (floats_of(leaf.corner[c][line.j]) + p * slope_v) + v0;
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

/// Eight points or directions, one in each lane.
struct EightVectors {
  Float8 x, y, z;
};
INLINE EightVectors difference(const EightVectors& a, const EightVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
INLINE EightVectors product(const EightVectors& a, const Float8& s) { return {a.x * s, a.y * s, a.z * s}; }
INLINE Float8 dot(const EightVectors& a, const EightVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// In [0, 1].
INLINE Float8 fraction(const Float8& part, const Float8& whole) {
  const Float8 ratio = part / whole, from_0 = ratio > 0 ? ratio : Float8{};
  return from_0 < 1 ? from_0 : Float8{} + 1;
}

/// From about the closest point of each face to q, which is `away` from its corners.
// With e = b - a and f = c - a, of the points a + v e + w f it is the one with the least distance from q, or from a on:
// |a + v e + w f - q|^2 - |a - q|^2. That of the plane, if it is in the face, or else of those on the three edges.
INLINE EightVectors away_from_feet(const EightVectors (&away)[3]) {
  const EightVectors e = difference(away[0], away[1]), f = difference(away[0], away[2]);
  const Float8 ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), eq = dot(e, away[0]), fq = dot(f, away[0]);
  const Float8 on_ab = fraction(eq, ee), on_ac = fraction(fq, ff),
               on_bc = fraction((fq - eq) + (ee - ef), ee - 2 * ef + ff);
  const Float8 at_ab = on_ab * (on_ab * ee - 2 * eq), at_ac = on_ac * (on_ac * ff - 2 * fq),
               at_bc = ee - 2 * eq + on_bc * (on_bc * (ee - 2 * ef + ff) - 2 * ((fq - eq) + (ee - ef)));
  const Truth8 is_ac = at_ac < at_ab, is_bc = at_bc < (is_ac ? at_ac : at_ab);
  const Float8 of_v = ff * eq - ef * fq, of_w = ee * fq - ef * eq, whole = ee * ff - ef * ef;
  const Truth8 is_inside = (of_v > 0) & (of_w > 0) & (of_v + of_w < whole);
  const Float8 v_on_edge = is_bc ? 1 - on_bc : is_ac ? Float8{} : on_ab,
               w_on_edge = is_bc ? on_bc : is_ac ? on_ac : Float8{};
  const Float8 v = is_inside ? of_v / whole : v_on_edge, w = is_inside ? of_w / whole : w_on_edge;
  return difference(difference(away[0], product(e, v)), product(f, w));
}

/// The faces of a leaf, seen from a point.
struct SeenLeaf {
  Float8 squared_distance;
  double error;  ///< in quanta: no face is nearer than the root of that less this, but for a relative rounding of 2^-20
};

/// q is a point in the frame, off by at most `slack`.
// No point of a face is nearer than its nearest corner along a direction n, whatever n is: here it comes from about the
// closest point. In quanta, a corner is off by kCornerError along each axis, q by slack per_quantum, and its rounding
// and that of the difference, which is at most reach = 65536 + |q|, by 2^-24 reach each. The rounding of dot(n, away)
// adds at most 3 sqrt(3) 2^-24 reach |n|. So along n a corner is off by less than sqrt(3) (kCornerError + slack
// per_quantum + 5 2^-24 reach).
INLINE SeenLeaf seen_from(const WideBvh::Leaf& leaf, const Vec3& q, double slack) {
  float at[3], reach = 65536;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = static_cast<float>((q[static_cast<int>(axis)] - leaf.low[axis]) * leaf.per_quantum);
    reach = std::max(reach, 65536 + std::abs(at[axis]));
  }
  EightVectors away[3];
  for (int c = 0; c < 3; ++c)
    away[c] = {at[0] - floats_of(leaf.corner[c][0]), at[1] - floats_of(leaf.corner[c][1]),
               at[2] - floats_of(leaf.corner[c][2])};
  const EightVectors n = away_from_feet(away);
  const Float8 a = dot(n, away[0]), b = dot(n, away[1]), c = dot(n, away[2]), squared_length = dot(n, n);
  const Float8 ab = a < b ? a : b, least = ab < c ? ab : c;
  const Truth8 is_apart = (least > 0) & (squared_length > 0x1p-100f);
  return {is_apart ? least * (least / squared_length) : Float8{},
          1.75 * (WideBvh::kCornerError + slack * leaf.per_quantum + 0x1p-21 * reach)};
}

/// Which faces may be as near as the limit, in quanta.
INLINE unsigned lanes_within(double limit, const SeenLeaf& seen) {
  const double reach = limit * (1 + 0x1p-20) + seen.error;
  return ~mask_of(seen.squared_distance > static_cast<float>(reach * reach * (1 + 0x1p-20)));
}

/// Offers the faces of a leaf that may be as near to q as the limit, the nearest first.
TARGET void offer_near_faces(const WideBvh& tree, std::uint32_t child, const Vec3& q, double slack,
                             ClosestCollector& closest) {
  const WideBvh::Leaf& leaf = tree.leaf(child);
  tree.prefetch_corners(leaf);
  const SeenLeaf seen = seen_from(leaf, q, slack);
  const double quanta_per_unit = tree.scale() * leaf.per_quantum;
  unsigned left = (2u << (WideBvh::faces_of(child) - 1)) - 1;
  for (;;) {
    left &= lanes_within(closest.limit() * quanta_per_unit, seen);
    if (left == 0) return;
    int nearest = std::countr_zero(left);
    for (unsigned others = left & (left - 1); others != 0; others &= others - 1)
      if (const int lane = std::countr_zero(others); seen.squared_distance[lane] < seen.squared_distance[nearest])
        nearest = lane;
    closest.offer(FaceId{leaf.face[nearest]}, tree.triangle(leaf, nearest));
    left &= ~(1u << nearest);
  }
}

/// The children of a node that wait to be seen, by the squares of the distances of their boxes from q.
struct WaitingChildren {
  Double4 squared_distance[2];
  const std::uint32_t* child;
};

INLINE WaitingChildren children_from(const WideBvh::Node& node, const Vec3& q) {
  WaitingChildren all{{}, node.child};
  for (int half = 0; half < 2; ++half) {
    Double4 sum{};
    for (int axis = 0; axis < 3; ++axis) {
      const Double4 below = doubles_of(node.plane[axis], half) - q[axis],
                    above = q[axis] - doubles_of(node.plane[axis + 3], half);
      Double4 gap = below > above ? below : above;
      gap = gap > 0 ? gap : Double4{};
      sum += gap * gap;
    }
    all.squared_distance[half] = sum < kMostDouble ? sum : Double4{} + kMostDouble;
  }
  return all;
}

/// Takes the nearest child out; kNoChild if none is as near as that. Those that a node has not are farther than any.
INLINE std::uint32_t take_nearest(WaitingChildren& waiting, double squared_reach) {
  const Double4 &a = waiting.squared_distance[0], &b = waiting.squared_distance[1];
  Double4 least = a < b ? a : b, other = __builtin_shufflevector(least, least, 2, 3, 0, 1);
  least = least < other ? least : other;
  other = __builtin_shufflevector(least, least, 1, 0, 3, 2);
  least = least < other ? least : other;
  if (!(least[0] <= squared_reach)) return WideBvh::kNoChild;
  const int lane = std::countr_zero(mask_of(a == least) | mask_of(b == least) << 4);
  waiting.squared_distance[lane / 4][lane % 4] = std::numeric_limits<double>::infinity();
  return waiting.child[lane];
}

// In the frame q = (p - center) scale is off by at most 2 eps of each of its coordinates, eps = 2^-53. Distances to
// boxes are rounded by a relative 4 eps, which the limit makes up for, with 2^-500 for squares that underflow.
TARGET void trace_nearest(const WideBvh& tree, ClosestCollector& closest) {
  using line_filter::kEpsilon;
  const Vec3 q = tree.in_frame(closest.point());
  const double slack = 4 * kEpsilon * (std::abs(q.x) + std::abs(q.y) + std::abs(q.z)) + 0x1p-500;
  const auto squared_reach_of = [&](double limit) {
    const double reach = limit * tree.scale() * (1 + 16 * kEpsilon) + slack;
    return std::min(reach * reach, kMostDouble);
  };
  double squared_reach = squared_reach_of(closest.limit());
  WaitingChildren stack[WideBvh::kMaxDepth];
  int size = 0;
  stack[size++] = children_from(tree.node(WideBvh::kRoot), q);
  while (size > 0) {
    const std::uint32_t child = take_nearest(stack[size - 1], squared_reach);
    if (child == WideBvh::kNoChild) {
      --size;
    } else if (WideBvh::is_leaf(child)) {
      offer_near_faces(tree, child, q, slack, closest);
      squared_reach = squared_reach_of(closest.limit());
    } else {
      stack[size++] = children_from(tree.node(child), q);
    }
  }
}
