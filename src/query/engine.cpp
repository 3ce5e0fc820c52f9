#include "query/engine.h"

#include <algorithm>

#include "geometry/triangle_contact.h"

namespace prohull {

bool HitCollector::before(const Found& one, const Found& other) const {
  const Triangle first = mesh_.triangle(one.face), second = mesh_.triangle(other.face);
  if (crosses_before(line_, first, one.at, second, other.at)) return true;
  return !crosses_before(line_, second, other.at, first, one.at) && one.face < other.face;
}

void HitCollector::offer(FaceId face) {
  const Triangle triangle = mesh_.triangle(face);
  const Crossing how = crossing(line_, triangle);
  if (how == Crossing::None) return;
  const Found found{face, how == Crossing::Entering, parameter(line_, triangle)};
  if (mode_ == HitMode::All) {
    all_.push_back(found);
  } else if (!best_ || (mode_ == HitMode::First && before(found, *best_))) {
    best_ = found;
    if (mode_ == HitMode::First) limit_ = std::min(line_.t_end, found.at.t + found.at.error);
  }
}

Hit HitCollector::hit(const Found& found) const {
  return {found.face, found.at.t, line_.at(found.at.t), found.entering};
}

std::optional<Hit> HitCollector::best() const { return best_ ? std::optional(hit(*best_)) : std::nullopt; }

std::vector<Hit> HitCollector::all() {
  std::ranges::sort(all_, [&](const Found& one, const Found& other) { return before(one, other); });
  std::vector<Hit> hits;
  hits.reserve(all_.size());
  for (const Found& found : all_) hits.push_back(hit(found));
  return hits;
}

void FaceCollector::offer(FaceId face) {
  if (triangles_touch(triangle_, mesh_.triangle(face))) found_.push_back(face);
}

std::vector<FaceId> FaceCollector::all() {
  std::ranges::sort(found_);
  return std::move(found_);
}

}  // namespace prohull
