#include <fmt/format.h>

#include <array>

#include "prohull/detail/text.h"
#include "prohull/hull_builder.h"

namespace prohull {
namespace {

constexpr std::array<std::pair<std::string_view, Strategy>, 3> kStrategyNames{
    {{"lazy", Strategy::Lazy}, {"paper1", Strategy::Paper1}, {"paper2", Strategy::Paper2}}};

constexpr std::array<std::pair<std::string_view, SelfIntersections>, 3> kSelfIntersectionsNames{
    {{"by-strategy", SelfIntersections::ByStrategy},
     {"refused", SelfIntersections::Refused},
     {"allowed", SelfIntersections::Allowed}}};

constexpr std::array<std::pair<std::string_view, Refusal>, kRefusalKinds> kRefusalNames{
    {{"link_condition", Refusal::LinkCondition},
     {"valence", Refusal::Valence},
     {"no_room_outside", Refusal::NoRoomOutside},
     {"certificate", Refusal::Certificate},
     {"compactness", Refusal::Compactness},
     {"normal_deviation", Refusal::NormalDeviation},
     {"self_intersection", Refusal::SelfIntersection},
     {"overhang", Refusal::Overhang},
     {"tolerance", Refusal::Tolerance},
     {"symmetry", Refusal::Symmetry}}};

/// What collapsing the edge would do.
constexpr std::string_view consequence(Refusal refusal) {
  switch (refusal) {
    case Refusal::LinkCondition:
      return "would pinch the surface";
    case Refusal::Valence:
      return "would give a vertex too many triangles";
    case Refusal::NoRoomOutside:
      return "would leave no place for the new vertex";
    case Refusal::Certificate:
      return "would not provably enclose";
    case Refusal::Compactness:
      return "would make a triangle too thin";
    case Refusal::NormalDeviation:
      return "would turn a triangle too far";
    case Refusal::SelfIntersection:
      return "would make the hull intersect itself";
    case Refusal::Overhang:
      return "would make a spike";
    case Refusal::Tolerance:
      return "would go too far from faces with a tolerance";
    case Refusal::Symmetry:
      return "would make the hull asymmetric";
  }
  return "";
}

}  // namespace

Names<Strategy> strategy_names() { return kStrategyNames; }

Names<SelfIntersections> self_intersections_names() { return kSelfIntersectionsNames; }

Names<Refusal> refusal_names() { return kRefusalNames; }

std::string describe_refusals(const RefusalCounts& counts, std::string_view before) {
  std::string text;
  for (const auto& [name, refusal] : kRefusalNames)
    if (const std::size_t count = counts[refusal])
      text += fmt::format("{}{} {}", text.empty() ? before : ", ", grouped(count), consequence(refusal));
  return text;
}

}  // namespace prohull
