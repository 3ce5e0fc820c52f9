#include "query/engine.h"

#include <algorithm>

#include "geometry/triangle_intersection.h"
#include "query/exact_line.h"

namespace prohull {

bool HitCollector::before(const Found& one, const Found& other) const {
  if (const int order = rounded_order(one.at, other.at); order != 0) return order < 0;
  const int order = prohull::order(line_, mesh_.triangle(one.face), mesh_.triangle(other.face));
  return order != 0 ? order < 0 : one.face < other.face;
}

void HitCollector::offer(FaceId face, const Triangle& triangle) {
  if (const int sign = pierced(line_, triangle); sign != 0) offer_pierced(face, triangle, sign);
}

void HitCollector::offer_pierced(FaceId face, const Triangle& triangle, int sign) {
  const auto at = parameter_if_within(line_, triangle, sign);
  if (!at || settles(sign)) return;
  const Found found{face, sign < 0, *at};
  if (mode_ == HitMode::All) {
    all_.push_back(found);
  } else if (!best_ || (mode_ == HitMode::First && before(found, *best_))) {
    best_ = found;
    if (mode_ == HitMode::First) limit_ = std::min(line_.t_end, found.at.t + found.at.error);
  }
}

// A ray with a tiny direction meets a face at a t that is too large for a double, one with a huge direction at a t that
// has lost digits.
Vec3 HitCollector::position(const Found& found) const {
  const double t = found.at.t;
  return std::isnormal(t) || t == 0 ? line_.at(t) : exact_crossing_point(line_, mesh_.triangle(found.face));
}

Hit HitCollector::hit(const Found& found) const { return {found.face, found.at.t, position(found), found.entering}; }

std::optional<Hit> HitCollector::best() const { return best_ ? std::optional(hit(*best_)) : std::nullopt; }

void HitCollector::append_all(std::vector<Hit>& hits) {
  std::ranges::sort(all_, [&](const Found& one, const Found& other) { return before(one, other); });
  for (const Found& found : all_) hits.push_back(hit(found));
}

void FaceCollector::offer(FaceId face) {
  if (triangles_touch(triangle_, mesh_.triangle(face))) found_.push_back(face);
}

std::vector<FaceId> FaceCollector::all() {
  std::ranges::sort(found_);
  return std::move(found_);
}

std::optional<Hit> QueryWorker::one_hit(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode) {
  HitCollector hits(mesh, line, mode);
  collect(line, hits);
  return hits.best();
}

void QueryWorker::all_hits(const TriangleMesh& mesh, const DirectedLine& line, std::vector<Hit>& hits) {
  HitCollector found(mesh, line, HitMode::All);
  collect(line, found);
  found.append_all(hits);
}

bool QueryWorker::crosses(const TriangleMesh& mesh, const DirectedLine& line) {
  HitCollector hits(mesh, line, HitMode::Any);
  hits.ask_only(HitCollector::Only::Whether);
  collect(line, hits);
  return hits.has_any();
}

int QueryWorker::winding(const TriangleMesh& mesh, const DirectedLine& line) {
  HitCollector hits(mesh, line, HitMode::All);
  hits.ask_only(HitCollector::Only::Winding);
  collect(line, hits);
  return hits.winding();
}

}  // namespace prohull
