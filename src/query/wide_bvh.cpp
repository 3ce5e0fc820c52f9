#include "query/wide_bvh.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <limits>

#include "geometry/bvh.h"
#include "prohull/error.h"
#include "query/wide_line.h"

namespace prohull {

// WideBvhBuilder, which WideBvh knows by name, keeps these.
struct NodeBox {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  void extend(const NodeBox& other) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
  float middle(int axis) const { return 0.5f * (low[axis] + high[axis]); }
  double half_area() const {  // floats would overflow from 1e19 on
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }

  std::array<float, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
};

/// A face with its box, moved about together while ranges are split.
struct Item {
  NodeBox box;
  FaceId face;
};

struct NodeRange {
  std::uint32_t begin, end;
  NodeBox box;
  std::uint32_t size() const { return end - begin; }
};

namespace {

constexpr std::uint32_t kLeafFaces = WideBvh::kWidth;
/// Coordinates of the frame are rounded to 2^-53, twice: that is negligible in quanta of at least 2^-40.
constexpr int kLeastQuantum = -40;
constexpr int kBins = 16;
constexpr int kDepthOfBins = 60;  // below, ranges are halved, so that the depth is bounded whatever the mesh

/// Floats below and above a value that was rounded to double: its nearest float, moved by at least one of its ulps.
float below(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest - (std::abs(nearest) * 0x1p-23f + 0x1p-126f);
}
float above(double x) { return -below(-x); }

NodeRange part_of(const std::vector<Item>& items, std::uint32_t begin, std::uint32_t end) {
  NodeRange range{begin, end, {}};
  for (std::uint32_t i = begin; i < end; ++i) range.box.extend(items[i].box);
  return range;
}

struct Bin {
  NodeBox box;
  std::uint32_t count = 0;
};

/// The plane between two bins, of those along one axis, with the least surface-area cost.
struct SplitPlane {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1, bin = 0;
};

/// How many leaves so many faces fill.
float leaves_of(std::uint32_t faces) {
  const std::uint32_t leaves = (faces + kLeafFaces - 1) / kLeafFaces;
  return static_cast<float>(leaves);
}

class Bins {
 public:
  Bins(const std::vector<Item>& items, const NodeRange& part) {
    const auto sum = [&](auto zero, auto add, auto join) {
      if (part.size() < kParallel) {
        for (std::uint32_t i = part.begin; i < part.end; ++i) add(zero, items[i]);
        return zero;
      }
      return oneapi::tbb::parallel_reduce(
          oneapi::tbb::blocked_range(part.begin, part.end, kParallel / 4), zero,
          [&](const auto& range, auto all) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i) add(all, items[i]);
            return all;
          },
          join);
    };
    const NodeBox middles = sum(
        NodeBox{},
        [](NodeBox& box, const Item& item) {
          for (int axis = 0; axis < 3; ++axis) {
            const float middle = item.box.middle(axis);
            box.low[axis] = std::min(box.low[axis], middle), box.high[axis] = std::max(box.high[axis], middle);
          }
        },
        [](NodeBox box, const NodeBox& other) { return box.extend(other), box; });
    low_ = middles.low;
    for (int axis = 0; axis < 3; ++axis)
      per_length_[axis] =
          middles.high[axis] > low_[axis] ? kBins * (1 - 0x1p-20f) / (middles.high[axis] - low_[axis]) : 0;
    bins_ = sum(
        AllBins{},
        [&](AllBins& bins, const Item& item) {
          for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][bin_of(item, axis)];
            bin.box.extend(item.box);
            ++bin.count;
          }
        },
        [](AllBins bins, const AllBins& other) {
          for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < kBins; ++i) {
              bins[axis][i].box.extend(other[axis][i].box);
              bins[axis][i].count += other[axis][i].count;
            }
          return bins;
        });
  }

  int bin_of(const Item& item, int axis) const {
    const float place = (item.box.middle(axis) - low_[axis]) * per_length_[axis];
    return place < kBins - 1 ? static_cast<int>(place) : kBins - 1;
  }

  SplitPlane best() const {
    SplitPlane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(per_length_[axis] > 0)) continue;
      std::array<double, kBins> cost_above{};  // of the bins from i on
      NodeBox box;
      std::uint32_t count = 0;
      for (int i = kBins - 1; i > 0; --i) {
        box.extend(bins_[axis][i].box);
        count += bins_[axis][i].count;
        cost_above[i] = count == 0 ? 0 : box.half_area() * leaves_of(count);
      }
      const std::uint32_t all = count + bins_[axis][0].count;
      box = {}, count = 0;
      for (int i = 1; i < kBins; ++i) {
        box.extend(bins_[axis][i - 1].box);
        count += bins_[axis][i - 1].count;
        if (count == 0 || count == all) continue;
        const double cost = box.half_area() * leaves_of(count) + cost_above[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

 private:
  static constexpr std::uint32_t kParallel = 1 << 16;
  using AllBins = std::array<std::array<Bin, kBins>, 3>;

  std::array<float, 3> low_, per_length_;
  AllBins bins_;
};

/// Splits a range in two, of which neither is empty.
std::pair<NodeRange, NodeRange> split(std::vector<Item>& items, const NodeRange& part, int depth) {
  const Bins bins(items, part);
  const SplitPlane plane = depth < kDepthOfBins ? bins.best() : SplitPlane{};
  const auto begin = items.begin() + part.begin, end = items.begin() + part.end;
  auto middle = begin + part.size() / 2;
  if (plane.axis >= 0)
    middle = std::partition(begin, end, [&](const Item& item) { return bins.bin_of(item, plane.axis) < plane.bin; });
  const auto at = static_cast<std::uint32_t>(middle - items.begin());
  return {part_of(items, part.begin, at), part_of(items, at, part.end)};
}

/// Up to as many parts as a node has children: the biggest that is no leaf is split until there are.
std::vector<NodeRange> children_of(std::vector<Item>& items, const NodeRange& whole, int depth) {
  std::vector<NodeRange> children{whole};
  while (children.size() < WideBvh::kWidth) {
    const auto biggest = std::ranges::max_element(
        children, {}, [](const NodeRange& p) { return p.size() > kLeafFaces ? p.box.half_area() : -1.0; });
    if (biggest->size() <= kLeafFaces) break;
    const auto [left, right] = split(items, *biggest, depth);
    *biggest = left;
    children.push_back(right);
  }
  return children;
}

}  // namespace

