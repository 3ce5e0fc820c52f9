#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/detail/symmetry.h"
#include "prohull/detail/vertex_split.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

enum class HullSide {
  Outer,  ///< every hull encloses the original mesh
  Inner,  ///< every hull is enclosed by the original mesh
};

/// "outer", "inner"
Names<HullSide> hull_side_names();

/// What the original mesh of a progressive hull, its finest level, is in terms of the input that the hull encloses.
enum class FinestLevel {
  Input,       ///< the input itself, or nothing is known: of build_hull, and of files that do not say it
  Repaired,    ///< the input after repairs
  ConvexHull,  ///< the convex hull of the input
  Wrap,        ///< a wrap of the input (wrap.h)
};

/// "input", "repaired", "convex-hull", "wrap"
Names<FinestLevel> finest_level_names();

/// A mesh at every resolution, from a coarse base mesh up to the original mesh (P&T 2, Hoppe 1996). It is immutable;
/// any number of threads may share one, and copies share their memory. Guaranteed: every level is a closed 2-manifold.
/// Every level encloses the next finer one (HullSide::Inner: is enclosed by it) in the sense of winding numbers. The
/// finest level is the original mesh, bit for bit. Not guaranteed: freedom from self-intersection.
class ProgressiveHull {
 public:
  /// Vertices are numbered: the vertices of the original mesh come first, then one vertex for each edge collapse, in
  /// the order of the collapses. `base_corners` holds the base mesh: at 3 f + c the vertex of corner c of face f, or
  /// kAbsent. Required: first_defect finds no defect. Unused vertices are allowed.
  ProgressiveHull(HullSide side, std::size_t original_vertices, PerVertex<Vec3> positions,
                  std::vector<VertexId> base_corners, std::vector<VertexSplit> splits);

  static constexpr VertexId kAbsent{0xffffffff};
  /// Of a vertex that a split replaces. All work on a hull takes time in proportion to these valences.
  static constexpr unsigned kMostValence = 1024;

  HullSide side() const { return side_; }
  FinestLevel finest_level() const { return finest_level_; }
  std::size_t original_face_count() const { return base_corners().size() / 3; }
  std::size_t base_face_count() const { return original_face_count() - 2 * splits().size(); }
  std::size_t original_vertex_count() const { return original_vertices_; }

  /// The finest level of at most `faces` faces, or the base mesh if that has more.
  TriangleMesh level(std::size_t faces) const;
  TriangleMesh base() const;
  TriangleMesh original() const { return level(original_face_count()); }

  /// The same record with level(faces) as its base mesh: vertices and faces keep their numbers.
  ProgressiveHull with_base(std::size_t faces) const;

  /// The same record, which says what its finest level is.
  ProgressiveHull with_finest_level(FinestLevel finest_level) const;

  const PerVertex<Vec3>& positions() const { return record_->positions; }
  const std::vector<VertexId>& base_corners() const { return record_->base_corners; }
  /// In the order of the collapses: splits()[i] replaces vertex made_vertex(i). Refinement starts with the last one.
  const std::vector<VertexSplit>& splits() const { return record_->splits; }
  VertexId made_vertex(std::size_t i) const { return VertexId(static_cast<std::uint32_t>(original_vertices_ + i)); }

  bool operator==(const ProgressiveHull& other) const;

 private:
  struct Record {
    PerVertex<Vec3> positions;
    std::vector<VertexId> base_corners;
    std::vector<VertexSplit> splits;

    bool operator==(const Record&) const = default;
  };

  HullSide side_;
  FinestLevel finest_level_ = FinestLevel::Input;
  std::size_t original_vertices_;
  std::shared_ptr<const Record> record_;
};

/// The number of faces of the coarsest level that `is_within` accepts. It is found by bisection, which assumes that
/// `is_within` accepts every level that is finer than an accepted one. If no level is accepted: the number of faces of
/// the original mesh.
std::size_t faces_within(const ProgressiveHull& hull, const std::function<bool(const TriangleMesh&)>& is_within);

/// The number of faces of the finest symmetric level that has at most `faces` faces, of a hull that was built with
/// HullOptions::mirror; that of the base mesh if it has more. Where two mirrored edges were collapsed, the level
/// between the two collapses is a hull as any other, but not symmetric. Throws InputError(InvalidOption) if there is no
/// such level.
std::size_t symmetric_faces(const ProgressiveHull& hull, Axis mirror, std::size_t faces);

/// The first defect of the record, such as "split 12 does not fit the mesh it refines"; nothing if the base mesh is a
/// closed 2-manifold and all splits can be made. Whether levels enclose each other is decided by verify_replay.
std::optional<std::string> first_defect(const ProgressiveHull& hull);

}  // namespace prohull
