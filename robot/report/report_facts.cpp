#include "robot/report/report_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/detail/rounded.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

double rounded_to(double value, int digits, Rounded rounded) {
  if (rounded == Rounded::Nearest) return nearest_of_digits(value, digits);
  return rounded == Rounded::Up ? rounded_up(value, digits) : rounded_down(value, digits);
}

struct Unit {
  double metres;
  std::string_view name;
};

Unit unit_of(double metres) {
  if (metres >= 1) return {1, "m"};
  if (metres >= 1e-5 || metres == 0) return {1e-3, "mm"};
  return {1e-6, "µm"};
}

std::string number_in(const Unit& unit, double metres, Rounded rounded) {
  if (!(metres > 0)) return "0";
  constexpr int kDigits = 3, kMostDecimals = 12;
  const int whole = static_cast<int>(std::floor(std::log10(metres / unit.metres))) + 1;
  const double value = rounded_to(metres, std::max(kDigits, whole), rounded) / unit.metres;  // moves the decimal point
  if (kDigits - whole > kMostDecimals) return fmt::format("{:.{}e}", value, kDigits - 1);
  return fmt::format("{:.{}f}", value, std::max(kDigits - whole, 0));
}

bool is_hull(const LinkHull& hull) { return hull.pieces.empty() && hull.balls.empty(); }

std::string sentence_of_hull(const LinkHull& hull, std::string_view what) {
  return fmt::format("The {} {} {}", is_hull(hull) ? "hull with" : "union of", size_text(hull), what);
}

void mark_hull(std::size_t link, const LinkHulls& link_hulls, const LinkHull& hull, std::vector<Mark>& marks) {
  constexpr double kFat = 1.1;
  const auto add = [&](Severity severity, std::string_view what) {
    marks.push_back({link, severity, sentence_of_hull(hull, what)});
  };
  if (!hull.certified()) add(Severity::Failure, "is not certified: it may not enclose the link.");
  if (!hull.target_reached)
    add(Severity::Look, fmt::format("has more faces than the {} asked for.", grouped(hull.target_faces)));
  if (!hull.within_bounds) add(Severity::Look, "does not keep the bound of the distance.");
  if (const auto fat = ratio(hull.volume, link_hulls.sealed_volume); is_hull(hull) && fat && *fat > kFat)
    add(Severity::Look, fmt::format("has {} the {}volume of the original.", ratio_text(fat),
                                    link_hulls.is_estimated ? "estimated " : ""));
  if (hull.self_intersections > 0)
    add(Severity::Look,
        fmt::format("intersects itself: {}.", counted(hull.self_intersections, "pair of faces", "pairs of faces")));
}

void mark_check(const ReportInput& input, const LinkCheck& check, std::vector<Mark>& marks) {
  if (!passes(check, input.allow))
    // New hulls mend what was shipped.
    marks.push_back({check.link, input.hulls.empty() ? Severity::Failure : Severity::Look,
                     fmt::format("The shipped collision geometry {}.", verdict_text(check))});
}

void mark_motion(const ReportInput& input, std::size_t link, std::vector<Mark>& marks) {
  if (!input.motion) return;
  const auto& links = input.file.robot.links;
  for (const MotionPair& pair : input.motion->pairs)
    if (pair.missed > 0 && pair.a == link)
      marks.push_back({link, Severity::Failure,
                       fmt::format("In {} a collision with {} is missed: a failed certificate.",
                                   counted(pair.missed, "configuration"), clean_text(links[pair.b].name))});
}

std::string sum_up_hulls(const Totals& totals, std::string_view geometry, std::string_view covers) {
  const std::string hulled = counted(totals.hulled, "link");
  if (totals.certified < totals.hulled)
    return fmt::format("{} of {} with {} {} not certified.", totals.hulled - totals.certified, hulled, covers,
                       totals.hulled - totals.certified == 1 ? "is" : "are");
  const std::string_view cover = covers == "hulls" ? "hull" : covers;
  const std::string_view point = totals.non_finite_faces > 0 ? "no point of a finite triangle" : "no point";
  const bool all = totals.hulled == totals.links;
  if (totals.hulled == 1)
    return fmt::format("The one link {}is certified: {} of its {} lies outside of its {}.",
                       all                 ? ""
                       : covers == "hulls" ? "with a hull "
                                           : fmt::format("with {} ", covers),
                       point, geometry, cover);
  return fmt::format("All {} {}are certified: {} of their {} lies outside of its {}.", hulled,
                     all ? "" : fmt::format("with {} ", covers), point, geometry, cover);
}