/// Builds the upper nodes, then what is below them in parallel, and joins all. What is made does not depend on the
/// number of threads.
class WideBvhBuilder {
 public:
  WideBvhBuilder(WideBvh& tree, const TriangleMesh& mesh, std::vector<Item> items)
      : tree_(tree), mesh_(mesh), items_(std::move(items)), least_below_(items_.size() / kPieces + kLeafFaces) {
    const auto count = static_cast<std::uint32_t>(items_.size());
    Piece top;
    add_node(top, part_of(items_, 0, count), 0, &WideBvhBuilder::defer);
    oneapi::tbb::parallel_for(std::size_t{0}, below_.size(), [&](std::size_t i) {
      add_node(below_[i].piece, below_[i].part, below_[i].depth, &WideBvhBuilder::add_node_below);
    });
    join(top);
  }

 private:
  static constexpr std::uint32_t kPieces = 256;

  /// Nodes and leaves, numbered from 0 each.
  struct Piece {
    std::vector<WideBvh::Node> nodes;
    std::vector<WideBvh::Leaf> leaves;
    std::vector<Vec3> corners;
  };
  struct Below {
    NodeRange part;
    int depth;
    Piece piece;
  };
  using AddInner = std::uint32_t (WideBvhBuilder::*)(Piece&, const NodeRange&, int depth);

