#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull {

struct SampleInfo {
  std::string_view name;
  std::string_view description;
  int genus;
};

/// The meshes that make_sample can make.
std::span<const SampleInfo> samples();

/// A closed, manifold, outward-oriented mesh free of self-intersection, of about `faces` faces (within 20 %, or the
/// fewest that the shape allows), deterministic, up to tens of millions. Throws InputError(InvalidOption) for an unknown
/// name (listing the known) or a face count outside [4, 2^30].
TriangleMesh make_sample(std::string_view name, std::size_t faces);

}  // namespace prohull
