#include "prohull/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"

namespace prohull {
namespace {

bool contains(const std::vector<NumberRange>& ranges, std::uint32_t number) {
  return std::ranges::any_of(ranges, [&](const NumberRange& r) { return r.first <= number && number <= r.last; });
}

bool is_about(const Color& a, const PaintedColor& wanted) {
  const auto differ = [](std::uint8_t x, std::uint8_t y) { return static_cast<unsigned>(std::abs(x - y)); };
  return std::max({differ(a.red, wanted.color.red), differ(a.green, wanted.color.green),
                   differ(a.blue, wanted.color.blue)}) <= wanted.spread;
}

/// Whether a face belongs to a region.
class Membership {
 public:
  Membership(const TriangleMesh& mesh, const MeshMarks& marks, const Region& region)
      : mesh_(mesh), marks_(marks), region_(region) {
    if (std::holds_alternative<PaintedColor>(region.faces) && marks.face_colors.empty() && marks.vertex_colors.empty())
      refuse("asks for a colour, but the mesh has none; PLY files have colours of vertices or faces");
    if (std::holds_alternative<NamedGroup>(region.faces) && marks.names_of.empty())
      refuse("asks for a group, but the mesh has none; OBJ files have groups, objects and materials");
    if (const auto* const faces = std::get_if<NumberedFaces>(&region.faces))
      require_numbers(faces->ranges, mesh.face_count(), "face");
    if (const auto* const vertices = std::get_if<NumberedVertices>(&region.faces))
      require_numbers(vertices->ranges, mesh.vertex_count(), "vertex");
  }

  [[noreturn]] void refuse(const std::string& why) const {
    prohull::refuse(fmt::format("region {}: {}", region_.name, why));
  }

  bool has(FaceId f) const {
    return std::visit([&](const auto& wanted) { return is_of(f, wanted); }, region_.faces);
  }

  void require_faces(std::size_t found, std::size_t taken) const {
    if (found > taken) return;
    if (found > 0)
      refuse(
          fmt::format("the regions before it take all of its {}, because a face belongs to the first region that it "
                      "fits: put it before them, or make them smaller",
                      counted(found, "face")));
    if (std::holds_alternative<Box>(region_.faces))
      refuse(
          "no face has all its corners in the box; is the box in the unit of the mesh, which is metres with --unit?");
    if (const auto* const group = std::get_if<NamedGroup>(&region_.faces))
      refuse(fmt::format("no face has the group, object or material {}; the file has {}", group->name, known_names()));
    if (std::holds_alternative<PaintedColor>(region_.faces))
      refuse("no face has that colour; give the colour a greater spread if it is blended or compressed");
    refuse("it has no faces");
  }

 private:
  void require_numbers(const std::vector<NumberRange>& ranges, std::size_t count, std::string_view what) const {
    for (const NumberRange& range : ranges)
      if (range.last >= count)
        refuse(fmt::format("the mesh has no {} {}; its last one is {}", what, range.last, count - 1));
  }

  bool all_corners(FaceId f, auto&& is_wanted) const { return std::ranges::all_of(mesh_.triangles[f], is_wanted); }

  bool is_of(FaceId f, const Box& box) const {
    return all_corners(f, [&](VertexId v) { return box.contains(mesh_.positions[v]); });
  }
  bool is_of(FaceId f, const PaintedColor& wanted) const {
    if (!marks_.face_colors.empty() && is_about(marks_.face_colors[f], wanted)) return true;
    return !marks_.vertex_colors.empty() &&
           all_corners(f, [&](VertexId v) { return is_about(marks_.vertex_colors[v], wanted); });
  }
  bool is_of(FaceId f, const NamedGroup& group) const {
    const std::vector<std::string>& names = marks_.names[marks_.names_of[f]];
    return std::ranges::find(names, group.name) != names.end();
  }
  bool is_of(FaceId f, const NumberedFaces& faces) const { return contains(faces.ranges, index(f)); }
  bool is_of(FaceId f, const NumberedVertices& vertices) const {
    return all_corners(f, [&](VertexId v) { return contains(vertices.ranges, index(v)); });
  }

  std::string known_names() const {
    constexpr std::size_t kMost = 12;
    std::set<std::string> known;
    for (const auto& names : marks_.names) known.insert(names.begin(), names.end());
    if (known.empty()) return "none";
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : known) {
      if (count++ == kMost) return fmt::format("{}, and {} more", text, known.size() - kMost);
      text += (text.empty() ? "" : ", ") + name;
    }
    return text;
  }

  const TriangleMesh& mesh_;
  const MeshMarks& marks_;
  const Region& region_;
};

void check(const Region& region) {
  if (!(region.max_distance >= 0))
    refuse(fmt::format("region {}: the distance is {:g}; it must be at least 0", region.name, region.max_distance));
}

}  // namespace

PerFace<std::uint32_t> regions_of_faces(const TriangleMesh& mesh, const MeshMarks& marks,
                                        const std::vector<Region>& regions) {
  const auto none = static_cast<std::uint32_t>(regions.size());
  PerFace<std::uint32_t> result(mesh.face_count(), none);
  for (std::uint32_t r = 0; r < none; ++r) {
    check(regions[r]);
    const Membership membership(mesh, marks, regions[r]);
    std::size_t found = 0, taken = 0;
    for (const FaceId f : mesh.triangles.ids()) {
      if (!membership.has(f)) continue;
      ++found;
      if (result[f] == none)
        result[f] = r;
      else
        ++taken;
    }
    membership.require_faces(found, taken);
  }
  return result;
}

PerFace<double> tolerances_of(const PerFace<std::uint32_t>& regions_of_faces, const std::vector<Region>& regions) {
  PerFace<double> tolerances(regions_of_faces.size(), std::numeric_limits<double>::infinity());
  for (const FaceId f : tolerances.ids())
    if (const std::uint32_t r = regions_of_faces[f]; r < regions.size()) tolerances[f] = regions[r].max_distance;
  return tolerances;
}

}  // namespace prohull
