#include "geometry/bvh.h"
#include "query/box_line.h"
#include "query/engine.h"

namespace prohull {
namespace {

class BvhWorker final : public QueryWorker {
 public:
  explicit BvhWorker(const Bvh& tree) : tree_(tree) {}

  void collect(const DirectedLine& line, HitCollector& hits) override {
    const BoxLine box_line(line);
    tree_.visit([&](const Box& box) { return !hits.is_complete() && may_meet(box_line, box, hits.limit()); },
                [&](std::uint32_t face) { hits.offer(FaceId(face)); });
  }

  void collect(const Triangle& triangle, FaceCollector& faces) override {
    const Box around = box_of(triangle);
    tree_.visit([&](const Box& box) { return !faces.is_complete() && around.overlaps(box); },
                [&](std::uint32_t face) { faces.offer(FaceId(face)); });
  }

 private:
  const Bvh& tree_;
};

class BvhEngine final : public QueryEngine {
 public:
  explicit BvhEngine(const TriangleMesh& mesh) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) boxes.push_back(box_of(mesh.triangle(f)));
    tree_ = Bvh(boxes);
  }
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<BvhWorker>(tree_); }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  Bvh tree_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_bvh_engine(const TriangleMesh& mesh) { return std::make_unique<BvhEngine>(mesh); }

}  // namespace prohull
