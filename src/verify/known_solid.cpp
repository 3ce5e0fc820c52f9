#include "verify/known_solid.h"

#include <algorithm>

#include "verify/solid_volume.h"
#include "verify/solids.h"

namespace prohull::verify {

const Surface& KnownSolid::surface() {
  if (!surface_) surface_.emplace(mesh_, name_);
  return *surface_;
}

const FacePairs& KnownSolid::self_intersections(ProgressMeter& meter) {
  if (!pairs_) pairs_ = verify::self_intersections(mesh_, meter);
  return *pairs_;
}

bool KnownSolid::bounds_one(ProgressMeter& meter) {
  if (!bounds_one_)
    bounds_one_ = (outward_sheet_ ? *outward_sheet_ : is_outward_sheet(mesh_)) && self_intersections(meter).empty();
  return *bounds_one_;
}

const std::vector<FaceId>& KnownSolid::faces_beside(const Progress& progress) {
  if (!beside_) {
    ProgressMeter meter(progress, "verify");
    beside_ = bounds_one(meter) ? std::vector<FaceId>{}
                                : faces_beside_the_solid(surface(), mesh_, pairs_of_surface(meter), progress);
  }
  return *beside_;
}

double KnownSolid::volume(ProgressMeter& meter) {
  if (!volume_)
    volume_ = bounds_one(meter) ? signed_volume(mesh_) : solid_volume(surface(), pairs_of_surface(meter), meter);
  // It takes some 220 bytes per face, which hulls of large meshes need while they are built.
  constexpr std::size_t kMostKept = 1'000'000;
  if (mesh_.face_count() > kMostKept) surface_.reset();
  return *volume_;
}

// A surface leaves out faces without area, which are in no pair.
FacePairs KnownSolid::pairs_of_surface(ProgressMeter& meter) {
  FacePairs pairs = self_intersections(meter);
  const std::vector<FaceId>& source = surface().source;
  if (source.size() == mesh_.face_count()) return pairs;
  const auto in_surface = [&](FaceIndex f) {
    return static_cast<FaceIndex>(std::ranges::lower_bound(source, FaceId{f}) - source.begin());
  };
  for (auto& [f, g] : pairs) f = in_surface(f), g = in_surface(g);
  return pairs;
}

}  // namespace prohull::verify
