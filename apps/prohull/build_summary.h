#pragma once

#include <filesystem>
#include <vector>

#include "command.h"
#include "prohull/certificate.h"
#include "prohull/detail/summary.h"
#include "prohull/enclosing_hull.h"
#include "prohull/regions.h"

namespace prohull::cli {

struct BuildOptions {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path in, out, hierarchy, certificate, report, tolerance;
  std::vector<std::size_t> faces{2000};
  EnclosingOptions enclosing;
  InputOptions input;
  std::string out_format;
  double normal_deviation_degrees = 45;
  double max_void_percent = 0;           ///< 0: any
  Length gap, max_distance, seal_holes;  ///< the numbers in `enclosing` follow from them
  bool recenter = false, strict = false;

  bool is_outer() const { return enclosing.hull.side == HullSide::Outer; }
};

/// A hull and its file.
struct Written {
  EnclosingHull hull;
  std::filesystem::path path;
  bool holds_bits = false;                   ///< the hull is certified, and the file holds its very bits
  HullMeasures measures = {};                ///< the verdict is about the file
  std::vector<DistanceBounds> regions = {};  ///< of each region, from the hull
  std::filesystem::path certificate_path = {};
  Certificate certificate = {};
  double write_seconds = 0;

  bool certified() const { return measures.verdict.certified; }
  bool is_as_asked() const { return certified() && hull.target_reached && hull.within_bounds; }
};

/// The regions of --tolerance, and the faces of each.
struct Regions {
  std::vector<Region> all;
  std::vector<TriangleMesh> faces;
};

struct BuildOutcome {
  EnclosingHulls made;
  std::size_t input_self_intersections = 0;  ///< of the repaired mesh, if there is one, else of the mesh
  std::vector<Written> written;
  double read_seconds = 0;
  Regions regions;
  Vec3 offset;  ///< that --recenter has subtracted

  const Solid& solid(const EnclosingHull& hull) const { return made.solids[hull.solid]; }
};

void print_summary(const BuildOptions& options, const BuildOutcome& outcome);
/// What each hull has in a table of several meshes, and the head of that table.
std::string table_head();
std::vector<std::string> table_rows(const BuildOptions& options, const BuildOutcome& outcome);
nlohmann::json report_of(const BuildOptions& options, const BuildOutcome& outcome);

}  // namespace prohull::cli
