#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "prohull/triangle_mesh.h"
#include "table.h"

namespace prohull::bench {

/// What the hulls of a mesh file are compared with. Lengths and volumes are in the unit of the file.
struct Reference {
  std::size_t faces = 0, components = 0;  ///< of the finite faces, vertices at equal positions welded
  std::string closed;                  ///< "yes": closed, after repair at the most; "capped": closed by caps; else "no"
  std::size_t self_intersections = 0;  ///< pairs of faces that intersect
  std::size_t capped_self_intersections = 0;  ///< the same with caps on all openings
  std::size_t openings = 0;
  double largest_opening = 0;  ///< its diameter; 0 if there is none
  double diagonal = 0;
  /// Of the solid that a person would see: of the mesh, with caps, if that is closed and free of self-intersection;
  /// else of a wrap of the mesh with caps, alpha diagonal / 200, offset diagonal / 2000. NaN if the wrap was not built,
  /// or takes more than two minutes.
  double volume = kUnknown;
  double convex_volume = kUnknown;  ///< of the convex hull of the vertices; NaN if it was not built, or is flat
};

/// The faces with finite corners, and the vertices that they use.
TriangleMesh finite_part(const TriangleMesh& mesh);

// Of a mesh that is finite and has faces.
Reference reference_of(const TriangleMesh& mesh);
double convex_volume(const TriangleMesh& mesh);  ///< Reference::convex_volume

/// References by the name of the file, kept in a CSV file, because a fine wrap takes long. Any thread may call.
class References {
 public:
  /// Reads the file, if it is there.
  explicit References(std::filesystem::path path);

  /// Measures what the file does not have yet, and adds it to the file.
  Reference of(const std::string& name, const TriangleMesh& mesh);

 private:
  void write() const;

  std::filesystem::path path_;
  std::mutex mutex_;
  std::map<std::string, Reference> known_;
};

}  // namespace prohull::bench
