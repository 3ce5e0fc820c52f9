#include "query/wide_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "geometry/bvh.h"

namespace prohull {
namespace {

constexpr std::uint32_t kLeafFaces = 4;
constexpr int kBins = 16;
constexpr int kDepthOfBins = 60;  // below, ranges are halved, so that the depth is bounded whatever the mesh

/// Floats below and above a value that was rounded to double: its nearest float, moved by at least one of its ulps.
float below(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest - (std::abs(nearest) * 0x1p-23f + 0x1p-126f);
}
float above(double x) { return -below(-x); }

struct FloatBox {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  void extend(const FloatBox& other) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
  float middle(int axis) const { return 0.5f * (low[axis] + high[axis]); }
  float half_area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }

  std::array<float, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
};

/// A face with its box, moved about together while ranges are split.
struct Item {
  FloatBox box;
  FaceId face;
};

struct Range {
  std::uint32_t begin, end;
  FloatBox box;
  std::uint32_t size() const { return end - begin; }
};

Range range_of(const std::vector<Item>& items, std::uint32_t begin, std::uint32_t end) {
  Range range{begin, end, {}};
  for (std::uint32_t i = begin; i < end; ++i) range.box.extend(items[i].box);
  return range;
}

struct Bin {
  FloatBox box;
  std::uint32_t count = 0;
};

/// The plane between two bins, of those along one axis, with the least surface-area cost.
struct Plane {
  float cost = std::numeric_limits<float>::infinity();
  int axis = -1, bin = 0;
};

class Bins {
 public:
  Bins(const std::vector<Item>& items, const Range& range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const float middle = items[i].box.middle(axis);
        low_[axis] = std::min(low_[axis], middle), high_[axis] = std::max(high_[axis], middle);
      }
    for (int axis = 0; axis < 3; ++axis)
      per_length_[axis] = high_[axis] > low_[axis] ? kBins * (1 - 0x1p-20f) / (high_[axis] - low_[axis]) : 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins_[axis][bin_of(items[i], axis)];
        bin.box.extend(items[i].box);
        ++bin.count;
      }
  }

  int bin_of(const Item& item, int axis) const {
    const float place = (item.box.middle(axis) - low_[axis]) * per_length_[axis];
    return place < kBins - 1 ? static_cast<int>(place) : kBins - 1;
  }

  Plane best() const {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(per_length_[axis] > 0)) continue;
      std::array<float, kBins> cost_above{};  // of the bins from i on
      FloatBox box;
      std::uint32_t count = 0;
      for (int i = kBins - 1; i > 0; --i) {
        box.extend(bins_[axis][i].box);
        count += bins_[axis][i].count;
        cost_above[i] = count == 0 ? 0 : box.half_area() * static_cast<float>(count);
      }
      const std::uint32_t all = count + bins_[axis][0].count;
      box = {}, count = 0;
      for (int i = 1; i < kBins; ++i) {
        box.extend(bins_[axis][i - 1].box);
        count += bins_[axis][i - 1].count;
        if (count == 0 || count == all) continue;
        const float cost = box.half_area() * static_cast<float>(count) + cost_above[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

 private:
  std::array<float, 3> low_ = FloatBox{}.low, high_ = FloatBox{}.high, per_length_;
  std::array<std::array<Bin, kBins>, 3> bins_{};
};

}  // namespace

class WideBvhBuilder {
 public:
  WideBvhBuilder(WideBvh& tree, std::vector<Item> items) : tree_(tree), items_(std::move(items)) {
    tree_.nodes_.reserve(items_.size() / 3 + 1);
    build(range_of(items_, 0, static_cast<std::uint32_t>(items_.size())), 0);
    tree_.faces_.reserve(items_.size());
    for (const Item& item : items_) tree_.faces_.push_back(item.face);
  }

 private:
  std::uint32_t build(const Range& whole, int depth) {
    const auto self = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    std::vector<Range> children{whole};
    while (children.size() < WideBvh::kWidth) {
      const auto biggest = std::ranges::max_element(
          children, {}, [](const Range& r) { return r.size() > kLeafFaces ? r.box.half_area() : -1.0f; });
      if (biggest->size() <= kLeafFaces) break;
      const auto [left, right] = split(*biggest, depth);
      *biggest = left;
      children.push_back(right);
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Range& child = children[i];
      const bool is_leaf = child.size() <= kLeafFaces;
      const std::uint32_t first = is_leaf ? child.begin : build(child, depth + 1);
      WideBvh::Node& node = tree_.nodes_[self];
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][i] = child.box.low[axis];
        node.high[axis][i] = child.box.high[axis];
      }
      node.first[i] = first;
      node.faces[i] = is_leaf ? static_cast<std::uint8_t>(child.size()) : std::uint8_t{0};
      node.children = static_cast<std::uint8_t>(i + 1);
    }
    return self;
  }

  std::pair<Range, Range> split(const Range& range, int depth) {
    const Bins bins(items_, range);
    const Plane plane = depth < kDepthOfBins ? bins.best() : Plane{};
    const auto begin = items_.begin() + range.begin, end = items_.begin() + range.end;
    auto middle = begin + range.size() / 2;
    if (plane.axis >= 0)
      middle = std::partition(begin, end, [&](const Item& item) { return bins.bin_of(item, plane.axis) < plane.bin; });
    const auto at = static_cast<std::uint32_t>(middle - items_.begin());
    return {range_of(items_, range.begin, at), range_of(items_, at, range.end)};
  }

  WideBvh& tree_;
  std::vector<Item> items_;
};

WideBvh::WideBvh(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  if (box.is_empty()) return;
  center_ = box.center();
  const Vec3 half = box.max * 0.5 - box.min * 0.5;
  const double size = std::max({half.x, half.y, half.z});
  // Far from subnormals, of which the powers of 2 do not invert.
  scale_ = size > 0x1p-1000 ? std::ldexp(1, -std::ilogb(size)) : 1;
  std::vector<Item> items;
  items.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) {
    const Box around = box_of(mesh.triangle(f));
    Item& item = items.emplace_back(Item{{}, f});
    for (int axis = 0; axis < 3; ++axis)
      std::tie(item.box.low[axis], item.box.high[axis]) = outwards(axis, around.min[axis], around.max[axis]);
  }
  WideBvhBuilder(*this, std::move(items));
}

std::pair<float, float> WideBvh::outwards(int axis, double low, double high) const {
  return {below((low - center_[axis]) * scale_), above((high - center_[axis]) * scale_)};
}

WideLine WideBvh::seen(const DirectedLine& line) const {
  WideLine seen;
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = line.direction[axis] * scale_;
    const auto [down, up] = outwards(axis, line.origin[axis], line.origin[axis]);
    const bool is_usable =
        (line.direction[axis] == 0 || (std::abs(direction) > 0x1p-60 && std::abs(direction) < 0x1p60)) &&
        std::isfinite(down) && std::isfinite(up);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const bool backwards = direction < 0;
    seen.backwards[axis] = backwards;
    seen.near_origin[axis] = !is_usable ? kNaN : backwards ? down : up;
    seen.far_origin[axis] = !is_usable ? kNaN : backwards ? up : down;
    seen.inverse[axis] = direction == 0 ? std::numeric_limits<float>::infinity() : static_cast<float>(1 / direction);
  }
  return seen;
}

}  // namespace prohull
