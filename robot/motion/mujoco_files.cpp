#include "robot/motion/mujoco_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "prohull/detail/finite.h"
#include "prohull/detail/refuse.h"
#include "prohull/mesh_io.h"
#include "robot/files/mjcf_robot.h"
#include "robot/hulls/file_names.h"
#include "robot/link_triangles.h"
#include "robot/motion/joint_paths.h"

namespace prohull::robot {
namespace {

using std::filesystem::path;

/// Whether all corners lie in a plane, but for the rounding of float32.
bool is_flat(const TriangleMesh& mesh) {
  const auto normal = [&](FaceId face) {
    const Triangle t = mesh.triangle(face);
    return cross(t.b - t.a, t.c - t.a);
  };
  FaceId largest{};
  for (std::size_t i = 0; i < mesh.face_count(); ++i)
    if (norm(normal(FaceId(i))) > norm(normal(largest))) largest = FaceId(i);
  const Vec3 n = normal(largest), origin = mesh.triangle(largest).a;
  const Box box = bounding_box(mesh);
  const double most = 1e-6 * norm(n) * norm(box.max - box.min);
  return std::ranges::none_of(mesh.positions, [&](const Vec3& p) { return std::abs(dot(n, p - origin)) > most; });
}

/// MuJoCo refuses volumes of less than 1e-15.
bool is_tiny(const TriangleMesh& mesh) {
  constexpr double kLeast = 1e-14;
  const Box box = bounding_box(mesh);
  const Vec3 size = box.max - box.min;
  return size.x * size.y * size.z < kLeast;
}

/// Whether MuJoCo reads an STL file of the mesh, and that keeps its coordinates.
bool fits_stl(const TriangleMesh& mesh) { return mesh.face_count() <= kMostMujocoStlFaces && keeps_float32(mesh); }

/// Files of the meshes that a robot names, other than its hulls.
class MujocoMeshes {
 public:
  explicit MujocoMeshes(const RobotFiles& written) {
    for (const HullFiles& hull : written.hulls)
      for (const path& mesh : hull.meshes) hulls_.insert(mesh.generic_string());
  }

  std::string name_of(const MeshFile& mesh) {
    if (mesh.path.empty() && hulls_.contains(mesh.uri)) return mesh.uri;
    const Vec3& scale = mesh.scale;
    std::string& name = names_[{mesh.path, {scale.x, scale.y, scale.z}}];
    if (name.empty()) name = add(mesh);
    return name;
  }

  std::vector<OutputFile> files;

 private:
  std::string add(const MeshFile& mesh) {
    const auto triangles = std::make_shared<TriangleMesh>(finite_part(mesh_triangles(mesh)));
    if (is_flat(*triangles) || is_tiny(*triangles))
      refuse(mesh.path.string() + ": it is flat, or too small for MuJoCo");
    const std::string name = file_names_.of(mesh.path.stem().string());
    const path file = path("meshes/visual") / (name + (fits_stl(*triangles) ? ".stl" : ".obj"));
    files.push_back({file, [triangles](const path& target) { write_mesh(target, *triangles); }});
    return file.generic_string();
  }

  std::set<std::string> hulls_;
  std::map<std::pair<path, std::array<double, 3>>, std::string> names_;
  FileNames file_names_;
};

/// With the suffix that MuJoCo's files have, unless the URDF file has it.
path mjcf_name(const path& urdf) { return path(urdf).replace_extension(urdf.extension() == ".xml" ? ".mjcf" : ".xml"); }

}  // namespace

std::vector<LinkPair> adjacent_pairs(const Robot& robot) {
  const JointPaths paths(robot);
  const auto has_geometry = [&](std::size_t i) {
    return !robot.links[i].visual.empty() || !robot.links[i].collision.empty();
  };
  std::vector<LinkPair> pairs;
  for (std::size_t a = 0; a < robot.links.size(); ++a)
    for (std::size_t b = a + 1; b < robot.links.size(); ++b)
      if (has_geometry(a) && has_geometry(b) && paths.are_adjacent(a, b)) pairs.emplace_back(a, b);
  return pairs;
}

MujocoFiles mujoco_files(const RobotFile& file, const RobotFiles& written, std::span<const LinkPair> apart) {
  MujocoMeshes meshes(written);
  MujocoFiles result;
  for (const auto& [name, robot] : written.robots) {
    MjcfRobot mjcf = mjcf_of(file, robot, apart, [&](const MeshFile& mesh) { return meshes.name_of(mesh); });
    result.files.push_back(text_file(mjcf_name(name), std::move(mjcf.text)));
    result.notes = std::move(mjcf.notes);
  }
  std::ranges::move(meshes.files, std::back_inserter(result.files));
  return result;
}

}  // namespace prohull::robot
