#include "geometry/bvh.h"
#include "query/engine.h"
#include "query/wide_trace.h"

namespace prohull {
namespace {

class BvhWorker final : public QueryWorker {
 public:
  explicit BvhWorker(const WideBvh& tree) : tree_(tree), trace_(wide_traces().back()) {}

  void collect(const DirectedLine& line, HitCollector& hits) override {
    if (!tree_.is_empty()) trace_.trace(tree_, line, hits);
  }

  void all_hits(const TriangleMesh& mesh, const DirectedLine& line, std::vector<Hit>& hits) override {
    HitCollector found(mesh, line, HitMode::All, std::move(scratch_));
    collect(line, found);
    found.append_all(hits);
    scratch_ = std::move(found).storage();
  }

  std::size_t memory_bytes() const override {
    return sizeof(*this) + scratch_.capacity() * sizeof(HitCollector::Storage::value_type);
  }

  void collect(const Triangle& triangle, FaceCollector& faces) override {
    tree_.visit(box_of(triangle), [&](FaceId face, const Triangle&) {
      faces.offer(face);
      return !faces.is_complete();
    });
  }

  void collect(ClosestCollector& closest) override {
    if (!tree_.is_empty()) trace_.trace_nearest(tree_, closest);
  }

 private:
  const WideBvh& tree_;
  HitCollector::Storage scratch_;
  const WideTrace& trace_;
};

class BvhEngine final : public QueryEngine {
 public:
  explicit BvhEngine(const TriangleMesh& mesh) : tree_(mesh) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<BvhWorker>(tree_); }
  std::size_t memory_bytes() const override { return sizeof(*this) + tree_.memory_bytes(); }
  bool gains_from_order() const override { return tree_.memory_bytes() > kCache; }

 private:
  static constexpr std::size_t kCache = std::size_t{1} << 22;  ///< trees of this size stay in the cache of a core
  WideBvh tree_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_bvh_engine(const TriangleMesh& mesh) { return std::make_unique<BvhEngine>(mesh); }

}  // namespace prohull
