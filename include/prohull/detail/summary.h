#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/mesh_quality.h"
#include "prohull/enclosing_hull.h"

namespace prohull {

// The sentences of summaries, which the command line prints and the page in the browser shows.

/// What is proven, or what is not: "hull.stl encloses part.stl", "hull.stl does not cover every triangle of part.stl",
/// of an inner hull "hull.stl is enclosed by part.stl"; and what closes the openings of an original that is not closed.
/// docs/proofs.md has these words.
std::string claim(const Verdict& verdict, const std::string& subject, const std::string& object);
/// The same of a hull. Of a progressive one it tells of which levels that is known.
std::string claim(const Verification& found, const std::string& hull, const std::string& original);
/// Of a progressive hull: all of that is known of every level, and not of the base mesh alone.
bool is_of_every_level(const Verification& found);
/// Of a progressive hull that proves nothing: nothing else was looked at.
bool has_failed_replay(const Verification& found);

/// What every summary says behind "certified: ": "yes, the file as written encloses the original", or why not.
std::string certificate_of(const Verdict& verdict, const std::string& subject = "the file as written",
                           const std::string& object = "the original");

/// ", void 3.125 %"; empty if the void is not known.
std::string text_of_void(double void_ratio);

/// The same of a hull that was made; where its volume is only estimated, it says so.
std::string described_void(const EnclosingHulls& made, const EnclosingHull& hull);

/// Behind a distance that counts from the mesh: that its openings, or what else, are closed, and how far the triangles
/// alone are.
std::string text_of_openings(bool has_openings, const DistanceBounds& from_triangles,
                             const char* openings = "its openings");

/// A verdict about the finite triangles of a file, as it is of the file: with those that were left out.
Verification of_file(Verification found, const RepairedMesh& input);

/// The verdict about what was made, as it is of the file: of one that does not hold its very bits, the answer is no.
Verdict as_written(Verdict verdict, bool holds_bits);

/// What the finest level of a hull is, where that is not the input: "the convex hull of the input"; else empty.
std::string described_finest_level(FinestLevel finest_level);

/// "the mesh", "a convex solid", which is the convex hull or one of fewer faces around it, "a wrap with a spacing of
/// 0.1"
std::string source_of(const Solid& solid);

struct HullMeasures {
  bool has_openings = false;  ///< that count as closed
  Verdict verdict = {};       ///< of the hull, with its distances: to the solid, doors of a wrap belong
  MeshQuality quality = {};
};

HullMeasures measures_of(const EnclosingHulls& made, const EnclosingHull& hull, const HullBounds& bounds,
                         const Progress& progress = {});

/// Pairs of faces of the repaired mesh, or of the input where that could not be repaired.
std::size_t self_intersections_of_input(const EnclosingHulls& made);

/// A hull that was made, which need not stand among `made.hulls` any more.
struct ToldHull {
  const EnclosingHulls& made;
  const EnclosingHull& hull;
  const EnclosingOptions& options;
  const HullMeasures& measures;
  std::size_t input_self_intersections;

  const Solid& solid() const { return made.solids[hull.solid]; }
  std::size_t added_self_intersections() const;
};

// Lines of a summary, in this order.
std::string line_of_input(const std::string& name, const RepairedMesh& input);
std::vector<std::string> lines_of_repairs(const RepairedMesh& input);
std::string line_of_hull(const std::string& name, const ToldHull& told);
std::vector<std::string> lines_of_shape(const ToldHull& told);
std::vector<std::string> lines_of_limits(const ToldHull& told);
std::vector<std::string> lines_of_proof(const Verdict& verdict);

/// What a hull has in a table of several meshes: the faces of the mesh, its own, its void, its distance, and whether it
/// is certified. `verdict`: about the file as written.
constexpr std::array<const char*, 5> kTableHead{"faces", "hull", "void", "distance", "certified"};
std::array<std::string, kTableHead.size()> cells_of_hull(const ToldHull& told, const Verdict& verdict);

/// A level of a hull, as a file holds it.
struct ToldLevel {
  const ProgressiveHull& hull;
  std::size_t target_faces;                  ///< that were asked for; 0: the coarsest level was
  std::size_t faces;                         ///< that the level has
  const std::optional<Verification>& found;  ///< against the finest level, unless the file holds that, bit for bit
};

/// What `prohull lod` says of it, line by line.
std::vector<std::string> lines_of_level(const std::string& name, const ToldLevel& told);

}  // namespace prohull