Finding finding_of_checks(const Totals& totals, const ReportInput& input) {
  if (totals.passed == totals.checked)
    return {true, fmt::format("The shipped collision geometry {}.", passing_text(input.shipped, input.allow))};
  std::string text = fmt::format("The shipped collision geometry does not cover {} of {}",
                                 totals.checked - totals.passed - totals.unchecked, counted(totals.checked, "link"));
  if (totals.unchecked > 0) text += fmt::format(", and could not be checked for {}", totals.unchecked);
  if (totals.sticks_out_at_most > 0)
    text += fmt::format("; what sticks out farthest does so by {}",
                        range_text(totals.sticks_out_at_least, totals.sticks_out_at_most));
  return {false, text + "."};
}

Finding finding_of_motion(const MotionResult& motion, std::string_view covers) {
  const std::string moved = counted(motion.configurations, "random configuration");
  if (motion.missed() > 0)
    return {false, fmt::format("In {}, {} of the visual geometry {} missed: failed certificates.", moved,
                               counted(motion.missed(), "collision"), motion.missed() == 1 ? "is" : "are")};
  return {true,
          fmt::format("In {}, no collision of the visual geometry is missed. With the {} there are {}, with convex "
                      "hulls {}.",
                      moved, covers, counted(motion.false_hull(), "false collision"), grouped(motion.false_convex()))};
}

void count_hulls(const LinkHulls& hulls, Totals& totals) {
  totals.primitives += hulls.status == LinkStatus::Primitives;
  totals.skipped += hulls.status == LinkStatus::Skipped || hulls.status == LinkStatus::Unread;
  totals.empty += hulls.status == LinkStatus::Empty;
  const LinkHull* const first = first_hull(hulls);
  if (!first) return;
  ++totals.hulled;
  totals.certified += is_certified(hulls);
  totals.faces_before += hulls.triangles.face_count(), totals.non_finite_faces += hulls.non_finite_faces;
  if (first->balls.empty()) totals.faces_after += first->mesh.face_count();
  totals.pieces += first->pieces.size(), totals.balls += first->balls.size();
}

void count_check(const LinkCheck& check, double allow, Totals& totals) {
  if (check.verdict == CheckVerdict::NoVisual) return;
  ++totals.checked;
  if (passes(check, allow)) {
    ++totals.passed;
    return;
  }
  totals.unchecked += check.verdict == CheckVerdict::Missing;
  totals.sticks_out_at_least = std::max(totals.sticks_out_at_least, check.sticks_out_at_least);
  totals.sticks_out_at_most = std::max(totals.sticks_out_at_most, check.sticks_out_at_most);
}

/// The first hulls' volumes by that of something else.
std::optional<double> median_ratio(const ReportInput& input, double LinkHulls::*of) {
  std::vector<double> ratios;
  for (const LinkHulls& hulls : input.hulls)
    if (const LinkHull* const first = first_hull(hulls))
      if (const auto r = ratio(first->volume, hulls.*of)) ratios.push_back(*r);
  return median(std::move(ratios));
}

std::optional<double> median_shipped_ratio(const ReportInput& input) {
  std::vector<double> ratios;
  for (const LinkCheck& check : input.shipped)
    if (const auto r = ratio(check.collision_volume, check.visual_volume); r && was_measured(check))
      ratios.push_back(*r);
  return median(std::move(ratios));
}

