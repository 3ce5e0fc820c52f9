#include "enclose/tolerances.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "prohull/detail/text.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using Corner = std::array<double, 3>;
using Key = std::array<Corner, 3>;

/// Equal for faces of the same corners, whichever way they look.
Key key_of(const Triangle& t) {
  const auto corner = [](const Vec3& p) { return Corner{p.x, p.y, p.z}; };
  Key key{corner(t.a), corner(t.b), corner(t.c)};
  std::ranges::sort(key);
  return key;
}

bool may_vanish(const Triangle& t) {
  return !is_finite(t.a) || !is_finite(t.b) || !is_finite(t.c) || t.a == t.b || t.b == t.c || t.c == t.a;
}

struct Wanted {
  Key key;
  double tolerance;
  bool is_found = false;
};

}  // namespace

PerFace<double> carried_tolerances(const TriangleMesh& given, const PerFace<double>& tolerances,
                                   const TriangleMesh& repaired) {
  std::vector<Wanted> wanted;
  for (const FaceId f : given.triangles.ids())
    if (!(tolerances[f] == std::numeric_limits<double>::infinity()) && !may_vanish(given.triangle(f)))
      wanted.push_back({key_of(given.triangle(f)), tolerances[f]});
  std::ranges::sort(wanted, [](const Wanted& a, const Wanted& b) {
    return a.key != b.key ? a.key < b.key : a.tolerance < b.tolerance;
  });
  PerFace<double> carried(repaired.face_count(), std::numeric_limits<double>::infinity());
  for (const FaceId f : repaired.triangles.ids()) {
    const Key key = key_of(repaired.triangle(f));
    const auto first = std::ranges::lower_bound(wanted, key, {}, &Wanted::key);
    if (first == wanted.end() || first->key != key) continue;
    carried[f] = first->tolerance;
    for (auto same = first; same != wanted.end() && same->key == key; ++same) same->is_found = true;
  }
  if (const auto lost = static_cast<std::size_t>(std::ranges::count(wanted, false, &Wanted::is_found)); lost > 0)
    throw InputError(Defect::InvalidOption,
                     fmt::format("{} with a tolerance {} not left after the repair, which drops parts inside of other "
                                 "parts; --keep-cavities keeps these",
                                 counted(lost, "face"), lost == 1 ? "is" : "are"));
  return carried;
}

}  // namespace prohull
