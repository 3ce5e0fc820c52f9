#pragma once

#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull {

// The content of a file in each format; coordinates are finite, for STL float32.

std::string ply_content(const TriangleMesh& mesh);
std::string obj_content(const TriangleMesh& mesh);
std::string off_content(const TriangleMesh& mesh);
std::string stl_content(const TriangleMesh& mesh);

/// Whether float32 stores the value without changing it (for -0.0, denormals and all others).
bool is_float32(double value);

}  // namespace prohull
