#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull {

struct SampleInfo {
  std::string_view name;
  std::string_view description;
  int genus;  ///< the number of handles, the same for every number of faces
};

/// The meshes that make_sample can make.
std::span<const SampleInfo> samples();

/// Makes a test mesh of about `faces` faces: within 20 %, or the fewest that the shape allows (12 for the sphere, about
/// 22,000 for the gyroid).
/// Guaranteed: one closed 2-manifold of the sample's genus, oriented outwards, free of self-intersection and of
/// slivers; the same bits every time. The planar faces of "box" and "bracket" are exactly planar, also as float32. Time
/// and memory are linear in `faces`, up to tens of millions. Throws InputError(InvalidOption) if the name is unknown
/// (the message lists the known ones) or `faces` is outside of [4, 2^30].
TriangleMesh make_sample(std::string_view name, std::size_t faces);

}  // namespace prohull
