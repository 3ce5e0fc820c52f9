#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "verify/self_intersection.h"
#include "verify/surface.h"

namespace prohull::verify {

/// A closed mesh, and what is decided of it: once, when it is asked for first. One thread at a time may ask.
class KnownSolid {
 public:
  /// The mesh must outlive it. Messages call it `name`. `outward_sheet`: whether it is_outward_sheet, if that is known.
  KnownSolid(const TriangleMesh& mesh, std::string name, std::optional<bool> outward_sheet = std::nullopt)
      : mesh_(mesh), name_(std::move(name)), outward_sheet_(outward_sheet) {}

  const TriangleMesh& mesh() const { return mesh_; }
  const Surface& surface();  ///< good until the volume is asked for
  /// Pairs of faces of the mesh that meet (self_intersections).
  const FacePairs& self_intersections(ProgressMeter& meter);
  /// The same as pairs of faces of the surface.
  FacePairs pairs_of_surface(ProgressMeter& meter);
  /// Whether it is_outward_sheet without self-intersections: then all of its faces bound the solid.
  bool bounds_one(ProgressMeter& meter);
  /// As faces_beside_the_solid.
  const std::vector<FaceId>& faces_beside(const Progress& progress);
  /// As solid_volume.
  double volume(ProgressMeter& meter);

 private:
  const TriangleMesh& mesh_;
  const std::string name_;
  const std::optional<bool> outward_sheet_;
  std::optional<Surface> surface_;
  std::optional<FacePairs> pairs_;
  std::optional<bool> bounds_one_;
  std::optional<std::vector<FaceId>> beside_;
  std::optional<double> volume_;
};

}  // namespace prohull::verify
