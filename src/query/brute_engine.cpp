#include "geometry/bvh.h"
#include "query/engine.h"

namespace prohull {
namespace {

class BruteWorker final : public QueryWorker {
 public:
  explicit BruteWorker(const TriangleMesh& mesh) : mesh_(mesh) {}

  void collect(const DirectedLine& /*line*/, HitCollector& hits) override {
    for (const FaceId f : mesh_.triangles.ids()) {
      hits.offer(f);
      if (hits.is_complete()) return;
    }
  }

  void collect(const Triangle& triangle, FaceCollector& faces) override {
    const Box box = box_of(triangle);
    for (const FaceId f : mesh_.triangles.ids()) {
      if (!box.overlaps(box_of(mesh_.triangle(f)))) continue;
      faces.offer(f);
      if (faces.is_complete()) return;
    }
  }

 private:
  const TriangleMesh& mesh_;
};

class BruteEngine final : public QueryEngine {
 public:
  explicit BruteEngine(const TriangleMesh& mesh) : mesh_(mesh) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<BruteWorker>(mesh_); }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  const TriangleMesh& mesh_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_brute_engine(const TriangleMesh& mesh) { return std::make_unique<BruteEngine>(mesh); }

}  // namespace prohull
