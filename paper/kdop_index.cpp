#include "paper/kdop_index.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "paper/kdop.h"
#include "prohull/detail/refuse.h"
#include "query/engine.h"

namespace prohull {
namespace {

/// A binary tree of k-DOPs with one face in each leaf, built from the top as Klosowski et al. advise: a set of faces is
/// split across the coordinate axis along which their centroids vary most ("splatter"), at the mean of the centroids.
template <int K>
class KDopTree {
 public:
  struct Node {
    bool is_leaf() const { return left == 0; }

    KDop<K> kdop;
    std::uint32_t left;  ///< child, followed by the right one; 0 in a leaf
    FaceId face;         ///< of a leaf
  };

  explicit KDopTree(const TriangleMesh& mesh) : box_(bounding_box(mesh)), frame_(box_) {
    if (mesh.face_count() == 0) return;
    std::vector<Item> items;
    items.reserve(mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      items.push_back({(frame_(t.a) + frame_(t.b) + frame_(t.c)) / 3, f});
    }
    nodes_.reserve(2 * mesh.face_count() - 1);
    nodes_.emplace_back();
    build(mesh, 0, items, 0);
  }

  bool empty() const { return nodes_.empty(); }
  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
  const Box& box() const { return box_; }
  const KDopFrame& frame() const { return frame_; }
  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node); }

  static constexpr std::uint32_t kMaxDepth = 96;

 private:
  /// Splits at the mean may leave a single face on one side; further down sets are halved, so that the depth is bounded
  /// for all of 2^32 faces.
  static constexpr std::uint32_t kDepthOfMeans = 64;

  struct Item {
    Vec3 centroid;
    FaceId face;
  };

  void build(const TriangleMesh& mesh, std::uint32_t node, std::span<Item> items, std::uint32_t depth) {
    if (items.size() == 1) {
      nodes_[node] = {kdop_of<K>(frame_, mesh.triangle(items[0].face)), 0, items[0].face};
      return;
    }
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    const std::size_t middle = split(items, depth);
    build(mesh, left, items.first(middle), depth + 1);
    build(mesh, left + 1, items.subspan(middle), depth + 1);
    nodes_[node] = {nodes_[left].kdop, left, FaceId{}};
    nodes_[node].kdop.extend(nodes_[left + 1].kdop);
  }

  /// Orders the items, so that those of the left child come first; returns how many these are.
  static std::size_t split(std::span<Item> items, std::uint32_t depth) {
    const double count = static_cast<double>(items.size());
    Vec3 mean, variance;
    for (const Item& item : items) mean += item.centroid / count;
    for (const Item& item : items) {
      const Vec3 d = item.centroid - mean;
      variance += Vec3{d.x * d.x, d.y * d.y, d.z * d.z};
    }
    const int axis = variance.x >= variance.y && variance.x >= variance.z ? 0 : variance.y >= variance.z ? 1 : 2;
    const auto value = [axis](const Item& item) { return item.centroid[axis]; };
    const auto right = std::partition(items.begin(), items.end(), [&](const Item& i) { return value(i) < mean[axis]; });
    if (right != items.begin() && right != items.end() && depth < kDepthOfMeans)
      return static_cast<std::size_t>(right - items.begin());
    const std::size_t half = items.size() / 2;
    std::nth_element(
        items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
        [&](const Item& i, const Item& j) { return value(i) != value(j) ? value(i) < value(j) : i.face < j.face; });
    return half;
  }

  Box box_;
  KDopFrame frame_;
  std::vector<Node> nodes_;
};

/// Offers every face of which the k-DOP, and those above it in the tree, overlap the query's.
template <int K, class Collector>
void collect_overlapping(const KDopTree<K>& tree, const KDop<K>& query, Collector& faces) {
  if (tree.empty() || !query.overlaps(tree[0].kdop)) return;
  std::uint32_t stack[KDopTree<K>::kMaxDepth], waiting = 0;
  for (std::uint32_t n = 0;;) {
    const auto& node = tree[n];
    if (node.is_leaf()) {
      faces.offer(node.face);
      if (faces.is_complete()) return;
    } else {
      const bool in_left = query.overlaps(tree[node.left].kdop), in_right = query.overlaps(tree[node.left + 1].kdop);
      if (in_left && in_right) stack[waiting++] = node.left + 1;
      if (in_left || in_right) {
        n = in_left ? node.left : node.left + 1;
        continue;
      }
    }
    if (waiting == 0) return;
    n = stack[--waiting];
  }
}

