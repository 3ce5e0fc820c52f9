#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull {

struct SampleInfo {
  std::string_view name;
  std::string_view description;
  int genus;  ///< at every face count
};

/// The meshes that make_sample can make.
std::span<const SampleInfo> samples();

/// Guaranteed: one closed, 2-manifold, outward-oriented surface free of self-intersection and of slivers, of the
/// sample's genus; about `faces` faces (within 20 %, or the fewest that the shape allows: 12 for the sphere, some
/// 22,000 for the gyroid); the same bits every time. Time and memory are linear in `faces`, up to tens of millions. The
/// planar faces of "box" and "bracket" are exactly planar, also as float32. Throws InputError(InvalidOption) for an
/// unknown name (listing the known) or a face count outside [4, 2^30].
TriangleMesh make_sample(std::string_view name, std::size_t faces);

}  // namespace prohull
