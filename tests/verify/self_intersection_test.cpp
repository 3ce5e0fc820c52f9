#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <random>

#include "meshes.h"
#include "prohull/enclosure.h"

namespace prohull {
namespace {

std::size_t counted_by_cgal(const TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  std::vector<CGAL::SM_Vertex_index> vertices;
  for (const Vec3& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (const auto& [a, b, c] : mesh.triangles)
    surface.add_face(vertices[index(a)], vertices[index(b)], vertices[index(c)]);
  std::vector<std::pair<CGAL::SM_Face_index, CGAL::SM_Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}

TEST(SelfIntersections, AreCountedAsByCgal) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  for (const double noise : {0.0, 0.01, 0.05, 0.1, 0.3}) {
    std::uniform_real_distribution<double> jitter(-noise, noise);
    for (TriangleMesh mesh : {meshes::torus(30, 12), meshes::sphere(3), meshes::subdivided(meshes::octahedron())}) {
      for (Vec3& p : mesh.positions) p += {jitter(random), jitter(random), jitter(random)};
      EXPECT_EQ(verify_enclosure(mesh, mesh).self_intersections, counted_by_cgal(mesh)) << "noise " << noise;
    }
  }
}

}  // namespace
}  // namespace prohull
