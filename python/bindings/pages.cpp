#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "view/page.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using SharedRobot = std::shared_ptr<view::ShownRobot>;
/// A mesh, levels, convex pieces, balls as rows of four numbers, or a robot.
using Drawn = std::variant<SharedMesh, SharedLevels, SharedRobot, std::vector<SharedMesh>, Array<double>>;

template <class T>
const T& required(const std::shared_ptr<T>& shared) {
  if (!shared) throw py::type_error("None cannot be shown");
  return *shared;
}

/// What view::Shown takes.
struct DrawnOf {
  using Result = decltype(view::Shown::shape);

  template <class T>
  Result operator()(const std::shared_ptr<T>& shared) const {
    return required(shared);
  }
  Result operator()(const std::vector<SharedMesh>& given) const {
    view::Pieces pieces;
    for (const SharedMesh& piece : given) pieces.push_back(required(piece));
    return pieces;
  }
  Result operator()(const Array<double>& given) const { return balls_of(given); }
};

/// Each with its name; of meshes the side on which they lie is told, too.
using Given = std::tuple<std::string, Drawn, std::optional<std::string>>;

view::Shown shown_of(const Given& given) {
  const auto& [name, shape, side] = given;
  view::Shown shown{name, std::visit(DrawnOf{}, shape)};
  if (side) shown.side = value_of(hull_side_names(), *side);
  return shown;
}

std::string page(const std::vector<Given>& given, const std::optional<std::pair<std::string, SharedMesh>>& original,
                 bool solid_only, const std::string& unit, unsigned threads, const py::object& progress) {
  std::vector<view::Shown> shown;
  for (const Given& one : given) shown.push_back(shown_of(one));
  std::optional<view::Original> compared;
  if (original) compared = view::Original{original->first, required(original->second)};
  return watched(progress, [&](Watch& watch) {
    return view::page(shown, compared,
                      {.solid_only = solid_only,
                       .unit = unit,
                       .version = PROHULL_VERSION,
                       .threads = threads,
                       .progress = watch.progress()});
  });
}

}  // namespace

void bind_pages(py::module_& module) {
  py::class_<view::ShownRobot, SharedRobot>(module, "ShownRobot");
  module.attr("no_page") = view::has_page() ? "" : std::string(view::kNoPage);
  module.def("page", &page);
}

}  // namespace prohull::python