  std::uint32_t add_node(Piece& piece, const NodeRange& whole, int depth, AddInner add_inner) {
    const auto self = static_cast<std::uint32_t>(piece.nodes.size());
    piece.nodes.emplace_back();
    const std::vector<NodeRange> children = children_of(items_, whole, depth);
    for (std::uint32_t i = 0; i < WideBvh::kWidth; ++i) {
      const bool is_there = i < children.size();
      const NodeBox box = is_there ? children[i].box : NodeBox{};
      const std::uint32_t child = !is_there                         ? WideBvh::kNoChild
                                  : children[i].size() > kLeafFaces ? (this->*add_inner)(piece, children[i], depth + 1)
                                                                    : add_leaf(piece, children[i]);
      WideBvh::Node& node = piece.nodes[self];
      for (int axis = 0; axis < 3; ++axis)
        node.plane[axis][i] = box.low[axis], node.plane[3 + axis][i] = box.high[axis];
      node.child[i] = child;
    }
    return self;
  }
  std::uint32_t add_node_below(Piece& piece, const NodeRange& part, int depth) {
    return add_node(piece, part, depth, &WideBvhBuilder::add_node_below);
  }
  /// An upper node; or a place in below_, counted from the top of the numbers.
  std::uint32_t defer(Piece& piece, const NodeRange& part, int depth) {
    if (part.size() > least_below_) return add_node(piece, part, depth, &WideBvhBuilder::defer);
    below_.push_back({part, depth, {}});
    return WideBvh::kLeafBit - static_cast<std::uint32_t>(below_.size());
  }

  std::uint32_t add_leaf(Piece& piece, const NodeRange& part) {
    WideBvh::Leaf& leaf = piece.leaves.emplace_back();
    const NodeBox& box = part.box;
    leaf.low = box.low;
    const float size = std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
    // No corner is more than 65535 quanta away, rounded: a size just below a power of 2 counts as that.
    leaf.per_quantum = std::ldexp(1.0f, -std::max(std::ilogb(size * (1 + 0x1p-15f)) - 15, kLeastQuantum));
    leaf.first_corner = static_cast<std::uint32_t>(piece.corners.size());
    std::array<VertexId, 3 * WideBvh::kWidth> vertices;  // of its corners
    const auto first = vertices.begin();
    auto last = first;
    for (std::uint32_t i = 0; i < part.size(); ++i) {
      const FaceId face = items_[part.begin + i].face;
      leaf.face[i] = index(face);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const VertexId v = mesh_.triangles[face][corner];
        const Vec3 p = tree_.in_frame(mesh_.positions[v]);
        for (int axis = 0; axis < 3; ++axis)
          leaf.corner[corner][axis][i] = static_cast<std::uint16_t>(
              std::lrint((p[axis] - leaf.low[static_cast<std::size_t>(axis)]) * leaf.per_quantum));
        const auto place = std::find(first, last, v);
        leaf.corner_at[corner][i] = static_cast<std::uint8_t>(place - first);
        if (place != last) continue;
        *last++ = v;
        piece.corners.push_back(mesh_.positions[v]);
      }
    }
    return WideBvh::leaf_at(static_cast<std::uint32_t>(piece.leaves.size() - 1), part.size());
  }

  /// The upper nodes first, then what is below them, in its order.
  void join(const Piece& top) {
    struct Place {
      std::uint32_t node, leaf, corner;
    };
    std::size_t leaves = top.leaves.size();
    for (const Below& below : below_) leaves += below.piece.leaves.size();
    if (leaves > WideBvh::kLeafMask)
      throw InputError(Defect::InvalidOption,
                       "the mesh has too many faces for an index: they take more than 2^28 leaves");
    std::vector<Place> places;
    Place end{static_cast<std::uint32_t>(top.nodes.size()), static_cast<std::uint32_t>(top.leaves.size()),
              static_cast<std::uint32_t>(top.corners.size())};
    for (const Below& below : below_) {
      places.push_back(end);
      end.node += static_cast<std::uint32_t>(below.piece.nodes.size());
      end.leaf += static_cast<std::uint32_t>(below.piece.leaves.size());
      end.corner += static_cast<std::uint32_t>(below.piece.corners.size());
    }
    tree_.nodes_ = HugeArray<WideBvh::Node>(end.node);
    tree_.leaves_ = HugeArray<WideBvh::Leaf>(end.leaf);
    tree_.corners_ = HugeArray<Vec3>(end.corner);
    std::ranges::copy(top.nodes, tree_.nodes_.begin());
    std::ranges::copy(top.leaves, tree_.leaves_.begin());
    std::ranges::copy(top.corners, tree_.corners_.begin());
    for (std::size_t n = 0; n < top.nodes.size(); ++n)
      for (std::uint32_t& child : tree_.nodes_[n].child)
        if (!WideBvh::is_leaf(child) && child >= WideBvh::kLeafBit - below_.size())
          child = places[WideBvh::kLeafBit - child - 1].node;
    oneapi::tbb::parallel_for(std::size_t{0}, below_.size(), [&](std::size_t i) {
      Piece& piece = below_[i].piece;
      for (WideBvh::Node& node : piece.nodes)
        for (std::uint32_t& child : node.child)
          if (child != WideBvh::kNoChild) child += WideBvh::is_leaf(child) ? places[i].leaf : places[i].node;
      for (WideBvh::Leaf& leaf : piece.leaves) leaf.first_corner += places[i].corner;
      std::ranges::copy(piece.corners, tree_.corners_.begin() + places[i].corner);
      std::ranges::copy(piece.nodes, tree_.nodes_.begin() + places[i].node);
      std::ranges::copy(piece.leaves, tree_.leaves_.begin() + places[i].leaf);
      piece = {};
    });
  }

  WideBvh& tree_;
  const TriangleMesh& mesh_;
  std::vector<Item> items_;
  std::uint32_t least_below_;  ///< parts of more faces are split one after the other
  std::vector<Below> below_;
};

