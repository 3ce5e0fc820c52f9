#include "mesh/mirror_images.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace prohull {
namespace {

auto key(const Vec3& p) { return std::tuple(p.x, p.y, p.z); }

class MirrorSearch {
 public:
  MirrorSearch(const HalfEdgeMesh& mesh, const MirrorPlane& plane)
      : mesh_(mesh), plane_(plane), images_(3 * mesh.face_id_count(), kNoHalfEdge) {
    for (const HalfEdgeId h : images_.ids())
      if (mesh.tail(h) != kNoVertex) by_place_.push_back(h);
    std::ranges::sort(by_place_, {}, [this](HalfEdgeId h) { return std::pair(place(h), h); });
  }

  std::optional<PerHalfEdge<HalfEdgeId>> run() {
    for (const HalfEdgeId h : images_.ids())
      if (mesh_.tail(h) != kNoVertex && images_[h] == kNoHalfEdge && !match_component(h)) return std::nullopt;
    return std::move(images_);
  }

 private:
  using Place = std::array<std::tuple<double, double, double>, 2>;

  Place place(HalfEdgeId h) const { return {key(mesh_.position(mesh_.tail(h))), key(mesh_.position(mesh_.tip(h)))}; }

  // Where faces lie on each other, several may be the image of one; all of a component then go to one component.
  bool match_component(HalfEdgeId h) {
    const auto tail = plane_.image(mesh_.position(mesh_.tip(h))), tip = plane_.image(mesh_.position(mesh_.tail(h)));
    if (!tail || !tip) return false;
    const Place wanted{key(*tail), key(*tip)};
    auto candidate = std::ranges::lower_bound(by_place_, wanted, {}, [this](HalfEdgeId g) { return place(g); });
    for (; candidate != by_place_.end() && place(*candidate) == wanted; ++candidate)
      if (match(h, *candidate)) return true;
    return false;
  }

  bool match(HalfEdgeId h, HalfEdgeId g) {
    matched_.clear();
    if (!pair(h, g)) return false;
    for (std::size_t i = 0; i < matched_.size(); ++i) {
      const auto [a, b] = matched_[i];
      if (pair(mesh_.next(a), mesh_.previous(b)) && pair(mesh_.twin(a), mesh_.twin(b))) continue;
      for (const auto& [c, d] : matched_) images_[c] = images_[d] = kNoHalfEdge;
      return false;
    }
    return true;
  }

  bool pair(HalfEdgeId a, HalfEdgeId b) {
    if (images_[a] == b && images_[b] == a) return true;
    if (images_[a] != kNoHalfEdge || images_[b] != kNoHalfEdge) return false;
    const auto image = plane_.image(mesh_.position(mesh_.tail(a)));
    if (!image || *image != mesh_.position(mesh_.tip(b))) return false;
    images_[a] = b, images_[b] = a;
    matched_.emplace_back(a, b);
    return true;
  }

  const HalfEdgeMesh& mesh_;
  const MirrorPlane& plane_;
  PerHalfEdge<HalfEdgeId> images_;
  std::vector<HalfEdgeId> by_place_;
  std::vector<std::pair<HalfEdgeId, HalfEdgeId>> matched_;
};

}  // namespace

std::optional<MirrorPlane> mirror_plane_of(const Box& box, Axis axis) {
  const int along = static_cast<int>(axis);
  const MirrorPlane plane{along, box.min[along] + box.max[along]};
  const auto image = plane.image(box.min);
  if (!image || (*image)[along] != box.max[along]) return std::nullopt;
  return plane;
}

std::optional<PerHalfEdge<HalfEdgeId>> mirror_images(const HalfEdgeMesh& mesh, const MirrorPlane& plane) {
  return MirrorSearch(mesh, plane).run();
}

}  // namespace prohull
