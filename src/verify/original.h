#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"

namespace prohull::verify {

/// What is known of an original once it is prepared.
struct PreparedOriginal {
  Box box;
  bool closed = false;
  std::size_t turned_faces = 0;      ///< that looked inwards
  std::size_t non_finite_faces = 0;  ///< that were left out
};

/// Leaves out faces that are not finite and turns a closed mesh outwards; `notes` tell of both. Throws InputError if
/// the mesh is empty or too large to verify.
PreparedOriginal prepare_original(TriangleMesh& mesh, std::vector<std::string>& notes);

/// A yes about the other faces is none about the original, unless options.finite_only says so.
void refuse_non_finite_faces(std::size_t count, const VerificationOptions& options, bool& yes, std::string& why_not);

/// The box of what faces refer to. Throws InputError, with `name` in the message, if the mesh is empty, not finite or
/// too large to verify.
Box usable_box(const TriangleMesh& mesh, std::string_view name);

}  // namespace prohull::verify
