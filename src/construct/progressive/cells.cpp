#include "construct/progressive/cells.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/morton_code.h"

namespace prohull {
namespace {

float center(const FloatBox& box, int axis) { return box.min[axis] / 2 + box.max[axis] / 2; }

/// The axis along which the centres of the faces are spread most, and where to split it.
struct Split {
  int axis;
  float at;
};

Split choose_split(const std::vector<BoxedFace>& faces, double fraction) {
  // Some of them tell enough.
  const std::size_t step = 1 + faces.size() / 1024;
  std::array<std::vector<float>, 3> centers;
  for (std::size_t i = 0; i < faces.size(); i += step)
    for (int axis = 0; axis < 3; ++axis) centers[axis].push_back(center(faces[i].box, axis));
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

std::vector<Cell> split(std::vector<BoxedFace> faces, const FloatBox& box, std::size_t most_faces, double shift) {
  constexpr double kGoldenRatio = 0.6180339887498949, kMostShared = 0.2, kLargestPart = 0.9;
  if (faces.size() > most_faces) {
    const auto [axis, at] = choose_split(faces, 0.35 + 0.3 * shift);
    std::vector<BoxedFace> below, above;
    for (const BoxedFace& face : faces) {
      if (face.box.min[axis] <= at) below.push_back(face);
      if (face.box.max[axis] >= at) above.push_back(face);
    }
    const std::size_t shared = below.size() + above.size() - faces.size();
    const auto is_at_most = [&](std::size_t count, double part) {
      return static_cast<double>(count) <= part * static_cast<double>(faces.size());
    };
    if (is_at_most(shared, kMostShared) && is_at_most(std::max(below.size(), above.size()), kLargestPart)) {
      faces = {};
      FloatBox lower = box, upper = box;
      lower.max[axis] = upper.min[axis] = at;
      const double next = std::fmod(shift + kGoldenRatio, 1);
      std::vector<Cell> cells, others;
      oneapi::tbb::parallel_invoke([&] { cells = split(std::move(below), lower, most_faces, next); },
                                   [&] { others = split(std::move(above), upper, most_faces, next); });
      std::ranges::move(others, std::back_inserter(cells));
      return cells;
    }
  }
  Cell cell{box, {}};
  cell.faces.reserve(faces.size());
  for (const BoxedFace& face : faces) cell.faces.push_back(face.face);
  std::vector<Cell> cells;
  cells.push_back(std::move(cell));
  return cells;
}

}  // namespace

FloatBox everywhere() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

std::vector<Cell> split_into_cells(std::vector<BoxedFace> faces, std::size_t most_faces, double shift,
                                   const FloatBox& box) {
  return split(std::move(faces), box, most_faces, shift);
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
