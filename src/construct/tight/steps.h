#pragma once

#include <cstddef>

#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// Counts the steps of a change of a mesh; every 64th asks HullOptions::progress whether to go on.
class Steps {
 public:
  Steps(const HalfEdgeMesh& mesh, const HullOptions& options) : mesh_(mesh), options_(options) {}

  bool cancelled() {
    constexpr std::size_t kInterval = 64;
    if (!cancelled_ && options_.progress && ++steps_ % kInterval == 0)
      cancelled_ = !options_.progress({mesh_.face_count(), mesh_.face_id_count(), options_.target_faces});
    return cancelled_;
  }

 private:
  const HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  std::size_t steps_ = 0;
  bool cancelled_ = false;
};

}  // namespace prohull
