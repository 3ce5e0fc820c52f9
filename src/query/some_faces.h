#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "query/engine.h"

namespace prohull {

/// Some faces of a mesh, most often none, that are to be tested apart.
class SomeFaces {
 public:
  /// `faces`: ascending.
  SomeFaces(const TriangleMesh& mesh, std::vector<FaceId> faces)
      : faces_(std::move(faces)), part_(part_of(mesh, faces_)), tree_(make_bvh_engine(part_)) {}

  bool empty() const { return faces_.empty(); }
  bool has(FaceId face) const { return !empty() && std::ranges::binary_search(faces_, face); }
  std::size_t memory_bytes() const {
    return faces_.size() * sizeof(FaceId) + part_.positions.size() * sizeof(Vec3) +
           part_.face_count() * sizeof(part_.triangles[FaceId{}]) + tree_->memory_bytes();
  }

  /// Of one thread.
  class Asker {
   public:
    explicit Asker(const SomeFaces& some) : some_(some), worker_(some.tree_->worker()) {}

    /// Offers those that the line crosses.
    void collect(const DirectedLine& line, HitCollector& hits) {
      if (some_.empty()) return;
      hits_.clear();
      worker_->all_hits(some_.part_, line, hits_);
      for (const Hit& hit : hits_) hits.offer(some_.faces_[index(hit.face)]);
    }
    bool crosses(const DirectedLine& line) { return !some_.empty() && worker_->crosses(some_.part_, line); }

   private:
    const SomeFaces& some_;
    std::unique_ptr<QueryWorker> worker_;
    std::vector<Hit> hits_;
  };

 private:
  static TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<FaceId>& faces) {
    TriangleMesh part;
    for (const FaceId f : faces) {
      const auto [a, b, c] = mesh.triangle(f);
      part.triangles.push_back({part.positions.push_back(a), part.positions.push_back(b), part.positions.push_back(c)});
    }
    return part;
  }

  std::vector<FaceId> faces_;
  TriangleMesh part_;
  std::unique_ptr<QueryEngine> tree_;
};

}  // namespace prohull
