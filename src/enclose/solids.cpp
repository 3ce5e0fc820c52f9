#include "enclose/solids.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "enclose/estimated_volume.h"
#include "enclose/folds.h"
#include "enclose/offset_surface.h"
#include "geometry/float32.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/detail/summary.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/wrap.h"
#include "verify/solid_volume.h"

namespace prohull {

Solids::Solids(const Request& request)
    : request_(request),
      original_(request.input.original, request.input.closed_mesh()),
      repair_seconds_(request.repair_seconds) {
  const EnclosingOptions& options = request.options;
  const Stopwatch watch;
  const auto& closed = request.input.closed;
  if (closed && options.repair != Repair::Wrap) {
    const std::size_t pairs =
        entries_[add({.source = Source::Mesh, .mesh = closed->mesh, .components = closed->report.components})]
            .solid.self_intersections;
    volume_ = closed->report.volume;
    constexpr std::size_t kMostPairs = 10'000;
    if (!request.is_outer() && pairs > kMostPairs)
      throw InputError(Defect::NoVolume,
                       fmt::format("{} pairs of its faces intersect, too many to prove what lies inside of it; unite "
                                   "its parts first, for instance by Blender's voxel remesh",
                                   grouped(pairs)));
  }
  double exact = volume_;
  const bool is_exact = has_mesh() && entries_[0].solid.self_intersections == 0;
  if (options.repair != Repair::None && closed && !is_exact && request.is_outer()) {
    exact = exact_volume();
    const double volume = std::isnan(exact) ? estimated_volume(closed->mesh) : exact;
    if (volume > 0) volume_ = volume;
  }
  if (request.input.repairs.dropped_components > 0 && closed) filled_volume_ = std::isnan(exact) ? 0 : exact;
  if (options.bounds.any() && original_.has_solid()) {
    ProgressMeter meter(options.progress, "repair");
    verified_volume_ = filled_volume_ ? *filled_volume_ : original_.solid().volume(meter);
  }
  repair_seconds_ += watch.seconds();
}

std::size_t Solids::self_intersections_of(const TriangleMesh& mesh) {
  if (!has_triangles_of(mesh, original_.solid().mesh())) return count_self_intersections(mesh);
  ProgressMeter meter(request_.options.progress, "repair");
  return original_.solid().self_intersections(meter).size();
}

// Parts that overlap would count twice in a signed volume. NaN where they overlap too often.
double Solids::exact_volume() {
  const TriangleMesh& mesh = request_.input.closed->mesh;
  ProgressMeter meter(request_.options.progress, "repair");
  return has_triangles_of(mesh, original_.solid().mesh()) ? original_.solid().volume(meter)
                                                          : verify::solid_volume(mesh, meter);
}

SolidId Solids::add(Solid solid) {
  solid.volume = signed_volume(solid.mesh);
  solid.self_intersections = solid.source == Source::Mesh ? self_intersections_of(solid.mesh) : 0;
  Entry entry;
  if (solid.doors.face_count() > 0) {
    entry.with_doors = request_.to_cover();
    append(entry.with_doors, solid.doors);
  }
  entry.solid = std::move(solid);
  entries_.push_back(std::move(entry));
  return entries_.size() - 1;
}

std::optional<SolidId> Solids::unfolded() {
  const Stopwatch watch;
  if (!unfolded_) {
    unfolded_.emplace();
    if (auto made = prohull::unfolded(entries_[0].solid.mesh,
                                      request_.hull_options(request_.fewest_faces, request_.options.hull.seed)))
      *unfolded_ = add({.source = Source::Mesh, .mesh = std::move(made->mesh), .folds = made->folds});
    repair_seconds_ += watch.seconds();
  }
  return *unfolded_;
}

std::optional<SolidId> Solids::with_sheets(double distance) {
  if (const auto known = sheets_.find(distance); known != sheets_.end()) return known->second;
  const Stopwatch watch;
  std::optional<SolidId>& id = sheets_[distance];
  auto made = prohull::with_sheets(entries_[0].solid.mesh, request_.to_cover(), distance,
                                   request_.hull_options(request_.fewest_faces, request_.options.hull.seed));
  if (made && inspect(made->mesh).is_closed_manifold())
    id = add({.source = Source::Mesh,
              .mesh = std::move(made->mesh),
              .components = entries_[0].solid.components,
              .folds = made->folds});
  repair_seconds_ += watch.seconds();
  return id;
}

std::span<const SolidId> Solids::wraps(std::size_t faces) const {
  const auto found = wraps_.find(faces);
  return found == wraps_.end() ? std::span<const SolidId>() : found->second;
}

double Solids::volume(std::size_t faces) const {
  if (request_.input.closed || !request_.is_outer()) return volume_;
  const std::span<const SolidId> made = wraps(faces);
  return made.empty() ? 0 : entries_[made.front()].inside_volume;
}

double Solids::verified_volume(std::size_t faces) const {
  return verified_volume_ > 0 ? verified_volume_ : volume(faces);
}

std::optional<SolidId> Solids::wrap(const WrapKind& kind, double spacing, std::size_t faces, std::string& why_not) {
  for (const SolidId id : wraps(faces))
    if (entries_[id].kind == kind && entries_[id].solid.wrap_spacing == spacing) return id;
  const Stopwatch watch;
  const EnclosingOptions& options = request_.options;
  const bool is_closed = request_.input.closed.has_value();
  const WrapOptions how{.spacing = spacing,
                        .offset = kind.offset,
                        .padding = request_.aim(),
                        .seal_holes = options.seal_holes,
                        .seal_rooms = !is_closed && options.open_shells == OpenShells::Close,
                        .closing = kind.closing * spacing,
                        .flatness = kind.flatness,
                        .progress = options.progress};
  std::optional<SolidId> id;
  try {
    Wrap made;
    if (request_.is_outer())
      made = prohull::wrap(request_.to_cover(), how);
    else
      made.mesh = inner_wrap(request_.input.closed->mesh, how);
    if (options.hull.float32_coordinates)  // the wrap is farther from the triangles than what that moves it
      for (Vec3& p : made.mesh.positions) p = nearest_float32(p);
    if (request_.is_outer() || made.mesh.face_count() > 0) {
      ClosedMesh wrapped = closed_mesh(std::move(made.mesh));
      id = add({.source = Source::Wrap,
                .mesh = std::move(wrapped.mesh),
                .wrap_spacing = spacing,
                .doors = std::move(made.doors),
                .largest_door = made.largest_door,
                .components = wrapped.report.components});
      entries_[*id].inside_volume = made.inside_volume, entries_[*id].kind = kind;
      wraps_[faces].push_back(*id);
    } else if (!request_.is_padded()) {
      why_not = fmt::format("nothing inside of the mesh is thick enough for a wrap with a spacing of {:.4g}", spacing);
    }
  } catch (const InputError& error) {
    if (error.defect() == Defect::InvalidOption) throw;
    why_not = fmt::format("there is no wrap with a spacing of {:.4g}: {}", spacing, error.what());
  }
  repair_seconds_ += watch.seconds();
  return id;
}

std::optional<SolidId> Solids::offset(double distance) {
  if (const auto known = offsets_.find(distance); known != offsets_.end()) return known->second;
  const Stopwatch watch;
  std::optional<SolidId>& id = offsets_[distance];
  const auto& closed = request_.input.closed;
  std::optional<TriangleMesh> made = offset_surface(closed ? closed->mesh : request_.to_cover(), distance);
  if (made && request_.options.hull.float32_coordinates)
    for (Vec3& p : made->positions) p = nearest_float32(p);
  if (made) try {
      ClosedMesh around = closed_mesh(std::move(*made));
      if (count_self_intersections(around.mesh) == 0)
        id = add({.source = Source::Wrap,
                  .mesh = std::move(around.mesh),
                  .wrap_spacing = distance,
                  .components = around.report.components});
    } catch (const InputError&) {  // no closed 2-manifold
    }
  repair_seconds_ += watch.seconds();
  return id;
}

const HullResult& Solids::levels(SolidId id, std::uint64_t seed) {
  std::map<std::uint64_t, HullResult>& levels = entries_[id].levels;
  if (const auto known = levels.find(seed); known != levels.end()) return known->second;
  const HullOptions options = request_.hull_options(request_.fewest_faces, seed);
  return levels.emplace(seed, build_hull(entries_[id].solid.mesh, options)).first->second;
}

const TriangleMesh& Solids::to_cover(SolidId id) const {
  const TriangleMesh& with_doors = entries_[id].with_doors;
  return with_doors.face_count() > 0 ? with_doors : request_.to_cover();
}

double Solids::distance_from(const TriangleMesh& hull, SolidId id) {
  std::optional<CollisionIndex>& surface = entries_[id].surface;
  if (!surface) surface.emplace(to_cover(id), StandsFor::Surface);
  return separation(CollisionIndex(hull, StandsFor::Surface), {}, *surface, {}).lower;
}

std::vector<Solid> Solids::taken() {
  std::vector<Solid> all;
  for (Entry& entry : entries_) all.push_back(std::move(entry.solid));
  entries_.clear();
  return all;
}

}  // namespace prohull