/// Offers the faces of which the k-DOPs are met by the line, the nearer child first, up to the limit of `hits`.
template <int K>
void collect_along(const KDopTree<K>& tree, const KDopLine<K>& line, HitCollector& hits) {
  struct Waiting {
    std::uint32_t node;
    double from;
  };
  Waiting stack[KDopTree<K>::kMaxDepth];
  std::uint32_t waiting = 0;
  if (line.through(tree[0].kdop, hits.limit()).is_empty()) return;
  for (std::uint32_t n = 0;;) {
    const auto& node = tree[n];
    if (node.is_leaf()) {
      hits.offer(node.face);
      if (hits.is_complete()) return;
    } else {
      const Passage left = line.through(tree[node.left].kdop, hits.limit());
      const Passage right = line.through(tree[node.left + 1].kdop, hits.limit());
      const bool left_first = right.is_empty() || (!left.is_empty() && left.from <= right.from);
      if (!left.is_empty() && !right.is_empty())
        stack[waiting++] = left_first ? Waiting{node.left + 1, right.from} : Waiting{node.left, left.from};
      if (!left.is_empty() || !right.is_empty()) {
        n = left_first ? node.left : node.left + 1;
        continue;
      }
    }
    do {
      if (waiting == 0) return;
      n = stack[--waiting].node;
    } while (stack[waiting].from > BoxLine::widened(hits.limit()));
  }
}

enum class LineTest { Clip, Overlap };

template <int K, LineTest kTest>
class KDopWorker final : public QueryWorker {
 public:
  explicit KDopWorker(const KDopTree<K>& tree) : tree_(tree) {}

  void collect(const DirectedLine& line, HitCollector& hits) override {
    if (tree_.empty()) return;
    const Passage within = passage(BoxLine(line), tree_.box(), line.t_end);
    if (within.is_empty()) return;
    const LineProjections<K> seen(tree_.frame(), line, std::min(within.to, line.t_end));
    if constexpr (kTest == LineTest::Clip)
      collect_along(tree_, KDopLine<K>(seen), hits);
    else
      collect_overlapping(tree_, kdop_of(seen), hits);
  }

  void collect(const Triangle& triangle, FaceCollector& faces) override {
    collect_overlapping(tree_, kdop_of<K>(tree_.frame(), triangle), faces);
  }

 private:
  const KDopTree<K>& tree_;
};

template <int K, LineTest kTest>
class KDopEngine final : public QueryEngine {
 public:
  explicit KDopEngine(const TriangleMesh& mesh) : tree_(mesh) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<KDopWorker<K, kTest>>(tree_); }
  std::size_t memory_bytes() const override { return sizeof(*this) + tree_.memory_bytes(); }

 private:
  KDopTree<K> tree_;
};

constexpr std::array<std::string_view, 8> kNames{"kdop6",         "kdop14",         "kdop18",         "kdop26",
                                                 "kdop6-overlap", "kdop14-overlap", "kdop18-overlap", "kdop26-overlap"};

template <int K, LineTest kTest>
std::unique_ptr<QueryEngine> make_engine(const TriangleMesh& mesh) {
  return std::make_unique<KDopEngine<K, kTest>>(mesh);
}

constexpr std::array<std::unique_ptr<QueryEngine> (*)(const TriangleMesh&), kNames.size()> kMakers{
    make_engine<6, LineTest::Clip>,     make_engine<14, LineTest::Clip>,    make_engine<18, LineTest::Clip>,
    make_engine<26, LineTest::Clip>,    make_engine<6, LineTest::Overlap>,  make_engine<14, LineTest::Overlap>,
    make_engine<18, LineTest::Overlap>, make_engine<26, LineTest::Overlap>,
};

}  // namespace

std::span<const std::string_view> kdop_names() { return kNames; }

QueryIndex kdop_index(TriangleMesh mesh, std::string_view name) {
  const auto place = static_cast<std::size_t>(std::ranges::find(kNames, name) - kNames.begin());
  if (place == kNames.size())
    refuse(fmt::format("there are no k-DOP trees {}; expected one of {}", name, fmt::join(kNames, ", ")));
  return peer_index(std::move(mesh), kNames[place], kMakers[place]);
}

}  // namespace prohull
