#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/verification.h"
#include "robot/motion/motion.h"

namespace prohull::view {

using Pieces = std::vector<TriangleMesh>;
using Balls = std::vector<Ball>;

/// A robot along a path: where its joints are at moments, between which a page draws them on straight lines.
struct ShownMotion {
  /// All pairs of bodies are at least this distance apart from `begin` to `end`, proven; `pair` names the nearest.
  struct Bound {
    double begin = 0, end = 0, distance = 0;
    std::string pair;
  };
  std::vector<double> times = {};                   ///< of moments, increasing
  std::vector<std::vector<double>> positions = {};  ///< of each moment, of all joints of the robot
  bool in_seconds = true;                           ///< otherwise, times count rows
  std::string verdict = {};                         ///< a sentence
  bool is_good = true;                              ///< of the verdict
  std::vector<Bound> bounds = {};
};

/// A robot, and for each of its links what there is to draw, in the frame of the link; meshes may be empty.
struct ShownRobot {
  robot::Robot robot;
  std::vector<TriangleMesh> visual, collision;
  /// Pairs of links that may touch, such as an SRDF file disables. Without: those that are adjacent, and those whose
  /// collision geometry meets in every position.
  std::optional<std::vector<robot::LinkPair>> disabled = {};
  std::optional<ShownMotion> motion = {};  ///< none: only sliders move the joints
};

/// Something that a page shows, and how the page calls it: a mesh, all levels of a hull, pieces or balls that cover
/// together, or a robot, which is compared with nothing.
struct Shown {
  std::string name;
  std::variant<TriangleMesh, ProgressiveHull, Pieces, Balls, ShownRobot> shape;
  std::optional<HullSide> side = {};  ///< of a hull that is a mesh; none: as the options say
};

/// The mesh that all of it is compared with.
struct Original {
  std::string name;
  TriangleMesh mesh;
};

struct PageOptions {
  HullSide side = HullSide::Outer;  ///< of hulls that are meshes; a progressive hull knows its own
  bool solid_only = false;          ///< as VerificationOptions has it
  std::string unit = {};            ///< of all coordinates, such as "m"; empty: it is not known
  std::string version = {};         ///< of the program
  unsigned threads = 0;             ///< threads at most; 0: one for each core
  bool measures_levels = true;      ///< of progressive hulls bound the distances of all levels, not of the base alone
  Progress progress = {};           ///< stages "verify", "measure" and "query"
};

/// Whether the library was built with the page: node and npm make it.
bool has_page();
constexpr std::string_view kNoPage =
    "prohull was built without the page of `prohull view`, because node or npm was not there: install nodejs and npm, "
    "configure and build again";

constexpr std::size_t kMostShown = 8;

/// A page of HTML that shows hulls, and the mesh that they are hulls of, in any browser. It needs no other file and no
/// network. Verdicts and counts on it are exact, distances are proven bounds; what is drawn is rounded. Without an
/// original, a progressive hull is compared with its own finest level, and all else with nothing. Faces that are not
/// finite are left out, which is said. Throws InputError if a mesh has no finite face, if there are no pieces or balls,
/// if more than kMostShown are given, and if there is no page (has_page); Cancelled.
std::string page(const std::vector<Shown>& shown, const std::optional<Original>& original, const PageOptions& options);

}  // namespace prohull::view
