// Rays against a mesh: the index is shared, a query object belongs to one thread.
#include <prohull/mesh_query.h>
#include <prohull/sample.h>

#include <cstdio>

int main() {
  const prohull::TriangleMesh torus = prohull::make_sample("torus", 20000);
  const prohull::Ray ray{.origin = {-9, 0, 0.01}, .direction = {1, 0, 0}};

  // docs: queries
  const prohull::QueryIndex index(torus);
  prohull::MeshQuery query(index);
  if (const auto hit = query.first_hit(ray))
    std::printf("face %u at x = %.3f\n", static_cast<unsigned>(hit->face), hit->position.x);
  for (const prohull::Hit& hit : query.all_hits(ray))
    std::printf("%s at %.3f lengths of the direction\n", hit.entering ? "in " : "out", hit.t);
  // docs: end

  return query.all_hits(ray).size() == 4 ? 0 : 1;
}
