#include "levels.h"

#include <utility>

namespace prohull::js {
namespace {

template <class Id>
val array_of_ids(const std::vector<Id>& ids) {
  return array_of(reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size());
}

/// `name` is for messages.
std::vector<std::uint32_t> indices_of(const val& array, const std::string& name) {
  std::vector<std::uint32_t> result;
  for (const double number : numbers_of(array, name)) {
    check_whole(number, name, 0);
    result.push_back(static_cast<std::uint32_t>(number));
  }
  return result;
}

}  // namespace

val object_of_levels(const ProgressiveHull& hull) {
  std::vector<std::uint32_t> splits;
  splits.reserve(6 * hull.splits().size());
  for (const VertexSplit& s : hull.splits())
    splits.insert(splits.end(), {index(s.o), index(s.d), index(s.l), index(s.r), s.od, s.do_});
  val object = val::object();
  object.set("side", std::string(name_of(hull_side_names(), hull.side())));
  object.set("finestLevel", std::string(name_of(finest_level_names(), hull.finest_level())));
  object.set("originalVertices", hull.original_vertex_count());
  object.set("positions",
             array_of(reinterpret_cast<const double*>(hull.positions().data()), 3 * hull.positions().size()));
  object.set("baseCorners", array_of_ids(hull.base_corners()));
  object.set("splits", array_of(splits.data(), splits.size()));
  return object;
}

ProgressiveHull levels_of(const val& levels) {
  HullSide side = HullSide::Outer;
  std::size_t vertices = 0;
  const Given given(levels);
  FinestLevel finest = FinestLevel::Input;
  given.choice("side", hull_side_names(), side);
  given.choice("finest_level", finest_level_names(), finest);
  given.count("original_vertices", vertices);
  const std::vector<double> numbers = numbers_of(levels["positions"], "levels.positions");
  std::vector<Vec3> positions(numbers.size() / 3);
  for (std::size_t i = 0; i < 3 * positions.size(); ++i) positions[i / 3][static_cast<int>(i % 3)] = numbers[i];
  std::vector<VertexId> corners;
  for (const std::uint32_t corner : indices_of(levels["baseCorners"], "levels.baseCorners"))
    corners.push_back(VertexId(corner));
  const std::vector<std::uint32_t> fields = indices_of(levels["splits"], "levels.splits");
  std::vector<VertexSplit> splits(fields.size() / 6);
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const std::uint32_t* const f = &fields[6 * i];
    splits[i] = {VertexId(f[0]), VertexId(f[1]), VertexId(f[2]), VertexId(f[3]), f[4], f[5]};
  }
  if (numbers.size() % 3 != 0 || fields.size() % 6 != 0 || positions.size() != vertices + splits.size() ||
      corners.size() % 3 != 0 || 2 * splits.size() > corners.size() / 3)
    throw InputError(Defect::Malformed, "levels: its arrays do not belong together");
  ProgressiveHull hull(side, vertices, PerVertex<Vec3>(std::move(positions)), std::move(corners), std::move(splits));
  if (const auto defect = first_defect(hull)) throw InputError(Defect::Malformed, "levels: " + *defect);
  return hull.with_finest_level(finest);
}

}  // namespace prohull::js