WideBvh::WideBvh(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  if (box.is_empty()) return;
  center_ = box.center();
  const Vec3 half = box.max * 0.5 - box.min * 0.5;
  const double size = std::max({half.x, half.y, half.z});
  // Far from subnormals, of which the powers of 2 do not invert.
  scale_ = size > 0x1p-1000 ? std::ldexp(1, -std::ilogb(size) - 1) : 1;
  std::vector<Item> items;
  items.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) {
    const Box around = box_of(mesh.triangle(f));
    Item& item = items.emplace_back(Item{{}, f});
    for (int axis = 0; axis < 3; ++axis)
      std::tie(item.box.low[axis], item.box.high[axis]) = outwards(axis, around.min[axis], around.max[axis]);
  }
  WideBvhBuilder(*this, mesh, std::move(items));
}

unsigned WideBvh::faces_that_may_overlap(std::uint32_t child, const std::array<float, 3>& low,
                                         const std::array<float, 3>& high) const {
  const Leaf& l = leaf(child);
  constexpr float kGreatest = 65535;
  auto met = Short8{} == Short8{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float from = (low[axis] - l.low[axis]) * l.per_quantum - 2,
                to = (high[axis] - l.low[axis]) * l.per_quantum + 2;
    if (from > kGreatest || to < 0) return 0;
    const auto first = static_cast<std::uint16_t>(std::max(from, 0.0f)),
               last = static_cast<std::uint16_t>(std::min(to, kGreatest));
    const Short8 &a = l.corner[0][axis], &b = l.corner[1][axis], &c = l.corner[2][axis];
    const Short8 ab_least = a < b ? a : b, ab_most = a < b ? b : a;
    met &= ((ab_least < c ? ab_least : c) <= last) & ((ab_most > c ? ab_most : c) >= first);
  }
  unsigned mask = 0;
  for (std::uint32_t i = 0; i < faces_of(child); ++i) mask |= unsigned(met[i] != 0) << i;
  return mask;
}

std::pair<float, float> WideBvh::outwards(int axis, double low, double high) const {
  return {below((low - center_[axis]) * scale_), above((high - center_[axis]) * scale_)};
}

WideShear::WideShear(const WideLine& line) {
  const Vec3 &o = line.origin, &d = line.direction;
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  k = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
  slope_u = -d[i] / d[k], slope_v = -d[j] / d[k];
  u0 = -(o[i] + slope_u * o[k]), v0 = -(o[j] + slope_v * o[k]);
  error = 0x1p-48 * (1 + std::abs(o.x) + std::abs(o.y) + std::abs(o.z));
  // Elsewhere scaling has rounded the direction, or lost it: then nothing is certain.
  if (!(std::abs(d[k]) > 0x1p-900 && std::abs(d[k]) < 0x1p900)) error = std::numeric_limits<double>::infinity();
  origin_k = o[k], direction_k = d[k];
  k_forwards = d[k] > 0;
}

}  // namespace prohull
