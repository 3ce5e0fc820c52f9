#include <pybind11/stl.h>

#include <cstdint>
#include <string>

#include "arrays.h"
#include "module.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

/// The options of build(), by name.
class Keywords {
 public:
  explicit Keywords(const py::dict& values) : values_(values) {}

  template <class T>
  T get(const char* name, const char* expected) const {
    try {
      return values_[name].cast<T>();
    } catch (const py::cast_error&) {
      refuse(name, expected);
    }
  }
  bool flag(const char* name) const { return get<bool>(name, "True or False"); }
  unsigned count(const char* name) const { return get<unsigned>(name, "a whole number, at least 0"); }
  double number(const char* name) const { return get<double>(name, "a number"); }
  double not_negative(const char* name) const {
    const double value = number(name);
    if (!(value >= 0)) refuse(name, "a number, at least 0");
    return value;
  }
  template <class T>
  T choice(const char* name, Names<T> choices) const {
    if (const auto value = value_of(choices, py::str(values_[name]).cast<std::string>())) return *value;
    refuse(name, ("one of " + joined(choices)).c_str());
  }

 private:
  [[noreturn]] void refuse(const char* name, const char* expected) const {
    throw InputError(Defect::InvalidOption,
                     std::string(name) + "=" + std::string(py::repr(values_[name])) + ": expected " + expected);
  }

  const py::dict& values_;
};

EnclosingOptions options_of(const Keywords& given) {
  EnclosingOptions options;
  HullOptions& hull = options.hull;
  hull.side = given.choice("side", hull_side_names());
  hull.strategy = given.choice("strategy", strategy_names());
  hull.self_intersections = given.choice("self_intersections", self_intersections_names());
  hull.guards.max_valence = given.count("max_valence");
  hull.guards.min_compactness_ratio = given.number("min_compactness_ratio");
  hull.guards.sufficient_compactness = given.number("sufficient_compactness");
  hull.guards.max_normal_deviation = given.number("max_normal_deviation");
  hull.relax_guards = given.flag("relax_guards");
  hull.float32_coordinates = given.flag("float32");
  hull.seed = given.get<std::uint64_t>("seed", "a whole number, at least 0");
  hull.best_of = given.count("best_of");
  hull.threads = given.count("threads");
  options.bounds.max_distance = given.not_negative("max_distance");
  options.bounds.max_void_ratio = given.not_negative("max_void");
  options.bounds.max_added_volume = given.not_negative("max_added_volume");
  options.tight = given.flag("tight");
  options.levels = given.flag("levels");
  options.repair = given.choice("repair", repair_names());
  options.keep_cavities = given.flag("keep_cavities");
  options.seal_holes = given.not_negative("seal_holes");
#ifdef PROHULL_HAS_WRAP
  options.wrap = alpha_wrap;
#endif
  return options;
}

py::dict dict_of(const RefusalCounts& counts) {
  py::dict result;
  for (const auto& [name, refusal] : refusal_names())
    if (counts[refusal] > 0) result[py::cast(name)] = counts[refusal];
  return result;
}

/// A hull and what it was built from, which hulls of one run share.
py::dict facts_of(EnclosingHull hull, const SharedMesh& original) {
  py::dict facts;
  facts["mesh"] = std::move(hull.mesh);
  facts["original"] = original;
  facts["levels"] = std::move(hull.levels);
  facts["wrap_alpha"] = hull.wrap_alpha;
  facts["notes"] = hull.notes;
  facts["certified"] = hull.certified;
  facts["proof"] = hull.proof;
  facts["faces_target"] = hull.target_faces;
  facts["reached"] = hull.target_reached;
  facts["bounded"] = hull.within_bounds;
  facts["refused"] = dict_of(hull.refusals);
  facts["blocked"] = dict_of(hull.blocked);
  facts["relaxed_guards"] = hull.relaxed_guards;
  facts["self_intersections"] = hull.self_intersections;
  facts["build_seconds"] = hull.build_seconds;
  facts["verify_seconds"] = hull.verify_seconds;
  return facts;
}

py::list facts_of(EnclosingHulls made) {
  const auto repairs = describe(made.input.repairs);
  SharedMesh closed, triangles;  // each only once, and only if needed
  const auto once = [](SharedMesh& mesh, TriangleMesh& from) {
    if (!mesh) mesh = std::make_shared<TriangleMesh>(std::move(from));
    return mesh;
  };
  py::list hulls;
  for (EnclosingHull& hull : made.hulls) {
    const SharedMesh original =
        hull.wrap_alpha > 0 ? once(triangles, made.input.original) : once(closed, made.input.closed->mesh);
    py::dict facts = facts_of(std::move(hull), original);
    facts["repairs"] = repairs;
    hulls.append(facts);
  }
  return hulls;
}

py::list build(const TriangleMesh& mesh, const std::vector<std::size_t>& targets, const py::object& progress,
               const py::dict& keywords) {
  EnclosingOptions options = options_of(Keywords(keywords));
  return facts_of(watched(progress, [&](Watch& watch) {
    options.progress = watch.progress();
    return enclosing_hulls(mesh, targets, options);
  }));
}

}  // namespace

void bind_construction(py::module_& module) { module.def("build", &build); }

}  // namespace prohull::python
