#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <vector>

#include "construct/progressive/cells.h"
#include "construct/progressive/collapse_loop.h"
#include "geometry/unit_cube.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// The mesh under construction, or the part of a mesh within a box, of which cells are cut out, each to be simplified
/// by itself, and put back.
///
/// Its elements have four numbers:
///
///     number | of what                       | given by
///     -------+-------------------------------+-------------------------------------------------------------------
///     input  | faces and vertices            | the mesh to be simplified; the faces of the result keep them
///     place  | faces and vertices            | their order along a curve, so that what lies together in space does
///            |                               | so in memory; the vertex that a collapse makes takes the place of
///            |                               | one that it removes. All arrays here are by place.
///     local  | faces and vertices of a patch | their order in the patch; its new vertices follow
///     name   | vertices                      | ProgressiveHull: those of the input, then one for each collapse
///
///     input -- given_ -- place -- Cut::faces, Cut::vertices -- local
///                          |
///                        names_ -- name
class WholeMesh {
 public:
  /// Throws InputError unless the mesh is a closed 2-manifold, and as symmetric as options.mirror asks for; of a part
  /// of one, unless all faces around each vertex strictly inside of the box are there. Only these vertices change.
  WholeMesh(const TriangleMesh& mesh, const HullOptions& options, const UnitCube& unit_cube, const Box* part);

  /// The plane of symmetry, if options.mirror asks for one.
  const std::optional<MirrorPlane>& mirror() const { return mirror_; }

  std::size_t face_count() const { return faces_.size(); }
  std::vector<BoxedFace> boxed_faces() const;
  const FloatBox& box() const { return box_; }

  /// A patch, and the places of its elements.
  struct Cut {
    Patch patch;
    std::vector<FaceId> faces;
    std::vector<VertexId> vertices;

    std::uint32_t corner_place(std::uint32_t corner) const { return 3 * index(faces[corner / 3]) + corner % 3; }
    /// Where the facts of an edge are kept.
    std::uint32_t edge_place(HalfEdgeId h) const {
      return std::min(corner_place(index(h)), corner_place(index(patch.mesh.twin(h))));
    }
    bool is_free(HalfEdgeId h) const {
      return patch.vertices[patch.mesh.tail(h)].is_free && patch.vertices[patch.mesh.tip(h)].is_free;
    }
  };

  /// The collapses of a patch. Its vertices are numbered locally.
  struct Collapses {
    std::vector<VertexId> names;   ///< of the vertices that it began with
    std::vector<VertexId> places;  ///< of the vertex that each collapse makes
    std::vector<VertexSplit> record;
    std::vector<double> priorities;
    std::vector<Vec3> apexes;
    RefusalCounts refusals;
    std::size_t linear_programs;
    std::uint32_t time;
  };

  /// Cells of a partition may be cut and put back by any number of threads: cut reads only what put_back of no other
  /// cell writes.
  Cut cut(Cell cell, std::size_t target_faces, double max_priority);
  Cut cut_everything(std::size_t target_faces);
  Collapses put_back(Cut cut);
  /// Takes the collapses of patches that have been put back into the record, ordered by their priorities, as if there
  /// had been one queue.
  void add(const std::vector<Collapses>& patches);

  /// Of the edges of every n-th face, the priorities that are known of edges that are not refused.
  std::vector<double> known_priorities(std::size_t n) const;
  /// So that edges that were refused are looked at again.
  void forget_edges();

  /// What has become of it; ends the construction.
  ProgressiveHull hull();

 private:
  /// The local numbers of what a patch has, one for each thread; none between patches.
  struct LocalNumbers {
    PerVertex<VertexId> vertices;
    PerFace<std::uint32_t> faces;
    static constexpr std::uint32_t kNoFace = 0xffffffff;
  };

  void number_along_curve(const TriangleMesh& mesh);
  void find_twins(const TriangleMesh& mesh);
  void find_twins_of_part();
  void require_whole_stars(const HalfEdgeMesh& part) const;
  void find_images(const TriangleMesh& mesh);
  void set_tolerances(const HullOptions& options);
  void cut_tolerances(Cut& cut) const;
  void put_back_tolerances(const Cut& cut);
  std::uint32_t given_corner(std::uint32_t corner) const { return 3 * index(given_[FaceId{corner / 3}]) + corner % 3; }

  const HullOptions& options_;
  const UnitCube& unit_cube_;
  const FloatBox box_;

  PerFace<FaceId> given_;          ///< the number of a face in the input
  std::vector<VertexId> corners_;  ///< kNoVertex where a face has gone
  std::vector<HalfEdgeId> twins_;  ///< of the half-edge that starts at a corner
  std::optional<MirrorPlane> mirror_;
  PerHalfEdge<HalfEdgeId> images_;  ///< mirrored; collapses keep them
  std::vector<FaceId> faces_;       ///< those that are left
  std::vector<EdgeFacts> edges_;    ///< by one of an edge's two corners
  PerVertex<Vec3> positions_;
  PerVertex<std::uint32_t> changed_;
  PerVertex<VertexId> names_;
  Tolerances tolerances_;
  std::uint32_t time_ = 1;
  oneapi::tbb::enumerable_thread_specific<LocalNumbers> local_numbers_;

  PerVertex<Vec3> made_;  ///< by name
  std::vector<VertexSplit> record_;
};

}  // namespace prohull
