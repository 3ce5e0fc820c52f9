#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/replay.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"
#include "verify/known_solid.h"

namespace prohull::verify {

/// A closed mesh that stands for an original which is not closed.
struct StandIn {
  TriangleMesh mesh;                ///< turned outwards
  std::vector<FaceId> number = {};  ///< of each face in the original; caps are numbered behind its faces
  std::size_t caps = 0;             ///< faces of the mesh that are no triangles of the original, in either orientation
  std::vector<FaceId> rest = {};    ///< faces of the original that are no faces of the mesh
};

/// Throws InputError if `closed` is empty, not closed or not finite.
StandIn stand_in(const TriangleMesh& closed, const TriangleMesh& original);

/// What is known of an original once it is prepared.
struct PreparedOriginal {
  Box box;
  bool closed = false;
  bool outward_sheet = false;        ///< is_outward_sheet, once it is turned
  std::size_t turned_faces = 0;      ///< to look outwards
  std::size_t non_finite_faces = 0;  ///< that were left out
};

/// Of one that nothing stands for.
inline constexpr std::string_view kNotClosed =
    "the original is not closed: it has no volume, and every triangle of it must be covered";

/// Leaves out faces that are not finite and turns a closed mesh outwards; `notes` tell of both. Throws InputError if
/// the mesh is empty or too large to verify.
PreparedOriginal prepare_original(TriangleMesh& mesh, std::vector<std::string>& notes);

/// What hulls are compared with, and what is decided of it: once, however many hulls there are. One thread at a time
/// may ask.
class Original {
 public:
  /// `closed` is as VerificationOptions::closed. The mesh must outlive it. Throws InputError as prepare_original and
  /// stand_in do.
  Original(const TriangleMesh& given, const TriangleMesh* closed);
  Original(const Original&) = delete;
  Original& operator=(const Original&) = delete;

  const PreparedOriginal& facts() const { return facts_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Prepared.
  const TriangleMesh& mesh() const { return changed_ ? *changed_ : given_; }
  const std::optional<StandIn>& stand_in() const { return stand_in_; }
  bool has_solid() const { return facts_.closed || stand_in_; }
  /// The mesh, or what stands for it. Requires one of the two to be closed.
  KnownSolid& solid() { return solid_; }

 private:
  bool is_changed() const { return facts_.turned_faces + facts_.non_finite_faces > 0; }

  const TriangleMesh& given_;
  std::optional<TriangleMesh> changed_;  ///< if preparation has changed the mesh
  std::vector<std::string> notes_;
  PreparedOriginal facts_;
  std::optional<StandIn> stand_in_;
  KnownSolid solid_;
};

/// verify_hull, which says what they mean. The original is one that stays.
Verification verify_hull(const TriangleMesh& hull, Original& original, HullSide side,
                         const VerificationOptions& options);
Verification verify_hull(const ProgressiveHull& hull, Original& original, const VerificationOptions& options);

/// verify_replay of an original that turn_outwards leaves as it is.
ReplayReport replay(const ProgressiveHull& hull, const TriangleMesh& outwards, const Progress& progress);

/// What a union's verdict says of the original.
void take_facts(const PreparedOriginal& original, Verdict& verdict);

/// A yes about the other faces is none about the original, unless options.finite_only says so.
void refuse_non_finite_faces(std::size_t count, const VerificationOptions& options, bool& yes, std::string& why_not);

/// The box of what faces refer to. Throws InputError, with `name` in the message, if the mesh is empty, not finite or
/// too large to verify.
Box usable_box(const TriangleMesh& mesh, std::string_view name);

}  // namespace prohull::verify
