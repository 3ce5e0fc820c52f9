#include "verify/original.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/largest_coordinate.h"
#include "geometry/triangle_key.h"
#include "mesh/closed.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "verify/surface.h"

namespace prohull::verify {
namespace {

std::size_t drop_non_finite_faces(TriangleMesh& mesh) {
  const std::size_t before = mesh.face_count();
  PerFace<std::array<VertexId, 3>> finite;
  finite.reserve(before);
  for (const auto& corners : mesh.triangles)
    if (std::ranges::all_of(corners, [&](VertexId v) { return is_finite(mesh.positions[v]); }))
      finite.push_back(corners);
  mesh.triangles = std::move(finite);
  return before - mesh.face_count();
}

}  // namespace

Box usable_box(const TriangleMesh& mesh, std::string_view name) {
  require_usable(mesh, name);
  const Box box = bounding_box(mesh);
  require_usable_reach(box, fmt::format("coordinates of the {}", name));
  return box;
}

PreparedOriginal prepare_original(TriangleMesh& mesh, std::vector<std::string>& notes) {
  PreparedOriginal result;
  result.non_finite_faces = drop_non_finite_faces(mesh);
  if (const std::size_t dropped = result.non_finite_faces)
    notes.push_back(fmt::format("{} of the original {} not finite and {} left out", counted(dropped, "face"),
                                dropped == 1 ? "is" : "are", dropped == 1 ? "is" : "are"));
  result.box = usable_box(mesh, "original");
  const bool is_sheet = is_one_sheet(mesh);
  result.closed = is_sheet || is_closed(mesh);
  result.outward_sheet = is_sheet && volume_sign(mesh) > 0;
  if (!result.closed || result.outward_sheet) return result;
  const Turned turned = turn_outwards(mesh, "original");
  result.turned_faces = turned.faces;
  result.outward_sheet = is_sheet && turned.faces > 0;
  if (turned.inwards < turned.faces)
    notes.push_back(
        fmt::format("{} of the original count as turned, as its volume is negative: {} of these look inwards",
                    counted(turned.faces, "face"), grouped(turned.inwards)));
  else if (turned.faces > 0)
    notes.push_back(fmt::format("{} of the original {} inwards and {} as turned", counted(turned.faces, "face"),
                                turned.faces == 1 ? "looks" : "look", turned.faces == 1 ? "counts" : "count"));
  return result;
}

StandIn stand_in(const TriangleMesh& closed, const TriangleMesh& original) {
  require_closed(closed, "closed");
  StandIn result{.mesh = closed};
  turn_outwards(result.mesh, "closed");
  std::vector<std::pair<TriangleKey, FaceId>> known;
  known.reserve(original.face_count());
  for (const FaceId f : original.triangles.ids()) known.emplace_back(unoriented_key(original.triangle(f)), f);
  std::ranges::sort(known);
  std::vector<bool> stands(original.face_count());
  for (const FaceId f : result.mesh.triangles.ids()) {
    const TriangleKey corners = unoriented_key(result.mesh.triangle(f));
    const auto first = std::lower_bound(known.begin(), known.end(), corners,
                                        [](const auto& entry, const auto& other) { return entry.first < other; });
    auto last = first;
    for (; last != known.end() && last->first == corners; ++last) stands[index(last->second)] = true;
    result.number.push_back(first != last ? first->second
                                          : FaceId(static_cast<std::uint32_t>(original.face_count() + result.caps++)));
  }
  for (const FaceId f : original.triangles.ids())
    if (!stands[index(f)]) result.rest.push_back(f);
  return result;
}

Original::Original(const TriangleMesh& given, const TriangleMesh* closed)
    : given_(given),
      changed_(given),
      facts_(prepare_original(*changed_, notes_)),
      stand_in_(closed && !facts_.closed ? std::optional(verify::stand_in(*closed, *changed_)) : std::nullopt),
      solid_(stand_in_      ? stand_in_->mesh
             : is_changed() ? *changed_
                            : given_,
             "original", stand_in_ ? std::nullopt : std::optional(facts_.outward_sheet)) {
  if (!facts_.closed) notes_.emplace_back(stand_in_ ? "the original is not closed" : kNotClosed);
  if (!is_changed()) changed_.reset();
}

void take_facts(const PreparedOriginal& original, Verdict& verdict) {
  verdict.proof = "union";
  verdict.original_closed = original.closed;
  verdict.non_finite_faces = original.non_finite_faces;
}

void refuse_non_finite_faces(std::size_t count, const VerificationOptions& options, bool& yes, std::string& why_not) {
  if (count == 0 || options.finite_only || !yes) return;
  yes = false;
  why_not =
      fmt::format("{} of the original {} not finite; mend {}, or leave {} out (--finite-only)", counted(count, "face"),
                  count == 1 ? "is" : "are", count == 1 ? "it" : "them", count == 1 ? "it" : "them");
}

}  // namespace prohull::verify
