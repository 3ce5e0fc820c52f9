#include "construct/progressive/cells.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "geometry/morton_code.h"

namespace prohull {
namespace {

float center(const FloatBox& box, int axis) { return box.min[axis] / 2 + box.max[axis] / 2; }

/// The axis along which the centres of the faces are spread most, and where to split it.
struct Split {
  int axis;
  float at;
};

using Slots = std::vector<std::uint32_t>;  // of faces in a list of all

Split choose_split(const std::vector<BoxedFace>& all, const Slots& slots, double fraction) {
  // Some of them tell enough.
  const std::size_t step = 1 + slots.size() / 1024;
  std::array<std::vector<float>, 3> centers;
  for (std::size_t i = 0; i < slots.size(); i += step)
    for (int axis = 0; axis < 3; ++axis) centers[axis].push_back(center(all[slots[i]].box, axis));
  Split best{0, 0};
  float widest = -1;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& along = centers[axis];
    const auto [least, greatest] = std::ranges::minmax(along);
    if (!(greatest - least > widest)) continue;
    const auto place = along.begin() + std::lround(fraction * static_cast<double>(along.size() - 1));
    std::ranges::nth_element(along, place);
    best = {axis, *place};
    widest = greatest - least;
  }
  return best;
}

std::vector<Cell> split(const std::vector<BoxedFace>& all, Slots slots, const FloatBox& box, std::size_t most_faces,
                        double shift) {
  constexpr double kGoldenRatio = 0.6180339887498949, kMostShared = 0.2, kLargestPart = 0.9;
  if (slots.size() > most_faces) {
    const Split at = choose_split(all, slots, 0.35 + 0.3 * shift);
    Slots below, above;
    below.reserve(slots.size()), above.reserve(slots.size());
    for (const std::uint32_t i : slots) {
      if (all[i].box.min[at.axis] <= at.at) below.push_back(i);
      if (all[i].box.max[at.axis] >= at.at) above.push_back(i);
    }
    const std::size_t shared = below.size() + above.size() - slots.size();
    const auto is_at_most = [&](std::size_t count, double part) {
      return static_cast<double>(count) <= part * static_cast<double>(slots.size());
    };
    if (is_at_most(shared, kMostShared) && is_at_most(std::max(below.size(), above.size()), kLargestPart)) {
      slots = {};
      FloatBox lower = box, upper = box;
      lower.max[at.axis] = upper.min[at.axis] = at.at;
      const double next = std::fmod(shift + kGoldenRatio, 1);
      std::vector<Cell> cells, others;
      oneapi::tbb::parallel_invoke([&] { cells = split(all, std::move(below), lower, most_faces, next); },
                                   [&] { others = split(all, std::move(above), upper, most_faces, next); });
      std::ranges::move(others, std::back_inserter(cells));
      return cells;
    }
  }
  Cell cell{box, {}};
  cell.faces.reserve(slots.size());
  for (const std::uint32_t i : slots) cell.faces.push_back(all[i].face);
  std::vector<Cell> cells;
  cells.push_back(std::move(cell));
  return cells;
}

}  // namespace

FloatBox everywhere() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

std::vector<Cell> split_into_cells(const std::vector<BoxedFace>& faces, std::size_t most_faces, double shift,
                                   const FloatBox& box) {
  Slots all(faces.size());
  std::iota(all.begin(), all.end(), 0u);
  return split(faces, std::move(all), box, most_faces, shift);
}

std::vector<FaceId> along_curve(const std::vector<BoxedFace>& faces) {
  std::vector<std::uint64_t> by_code;
  by_code.reserve(faces.size());
  for (const auto& [face, box] : faces)
    by_code.push_back(std::uint64_t{morton_code(center(box, 0), center(box, 1), center(box, 2))} << 32 | index(face));
  oneapi::tbb::parallel_sort(by_code);
  std::vector<FaceId> sorted;
  sorted.reserve(faces.size());
  for (const std::uint64_t code : by_code) sorted.push_back(FaceId{static_cast<std::uint32_t>(code)});
  return sorted;
}

}  // namespace prohull
