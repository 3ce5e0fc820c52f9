#include "geometry/bvh.h"
#include "query/engine.h"
#include "query/wide_bvh.h"

namespace prohull {
namespace {

class BvhWorker final : public QueryWorker {
 public:
  explicit BvhWorker(const WideBvh& tree) : tree_(tree) {}

  void collect(const DirectedLine& line, HitCollector& hits) override {
    tree_.visit(
        line, [&] { return hits.limit(); },
        [&](FaceId face) {
          hits.offer(face);
          return !hits.is_complete();
        });
  }

  void collect(const Triangle& triangle, FaceCollector& faces) override {
    tree_.visit(box_of(triangle), [&](FaceId face) {
      faces.offer(face);
      return !faces.is_complete();
    });
  }

 private:
  const WideBvh& tree_;
};

class BvhEngine final : public QueryEngine {
 public:
  explicit BvhEngine(const TriangleMesh& mesh) : tree_(mesh) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<BvhWorker>(tree_); }
  std::size_t memory_bytes() const override { return sizeof(*this) + tree_.memory_bytes(); }

 private:
  WideBvh tree_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_bvh_engine(const TriangleMesh& mesh) { return std::make_unique<BvhEngine>(mesh); }

}  // namespace prohull
