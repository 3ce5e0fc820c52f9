#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/text.h"
#include "robot/report/report.h"

namespace prohull::robot {

// What all reports say in the same way.

/// UTF-8 that JSON, XML and HTML can hold: other bytes, and control characters, become U+FFFD.
std::string clean_text(std::string_view text);

/// Which bound of a length is written.
enum class Rounded { Nearest, Up, Down };

/// Metres with three digits and a fitting unit: "0.82 mm", "1.24 m". A bound stays one when it is rounded up or down.
std::string length_text(double metres, Rounded rounded = Rounded::Nearest);

/// "0.81 mm", or "0.81 to 0.83 mm" where the bounds differ.
std::string range_text(double at_least, double at_most);

std::string size_text(const LinkHull& hull);               ///< "500 faces", "8 convex pieces", "64 spheres"
std::string ratio_text(std::optional<double> ratio);       ///< "1.06 ×", or "–"
std::optional<double> ratio(double value, double of);      ///< none unless both are positive and finite
std::optional<double> median(std::vector<double> values);  ///< none without values

/// The hulls of a link, its check, and its first hull; nullptr if there is none.
const LinkHulls* hulls_of(const ReportInput& input, std::size_t link);
const LinkCheck* check_of(const ReportInput& input, std::size_t link);
const LinkHull* first_hull(const LinkHulls& hulls);

/// Whether the link has hulls, and all of them are certified.
bool is_certified(const LinkHulls& hulls);

/// Whether the link keeps its collision geometry, because there is no visual geometry to enclose.
bool has_collision_only(const ReportInput& input, const LinkHulls& hulls);

/// Where no link has a hull: "2 links have primitives only, which are kept; 1 link has collision geometry only, which
/// --from collision takes".
std::string why_no_hull(const ReportInput& input);

/// Whether both geometries are there and were compared.
bool was_measured(const LinkCheck& check);

/// How a link stands where it may stick out by `allow`.
enum class Standing { Covered, CoveredButForRounding, Allowed, Leaks, Undecided, NoCollision, NoVisual, NotChecked };
Standing standing(const LinkCheck& check, double allow);

/// What collision geometry does of which all links pass: "covers the visual geometry of every link, or lets it stick
/// out by at most 2.00 mm".
std::string passing_text(std::span<const LinkCheck> checks, double allow);

/// What the shipped collision geometry does: "leaks: the link sticks out by 0.81 to 0.83 mm".
std::string verdict_text(const LinkCheck& check);

/// What is known of a disabled pair by one geometry: "never meets, proven", "meets at joint2 2.54, joint3 0.83".
std::string finding_text(const PairProof& finding, const Robot& robot);
/// By both geometries.
std::string verdict_text(const DisabledCheck& check, const Robot& robot);

enum class Severity { Failure, Look };

/// What needs a look.
struct Mark {
  std::size_t link = 0;
  Severity severity = Severity::Look;
  std::string text;  ///< a sentence without the name of the link
};
std::vector<Mark> marks_of(const ReportInput& input);  ///< in the order of the links; failures first in each

struct Totals {
  std::size_t links = 0, hulled = 0, certified = 0, primitives = 0, skipped = 0, empty = 0;
  std::size_t faces_before = 0, faces_after = 0;     ///< of the links that have hulls, and of their first hulls
  std::size_t non_finite_faces = 0;                  ///< of these links: they were left out
  std::size_t pieces = 0, balls = 0;                 ///< of the links that have these in place of hulls
  std::optional<double> volume_ratio, convex_ratio;  ///< medians: hull / sealed original, hull / convex hull
  std::size_t checked = 0, passed = 0;               ///< links with visual geometry, and those that pass the check
  std::size_t unchecked = 0;                         ///< of the others, those that could not be checked
  std::optional<double> shipped_ratio;               ///< median: shipped collision geometry / sealed original
  double sticks_out_at_least = 0, sticks_out_at_most = 0;  ///< the greatest of the links that do not pass
  std::size_t failures = 0, looks = 0;                     ///< marks
};
Totals totals_of(const ReportInput& input);

/// What the report comes to.
struct Finding {
  bool good = true;
  std::string text;
};
std::vector<Finding> findings_of(const ReportInput& input);

}  // namespace prohull::robot
