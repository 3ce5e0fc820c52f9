#include "engine_rules.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace prohull::cli {
namespace {

// https://nvidia-omniverse.github.io/PhysX/physx/5.6.0/_api_build/classPxConvexMeshDesc.html and
// .../structPxConvexMeshCookingResult.html: 255 polygons. 64 vertices are what older versions take on a GPU.
const EngineRules kPhysx{.vertices = 64, .polygons = 255};
// The same page: on a GPU 64 vertices, 64 polygons, and 32 faces around a vertex. Of 33 vertices, none has more than 32
// neighbours.
const EngineRules kPhysxGpu{.vertices = 33, .polygons = 64};
// https://docs.unity3d.com/6000.1/Documentation/Manual/class-MeshCollider.html: 255 triangles. Of the formats that
// Unity imports by itself, OBJ is the one that is written here.
const EngineRules kUnity{.suffixes = {".obj"}, .polygons = 255};
// Interchange knows collision by names: UCX_NAME_01 is a convex piece of the mesh NAME.
// https://dev.epicgames.com/documentation/unreal-engine/API/Plugins/InterchangePipelines/UInterchangeGenericMeshPipeline
const EngineRules kUnreal{.suffixes = {".glb", ".obj"}, .prefix = "UCX_", .named_as_mesh = true};
// https://docs.godotengine.org/en/stable/tutorials/assets_pipeline/importing_3d_scenes/node_type_customization.html
const EngineRules kGodot{.suffixes = {".glb"}, .suffix = "-convcolonly"};
// Bullet's importer of URDF makes a convex hull of each STL file of a collision element, and of each object of an OBJ
// file.
const EngineRules kBullet{.suffixes = {".urdf", ".obj"}};
// Tests load it: tests/robot/mujoco_test.cpp.
const EngineRules kMujoco{.suffixes = {".xml"}};

std::tuple<double, double, double> numbers(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

Names<const EngineRules*> engine_names() {
  static constexpr std::pair<std::string_view, const EngineRules*> kNames[]{
      {"physx", &kPhysx}, {"physx-gpu", &kPhysxGpu}, {"unity", &kUnity},  {"unreal", &kUnreal},
      {"godot", &kGodot}, {"bullet", &kBullet},      {"mujoco", &kMujoco}};
  return kNames;
}

PieceSize largest_piece(const TriangleMesh& mesh, const std::vector<std::size_t>& faces) {
  PieceSize largest;
  std::size_t first = 0;
  for (const std::size_t count : faces) {
    std::set<std::tuple<double, double, double>> corners;
    for (std::size_t f = first; f < first + count; ++f) {
      const Triangle t = mesh.triangle(static_cast<FaceId>(f));
      corners.insert({numbers(t.a), numbers(t.b), numbers(t.c)});
    }
    largest = {std::max(largest.vertices, corners.size()), std::max(largest.polygons, count)};
    first += count;
  }
  return largest;
}

std::size_t most_vertices(const EngineRules& rules) {
  constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  const std::size_t by_polygons = rules.polygons == 0 ? kAny : (rules.polygons + 4) / 2;  // Euler: 2 v - 4 triangles
  return std::min(rules.vertices == 0 ? kAny : rules.vertices, by_polygons);
}

bool is_within(const PieceSize& size, const EngineRules& rules) {
  const auto is_kept = [](std::size_t number, std::size_t limit) { return limit == 0 || number <= limit; };
  return is_kept(size.vertices, rules.vertices) && is_kept(size.polygons, rules.polygons);
}

}  // namespace prohull::cli