template <class Entry>
const Entry* entry_of(const std::vector<Entry>& entries, std::size_t link) {
  const auto found = std::ranges::find(entries, link, &Entry::link);
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    clean += length > 0 ? text.substr(0, length) : kReplacement;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

std::string length_text(double metres, Rounded rounded) {
  if (!std::isfinite(metres)) return "unbounded";
  const Unit unit = unit_of(metres);
  return fmt::format("{} {}", number_in(unit, metres, rounded), unit.name);
}

std::string range_text(double at_least, double at_most) {
  if (!std::isfinite(at_most)) return fmt::format("at least {}", length_text(at_least, Rounded::Down));
  const Unit unit = unit_of(at_most);
  const std::string least = number_in(unit, at_least, Rounded::Down), most = number_in(unit, at_most, Rounded::Up);
  return least == most ? fmt::format("{} {}", most, unit.name) : fmt::format("{} to {} {}", least, most, unit.name);
}

std::string size_text(const LinkHull& hull) {
  if (!hull.pieces.empty()) return counted(hull.pieces.size(), "convex piece");
  if (!hull.balls.empty()) return counted(hull.balls.size(), "sphere");
  return counted(hull.mesh.face_count(), "face");
}

std::string ratio_text(std::optional<double> ratio) { return ratio ? times_text(*ratio) + " ×" : "–"; }

std::optional<double> ratio(double value, double of) {
  const bool known = std::isfinite(value) && std::isfinite(of) && value > 0 && of > 0 && std::isfinite(value / of);
  return known ? std::optional(value / of) : std::nullopt;
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

const LinkHull* first_hull(const LinkHulls& hulls) {
  return hulls.status == LinkStatus::Hulled && !hulls.hulls.empty() ? &hulls.hulls.front() : nullptr;
}

const LinkHulls* hulls_of(const ReportInput& input, std::size_t link) { return entry_of(input.hulls, link); }
const LinkCheck* check_of(const ReportInput& input, std::size_t link) { return entry_of(input.shipped, link); }

bool is_certified(const LinkHulls& hulls) {
  return first_hull(hulls) && std::ranges::all_of(hulls.hulls, &LinkHull::certified);
}

bool has_collision_only(const ReportInput& input, const LinkHulls& hulls) {
  return hulls.status == LinkStatus::Empty && !input.file.robot.links[hulls.link].collision.empty();
}

std::string why_no_hull(const ReportInput& input) {
  std::string text;
  const auto add = [&](const auto& is, std::string_view one, std::string_view many) {
    const auto links = static_cast<std::size_t>(std::ranges::count_if(input.hulls, is));
    if (links > 0) text += (text.empty() ? "" : "; ") + counted(links, one, many);
  };
  add([](const LinkHulls& hulls) { return hulls.status == LinkStatus::Primitives; },
      "link has primitives only, which are kept", "links have primitives only, which are kept");
  add([&](const LinkHulls& hulls) { return has_collision_only(input, hulls); },
      "link has collision geometry only, which --from collision takes",
      "links have collision geometry only, which --from collision takes");
  add([](const LinkHulls& hulls) { return !hulls.why.empty(); }, "link is left as it is, with nothing proven",
      "links are left as they are, with nothing proven");
  if (!text.empty()) return text;
  return fmt::format("no link has {} geometry", input.from == Geometry::Visual ? "visual" : "collision");
}

bool was_measured(const LinkCheck& check) {
  return check.verdict == CheckVerdict::Covered || check.verdict == CheckVerdict::Leaks ||
         check.verdict == CheckVerdict::Undecided;
}

Standing standing(const LinkCheck& check, double allow) {
  switch (check.verdict) {
    case CheckVerdict::Covered:
      return Standing::Covered;
    case CheckVerdict::Leaks:
      return passes(check, allow) ? Standing::Allowed : Standing::Leaks;
    case CheckVerdict::Undecided:
      if (passes(check, 0)) return Standing::CoveredButForRounding;
      return passes(check, allow) ? Standing::Allowed : Standing::Undecided;
    case CheckVerdict::NoCollision:
      return Standing::NoCollision;
    case CheckVerdict::NoVisual:
      return Standing::NoVisual;
    case CheckVerdict::Missing:
      break;
  }
  return Standing::NotChecked;
}

std::string passing_text(std::span<const LinkCheck> checks, double allow) {
  const auto any = [&](Standing is) {
    return std::ranges::any_of(checks, [&](const LinkCheck& check) { return standing(check, allow) == is; });
  };
  return fmt::format("covers the visual geometry of every link{}",
                     any(Standing::Allowed)
                         ? fmt::format(", or lets it stick out by at most {}", length_text(allow, Rounded::Up))
                     : any(Standing::CoveredButForRounding) ? ", but for rounding"
                                                            : ", exactly");
}

std::string verdict_text(const LinkCheck& check) {
  switch (check.verdict) {
    case CheckVerdict::Covered:
      return "covers the visual geometry";
    case CheckVerdict::Leaks:
      return fmt::format("leaks: the link sticks out by {}",
                         range_text(check.sticks_out_at_least, check.sticks_out_at_most));
    case CheckVerdict::Undecided:
      return fmt::format("is not decided: the link sticks out by at most {}",
                         length_text(check.sticks_out_at_most, Rounded::Up));
    case CheckVerdict::NoCollision:
      return "is missing: nothing covers the link";
    case CheckVerdict::NoVisual:
      return "has nothing to cover";
    case CheckVerdict::Missing:
      return "could not be checked; the notes say why";
  }
  return {};
}

std::string finding_text(const PairProof& finding, const Robot& robot) {
  switch (finding.verdict) {
    case PairVerdict::Unknown:
      return "names no two links of the robot";
    case PairVerdict::Adjacent:
      return "is adjacent";
    case PairVerdict::NoGeometry:
      return "is missing for one of the two";
    case PairVerdict::Never:
      return "never meets, proven";
    case PairVerdict::Always:
      return "always meets, proven";
    case PairVerdict::Open:
      return fmt::format("is open, {:.3g} % of the positions are proven free: {}",
                         rounded_down(100 * finding.proven_free, 3), clean_text(finding.why));
    case PairVerdict::Meets:
      break;
  }
  return "meets at " + clean_text(positions_text(robot, finding.positions));
}

std::string verdict_text(const DisabledCheck& check, const Robot& robot) {
  const std::string collision = finding_text(check.collision, robot);
  if (check.collision.verdict == PairVerdict::Unknown || check.collision.verdict == PairVerdict::Adjacent)
    return collision;
  return fmt::format("the collision geometry {}; the visual geometry {}", collision, finding_text(check.visual, robot));
}

std::vector<Mark> marks_of(const ReportInput& input) {
  std::vector<Mark> marks;
  for (std::size_t link = 0; link < input.file.robot.links.size(); ++link) {
    const auto begin = static_cast<std::ptrdiff_t>(marks.size());
    if (const LinkHulls* const hulls = hulls_of(input, link)) {
      for (const LinkHull& hull : hulls->hulls) mark_hull(link, *hulls, hull, marks);
      if (hulls->status == LinkStatus::Skipped)
        marks.push_back({link, Severity::Look, fmt::format("It was skipped: {}", clean_text(hulls->why))});
      if (hulls->status == LinkStatus::Unread)
        marks.push_back({link, Severity::Failure, fmt::format("It has no hull: {}", clean_text(hulls->why))});
      if (has_collision_only(input, *hulls))
        marks.push_back(
            {link, Severity::Look, "It has collision geometry only, which it keeps; nothing about it was looked at."});
    }
    if (const LinkCheck* const check = check_of(input, link)) mark_check(input, *check, marks);
    mark_motion(input, link, marks);
    std::stable_sort(marks.begin() + begin, marks.end(),
                     [](const Mark& a, const Mark& b) { return a.severity < b.severity; });
  }
  return marks;
}

Totals totals_of(const ReportInput& input) {
  Totals totals;
  totals.links = input.file.robot.links.size();
  for (const LinkHulls& hulls : input.hulls) count_hulls(hulls, totals);
  for (const LinkCheck& check : input.shipped) count_check(check, input.allow, totals);
  totals.volume_ratio = median_ratio(input, &LinkHulls::sealed_volume);
  totals.convex_ratio = median_ratio(input, &LinkHulls::convex_volume);
  totals.shipped_ratio = median_shipped_ratio(input);
  for (const Mark& mark : marks_of(input)) ++(mark.severity == Severity::Failure ? totals.failures : totals.looks);
  return totals;
}

std::vector<Finding> findings_of(const ReportInput& input) {
  const Totals totals = totals_of(input);
  const bool visual = input.from == Geometry::Visual;
  std::vector<Finding> findings;
  if (totals.hulled > 0)
    findings.push_back({totals.certified == totals.hulled,
                        sum_up_hulls(totals, visual ? "visual meshes" : "collision meshes", cover_words(input.hulls))});
  else if (!input.hulls.empty())
    findings.push_back({true, fmt::format("No hull was made: {}.", why_no_hull(input))});
  if (totals.checked > 0) findings.push_back(finding_of_checks(totals, input));
  if (input.motion) findings.push_back(finding_of_motion(*input.motion, cover_words(input.hulls)));
  if (!input.disabled.empty()) {
    const auto refuted = static_cast<std::size_t>(std::ranges::count_if(input.disabled, &DisabledCheck::is_refuted));
    findings.push_back({refuted == 0, fmt::format("{} of the SRDF {} refuted: the two links meet.",
                                                  counted(refuted, "disabled pair"), refuted == 1 ? "is" : "are")});
  }
  if (findings.empty()) findings.push_back({true, "No link has visual geometry: there was nothing to do."});
  return findings;
}

}  // namespace prohull::robot
