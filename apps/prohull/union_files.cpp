#include "union_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "command.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/error.h"
#include "robot/files/link_pieces.h"
#include "robot/files/sphere_file.h"

namespace prohull::cli {
namespace {

using std::filesystem::path;

/// The parts of a mesh whose faces are connected by shared vertices, in the order of their first faces.
std::vector<TriangleMesh> components(const TriangleMesh& mesh) {
  DisjointSets connected(mesh.vertex_count());
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) connected.join(index(corners[0]), index(v));
  std::vector<TriangleMesh> parts;
  std::map<std::uint32_t, std::size_t> part_of;
  PerVertex<VertexId> place(mesh.vertex_count(), VertexId(0));
  PerVertex<char> is_placed(mesh.vertex_count(), 0);
  for (const auto& corners : mesh.triangles) {
    const auto [entry, is_new] = part_of.try_emplace(connected.find(index(corners[0])), parts.size());
    if (is_new) parts.emplace_back();
    TriangleMesh& part = parts[entry->second];
    auto moved = corners;
    for (VertexId& v : moved) {
      if (is_placed[v] == 0) place[v] = part.positions.push_back(mesh.positions[v]), is_placed[v] = 1;
      v = place[v];
    }
    part.triangles.push_back(moved);
  }
  return parts;
}

/// The link that is asked for, or the only one.
template <class Link, class Name>
const Link& picked(const std::vector<Link>& links, Name name, const std::string& link, const path& file) {
  if (link.empty() && links.size() == 1) return links[0];
  const auto found = std::ranges::find(links, link, name);
  if (found != links.end()) return *found;
  if (links.empty()) throw InputError(Defect::EmptyMesh, fmt::format("{}: no link has any pieces", input_name(file)));
  std::vector<std::string> names;
  for (const Link& each : links) names.push_back(each.*name);
  const std::string which = link.empty() ? "pieces of which link?" : fmt::format("no link '{}' has pieces;", link);
  refuse(fmt::format("{}: {} it has {}; say --link NAME", input_name(file), which, fmt::join(names, ", ")));
}

/// Reads one file after the other.
class UnionReader {
 public:
  UnionReader(const InputOptions& input, const std::string& link) : input_(input), link_(link) {}

  void read(const path& file) {
    if (is_robot_file(file))
      add_robot(file);
    else if (is_sphere_file(file))
      add_spheres(file, robot::read_sphere_file(read_bytes(file), file));
    else if (file.extension() == ".json")
      add_spheres(file, {robot::read_sphere_json(read_bytes(file), file)});
    else
      add_components(read_input(file, input_));
  }

  Union result() {
    if (!link_.empty() && !has_picked_) refuse("--link picks a link of a robot or of a file of spheres; none is given");
    if (all_.balls.empty() && all_.pieces.empty())
      throw InputError(Defect::EmptyMesh, "the files hold neither pieces nor spheres");
    if (!all_.balls.empty() && !all_.pieces.empty())
      refuse("these are both spheres and meshes: verify a union of spheres, or one of meshes");
    return std::move(all_);
  }

 private:
  void add_components(const TriangleMesh& mesh) {
    for (TriangleMesh& piece : components(mesh)) all_.pieces.push_back(std::move(piece));
  }

  void add_robot(const path& path) {
    robot::RobotFile file = robot::read_robot(path);
    std::vector<robot::Link>& links = file.robot.links;
    std::erase_if(links, [](const robot::Link& link) { return link.collision.empty(); });
    const robot::LinkPieces pieces = link_pieces(file, picked(links, &robot::Link::name, link_, path));
    has_picked_ = true;
    for (const TriangleMesh& mesh : pieces.meshes) add_components(mesh);
    all_.balls.insert(all_.balls.end(), pieces.balls.begin(), pieces.balls.end());
    for (const auto& notes : {file.notes, pieces.notes})
      all_.notes.insert(all_.notes.end(), notes.begin(), notes.end());
  }

  void add_spheres(const path& path, const std::vector<robot::LinkBalls>& links) {
    const robot::LinkBalls& link = picked(links, &robot::LinkBalls::link, link_, path);
    has_picked_ = true;
    all_.balls.insert(all_.balls.end(), link.balls.begin(), link.balls.end());
    if (link.switched_off > 0)
      all_.notes.push_back(fmt::format("{}: {} of a radius of 0 or less left out: cuRobo switches such spheres off",
                                       input_name(path), counted(link.switched_off, "sphere")));
  }

  const InputOptions& input_;
  const std::string& link_;
  Union all_;
  bool has_picked_ = false;
};

}  // namespace

std::string Union::description() const {
  return balls.empty() ? counted(pieces.size(), "piece") : counted(balls.size(), "sphere");
}

Union read_union(const std::vector<path>& files, const InputOptions& input, const std::string& link) {
  UnionReader reader(input, link);
  for (const path& file : files) {
    reader.read(file);
    stop_if_interrupted();
  }
  return reader.result();
}

}  // namespace prohull::cli
